/* SPDX-License-Identifier: MIT
 *
 * rung_layout - the places of everything in a rung, and the part at a point.
 *
 * Each rung is laid out alone; then rungs of one sheet get the same right rail
 * (rung_layout_stretch). Places are px at 100 %, from the upper left corner of the rung's
 * strip; the caller applies the zoom.
 *
 * Columns are display columns (grid_display.h): an output at the end of a row is in the
 * last column, with a wire up to it. Rows are those of the rung, and empty ones below.
 */
#ifndef EDITOR_RUNG_LAYOUT_H
#define EDITOR_RUNG_LAYOUT_H

#include "editor-gtk/draw/grid_names.h"
#include "editor-gtk/kit/lettering.h"

#include <graphene.h>

/* px at 100 % */
#define RUNG_GUTTER      46     /* below the number                             */
#define RUNG_LEFT        61     /* x of the left rail                           */
#define RUNG_AFTER       24     /* behind the right rail                        */
#define RUNG_CELL_WIDTH  98
#define RUNG_TIGHT_WIDTH 66     /* of a cell where there is no room             */
#define RUNG_BLANK_WIDTH 12     /* the same where nothing stands, on a sheet that folds */
#define RUNG_CELL_HEIGHT 84
#define RUNG_WIRE        46     /* of a row: from its top to its wire           */
#define RUNG_HALF        12     /* half the height of a contact                 */
#define RUNG_LEAST_COLUMNS 6
#define RUNG_WIDE        2400 /* rails are not wider apart for the page alone   */
#define RUNG_SPREAD      1.5f /* columns of such a page, to their usual width   */

enum drafting_show { SHOW_BOTH, SHOW_SYMBOLS, SHOW_ADDRESSES };

/* Shared by the layouts and drawings of one sheet; all borrowed. */
struct drafting {
	const struct project *project;
	const struct grid_names *names; /* of the POU                          */
	struct lettering *lettering;
	enum drafting_show show;
	bool comments;     /* also comments of declarations, below elements     */
	bool all_comments; /* whole comments of rungs, and long names: for paper  */
	float beside;      /* px that comments leave free on both sides, for marks */
	int columns;       /* of the sheet: rung_layout_columns() of its rungs   */
	float width;       /* px, least distance of the rails; 0: natural       */
	float most;        /* px of a line above a rung; 0: from rail to rail    */
	bool folds;        /* rungs that are too wide are folded (rung_fold.h)    */
};

struct rung_row {
	float y, height, wire;
	int output;        /* col of the element that is shown in the last column; -1 */
	int trail;         /* col whose power goes on to the right rail; -1 */
	bool addressed;    /* one of its elements shows an address              */
};

struct rung_layout {
	const struct rung *rung; /* borrowed                                    */
	int number;              /* 1-based                                     */
	int rows, columns;       /* as shown                                    */
	float right;             /* x of the right rail                         */
	float natural;           /* distance of the rails with cells of usual width */
	float tight;             /* least distance of the rails                 */
	float top;               /* y of the first row                          */
	float height;            /* of the whole strip                          */
	float title_y;           /* baseline of title and number                */
	int title_lines;         /* 0: one line, or no title                    */
	int comment_lines;       /* below the title; 0: beside it                */
	float heading_room;      /* px of such lines, from the rail on          */
	float *column_x, *column_width; /* of the columns                       */
	float *column_need;      /* width that the names in them need           */
	struct rung_row *row;
	float whole_from, whole; /* the last answer of rung_layout_whole(); from 0: none */
};

/** rung_layout_columns - columns that a rung needs on a sheet, at least RUNG_LEAST_COLUMNS. */
int rung_layout_columns(const struct rung *rung);

/**
 * rung_layout_new - lays a rung out
 * @number: shown, from 1
 * @rows:   least number of rows; empty ones follow those of the rung. 0: no more
 *
 * Owns: the caller, rung_layout_free(); @rung must outlive it. Units: px.
 */
struct rung_layout *rung_layout_new(const struct drafting *drafting,
				    const struct rung *rung, int number, int rows);
void rung_layout_free(struct rung_layout *layout);
/** rung_layout_stretch - moves the right rail to @width from the left one, or to the
 * natural distance if that is more. */
void rung_layout_stretch(struct rung_layout *layout, float width);
/** rung_layout_fit - the same, but where there is less room than the natural distance, columns become
 * narrower, down to what their names need; on a page wider than RUNG_WIDE / RUNG_SPREAD they become wider. */
void rung_layout_fit(struct rung_layout *layout, float width);
/** rung_layout_pack - columns have their usual width, or the least one where nothing stands; the right rail is
 * @width from the left one, or behind them if that is more. */
void rung_layout_pack(struct rung_layout *layout, float width);
/** rung_layout_width - of the whole strip, with gutter and margin. */
float rung_layout_width(const struct rung_layout *layout);

/** rung_layout_column - the column in which cell (row, col) of the rung is shown. */
int rung_layout_column(const struct rung_layout *layout, int row, int col);
/** rung_layout_col - the rung's col that is shown in @column; -1: stretched wire, or
 * nothing. */
int rung_layout_col(const struct rung_layout *layout, int row, int column);
/** rung_layout_wired - is (row, column) on a wire that leads on to an output or the rail? */
bool rung_layout_wired(const struct rung_layout *layout, int row, int column);
/** rung_layout_goes_on - does (row, column) have an element or a wire? */
bool rung_layout_goes_on(const struct rung_layout *layout, int row, int column);
/** rung_layout_bar - x of bar @bar (0 … cols) of the rung. */
float rung_layout_bar(const struct rung_layout *layout, int row, int bar);

/** rung_layout_cell - the rectangle of (row, column); in a box that of the whole box. For
 * the cursor, accessible children and popovers. */
graphene_rect_t rung_layout_cell(const struct rung_layout *layout, int row, int column);

/** rung_layout_whole - the place at or left of @x where a line from top to bottom cuts no element. A frame asks several
 * times for one @x: the last answer is kept until the columns move. */
float rung_layout_whole(const struct drafting *drafting, struct rung_layout *layout, float x);
/** rung_layout_label - px: width of the texts above an element. */
float rung_layout_label(const struct drafting *drafting, const struct cell *cell);

enum rung_part {
	RUNG_PART_NONE,
	RUNG_PART_NUMBER,  /* the gutter                                        */
	RUNG_PART_TITLE,
	RUNG_PART_CELL,    /* row, column                                       */
	RUNG_PART_WIRE,    /* the same, within reach of its wire                 */
	RUNG_PART_LINK,    /* the wire between row and row - 1 at the right end of column */
	RUNG_PART_PIN,     /* the same, and pin, output                          */
};
struct rung_hit {
	enum rung_part part;
	int row, column;   /* 0-based                                           */
	int pin;           /* index in struct rung_box; -1: none                */
	bool output;
	const char *name;  /* of the pin, borrowed, not NUL-ended              */
	size_t name_len;
};
/** rung_layout_hit - finds the part at a point. */
struct rung_hit rung_layout_hit(const struct drafting *drafting,
				const struct rung_layout *layout, float x, float y);

/* Ends of cells: bar b is the left end of column b, 0 … columns - 1. */
/** rung_layout_end_x - x of such a bar. */
float rung_layout_end_x(const struct rung_layout *layout, int bar);
/** rung_layout_nearest - the end nearest to a point; below all rows: the next row. */
void rung_layout_nearest(const struct rung_layout *layout, float x, float y, int *row,
			 int *bar);
/** rung_layout_end - the end where a drag from a point begins a wire: beside an element, on
 * a wire, at the end of an empty cell. False: a drag from there draws no wire. */
bool rung_layout_end(const struct drafting *drafting, const struct rung_layout *layout,
		     float x, float y, int *row, int *bar);

#endif
