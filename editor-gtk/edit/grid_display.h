/* SPDX-License-Identifier: MIT
 *
 * grid_display - in which column of a sheet a cell of a rung is shown.
 *
 * A sheet shows all its rungs with the same number of columns. The output at the end of a
 * row (a coil, a jump) is shown in the last column, with a wire up to it; everything else is
 * shown in its own column.
 */
#ifndef EDITOR_GRID_DISPLAY_H
#define EDITOR_GRID_DISPLAY_H

#include "engine/model/rung.h"

enum grid_seen {
	GRID_SEEN_EMPTY,   /* nothing; perhaps a link or a comment            */
	GRID_SEEN_CELL,    /* the cell (row, col): an element, a wire, a pin row */
	GRID_SEEN_STRETCH, /* part of the longer wire to the output in (row, col) */
};

struct grid_place {
	enum grid_seen seen;
	int row, col;      /* 0-based cell of the rung; col -1: it has none there */
	bool link;         /* right end joined to the row above               */
	int box_row;       /* row of the box that covers the cell; -1: none   */
	int box_height;    /* rows of that box                                */
};

/** grid_display_columns - how many a rung needs to be shown: at least @least, one for
 * outputs behind everything else, at most LIMIT_COLS. Scan-safe: no; so are all. */
int grid_display_columns(const struct rung *rung, int least);
/** grid_display_find - the contents of display cell (@row, @col), 0-based. Cells outside are
 * empty. Returns out->seen. */
enum grid_seen grid_display_find(const struct rung *rung, int columns, int row,
				 int col, struct grid_place *out);
/** grid_display_column - the display column of cell (@row, @col) of the rung. */
int grid_display_column(const struct rung *rung, int columns, int row, int col);
/** grid_display_output - column of the output at the end of @row that is shown in the
 * last display column; -1: it has none. */
int grid_display_output(const struct rung *rung, int row);
#endif
