/* SPDX-License-Identifier: MIT
 *
 * grid_delete - taking elements and wires away.
 *
 * Where power must pass a wire stays; a branch that became nothing but wire would be a
 * short circuit and goes. Rows that nothing is left in go too.
 */
#include "editor-gtk/edit/grid_canvas.h"

struct stretch canvas_stretch(const struct canvas *c, int row, int col)
{
	struct stretch s = { col, col + 1 };

	while (s.left > 0 && canvas_word(c, row, s.left - 1) == ELEM_WIRE &&
	       !canvas_linked(c, row, s.left))
		s.left--;
	while (s.right < c->rung->cols && canvas_word(c, row, s.right) == ELEM_WIRE &&
	       !canvas_linked(c, row, s.right))
		s.right++;
	return s;
}

static int feeders(const struct network *n, int net)
{
	return n->first_feeder[net + 1] - n->first_feeder[net];
}

/* Does power have to go through (@row, @col), which is empty now? So if what comes
 * behind it is read and fed by nothing else, or what comes before it leads nowhere
 * else. */
static bool must_pass(struct canvas *c, int row, int col)
{
	const struct network *n = &c->network;
	int in, out;

	if (!canvas_network(c))
		return false;
	in = network_net(n, row, col);
	out = network_net(n, row, col + 1);
	if (in == out || out == NET_RAIL || n->reader_count[out] == 0)
		return false;
	return feeders(n, out) == 0 ||
	       (in != NET_RAIL && n->reader_count[in] == 0 && feeders(n, in) > 0);
}

/* Wire that ended at bar @bar of @row and now ends in nothing goes, up to its other end;
 * returns the bar there, or -1: none did. */
static int erase_end(struct canvas *c, int row, int bar)
{
	const int from = bar;

	if (canvas_linked(c, row, bar))
		return -1;
	if (!canvas_right(c, row, bar))
		while (bar > 0 && canvas_word(c, row, bar - 1) == ELEM_WIRE &&
		       (bar == from || !canvas_linked(c, row, bar)))
			canvas_clear(c, row, --bar);
	else if (bar > 0 && !canvas_left(c, row, bar))
		while (canvas_word(c, row, bar) == ELEM_WIRE &&
		       (bar == from || !canvas_linked(c, row, bar)))
			canvas_clear(c, row, bar++);
	return bar == from ? -1 : bar;
}

/* Links and wires that led to bar @bar of @row alone. */
static void erase_way(struct canvas *c, int row, int bar)
{
	while (bar >= 0) {
		row = canvas_prune(c, row, bar);
		bar = erase_end(c, row, bar);
	}
}

static void erase_stretch(struct canvas *c, int row, struct stretch s)
{
	for (int col = s.left; col < s.right; col++)
		canvas_clear(c, row, col);
	erase_way(c, row, s.left);
	erase_way(c, row, s.right);
}

/* ---- a branch that became the only way moves up ---- */

/* Does the row below hold a branch from bar to bar, and nothing beside it? */
static bool can_pull(const struct canvas *c, int row, struct stretch s)
{
	const int below = row + 1;

	if (below >= c->rung->rows || !canvas_up(c, below, s.right) ||
	    (s.left > 0 && !canvas_up(c, below, s.left)) ||
	    canvas_left(c, below, s.left) || canvas_right(c, below, s.right))
		return false;
	for (int col = s.left; col < s.right; col++)
		if (!canvas_is_empty(c, row, col) || canvas_is_empty(c, below, col) ||
		    canvas_word(c, below, col) == ELEM_PIN ||
		    rung_height(c->rung, below, col) > 1 ||
		    (col > s.left && canvas_up(c, below, col)))
			return false;
	return true;
}

static void pull_up(struct canvas *c, int row, struct stretch s)
{
	if (!can_pull(c, row, s))
		return;
	for (int col = s.left; col < s.right; col++) {
		canvas_put(c, row, col, *canvas_cell(c, row + 1, col));
		canvas_clear(c, row + 1, col);
	}
	/* Links from further below now pass the row that was left. */
	for (int bar = s.left > 0 ? s.left : 1; bar <= s.right; bar++)
		canvas_cell(c, row + 1, bar - 1)->link =
			canvas_down(c, row + 1, bar);
	canvas_drop_row(c, row + 1);
}

/* ---- one element ---- */

/* The wire that leads to bar @col of @row, and nowhere else; with @elements also what
 * stands in it. */
static void erase_left(struct canvas *c, int row, int col, bool elements)
{
	while (col > 0 && !canvas_linked(c, row, col) &&
	       (canvas_word(c, row, col - 1) == ELEM_WIRE ||
		(elements && canvas_is_element(c, row, col - 1) &&
		 rung_height(c->rung, row, col - 1) == 1)))
		canvas_clear(c, row, --col);
	canvas_prune(c, row, col);
}

static void remove_pin(struct canvas *c, int row, int col, bool elements)
{
	rung_clear_cell(c->rung, row, col);
	erase_left(c, row, col, elements);
}

void canvas_remove_pin(struct canvas *c, int row, int col)
{
	remove_pin(c, row, col, false);
}

static struct stretch take_out(struct canvas *c, int row, int col)
{
	struct stretch s;

	for (int i = rung_height(c->rung, row, col) - 1; i > 0; i--)
		canvas_remove_pin(c, row + i, col);
	canvas_clear(c, row, col);
	s = canvas_stretch(c, row, col);
	if (must_pass(c, row, col))
		canvas_cell(c, row, col)->word = ELEM_WIRE;
	else
		erase_stretch(c, row, s);
	return s;
}

void canvas_delete(struct canvas *c, int row, int col)
{
	take_out(c, row, col);
}

/* Which rows were empty before: those stay. */
struct bare { bool row[LIMIT_ROWS]; };

static void look_for_bare(const struct canvas *c, struct bare *bare)
{
	for (int row = 0; row < c->rung->rows; row++)
		bare->row[row] = canvas_is_bare(c, row);
}

/* Drops the rows that are empty now, but not @keep; returns where that is then. */
static int drop_rows(struct canvas *c, const struct bare *bare, int keep)
{
	for (int row = c->rung->rows - 1; row >= 0; row--) {
		const int before = c->rung->rows;

		if (bare->row[row] || row == keep)
			continue;
		canvas_drop_row(c, row);
		if (row < keep && c->rung->rows < before)
			keep--;
	}
	return keep;
}

void canvas_delete_whole(struct canvas *c, int row, int col)
{
	struct stretch s;
	struct bare bare;

	look_for_bare(c, &bare);
	s = take_out(c, row, col);
	row = drop_rows(c, &bare, row);
	pull_up(c, row, s);
	canvas_drop_row(c, row);
}

static void erase_wire(struct canvas *c, int row, int col)
{
	canvas_clear(c, row, col);
	canvas_prune(c, row, col);
	canvas_prune(c, row, col + 1);
	canvas_drop_row(c, row);
}

static bool is_there(struct canvas *c, const struct rung *rung, struct grid_at *at)
{
	return canvas_open(c, rung, at->columns, 1) &&
	       ((at->row >= 0 && at->row < c->rung->rows && at->col >= 0 &&
		 at->col < c->rung->cols) || canvas_fail(c, GRID_NOTHING));
}

struct rung *grid_delete(const struct rung *rung, struct grid_at *at)
{
	struct canvas c;

	if (is_there(&c, rung, at)) {
		const int row = at->row, col = at->col;

		if (canvas_is_element(&c, row, col)) {
			canvas_delete_whole(&c, row, col);
		} else if (canvas_word(&c, row, col) == ELEM_PIN) {
			canvas_remove_pin(&c, row, col);
			canvas_drop_row(&c, row);
		} else if (canvas_word(&c, row, col) == ELEM_WIRE) {
			erase_wire(&c, row, col);
		} else if (canvas_up(&c, row, col + 1)) {
			canvas_cell(&c, row, col)->link = 0;
			canvas_prune(&c, row, col + 1);
			canvas_drop_row(&c, row);
		} else if (canvas_cell(&c, row, col)->comment) {
			canvas_clear(&c, row, col);
		} else {
			canvas_fail(&c, GRID_NOTHING);
		}
	}
	return canvas_close(&c, at);
}

struct rung *grid_remove_pin(const struct rung *rung, struct grid_at *at)
{
	struct canvas c;

	if (is_there(&c, rung, at)) {
		if (canvas_word(&c, at->row, at->col) == ELEM_PIN) {
			remove_pin(&c, at->row, at->col, true);
			canvas_drop_row(&c, at->row);
		} else {
			canvas_fail(&c, GRID_NO_PIN);
		}
	}
	return canvas_close(&c, at);
}

/* ---- an area ---- */

static bool clip(const struct canvas *c, struct grid_area *area)
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

/* From the end, so that a branch goes before what it goes round. */
static bool delete_elements(struct canvas *c, const struct grid_area *area)
{
	bool any = false;

	for (int row = area->last_row; row >= area->row; row--)
		for (int col = area->last_col; col >= area->col; col--) {
			if (!canvas_is_element(c, row, col))
				continue;
			canvas_delete(c, row, col);
			any = true;
		}
	return any;
}

static bool delete_wires(struct canvas *c, const struct grid_area *area)
{
	bool any = false;

	for (int row = area->last_row; row >= area->row; row--)
		for (int col = area->last_col; col >= area->col; col--) {
			struct cell *cell = canvas_cell(c, row, col);

			if (cell->word == ELEM_PIN ||
			    (cell->word == ELEM_EMPTY && !cell->link))
				continue;
			*cell = (struct cell){ .word = ELEM_EMPTY };
			canvas_prune(c, row, col);
			canvas_prune(c, row, col + 1);
			any = true;
		}
	return any;
}

struct rung *grid_delete_area(const struct rung *rung, struct grid_at *at,
			      const struct grid_area *area)
{
	struct grid_area clipped = *area;
	struct canvas c;

	if (canvas_open(&c, rung, at->columns, 1)) {
		struct bare bare;

		look_for_bare(&c, &bare);
		if (!clip(&c, &clipped) || (!delete_elements(&c, &clipped) &&
					    !delete_wires(&c, &clipped)))
			canvas_fail(&c, GRID_NOTHING);
		else
			drop_rows(&c, &bare, -1);
	}
	return canvas_close(&c, at);
}
