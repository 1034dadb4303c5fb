/* SPDX-License-Identifier: MIT
 *
 * grid_edit - elements, rows and pins of a rung: putting, changing, branching, deleting.
 *
 * Deleting leaves a wire where power must pass. A branch with nothing but wire would be a
 * short circuit and is removed; so are rows that become empty.
 *
 * A branch needs a row with free cells whose ends can be linked to the rung without
 * touching another circuit; if there is none, a new row is inserted. Below a box whose pins
 * are fed there is no such row, because their feeding wires come from the left; a branch
 * around such a box goes above it.
 *
 * It knows words only by their rows of the catalogue.
 */
#include "editor-gtk/edit/grid_spread.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/model/args.h"

#include <string.h>

static const char *const refusal_text[] = {
#define REFUSAL(id, text) text,
#include "editor-gtk/edit/grid_refusal.def"
};

const char *grid_refusal_text(enum grid_refusal refusal)
{
	return refusal < GRID_REFUSAL_COUNT ? refusal_text[refusal] : "";
}

static bool is_cell(struct spread *c, const struct grid_at *at)
{
	return (at->row >= 0 && at->row < LIMIT_ROWS && at->col >= 0 &&
		at->col < c->rung->cols) || spread_fail(c, GRID_OUTSIDE);
}

/* Spreads the rung out; @why: the refusal if there is no cell at @at. */
static bool at_cell(struct spread *c, const struct rung *rung, struct grid_at *at,
		    enum grid_refusal why)
{
	return spread_open(c, rung, at->columns, 1) &&
	       ((at->row >= 0 && at->row < c->rung->rows && at->col >= 0 &&
		 at->col < c->rung->cols) || spread_fail(c, why));
}

/* ---- deleting ---- */

/* The wire on both sides of a place, from bar to bar, up to the next joint. */
struct stretch { int left, right; };

static struct stretch stretch_at(const struct spread *c, int row, int col)
{
	struct stretch s = { col, col + 1 };

	while (s.left > 0 && spread_word(c, row, s.left - 1) == ELEM_WIRE &&
	       !spread_linked(c, row, s.left))
		s.left--;
	while (s.right < c->rung->cols && spread_word(c, row, s.right) == ELEM_WIRE &&
	       !spread_linked(c, row, s.right))
		s.right++;
	return s;
}

static int feeders(const struct network *n, int net)
{
	return n->first_feeder[net + 1] - n->first_feeder[net];
}

/* Must power pass (@row, @col), which is empty now? Yes if the net behind it is read and
 * has no other feeder, or the net before it is fed and leads nowhere else. */
static bool must_pass(struct spread *c, int row, int col)
{
	const struct network *n = &c->network;
	int in, out;

	if (!spread_network(c))
		return false;
	in = network_net(n, row, col);
	out = network_net(n, row, col + 1);
	if (in == out || out == NET_RAIL || n->reader_count[out] == 0)
		return false;
	return feeders(n, out) == 0 ||
	       (in != NET_RAIL && n->reader_count[in] == 0 && feeders(n, in) > 0);
}

/* Erases a wire at bar @bar of @row that ends in nothing. Returns the bar of its other end;
 * -1: there was none. */
static int erase_end(struct spread *c, int row, int bar)
{
	const int from = bar;

	if (spread_linked(c, row, bar))
		return -1;
	if (!spread_right(c, row, bar))
		while (bar > 0 && spread_word(c, row, bar - 1) == ELEM_WIRE &&
		       (bar == from || !spread_linked(c, row, bar)))
			spread_clear(c, row, --bar);
	else if (bar > 0 && !spread_left(c, row, bar))
		while (spread_word(c, row, bar) == ELEM_WIRE &&
		       (bar == from || !spread_linked(c, row, bar)))
			spread_clear(c, row, bar++);
	return bar == from ? -1 : bar;
}

/* Erases links and wires that led only to bar @bar of @row. */
static void erase_way(struct spread *c, int row, int bar)
{
	while (bar >= 0) {
		row = spread_prune(c, row, bar);
		bar = erase_end(c, row, bar);
	}
}

static void erase_stretch(struct spread *c, int row, struct stretch s)
{
	for (int col = s.left; col < s.right; col++)
		spread_clear(c, row, col);
	erase_way(c, row, s.left);
	erase_way(c, row, s.right);
}

/* ---- a remaining branch moves up ---- */

/* Does the row below hold a branch from bar to bar, and nothing beside it? */
static bool can_pull(const struct spread *c, int row, struct stretch s)
{
	const int below = row + 1;

	if (below >= c->rung->rows || !spread_up(c, below, s.right) ||
	    (s.left > 0 && !spread_up(c, below, s.left)) ||
	    spread_left(c, below, s.left) || spread_right(c, below, s.right))
		return false;
	for (int col = s.left; col < s.right; col++)
		if (!spread_is_empty(c, row, col) || spread_is_empty(c, below, col) ||
		    spread_word(c, below, col) == ELEM_PIN ||
		    rung_height(c->rung, below, col) > 1 ||
		    (col > s.left && spread_up(c, below, col)))
			return false;
	return true;
}

static void pull_up(struct spread *c, int row, struct stretch s)
{
	if (!can_pull(c, row, s))
		return;
	for (int col = s.left; col < s.right; col++) {
		spread_put(c, row, col, *spread_cell(c, row + 1, col));
		spread_clear(c, row + 1, col);
	}
	/* Links from further below now lead up to @row. */
	for (int bar = s.left > 0 ? s.left : 1; bar <= s.right; bar++)
		spread_cell(c, row + 1, bar - 1)->link =
			spread_down(c, row + 1, bar);
	spread_drop_row(c, row + 1);
}

/* ---- one element ---- */

/* Erases the wire that leads only to bar @col of @row. */
static void erase_left(struct spread *c, int row, int col)
{
	while (col > 0 && !spread_linked(c, row, col) &&
	       spread_word(c, row, col - 1) == ELEM_WIRE)
		spread_clear(c, row, --col);
	spread_prune(c, row, col);
}

static void remove_pin(struct spread *c, int row, int col)
{
	rung_clear_cell(c->rung, row, col);
	erase_left(c, row, col);
}

static struct stretch take_out(struct spread *c, int row, int col)
{
	struct stretch s;

	for (int i = rung_height(c->rung, row, col) - 1; i > 0; i--)
		remove_pin(c, row + i, col);
	spread_clear(c, row, col);
	s = stretch_at(c, row, col);
	if (must_pass(c, row, col))
		spread_cell(c, row, col)->word = ELEM_WIRE;
	else
		erase_stretch(c, row, s);
	return s;
}

/* Rows that were empty before the edit: those stay. */
struct bare { bool row[LIMIT_ROWS]; };

static void look_for_bare(const struct spread *c, struct bare *bare)
{
	for (int row = 0; row < c->rung->rows; row++)
		bare->row[row] = spread_is_bare(c, row);
}

/* Removes rows that are empty now, but not @keep; returns the new index of that. */
static int drop_rows(struct spread *c, const struct bare *bare, int keep)
{
	for (int row = c->rung->rows - 1; row >= 0; row--) {
		const int before = c->rung->rows;

		if (bare->row[row] || row == keep)
			continue;
		spread_drop_row(c, row);
		if (row < keep && c->rung->rows < before)
			keep--;
	}
	return keep;
}

void spread_delete_whole(struct spread *c, int row, int col)
{
	struct stretch s;
	struct bare bare;

	look_for_bare(c, &bare);
	s = take_out(c, row, col);
	row = drop_rows(c, &bare, row);
	pull_up(c, row, s);
	spread_drop_row(c, row);
}

static void erase_wire(struct spread *c, int row, int col)
{
	spread_clear(c, row, col);
	spread_prune(c, row, col);
	spread_prune(c, row, col + 1);
	spread_drop_row(c, row);
}

struct rung *grid_delete(const struct rung *rung, struct grid_at *at)
{
	struct spread c;

	if (at_cell(&c, rung, at, GRID_NOTHING)) {
		const int row = at->row, col = at->col;

		if (spread_is_element(&c, row, col)) {
			spread_delete_whole(&c, row, col);
		} else if (spread_word(&c, row, col) == ELEM_PIN) {
			remove_pin(&c, row, col);
			spread_drop_row(&c, row);
		} else if (spread_word(&c, row, col) == ELEM_WIRE) {
			erase_wire(&c, row, col);
		} else if (spread_up(&c, row, col + 1)) {
			spread_cell(&c, row, col)->link = 0;
			spread_prune(&c, row, col + 1);
			spread_drop_row(&c, row);
		} else if (spread_cell(&c, row, col)->comment) {
			spread_clear(&c, row, col);
		} else {
			spread_fail(&c, GRID_NOTHING);
		}
	}
	return spread_close(&c, at);
}

/* ---- an area ---- */

static bool clip(const struct spread *c, struct grid_area *area)
{
	if (area->row < 0)
		area->row = 0;
	if (area->col < 0)
		area->col = 0;
	if (area->last_row >= c->rung->rows)
		area->last_row = c->rung->rows - 1;
	if (area->last_col >= c->rung->cols)
		area->last_col = c->rung->cols - 1;
	return area->row <= area->last_row && area->col <= area->last_col;
}

/* Backwards, so that a branch is deleted before the element it is parallel to. */
static bool delete_elements(struct spread *c, const struct grid_area *area)
{
	bool any = false;

	for (int row = area->last_row; row >= area->row; row--)
		for (int col = area->last_col; col >= area->col; col--) {
			if (!spread_is_element(c, row, col))
				continue;
			take_out(c, row, col);
			any = true;
		}
	return any;
}

static bool delete_wires(struct spread *c, const struct grid_area *area)
{
	bool any = false;

	for (int row = area->last_row; row >= area->row; row--)
		for (int col = area->last_col; col >= area->col; col--) {
			struct cell *cell = spread_cell(c, row, col);

			if (cell->word == ELEM_PIN ||
			    (cell->word == ELEM_EMPTY && !cell->link))
				continue;
			*cell = (struct cell){ .word = ELEM_EMPTY };
			spread_prune(c, row, col);
			spread_prune(c, row, col + 1);
			any = true;
		}
	return any;
}

struct rung *grid_delete_area(const struct rung *rung, struct grid_at *at,
			      const struct grid_area *area)
{
	struct grid_area clipped = *area;
	struct spread c;

	if (spread_open(&c, rung, at->columns, 1)) {
		struct bare bare;

		look_for_bare(&c, &bare);
		if (!clip(&c, &clipped) || (!delete_elements(&c, &clipped) &&
					    !delete_wires(&c, &clipped)))
			spread_fail(&c, GRID_NOTHING);
		else
			drop_rows(&c, &bare, -1);
	}
	return spread_close(&c, at);
}

/* ---- branches ---- */

/* A branch to be made: cells first … last of a row, its ends at bars left and right; right
 * -1: an output ends it. */
struct reach { int row, first, last, left, right; };

static int net_at(const struct spread *c, int row, int bar)
{
	return network_net(&c->network, row, bar);
}

/* May bar @bar of @row be joined with the same bar of the branch's row? */
static bool may_join(const struct spread *c, const struct reach *reach, int row, int bar)
{
	return bar < 0 || !spread_bar_used(c, row, bar) ||
	       net_at(c, row, bar) == net_at(c, reach->row, bar);
}

static bool is_passable(const struct spread *c, const struct reach *reach, int row)
{
	return may_join(c, reach, row, reach->left) &&
	       may_join(c, reach, row, reach->right);
}

static bool is_free(const struct spread *c, const struct reach *reach, int row)
{
	for (int col = reach->first; col <= reach->last; col++) {
		if (!spread_is_empty(c, row, col))
			return false;
		if (col > reach->first && spread_linked(c, row, col))
			return false;
	}
	return (reach->right >= 0 || !spread_linked(c, row, reach->last + 1)) &&
	       is_passable(c, reach, row);
}

/* Can a row for the branch be inserted before @row, without cutting a box or crossing
 * links? */
static bool may_insert(const struct spread *c, const struct reach *reach, int row)
{
	for (int col = reach->first; col <= reach->last; col++)
		if (spread_word(c, row, col) == ELEM_PIN ||
		    (col > reach->first && spread_up(c, row, col)))
			return false;
	return true;
}

/* The first free row below, or a new one before the first obstacle; -1: none. */
static int row_below(struct spread *c, const struct reach *reach)
{
	int row = reach->row + 1, put_in = -1;

	for (; row < c->rung->rows; row++) {
		if (is_free(c, reach, row))
			return row;
		if (may_insert(c, reach, row))
			put_in = row;
		if (!is_passable(c, reach, row))
			break;
	}
	if (row == c->rung->rows)
		return spread_rows(c, row + 1) ? row : -1;
	return put_in >= 0 && spread_insert_row(c, put_in) ? put_in : -1;
}

/* The same above; a new row is inserted right before that of the branch. */
static int row_above(struct spread *c, const struct reach *reach)
{
	for (int row = reach->row - 1; row >= 0; row--) {
		if (is_free(c, reach, row))
			return row;
		if (!is_passable(c, reach, row))
			break;
	}
	return may_insert(c, reach, reach->row) && spread_insert_row(c, reach->row) ?
	       reach->row : -1;
}

static int find_row(struct spread *c, const struct reach *reach)
{
	int row = -1;

	if (spread_network(c))
		row = row_below(c, reach);
	if (row < 0)
		spread_fail(c, GRID_CROSSING);
	return row;
}

int spread_branch_row(struct spread *c, int *row, int col, int last)
{
	const struct reach reach = { *row, col, last, col, last + 1 };
	const int rows = c->rung->rows;
	int found = -1;

	if (spread_network(c))
		found = row_below(c, &reach);
	if (found < 0 && c->refusal == GRID_DONE) {
		found = row_above(c, &reach);
		*row += c->rung->rows - rows;
	}
	if (found < 0)
		spread_fail(c, GRID_CROSSING);
	return found;
}

/* Only up to the first row that is already joined with @row. */
void spread_join_branch(struct spread *c, int row, int branch, int bar)
{
	const bool old = c->rung->rows == c->network.rows;
	int top = branch - 1;

	if (old && net_at(c, branch, bar) == net_at(c, row, bar))
		return;
	if (branch < row) {
		spread_join_up(c, branch, row, bar);
		return;
	}
	while (top > row && net_at(c, top, bar) != net_at(c, row, bar))
		top--;
	spread_join_up(c, top, branch, bar);
}

/* ---- outputs ---- */

/* Puts an output in a row below @row, on a branch from bar @bar of it. */
static int branch_output(struct spread *c, int row, int bar, struct cell cell)
{
	const int last = spread_last(c);
	const struct reach reach = { row, bar, last, bar, -1 };
	const int below = find_row(c, &reach);

	if (below < 0)
		return -1;
	spread_join_branch(c, row, below, bar);
	for (int col = bar; col < last; col++)
		spread_cell(c, below, col)->word = ELEM_WIRE;
	spread_put(c, below, last, cell);
	return below;
}

/* The bar where the wire to the output of @row begins. */
static int output_bar(const struct spread *c, int row)
{
	int bar = spread_last(c);

	while (bar > 0 && spread_word(c, row, bar - 1) == ELEM_WIRE &&
	       !spread_linked(c, row, bar))
		bar--;
	return bar;
}

static int output_below(struct spread *c, int row, struct cell cell)
{
	return branch_output(c, row, output_bar(c, row), cell);
}

/* Has the row no open end for an output: is it empty, or a closed branch? */
static bool is_closed(const struct spread *c, int row)
{
	int bar = spread_last(c);

	while (bar > 0 && spread_is_empty(c, row, bar - 1) && !spread_linked(c, row, bar))
		bar--;
	return bar == 0 || (spread_left(c, row, bar) && spread_up(c, row, bar));
}

/* Puts an output at the end of @row, or in a row below if the end has one. Returns its row;
 * -1: failed. */
static int put_output(struct spread *c, int row, struct cell cell)
{
	const int last = spread_last(c);

	if (spread_is_output(c, row, last))
		return output_below(c, row, cell);
	if (!spread_is_empty(c, row, last)) {
		spread_fail(c, GRID_FULL_COLS);
		return -1;
	}
	if (row > 0 && spread_is_output(c, row - 1, last) && is_closed(c, row))
		return output_below(c, row - 1, cell);
	if (!spread_close_left(c, row, last)) {
		spread_fail(c, GRID_PIN_CELL);
		return -1;
	}
	spread_put(c, row, last, cell);
	return row;
}

/* ---- parallel ---- */

static bool parallel_output(struct spread *c, int row, int col, int last,
			    struct cell cell)
{
	const int at = spread_is_output(c, row, col) ? output_below(c, row, cell) :
			branch_output(c, row, last + 1, cell);

	if (at >= 0)
		spread_mark(c, at, spread_last(c));
	return at >= 0;
}

/* Column of the first element from @col to @last; -1: there is none. */
static int first_element(const struct spread *c, int row, int col, int last)
{
	for (; col <= last; col++)
		if (spread_is_element(c, row, col))
			return col;
	return -1;
}

bool spread_parallel(struct spread *c, int row, int col, int last, struct cell cell)
{
	const enum place place = word_row((enum word)cell.word)->place;
	const int at = first_element(c, row, col, last);
	int below;

	if (at < 0)
		return spread_fail(c, GRID_NOTHING_BELOW);
	if (place == PLACE_LAST)
		return parallel_output(c, row, col, last, cell);
	if (place != PLACE_SERIES && place != PLACE_BOX)
		return spread_fail(c, GRID_NO_WORD);
	if (last == spread_last(c))
		return spread_fail(c, GRID_ONLY_OUTPUT);
	below = spread_branch_row(c, &row, col, last);
	if (below < 0)
		return false;
	for (int i = col; i <= last; i++)
		spread_cell(c, below, i)->word = ELEM_WIRE;
	spread_put(c, below, at, cell);
	spread_join_branch(c, row, below, col);
	spread_join_branch(c, row, below, last + 1);
	spread_mark(c, below, at);
	return true;
}

/* A branch goes around the last column only if the area has no other. */
static bool take_area(struct spread *c, const struct grid_area *area, int *row, int *col,
		      int *last)
{
	*row = area->row;
	*col = area->col;
	*last = area->last_col;
	if (*row < 0 || *row >= c->rung->rows || *col < 0 || *last < *col ||
	    *last >= c->rung->cols)
		return spread_fail(c, GRID_OUTSIDE);
	if (*last == spread_last(c) && *col < *last)
		--*last;
	return true;
}

struct rung *grid_parallel(const struct rung *rung, struct grid_at *at,
			   const struct grid_area *area, struct cell cell)
{
	const struct grid_area own = { at->row, at->col, at->row, at->col };
	struct spread c;
	int row, col, last;

	cell.spare = 0;
	if (spread_open(&c, rung, at->columns, 1) &&
	    take_area(&c, area ? area : &own, &row, &col, &last)) {
		if (spread_word(&c, row, col) == ELEM_PIN)
			spread_fail(&c, GRID_PIN_CELL);
		else
			spread_parallel(&c, row, col, last, cell);
	}
	return spread_close(&c, at);
}

/* ---- branches drawn by hand ---- */

struct rung *grid_open_branch(const struct rung *rung, struct grid_at *at)
{
	struct spread c;
	int row = at->row, below;

	if (at_cell(&c, rung, at, GRID_OUTSIDE)) {
		const struct reach reach = { row, at->col, at->col, at->col, -1 };

		below = find_row(&c, &reach);
		if (below >= 0) {
			spread_join_branch(&c, row, below, at->col);
			at->row = below;
		}
	}
	return spread_close(&c, at);
}

struct rung *grid_close_gaps(const struct rung *rung, struct grid_at *at)
{
	struct spread c;

	if (spread_open(&c, rung, at->columns, 1))
		for (int row = 0; row < c.rung->rows; row++)
			for (int col = 1; col < c.rung->cols; col++)
				if (spread_right(&c, row, col) &&
				    spread_word(&c, row, col) != ELEM_WIRE)
					spread_close_left(&c, row, col);
	return spread_close(&c, at);
}

/* Would power flow leftwards to or from the element at (@row, @col), through other rows?
 * check_rung() refuses that. */
static bool is_backwards(struct spread *c, int row, int col)
{
	const struct network *n = &c->network;
	int in, out;

	if (!spread_network(c))
		return false;
	in = network_net(n, row, col);
	out = network_net(n, row, col + 1);
	for (int i = 0; i < n->element_count; i++)
		if ((n->element[i].out == in && n->element[i].col + 1 > col) ||
		    (n->element[i].in == out && n->element[i].col < col + 1))
			return true;
	for (int i = 0; i < n->pin_count; i++)
		if (n->pin[i].in == out && n->pin[i].col < col + 1)
			return true;
	return false;
}

/* ---- room in a row ---- */

/* Can the cells @col … @end - 1 move right by one, onto the wire or the open end at @end,
 * with no link between them? */
static bool can_shift(const struct spread *c, int row, int col, int end)
{
	for (int i = col; i < end; i++)
		if (spread_linked(c, row, i + 1) ||
		    spread_word(c, row, i) == ELEM_PIN ||
		    rung_height(c->rung, row, i) > 1)
			return false;
	if (spread_word(c, row, end) == ELEM_WIRE)
		return true;
	/* At the open end of a row. */
	return spread_is_empty(c, row, end) && !spread_linked(c, row, end + 1) &&
	       spread_is_empty(c, row, end + 1);
}

/* The column up to which cells from @col on can move; -1: they cannot. */
static int shift_end(const struct spread *c, int row, int col)
{
	int end = col;

	while (end < spread_last(c) && spread_is_element(c, row, end))
		end++;
	return end < spread_last(c) && can_shift(c, row, col, end) ? end : -1;
}

/* Would the last moved element be fed from its right, or feed to its left? */
static bool shift_fails(struct spread *c, int row, int end)
{
	return spread_is_element(c, row, end) && is_backwards(c, row, end);
}

static bool room_before(struct spread *c, int row, int col)
{
	const int end = shift_end(c, row, col);
	const enum word freed = spread_word(c, row, end);

	if (end < 0)
		return spread_insert_column(c, col);
	for (int i = end; i > col; i--)
		spread_put(c, row, i, *spread_cell(c, row, i - 1));
	spread_clear(c, row, col);
	spread_cell(c, row, col)->word = ELEM_WIRE;
	if (!shift_fails(c, row, end))
		return true;
	for (int i = col; i < end; i++)
		spread_put(c, row, i, *spread_cell(c, row, i + 1));
	spread_clear(c, row, end);
	spread_cell(c, row, end)->word = (uint16_t)freed;
	return spread_insert_column(c, col);
}

/* ---- put, replace ---- */

/* Replaces an element. Another box does not keep its rows of pins. */
static void replace(struct spread *c, int row, int col, struct cell cell)
{
	const int height = cell.word == spread_word(c, row, col) ?
		1 : rung_height(c->rung, row, col);

	for (int i = 1; i < height; i++)
		remove_pin(c, row + i, col);
	spread_put(c, row, col, cell);
}

/* A new element without a comment keeps the old one. */
static struct cell commented(struct spread *c, int row, int col, struct cell cell)
{
	if (!cell.comment)
		cell.comment = spread_cell(c, row, col)->comment;
	return cell;
}

static int behind_last(const struct spread *c, int row)
{
	int col = spread_last(c);

	while (col > 0 && !spread_is_element(c, row, col - 1))
		col--;
	return col;
}

/* In the last column it goes behind the row's last element; an output there stays. */
static bool place_last(struct spread *c, int row, struct cell cell)
{
	int col = behind_last(c, row);

	if (col == spread_last(c) && !spread_insert_column(c, col))
		return false;
	if (spread_is_output(c, row, spread_last(c)))
		return spread_place(c, row, col, cell, GRID_INSERT);
	for (int i = col + 1; i < c->rung->cols; i++)
		if (spread_word(c, row, i) == ELEM_WIRE && !spread_linked(c, row, i + 1))
			spread_clear(c, row, i);
	spread_put(c, row, col, cell);
	spread_close_left(c, row, col);
	spread_mark(c, row, col);
	return true;
}

static bool place_output(struct spread *c, int row, int col, struct cell cell,
			 enum grid_how how)
{
	const int last = spread_last(c);

	if (how == GRID_REPLACE && col == last && spread_is_output(c, row, last)) {
		spread_put(c, row, last, commented(c, row, last, cell));
	} else {
		row = put_output(c, row, cell);
		if (row < 0)
			return false;
	}
	spread_mark(c, row, spread_last(c));
	return true;
}

/* Can the element stand at @col of that wire, without power going leftwards? */
static bool fits_wire(struct spread *c, int row, int col, struct cell cell)
{
	const struct cell wire = *spread_cell(c, row, col);
	bool fits;

	spread_put(c, row, col, cell);
	fits = !is_backwards(c, row, col);
	spread_put(c, row, col, wire);
	return fits;
}

/* The column for an element in the wire at (@row, @col): the nearest one without power
 * leftwards, else the last one of the wire. -1: failed. */
static int wire_column(struct spread *c, int row, int col, struct cell cell)
{
	const struct stretch s = stretch_at(c, row, col);
	const int last = s.right < spread_last(c) ? s.right : spread_last(c);

	for (int step = 0; step < c->rung->cols; step++) {
		if (col + step < last && fits_wire(c, row, col + step, cell))
			return col + step;
		if (step > 0 && col - step >= s.left &&
		    fits_wire(c, row, col - step, cell))
			return col - step;
	}
	if (!spread_is_element(c, row, s.right) || spread_linked(c, row, s.right)) {
		spread_fail(c, GRID_BACKWARDS);
		return -1;
	}
	return room_before(c, row, s.right) ? s.right : -1;
}

static bool place_series(struct spread *c, int row, int col, struct cell cell,
			 enum grid_how how)
{
	if (spread_word(c, row, col) == ELEM_PIN)
		return spread_fail(c, GRID_PIN_CELL);
	if (spread_is_element(c, row, col)) {
		if (how == GRID_REPLACE) {
			replace(c, row, col, commented(c, row, col, cell));
			spread_mark(c, row, col);
			return true;
		}
		if (!room_before(c, row, col))
			return false;
	} else if (spread_word(c, row, col) == ELEM_WIRE) {
		col = wire_column(c, row, col, cell);
		if (col < 0)
			return false;
	}
	spread_put(c, row, col, cell);
	spread_close_left(c, row, col);
	spread_close_right(c, row, col);
	spread_mark(c, row, col);
	return true;
}

bool spread_place(struct spread *c, int row, int col, struct cell cell,
		  enum grid_how how)
{
	switch (word_row((enum word)cell.word)->place) {
	case PLACE_LAST:
		return place_output(c, row, col, cell, how);
	case PLACE_BOX:
		if (col >= spread_last(c))
			return place_last(c, row, cell);
		return place_series(c, row, col, cell, how);
	case PLACE_SERIES:
		if (col >= spread_last(c) && how == GRID_INSERT &&
		    spread_is_output(c, row, spread_last(c)))
			return place_last(c, row, cell);
		if (col >= spread_last(c))
			return spread_fail(c, GRID_LAST_COLUMN);
		return place_series(c, row, col, cell, how);
	case PLACE_NONE:
	case PLACE_WIRE:
	case PLACE_PIN:
		break;
	}
	return spread_fail(c, GRID_NO_WORD);
}

struct rung *grid_place(const struct rung *rung, struct grid_at *at, struct cell cell,
			enum grid_how how)
{
	struct spread c;

	cell.spare = 0;
	if (spread_open(&c, rung, at->columns, at->row + 1) && is_cell(&c, at))
		spread_place(&c, at->row, at->col, cell, how);
	return spread_close(&c, at);
}

/* ---- the element that stands there ---- */

bool spread_at_element(struct spread *c, const struct rung *rung, struct grid_at *at)
{
	if (!spread_open(c, rung, at->columns, 1))
		return false;
	if (at->row < 0 || at->row >= c->rung->rows || !is_cell(c, at))
		return spread_fail(c, GRID_OUTSIDE);
	if (!spread_is_element(c, at->row, at->col))
		return spread_fail(c, GRID_NO_ELEMENT);
	spread_mark(c, at->row, at->col);
	return true;
}

static bool same_place(enum word a, enum word b)
{
	return (word_row(a)->place == PLACE_LAST) == (word_row(b)->place == PLACE_LAST);
}

struct rung *grid_set(const struct rung *rung, struct grid_at *at, struct cell cell)
{
	struct spread c;

	cell.spare = 0;
	if (spread_at_element(&c, rung, at)) {
		struct cell *now = spread_cell(&c, at->row, at->col);
		const enum place place = word_row((enum word)cell.word)->place;

		if (place == PLACE_NONE || place == PLACE_WIRE || place == PLACE_PIN)
			spread_fail(&c, GRID_NO_WORD);
		else if (!same_place((enum word)cell.word, (enum word)now->word))
			spread_fail(&c, GRID_OTHER_PLACE);
		else
			replace(&c, at->row, at->col, cell);
		spread_mark(&c, at->row, at->col);
	}
	return spread_close(&c, at);
}

/* ---- rows and columns ---- */

struct rung *grid_insert_row(const struct rung *rung, struct grid_at *at)
{
	struct spread c;

	if (at_cell(&c, rung, at, GRID_OUTSIDE))
		spread_insert_row(&c, at->row);
	return spread_close(&c, at);
}

struct rung *grid_insert_column(const struct rung *rung, struct grid_at *at)
{
	struct spread c;

	if (at_cell(&c, rung, at, GRID_OUTSIDE))
		spread_insert_column(&c, at->col);
	return spread_close(&c, at);
}

struct rung *grid_delete_row(const struct rung *rung, struct grid_at *at)
{
	struct spread c;

	if (at_cell(&c, rung, at, GRID_OUTSIDE)) {
		if (c.rung->rows == 1)
			spread_fail(&c, GRID_ONLY_ROW);
		else
			spread_replace(&c, rung_delete_row(c.rung, at->row));
	}
	return spread_close(&c, at);
}

struct rung *grid_delete_column(const struct rung *rung, struct grid_at *at)
{
	struct spread c;

	if (at_cell(&c, rung, at, GRID_OUTSIDE)) {
		if (at->col == spread_last(&c))
			spread_fail(&c, GRID_LAST_COLUMN);
		else
			spread_replace(&c, rung_delete_column(c.rung, at->col));
	}
	return spread_close(&c, at);
}

/* ---- rows of pins below boxes: an input has one only when a branch feeds it ---- */

/* Why input @name cannot have a row of its own; GRID_DONE: it can. */
static enum grid_refusal judge(const struct word_row *row, const char *name)
{
	const int index = word_pin_find(row, name, strlen(name));
	const struct word_pin *pin;

	if (index < 0)
		return GRID_BAD_PIN;
	pin = &row->pin[index < row->pin_count ? index : row->pin_count - 1];
	if (pin->dir != PIN_IN)
		return GRID_BAD_PIN;
	if (row->kind == WORD_FN)
		return pin->classes & CLASS_BOOL ? GRID_DONE : GRID_BAD_PIN;
	if (index == word_first_bool(row, PIN_IN))
		return GRID_FIRST_PIN;
	return pin->type == IEC_BOOL ? GRID_DONE : GRID_BAD_PIN;
}

static bool is_connected(const struct spread *c, const struct project *project, int row,
			 int col, uint32_t pin)
{
	const struct cell *box = rung_at(c->rung, row, col);
	const char *name = project_text(project, pin);
	const int height = rung_height(c->rung, row, col);
	struct arg arg;

	for (int i = 1; i < height; i++)
		if (rung_at(c->rung, row + i, col)->operand == pin)
			return true;
	return box->args && args_find(project_text(project, box->args), name,
				      strlen(name), &arg);
}

static bool may_add(struct spread *c, const struct project *project, int row, int col,
		    uint32_t pin)
{
	const enum word word = spread_word(c, row, col);
	const struct word_row *words = words_row(&project->words, word);
	enum grid_refusal why;

	if (words->place != PLACE_BOX || words->kind == WORD_ELEM)
		return spread_fail(c, GRID_NO_BOX);
	why = judge(words, project_text(project, pin));
	if (why == GRID_DONE && is_connected(c, project, row, col, pin))
		why = GRID_PIN_TAKEN;
	return why == GRID_DONE || spread_fail(c, why);
}

/* Makes the row right below the box free up to column @col. */
static bool room_below(struct spread *c, int row, int col)
{
	if (row == c->rung->rows)
		return spread_rows(c, row + 1);
	if ((!spread_is_empty(c, row, col) || spread_bar_used(c, row, col)) &&
	    !spread_insert_row(c, row))
		return false;
	return !spread_bar_used(c, row, col) || spread_fail(c, GRID_CROSSING);
}

static void add_row(struct spread *c, struct grid_at *at, uint32_t pin,
		    const struct cell *feed)
{
	const struct cell cell = { .word = ELEM_PIN, .operand = pin };
	int col = at->col, row = at->row + rung_height(c->rung, at->row, at->col);

	if (col == 0 && !spread_insert_column(c, col++))
		return;
	if (!room_below(c, row, col))
		return;
	spread_put(c, row, col, cell);
	if (feed) {
		const enum place place = word_row((enum word)feed->word)->place;

		if (place != PLACE_SERIES && place != PLACE_BOX) {
			spread_fail(c, GRID_NO_WORD);
			return;
		}
		spread_put(c, row, col - 1, *feed);
		spread_close_left(c, row, col - 1);
	}
	at->row = row;
	at->col = col - 1;
	spread_mark(c, row, col - 1);
}

/* A row of pins belongs to the box above it. */
static void climb_to_box(const struct rung *rung, struct grid_at *at)
{
	if (at->col < 0 || at->col >= rung->cols || at->row >= rung->rows)
		return;
	while (at->row > 0 && rung_at(rung, at->row, at->col)->word == ELEM_PIN)
		at->row--;
}

struct rung *grid_add_pin(const struct rung *rung, struct grid_at *at,
			  const struct project *project, uint32_t pin,
			  const struct cell *feed)
{
	struct spread c;

	climb_to_box(rung, at);
	if (spread_at_element(&c, rung, at) &&
	    may_add(&c, project, at->row, at->col, pin))
		add_row(&c, at, pin, feed);
	return spread_close(&c, at);
}
