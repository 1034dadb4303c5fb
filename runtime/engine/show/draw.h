/* SPDX-License-Identifier: MIT
 *
 * draw - the state of one rung's drawing; shared by show.c, show_box.c and show_sfc.c.
 *
 * Private to show/. Every text line is written from left to right and nothing is
 * overwritten, so that no canvas is needed and wide characters keep their place.
 */
#ifndef SHOW_DRAW_H
#define SHOW_DRAW_H

#include "engine/base/limits.h"
#include "engine/base/sink.h"
#include "engine/model/project.h"
#include "engine/show/show.h"

enum { JOIN_UP = 1, JOIN_DOWN = 2, JOIN_LEFT = 4, JOIN_RIGHT = 8 };

struct strokes {
	const char *joint[16];      /* by directions that meet                */
	const char *across, *powered, *rail, *off_rail, *open, *close;
	const char *corner[4];      /* of a box: top left, right, bottom …    */
	const char *side;           /* of a box, where nothing is connected   */
	const char *more;           /* marks a clipped text                   */
};

#define DRAW_CLIP 48                /* columns of a name or value             */
#define DRAW_CLIP_TEXT 160          /* columns of an expression               */
#define BOX_PINS (LIMIT_ARGS + 8)   /* written ones and those of the row      */

struct box_pin {
	const char *name, *value;   /* borrowed; value NULL: not connected    */
	size_t name_len, value_len;
	bool inverse;               /* the value is inverted at the pin       */
};
struct box_side {
	struct box_pin pin[BOX_PINS];
	int count, name_width, value_width;
};
struct box {
	const struct word_row *row;
	const struct cell *cell;
	const char *args;
	int top, last, col;         /* rows and column it covers              */
	const char *power_in, *power_out;
	struct box_side in, out;    /* except pins that carry power           */
	int lead, inner, tail;      /* columns: before, between, behind sides */
	int need;                   /* columns of the cell                    */
};

struct draw {
	const struct project *project;
	const struct rung *rung;
	const struct sink *sink;
	const struct strokes *strokes;
	const struct show_options *options; /* or NULL                   */
	int pou;                    /* index in the project                   */
	int number;                 /* of the rung                            */
	bool in, out;               /* power of the cell that is drawn        */
	int margin;                 /* columns before the left rail           */
	int width[LIMIT_COLS];
	int above[LIMIT_ROWS], below[LIMIT_ROWS]; /* lines around it      */
	int y[LIMIT_ROWS];          /* of the power line                      */
	int trail[LIMIT_ROWS];      /* column from which power runs to the right
				       rail; LIMIT_COLS: none                 */
	struct box box;             /* the rung that is being drawn           */
};

void draw_blank(const struct draw *draw, int count);
/** draw_across - a wire; @on: with power. */
void draw_across(const struct draw *draw, int count, bool on);
/** draw_clipped - columns of a text that is clipped to @limit. */
int draw_clipped(const char *text, size_t len, int limit);
/** draw_text - writes the text clipped to @limit; returns its columns. */
int draw_text(const struct draw *draw, const char *text, size_t len, int limit);
/** draw_goes_right - whether the cell's right end reaches its bar. */
bool draw_goes_right(const struct draw *draw, int row, int col);

/** draw_rung - draws draw->rung with its texts, as wide as draw->options say (show.c). */
void draw_rung(struct draw *draw);
/** draw_sfc - a chart, and below it its rungs and lists (show_sfc.c).
 * Fails: false: no memory. */
bool draw_sfc(struct draw *draw, const struct pou *pou);
/** draw_network - network @index (from 0) of a POU in FBD (show_fbd.c). Fails: false: no memory. */
bool draw_network(struct draw *draw, const struct pou *pou, int index);

/** box_make - fills draw->box for the box whose first cell is (row, col). */
void box_make(struct draw *draw, int row, int col);
/** box_bottom - lines from its power line to its lower edge; draw->y must be
 * known down to its last row. */
int box_bottom(const struct draw *draw);
/** box_line - the line @line below its power line (or above, negative). */
void box_line(struct draw *draw, int line);

#endif
