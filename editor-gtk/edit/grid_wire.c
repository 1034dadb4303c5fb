/* SPDX-License-Identifier: MIT
 *
 * grid_wire - wires drawn and erased by hand, a cell or a link at a time.
 *
 * What hangs in the air afterwards is left as it was drawn: more will follow.
 */
#include "editor-gtk/edit/grid_canvas.h"

/* The cell that a wire to the left or right goes through. */
static int wire_column(const struct canvas *c, const struct grid_at *at,
		       enum grid_way way)
{
	const enum word word = canvas_word(c, at->row, at->col);

	if (word == ELEM_EMPTY || word == ELEM_WIRE)
		return at->col;
	return way == GRID_RIGHT ? at->col + 1 : at->col - 1;
}

static bool draw_across(struct canvas *c, struct grid_at *at, enum grid_way way)
{
	const int col = wire_column(c, at, way), step = way == GRID_RIGHT ? 1 : -1;
	struct cell *cell;

	if (col >= canvas_last(c))
		return canvas_fail(c, GRID_LAST_COLUMN);
	if (col < 0)
		return canvas_fail(c, GRID_OUTSIDE);
	cell = canvas_cell(c, at->row, col);
	if (cell->word == ELEM_PIN)
		return canvas_fail(c, GRID_PIN_CELL);
	if (cell->word != ELEM_WIRE && cell->word != ELEM_EMPTY)
		return canvas_fail(c, GRID_WIRE_BESIDE);
	cell->word = cell->word == ELEM_WIRE ? ELEM_EMPTY : ELEM_WIRE;
	if (at->col + step >= 0)
		at->col += step;
	return true;
}

static bool draw_along(struct canvas *c, struct grid_at *at, enum grid_way way)
{
	const int row = way == GRID_UP ? at->row : at->row + 1;
	struct cell *cell;

	if (at->col == canvas_last(c))
		return canvas_fail(c, GRID_LAST_COLUMN);
	if (row == 0)
		return canvas_fail(c, GRID_FIRST_ROW);
	if (!canvas_rows(c, row + 1))
		return false;
	cell = canvas_cell(c, row, at->col);
	cell->link = !cell->link;
	at->row += way == GRID_UP ? -1 : 1;
	return true;
}

struct rung *grid_wire(const struct rung *rung, struct grid_at *at, enum grid_way way)
{
	struct canvas c;

	if (canvas_open(&c, rung, at->columns, at->row + 1)) {
		if (at->row < 0 || at->col < 0 || at->col >= c.rung->cols)
			canvas_fail(&c, GRID_OUTSIDE);
		else if (way == GRID_LEFT || way == GRID_RIGHT)
			draw_across(&c, at, way);
		else
			draw_along(&c, at, way);
	}
	return canvas_close(&c, at);
}
