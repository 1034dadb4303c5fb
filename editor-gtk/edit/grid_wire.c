/* SPDX-License-Identifier: MIT
 *
 * grid_wire - wires drawn and erased by hand: a cell or a link at a time, or with one
 * stroke from one end of a cell to another.
 *
 * A stroke has at most one corner. If elements stand between its two ends in one row, it
 * goes around them in its own row. Loose ends stay as they were drawn.
 */
#include "editor-gtk/edit/grid_spread.h"

/* The cell of a wire to the left or right. */
static int cell_of_wire(const struct spread *c, const struct grid_at *at,
		       enum grid_way way)
{
	const enum word word = spread_word(c, at->row, at->col);

	if (word == ELEM_EMPTY || word == ELEM_WIRE)
		return at->col;
	return way == GRID_RIGHT ? at->col + 1 : at->col - 1;
}

static bool toggle_across(struct spread *c, struct grid_at *at, enum grid_way way)
{
	const int col = cell_of_wire(c, at, way), step = way == GRID_RIGHT ? 1 : -1;
	struct cell *cell;

	if (col >= spread_last(c))
		return spread_fail(c, GRID_LAST_COLUMN);
	if (col < 0)
		return spread_fail(c, GRID_OUTSIDE);
	cell = spread_cell(c, at->row, col);
	if (cell->word == ELEM_PIN)
		return spread_fail(c, GRID_PIN_CELL);
	if (cell->word != ELEM_WIRE && cell->word != ELEM_EMPTY)
		return spread_fail(c, GRID_WIRE_BESIDE);
	cell->word = cell->word == ELEM_WIRE ? ELEM_EMPTY : ELEM_WIRE;
	if (at->col + step >= 0)
		at->col += step;
	return true;
}

static bool toggle_along(struct spread *c, struct grid_at *at, enum grid_way way)
{
	const int row = way == GRID_UP ? at->row : at->row + 1;
	struct cell *cell;

	if (at->col == spread_last(c))
		return spread_fail(c, GRID_LAST_COLUMN);
	if (row == 0)
		return spread_fail(c, GRID_FIRST_ROW);
	if (!spread_rows(c, row + 1))
		return false;
	cell = spread_cell(c, row, at->col);
	cell->link = !cell->link;
	at->row += way == GRID_UP ? -1 : 1;
	return true;
}

struct rung *grid_wire(const struct rung *rung, struct grid_at *at, enum grid_way way)
{
	struct spread c;

	if (spread_open(&c, rung, at->columns, at->row + 1)) {
		if (at->row < 0 || at->col < 0 || at->col >= c.rung->cols)
			spread_fail(&c, GRID_OUTSIDE);
		else if (way == GRID_LEFT || way == GRID_RIGHT)
			toggle_across(&c, at, way);
		else
			toggle_along(&c, at, way);
	}
	return spread_close(&c, at);
}

/* ---- strokes ---- */

static int least(int a, int b)
{
	return a < b ? a : b;
}

static int most(int a, int b)
{
	return a > b ? a : b;
}

/* ---- strokes: which way it goes ---- */

/* Is @row empty or wire from bar to bar? */
static bool is_clear(const struct spread *c, int row, int a, int b)
{
	for (int col = least(a, b); col < most(a, b); col++)
		if (!spread_is_empty(c, row, col) &&
		    spread_word(c, row, col) != ELEM_WIRE)
			return false;
	return true;
}

static bool is_end(const struct spread *c, struct grid_end end)
{
	return end.row >= 0 && end.row <= c->rung->rows && end.row < LIMIT_ROWS &&
	       end.bar >= 0 && end.bar <= spread_last(c);
}

static bool has_pins(const struct spread *c, int row, int a, int b)
{
	for (int col = least(a, b); col < most(a, b); col++)
		if (spread_word(c, row, col) == ELEM_PIN)
			return true;
	return false;
}

static enum grid_course course_of(const struct spread *c, struct grid_end from,
				  struct grid_end to, bool along)
{
	const bool across = is_clear(c, from.row, from.bar, to.bar);

	if (!is_end(c, from) || !is_end(c, to) ||
	    (from.row == to.row && from.bar == to.bar))
		return GRID_NO_COURSE;
	if (from.row == to.row) {
		if (across)
			return GRID_ACROSS;
		return has_pins(c, from.row, from.bar, to.bar) ? GRID_NO_COURSE :
								 GRID_ROUND;
	}
	if (across && !(along && is_clear(c, to.row, from.bar, to.bar)))
		return GRID_ACROSS;
	return is_clear(c, to.row, from.bar, to.bar) ? GRID_ALONG : GRID_NO_COURSE;
}

static enum grid_refusal why_not(const struct spread *c, struct grid_end from,
				 struct grid_end to)
{
	if (from.bar > spread_last(c) || to.bar > spread_last(c))
		return GRID_LAST_COLUMN;
	if (!is_end(c, from) || !is_end(c, to))
		return GRID_OUTSIDE;
	if (from.row == to.row && from.bar == to.bar)
		return GRID_WIRE_THERE;
	return has_pins(c, from.row, from.bar, to.bar) ||
	       has_pins(c, to.row, from.bar, to.bar) ? GRID_PIN_CELL : GRID_WIRE_BESIDE;
}

/* ---- strokes: drawing ---- */

/* These return whether anything changed. */
static bool draw_across(struct spread *c, int row, int a, int b)
{
	bool any = false;

	for (int col = least(a, b); col < most(a, b); col++) {
		struct cell *cell = spread_cell(c, row, col);

		any |= cell->word != ELEM_WIRE;
		cell->word = ELEM_WIRE;
	}
	return any;
}

static bool draw_along(struct spread *c, int bar, int a, int b)
{
	bool any = false;

	for (int row = least(a, b) + 1; bar > 0 && row <= most(a, b); row++) {
		struct cell *cell = spread_cell(c, row, bar - 1);

		any |= !cell->link;
		cell->link = 1;
	}
	return any;
}

/* Returns the side of the elements that it took. */
static enum grid_course draw_round(struct spread *c, int row, int a, int b)
{
	const int col = least(a, b), last = most(a, b) - 1;
	const int branch = spread_branch_row(c, &row, col, last);

	if (branch < 0)
		return GRID_NO_COURSE;
	draw_across(c, branch, col, last + 1);
	spread_join_branch(c, row, branch, col);
	spread_join_branch(c, row, branch, last + 1);
	spread_mark(c, branch, col);
	return branch < row ? GRID_OVER : GRID_ROUND;
}

static void draw(struct spread *c, struct grid_end from, struct grid_end to, bool along)
{
	const enum grid_course course = course_of(c, from, to, along);
	const int corner = course == GRID_ACROSS ? to.bar : from.bar;
	const int row = course == GRID_ACROSS ? from.row : to.row;
	bool any;

	if (course == GRID_NO_COURSE) {
		spread_fail(c, why_not(c, from, to));
		return;
	}
	if (course == GRID_ROUND) {
		draw_round(c, from.row, from.bar, to.bar);
		return;
	}
	if (!spread_rows(c, most(from.row, to.row) + 1))
		return;
	any = draw_along(c, corner, from.row, to.row);
	any |= draw_across(c, row, from.bar, to.bar);
	if (!any)
		spread_fail(c, GRID_WIRE_THERE);
	else
		spread_mark(c, to.row, to.bar);
}

struct rung *grid_draw_wire(const struct rung *rung, struct grid_at *at,
			    struct grid_end from, struct grid_end to, bool along)
{
	struct spread c;

	at->row = to.row;
	at->col = to.bar;
	if (spread_open(&c, rung, at->columns, 1))
		draw(&c, from, to, along);
	return spread_close(&c, at);
}

/* ---- strokes: erasing ---- */

static bool erase_across(struct spread *c, int row, int a, int b)
{
	bool any = false;

	for (int col = least(a, b); row < c->rung->rows && col < most(a, b); col++)
		if (spread_word(c, row, col) == ELEM_WIRE) {
			spread_cell(c, row, col)->word = ELEM_EMPTY;
			any = true;
		}
	return any;
}

static bool erase_along(struct spread *c, int bar, int a, int b)
{
	bool any = false;

	for (int row = least(a, b) + 1; bar > 0 && row <= most(a, b) &&
					row < c->rung->rows; row++) {
		any |= spread_cell(c, row, bar - 1)->link;
		spread_cell(c, row, bar - 1)->link = 0;
	}
	return any;
}

static bool erase(struct spread *c, struct grid_end from, struct grid_end to, bool along)
{
	const bool across = erase_across(c, along ? to.row : from.row, from.bar, to.bar);

	return erase_along(c, along ? from.bar : to.bar, from.row, to.row) || across;
}

struct rung *grid_erase_wire(const struct rung *rung, struct grid_at *at,
			     struct grid_end from, struct grid_end to, bool along)
{
	struct spread c;

	at->row = to.row;
	at->col = to.bar;
	if (spread_open(&c, rung, at->columns, 1)) {
		if (!is_end(&c, from) || !is_end(&c, to))
			spread_fail(&c, GRID_OUTSIDE);
		else if (!erase(&c, from, to, along) && !erase(&c, from, to, !along))
			spread_fail(&c, GRID_NOTHING);
	}
	return spread_close(&c, at);
}

/* ---- strokes: for the pointer ---- */

enum grid_course grid_wire_course(const struct rung *rung, int columns,
				  struct grid_end from, struct grid_end to, bool along)
{
	struct grid_at at = { .columns = columns };
	enum grid_course course = GRID_NO_COURSE;
	struct spread c;

	if (spread_open(&c, rung, columns, 1))
		course = course_of(&c, from, to, along);
	if (course == GRID_ROUND)
		course = draw_round(&c, from.row, from.bar, to.bar);
	c.refusal = GRID_OUTSIDE; /* no rung is wanted */
	spread_close(&c, &at);
	return course;
}

void grid_wire_ends(const struct rung *rung, int columns, struct grid_end from,
		    int rows, bool *legal)
{
	struct grid_at at = { .columns = columns };
	struct spread c;
	const bool open = spread_open(&c, rung, columns, 1);

	for (int row = 0; row < rows; row++)
		for (int bar = 0; bar < columns; bar++)
			legal[row * columns + bar] = open &&
				course_of(&c, from, (struct grid_end){ row, bar }, false) !=
				GRID_NO_COURSE;
	c.refusal = GRID_OUTSIDE;
	spread_close(&c, &at);
	for (int bar = 0; bar < columns && from.row < rows; bar++)
		if (legal[from.row * columns + bar])
			legal[from.row * columns + bar] = grid_wire_course(rung, columns,
				from, (struct grid_end){ from.row, bar }, false) !=
				GRID_NO_COURSE;
}
