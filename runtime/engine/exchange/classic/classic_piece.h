/* SPDX-License-Identifier: MIT
 *
 * classic_piece - a part of a rung as it will be written. Private to classic_piece.c and
 * classic_power.c.
 */
#ifndef CLASSIC_PIECE_H
#define CLASSIC_PIECE_H

#include "engine/exchange/classic/classic_grid.h"

enum { PIECE_COLUMNS = CLASSIC_COLUMNS + 2 };

struct piece_cell {
	const char *text;     /* NULL: empty                                   */
	enum part_kind kind;
	bool box_row;         /* a further row of a box                        */
	bool gives;           /* of a box: its first output is used            */
	bool needed, fed;
};

struct piece {
	struct grid *grid;
	struct piece_cell cell[CLASSIC_ROWS][PIECE_COLUMNS];
	/* Bar @x of this row is joined with that of the row above. */
	bool link[CLASSIC_ROWS + 1][PIECE_COLUMNS + 1];
	int rows, columns;
	bool broken;          /* it cannot be drawn so                         */
};

/** piece_run - the rows whose bar @x is joined with that of row @y: from, and behind. */
void piece_run(const struct piece *piece, int y, int x, int *from, int *to);
/** piece_is_same_power - wires lead both ways here, there only to the right: does each
 * place get the same power all the same? */
bool piece_is_same_power(const struct piece *piece);
#endif
