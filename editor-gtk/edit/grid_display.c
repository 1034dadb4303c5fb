/* SPDX-License-Identifier: MIT
 *
 * grid_display - the column of a sheet in which a cell is shown; see grid_display.h.
 *
 * All depends on one question: can the wire before the last element of a row, an output, be
 * made longer without touching another wire?
 */
#include "editor-gtk/edit/grid_display.h"

/* Is the bar at the right end of cell (@row, @col) linked up or down? */
static bool is_linked(const struct rung *rung, int row, int col)
{
	return (row > 0 && rung_at(rung, row, col)->link) ||
	       (row + 1 < rung->rows && rung_at(rung, row + 1, col)->link);
}

static bool is_bare(const struct rung *rung, int row, int col)
{
	const struct cell *cell = rung_at(rung, row, col);

	return cell->word == ELEM_EMPTY && !cell->comment;
}

int grid_display_output(const struct rung *rung, int row)
{
	int col = rung->cols - 1;

	if (row < 0 || row >= rung->rows)
		return -1;
	while (col >= 0 && is_bare(rung, row, col) && !is_linked(rung, row, col))
		col--;
	if (col < 0 || is_linked(rung, row, col) ||
	    word_row((enum word)rung_at(rung, row, col)->word)->place != PLACE_LAST)
		return -1;
	return col;
}

/* Columns of a row in use, without its output. */
static int used_columns(const struct rung *rung, int row)
{
	const int output = grid_display_output(rung, row);
	int cols = rung->cols;

	if (output >= 0)
		return output;
	while (cols > 0 && is_bare(rung, row, cols - 1) &&
	       !is_linked(rung, row, cols - 1))
		cols--;
	return cols;
}

int grid_display_columns(const struct rung *rung, int least)
{
	int most = least;

	for (int row = 0; row < rung->rows; row++) {
		int used = used_columns(rung, row) + 1;

		if (used > most)
			most = used;
	}
	return most < LIMIT_COLS ? most : LIMIT_COLS;
}

int grid_display_column(const struct rung *rung, int columns, int row, int col)
{
	return grid_display_output(rung, row) == col && col < columns ?
		columns - 1 : col;
}

static void find_box(const struct rung *rung, struct grid_place *out)
{
	int top = out->row;

	if (out->col < 0)
		return;
	while (top > 0 && rung_at(rung, top, out->col)->word == ELEM_PIN)
		top--;
	out->box_height = rung_height(rung, top, out->col);
	if (top + out->box_height > out->row &&
	    (out->box_height > 1 ||
	     word_row((enum word)rung_at(rung, top, out->col)->word)->place == PLACE_BOX))
		out->box_row = top;
	else
		out->box_height = 0;
}

enum grid_seen grid_display_find(const struct rung *rung, int columns, int row,
				 int col, struct grid_place *out)
{
	const int output = grid_display_output(rung, row);

	*out = (struct grid_place){ GRID_SEEN_EMPTY, row, -1, false, -1, 0 };
	if (row < 0 || row >= rung->rows || col < 0 || col >= columns)
		return out->seen;
	if (output >= 0 && output < columns && col >= output) {
		out->col = output;
		out->seen = col == columns - 1 ? GRID_SEEN_CELL : GRID_SEEN_STRETCH;
		return out->seen;
	}
	if (col >= rung->cols)
		return out->seen;
	out->col = col;
	out->link = row > 0 && rung_at(rung, row, col)->link;
	if (rung_at(rung, row, col)->word != ELEM_EMPTY)
		out->seen = GRID_SEEN_CELL;
	find_box(rung, out);
	return out->seen;
}
