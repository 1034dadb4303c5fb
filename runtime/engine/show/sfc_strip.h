/* SPDX-License-Identifier: MIT
 *
 * sfc_strip - parts of a chart, put together to larger ones.
 *
 * A strip is a part of the drawing with lanes and rows of its own, counted from 0; a line
 * comes into it from above in its lane 0 (and in others, if it is made of several that
 * stand beside each other), and lines that lead on below it are its exits. Used by
 * sfc_layout.c and sfc_strip.c only. It knows nothing of steps and transitions.
 */
#ifndef SHOW_SFC_STRIP_H
#define SHOW_SFC_STRIP_H

#include "engine/show/sfc_graph.h"
#include "engine/show/sfc_layout.h"

/* A line that ends in a lane and has still to be led to @point. */
struct sfc_exit {
	int lane, up;      /* rows between its end and the strip's last row    */
	int point;          /* of the graph: where it leads                     */
	int from, ref;     /* and whence, by which name                        */
};

struct sfc_strip {
	int in;            /* the strip that it is a part of; -1: none         */
	int lane, row;     /* in it; of one that is in none: in the drawing    */
	int lanes, rows;
	int entry;         /* lane of its last entry; -1: nothing leads into it */
	int hint;          /* lane it wishes to have, from that of the first one
			      beside it                                       */
	int *reach;        /* lanes that are taken, by row, the last row first */
	int reach_count;   /* is rows                                          */
	struct sfc_exit *exit; /* from left to right                           */
	int exit_count;
};

struct sfc_weave {
	struct sfc_graph graph;
	struct sfc_layout *layout;
	struct arena arena;      /* for what is needed meanwhile               */
	struct sfc_strip *strip; /* parts before what they are parts of        */
	int strip_count;
	int *wire_strip;         /* by wire: the strip it is in                */
	int wire_strip_count;
	int *jump_strip;
	int jump_strip_count;
	struct sfc_shape *jump_at; /* by jump                                  */
	int jump_at_count;
};

/* All of these return -1 or false when memory is out. Strips are known by number. */

/** strip_new - of @rows rows, of which lane 0 is taken. */
int strip_new(struct sfc_weave *weave, int rows);
/** strip_wire - a line in it; lanes and rows of @wire are its own. */
bool strip_wire(struct sfc_weave *weave, int strip, struct sfc_wire wire);
/** strip_exit - a line in lane 0 leads on from its last row. */
bool strip_exit(struct sfc_weave *weave, int strip, struct sfc_exit exit);
/** strip_jump - an arrow at (lane, row), for @exit. */
bool strip_jump(struct sfc_weave *weave, int strip, int lane, int row,
		const struct sfc_exit *exit);
/** strip_cut - its only exit, in lane 0, becomes an arrow. */
bool strip_cut(struct sfc_weave *weave, int strip);
/** strip_beside - some strips beside each other, their first rows in line.
 * Returns the new strip. */
int strip_beside(struct sfc_weave *weave, const int *part, int count);
/** strip_join - leads the exits to @point together, and to @part below them.
 * @twin: by a double line. Exits that it would shut in become jumps. */
bool strip_join(struct sfc_weave *weave, int strip, int point, int part, bool twin);
/** strip_under - @rows of one lane above a strip, or (strip -1) alone.
 * @line: with a line to all its entries; @twin: a double one. Returns the new strip. */
int strip_under(struct sfc_weave *weave, int strip, int rows, bool line, bool twin);
/** strip_leads - has it an exit to @point? */
bool strip_leads(const struct sfc_weave *weave, int strip, int point);

#endif
