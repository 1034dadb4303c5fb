/* SPDX-License-Identifier: MIT
 *
 * grid_branch - what stands in parallel: branches round elements, outputs below outputs.
 *
 * A branch needs a row in which its cells are free and down to which its ends can be
 * linked without touching another circuit; where there is none it gets a new row. Below a
 * box whose pins are fed there is no such row: what feeds them comes from the left, past
 * where the branch would begin. A branch round it goes above.
 */
#include "editor-gtk/edit/grid_canvas.h"

/* The cells and bars of a branch that is looked for: cells first … last of a row, its
 * ends at bars left and right; right -1: an output ends it. */
struct reach { int row, first, last, left, right; };

static int net_at(const struct canvas *c, int row, int bar)
{
	return network_net(&c->network, row, bar);
}

/* May bar @bar of @row be joined with the same bar of the branch's own row? */
static bool may_join(const struct canvas *c, const struct reach *reach, int row, int bar)
{
	return bar < 0 || !canvas_bar_used(c, row, bar) ||
	       net_at(c, row, bar) == net_at(c, reach->row, bar);
}

static bool is_passable(const struct canvas *c, const struct reach *reach, int row)
{
	return may_join(c, reach, row, reach->left) &&
	       may_join(c, reach, row, reach->right);
}

static bool is_free(const struct canvas *c, const struct reach *reach, int row)
{
	for (int col = reach->first; col <= reach->last; col++) {
		if (!canvas_is_empty(c, row, col))
			return false;
		if (col > reach->first && canvas_linked(c, row, col))
			return false;
	}
	return (reach->right >= 0 || !canvas_linked(c, row, reach->last + 1)) &&
	       is_passable(c, reach, row);
}

/* May a row for the branch be put in before @row: without cutting a box where it goes,
 * or links that it would cross? */
static bool may_insert(const struct canvas *c, const struct reach *reach, int row)
{
	for (int col = reach->first; col <= reach->last; col++)
		if (canvas_word(c, row, col) == ELEM_PIN ||
		    (col > reach->first && canvas_up(c, row, col)))
			return false;
	return true;
}

/* The first row below that is free, or a new one before what is in the way; -1: none. */
static int row_below(struct canvas *c, const struct reach *reach)
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
		return canvas_rows(c, row + 1) ? row : -1;
	return put_in >= 0 && canvas_insert_row(c, put_in) ? put_in : -1;
}

/* The same above; a row put in there comes right before that of the branch. */
static int row_above(struct canvas *c, const struct reach *reach)
{
	for (int row = reach->row - 1; row >= 0; row--) {
		if (is_free(c, reach, row))
			return row;
		if (!is_passable(c, reach, row))
			break;
	}
	return may_insert(c, reach, reach->row) && canvas_insert_row(c, reach->row) ?
	       reach->row : -1;
}

static int find_row(struct canvas *c, const struct reach *reach)
{
	int row = -1;

	if (canvas_network(c))
		row = row_below(c, reach);
	if (row < 0)
		canvas_fail(c, GRID_CROSSING);
	return row;
}

int canvas_branch_row(struct canvas *c, int *row, int col, int last)
{
	const struct reach reach = { *row, col, last, col, last + 1 };
	const int rows = c->rung->rows;
	int found = -1;

	if (canvas_network(c))
		found = row_below(c, &reach);
	if (found < 0 && c->refusal == GRID_DONE) {
		found = row_above(c, &reach);
		*row += c->rung->rows - rows;
	}
	if (found < 0)
		canvas_fail(c, GRID_CROSSING);
	return found;
}

/* Only as far as the first row that is joined with @row there already: no wire twice. */
void canvas_join_branch(struct canvas *c, int row, int branch, int bar)
{
	const bool old = c->rung->rows == c->network.rows;
	int top = branch - 1;

	if (old && net_at(c, branch, bar) == net_at(c, row, bar))
		return;
	if (branch < row) {
		canvas_join_up(c, branch, row, bar);
		return;
	}
	while (top > row && net_at(c, top, bar) != net_at(c, row, bar))
		top--;
	canvas_join_up(c, top, branch, bar);
}

/* ---- outputs ---- */

/* An output in a row below @row, on a branch from bar @bar of it. */
static int branch_output(struct canvas *c, int row, int bar, struct cell cell)
{
	const int last = canvas_last(c);
	const struct reach reach = { row, bar, last, bar, -1 };
	const int below = find_row(c, &reach);

	if (below < 0)
		return -1;
	canvas_join_branch(c, row, below, bar);
	for (int col = bar; col < last; col++)
		canvas_cell(c, below, col)->word = ELEM_WIRE;
	canvas_put(c, below, last, cell);
	return below;
}

/* The bar where the wire to the output of @row begins. */
static int output_bar(const struct canvas *c, int row)
{
	int bar = canvas_last(c);

	while (bar > 0 && canvas_word(c, row, bar - 1) == ELEM_WIRE &&
	       !canvas_linked(c, row, bar))
		bar--;
	return bar;
}

static int output_below(struct canvas *c, int row, struct cell cell)
{
	return branch_output(c, row, output_bar(c, row), cell);
}

/* Has the row no end that waits for an output: is it bare, or a closed branch? */
static bool is_closed(const struct canvas *c, int row)
{
	int bar = canvas_last(c);

	while (bar > 0 && canvas_is_empty(c, row, bar - 1) && !canvas_linked(c, row, bar))
		bar--;
	return bar == 0 || (canvas_left(c, row, bar) && canvas_up(c, row, bar));
}

int canvas_output(struct canvas *c, int row, struct cell cell)
{
	const int last = canvas_last(c);

	if (canvas_is_output(c, row, last))
		return output_below(c, row, cell);
	if (!canvas_is_empty(c, row, last)) {
		canvas_fail(c, GRID_FULL_COLS);
		return -1;
	}
	if (row > 0 && canvas_is_output(c, row - 1, last) && is_closed(c, row))
		return output_below(c, row - 1, cell);
	if (!canvas_close_left(c, row, last)) {
		canvas_fail(c, GRID_PIN_CELL);
		return -1;
	}
	canvas_put(c, row, last, cell);
	return row;
}

/* ---- parallel ---- */

static bool parallel_output(struct canvas *c, int row, int col, int last,
			    struct cell cell)
{
	const int at = canvas_is_output(c, row, col) ? output_below(c, row, cell) :
			branch_output(c, row, last + 1, cell);

	if (at >= 0)
		canvas_mark(c, at, canvas_last(c));
	return at >= 0;
}

/* Column of the first element from @col to @last; -1: there is none. */
static int first_element(const struct canvas *c, int row, int col, int last)
{
	for (; col <= last; col++)
		if (canvas_is_element(c, row, col))
			return col;
	return -1;
}

bool canvas_parallel(struct canvas *c, int row, int col, int last, struct cell cell)
{
	const enum place place = word_row((enum word)cell.word)->place;
	const int at = first_element(c, row, col, last);
	int below;

	if (at < 0)
		return canvas_fail(c, GRID_NOTHING_BELOW);
	if (place == PLACE_LAST)
		return parallel_output(c, row, col, last, cell);
	if (place != PLACE_SERIES && place != PLACE_BOX)
		return canvas_fail(c, GRID_NO_WORD);
	if (last == canvas_last(c))
		return canvas_fail(c, GRID_ONLY_OUTPUT);
	below = canvas_branch_row(c, &row, col, last);
	if (below < 0)
		return false;
	for (int i = col; i <= last; i++)
		canvas_cell(c, below, i)->word = ELEM_WIRE;
	canvas_put(c, below, at, cell);
	canvas_join_branch(c, row, below, col);
	canvas_join_branch(c, row, below, last + 1);
	canvas_mark(c, below, at);
	return true;
}

/* What of an area a branch can go round: the last column only alone. */
static bool take_area(struct canvas *c, const struct grid_area *area, int *row, int *col,
		      int *last)
{
	*row = area->row;
	*col = area->col;
	*last = area->last_col;
	if (*row < 0 || *row >= c->rung->rows || *col < 0 || *last < *col ||
	    *last >= c->rung->cols)
		return canvas_fail(c, GRID_OUTSIDE);
	if (*last == canvas_last(c) && *col < *last)
		--*last;
	return true;
}

struct rung *grid_parallel(const struct rung *rung, struct grid_at *at,
			   const struct grid_area *area, struct cell cell)
{
	const struct grid_area own = { at->row, at->col, at->row, at->col };
	struct canvas c;
	int row, col, last;

	cell.spare = 0;
	if (canvas_open(&c, rung, at->columns, 1) &&
	    take_area(&c, area ? area : &own, &row, &col, &last)) {
		if (canvas_word(&c, row, col) == ELEM_PIN)
			canvas_fail(&c, GRID_PIN_CELL);
		else
			canvas_parallel(&c, row, col, last, cell);
	}
	return canvas_close(&c, at);
}

/* ---- branches drawn by hand ---- */

static bool is_there(struct canvas *c, const struct rung *rung, struct grid_at *at)
{
	return canvas_open(c, rung, at->columns, 1) &&
	       ((at->row >= 0 && at->row < c->rung->rows && at->col >= 0 &&
		 at->col < c->rung->cols) || canvas_fail(c, GRID_OUTSIDE));
}

struct rung *grid_open_branch(const struct rung *rung, struct grid_at *at)
{
	struct canvas c;
	int row = at->row, below;

	if (is_there(&c, rung, at)) {
		const struct reach reach = { row, at->col, at->col, at->col, -1 };

		below = find_row(&c, &reach);
		if (below >= 0) {
			canvas_join_branch(&c, row, below, at->col);
			at->row = below;
		}
	}
	return canvas_close(&c, at);
}

/* First row above @row whose bar @bar belongs to something; if none does, the one
 * right above is drawn out to it. */
static int top_of(struct canvas *c, int row, int bar)
{
	for (int top = row - 1; top >= 0; top--)
		if (canvas_bar_used(c, top, bar))
			return top;
	canvas_close_left(c, row - 1, bar);
	return row - 1;
}

struct rung *grid_close_branch(const struct rung *rung, struct grid_at *at)
{
	struct canvas c;
	int col = at->col;

	if (is_there(&c, rung, at)) {
		while (col >= 0 && canvas_is_empty(&c, at->row, col))
			col--;
		if (at->row == 0)
			canvas_fail(&c, GRID_FIRST_ROW);
		else if (col < 0)
			canvas_fail(&c, GRID_NO_ELEMENT);
		else if (col == canvas_last(&c))
			canvas_fail(&c, GRID_LAST_COLUMN);
		else if (canvas_up(&c, at->row, col + 1))
			canvas_fail(&c, GRID_CLOSED);
		else
			canvas_join_up(&c, top_of(&c, at->row, col + 1), at->row,
				       col + 1);
	}
	return canvas_close(&c, at);
}

struct rung *grid_close_gaps(const struct rung *rung, struct grid_at *at)
{
	struct canvas c;

	if (canvas_open(&c, rung, at->columns, 1))
		for (int row = 0; row < c.rung->rows; row++)
			for (int col = 1; col < c.rung->cols; col++)
				if (canvas_right(&c, row, col) &&
				    canvas_word(&c, row, col) != ELEM_WIRE)
					canvas_close_left(&c, row, col);
	return canvas_close(&c, at);
}
