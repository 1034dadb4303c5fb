/* SPDX-License-Identifier: MIT
 *
 * classic_grid - one rung of ClassicLadder as elements between nodes. Private to
 * classic_grid.c, classic_piece.c and classic_unfold.c.
 *
 * Node x of row y is the left end of cell (x, y); node 0 is the rail. Rows that are linked
 * at a column are one node there, a run. ClassicLadder evaluates column by column; an
 * element is evaluated in its last column.
 */
#ifndef CLASSIC_GRID_H
#define CLASSIC_GRID_H

#include "engine/exchange/classic/classic_convert.h"

enum part_kind {
	PART_WIRE, PART_CONTACT, PART_BOX,
	PART_COIL,   /* writes with and without power                          */
	PART_ACT     /* does something with power alone                        */
};

struct part_box {            /* inputs and outputs of a block, by row          */
	const char *input[4], *output[4];
	int rows, columns;
};

struct grid_part {
	enum part_kind kind;
	int x, y;            /* its first cell                                 */
	int columns, rows;
	const char *text;    /* "NO I0", "[ Word0 > 5 ]", "CL_TON TM0 …"       */
	const char *instance; /* of a box                                      */
	const struct part_box *box;
	bool gives[4];       /* of a box: the rows that have an output         */
	struct classic_variable reads; /* of a contact                         */
	int expression;      /* number of its expression; -1: none             */
	bool fed;            /* power can reach it (a box: its first row)      */
	bool needed;         /* an output depends on it                        */
	bool shared;         /* of a box: another cell holds the block, too     */
	bool odd;            /* not all its cells are marked as its own        */
	bool written;        /* the text has it                                */
};

enum { GRID_PARTS = CLASSIC_ROWS * CLASSIC_COLUMNS };

struct grid {
	struct conversion *c;
	const struct classic_rung *rung;
	int columns;         /* of the rung: 10 of LinuxCNC, 12 of upstream    */
	struct grid_part part[GRID_PARTS];
	int parts;
	bool fed[CLASSIC_ROWS][CLASSIC_COLUMNS + 1]; /* can this node have power? */
	bool begun;          /* label and comment are written                  */
	int reported;        /* elements that are no part: the report has each */
	bool unknown[1000];  /* codes without a meaning that the report has    */
};

/** grid_link - true if node @x of row @y is joined with the row above. */
static inline bool grid_link(const struct grid *grid, int y, int x)
{
	return x > 0 && x < grid->columns && y > 0 && y < CLASSIC_ROWS &&
	       grid->rung->cell[y][x].top;
}

/** grid_run - the rows of the node: from @from to before @to. */
static inline void grid_run(const struct grid *grid, int y, int x, int *from, int *to)
{
	for (*from = y; grid_link(grid, *from, x); (*from)--)
		;
	for (*to = y + 1; grid_link(grid, *to, x); (*to)++)
		;
}

/** part_end - the node at its right end. */
static inline int part_end(const struct grid_part *part)
{
	return part->x + part->columns;
}

/** part_gives - true if its right end in row @y can have power. */
static inline bool part_gives(const struct grid_part *part, int y)
{
	if (part->kind == PART_BOX)
		return y - part->y < part->rows && part->gives[y - part->y];
	return part->kind <= PART_CONTACT && y == part->y;
}

/** grid_box_text - text of a box. A shared block gets FALSE at the inputs that nothing feeds
 * here, because another cell may have set them. */
const char *grid_box_text(const struct grid *grid, const struct grid_part *part);
/** grid_head - writes the line RUNG; the first time with label and comment. */
void grid_head(struct grid *grid);
/** grid_called_again - true if the rung calls the block of this part again later, which
 * changes its outputs. */
bool grid_called_again(const struct grid *grid, const struct grid_part *part);
/** grid_temporary - name of a new BOOL between the parts of this rung. */
const char *grid_temporary(struct grid *grid);
/** grid_write_pieces - writes the rung as it is drawn, cut where the order of columns
 * matters. false: that is not possible, and nothing was written. */
bool grid_write_pieces(struct grid *grid);
/** grid_unfold - writes a rung for each element, in the order of columns. Always possible. */
void grid_unfold(struct grid *grid);
#endif
