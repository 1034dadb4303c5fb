/* SPDX-License-Identifier: MIT
 *
 * sfc_layout - where the steps, transitions and lines of a chart stand, without pixels.
 *
 * A chart is laid out upon lanes (from left to right) and rows (downwards), both counted
 * from 0. Boxes stand upon a lane; lines run along lanes, and along rows between them;
 * what belongs to a box (its actions, a condition) stands to the right of its lane,
 * before the next one. How wide a lane and how high a row is decides whoever draws.
 *
 * No line crosses another one or a box. What could not be drawn so - a way up, or across -
 * is a jump: an arrow with the name it leads to. The same chart always gives the same
 * layout; any chart has one, right or wrong.
 */
#ifndef SHOW_SFC_LAYOUT_H
#define SHOW_SFC_LAYOUT_H

#include "engine/base/arena.h"
#include "engine/model/sfc.h"

enum sfc_part { SFC_NOTHING, SFC_STEP, SFC_TRANSITION, SFC_JUMP };

/* A step covers rows from its upper edge to its lower one: what it does stands between
 * them, a row each. A transition and a jump have one row. */
struct sfc_shape {
	enum sfc_part part;
	int index;          /* of the chart's steps, transitions; layout.jump */
	int lane, top, bottom;
};

/* An arrow with a name. */
struct sfc_jump {
	int ref;            /* of sfc.ref: the name that is not joined by a line */
	int from;           /* transition that leads to a step; or a step, that
			       waits for a transition                         */
	bool to_transition;
	int target;         /* step or transition; -1: there is none           */
};

/* A piece of a line, its ends included: along a lane downwards, or along a row to the
 * right. It touches boxes at their edges only. */
struct sfc_wire {
	bool twin;          /* double: steps that run side by side             */
	int lane, row, end_lane, end_row;
};

/* The chart of the program, then those inside macro-steps, below one another. */
struct sfc_frame {
	int macro;          /* step; -1: the program                           */
	int title;          /* row of its name; -1: it has none                */
	int top, bottom;    /* rows                                            */
};

struct sfc_layout {
	const struct sfc *sfc;
	struct sfc_shape *shape; /* steps, then transitions, then jumps        */
	int shape_count;
	int *sorted;        /* shapes by lane, then from top to bottom         */
	struct sfc_jump *jump;
	int jump_count;
	struct sfc_wire *wire;
	int wire_count;
	struct sfc_frame *frame;
	int frame_count;
	bool *apart;        /* by sfc.ref: no line joins it                    */
	int *turn;          /* by transition: whose turn it is among those of its
			       step, from 1, where the drawing does not tell;
			       else 0                                          */
	int lanes, rows;
	struct arena arena; /* for all of it                                   */
};

/**
 * sfc_layout_new - the layout of a chart
 * @sfc: borrowed by the layout
 *
 * Takes time as the chart is large.
 * Owns: the caller, sfc_layout_free().   Scan-safe: no.   Fails: NULL: no memory.
 */
struct sfc_layout *sfc_layout_new(const struct sfc *sfc);
void sfc_layout_free(struct sfc_layout *layout);

/** sfc_layout_step, sfc_layout_transition - where it stands. Scan-safe: yes. */
const struct sfc_shape *sfc_layout_step(const struct sfc_layout *layout, int step);
const struct sfc_shape *sfc_layout_transition(const struct sfc_layout *layout,
					      int transition);
/** sfc_layout_at - number of the shape that covers a lane in a row; -1: none does. */
int sfc_layout_at(const struct sfc_layout *layout, int lane, int row);
/** sfc_step_rows - rows inside the box of a step: its name and times, what it does. */
int sfc_step_rows(const struct sfc *sfc, int step);

#endif
