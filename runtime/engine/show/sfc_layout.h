/* SPDX-License-Identifier: MIT
 *
 * sfc_layout - the places of the steps, transitions and lines of a chart, without
 * pixels.
 *
 * A chart is laid out upon lanes (from left to right) and rows (downwards), both
 * counted from 0. Boxes stand upon a lane; lines run along lanes, and along rows
 * between them; the texts of a box (its actions, a condition) are to the right of its
 * lane, before the next one. The drawing decides how wide lanes and how high rows are.
 *
 * No line crosses another one or a box. A connection that would - upwards, or across -
 * is a jump: an arrow with the name of its target. The same chart always gives the same
 * layout; charts with errors have one, too.
 */
#ifndef SHOW_SFC_LAYOUT_H
#define SHOW_SFC_LAYOUT_H

#include "engine/base/arena.h"
#include "engine/model/sfc.h"

enum sfc_part { SFC_NOTHING, SFC_STEP, SFC_TRANSITION, SFC_JUMP };

/* A step covers rows from its upper edge to its lower one: its actions are between
 * them, a row each. A transition and a jump have one row. */
struct sfc_shape {
	enum sfc_part part;
	int index;          /* of the chart's steps, transitions; layout.jump */
	int lane, top, bottom;
};

/* An arrow with a name. */
struct sfc_jump {
	int ref;            /* index in sfc.ref of the name without a line */
	int from;           /* a transition that leads to a step; or a step before a
			     * transition */
	bool to_transition;
	int target;         /* step or transition; -1: there is none           */
};

/* A segment of a line, including its ends: downwards in a lane, or to the right in a
 * row. It touches boxes only at their edges. */
struct sfc_wire {
	bool twin;          /* double: simultaneous steps                      */
	int lane, row, end_lane, end_row;
};

/* The chart of the program, then those of macro-steps, one below another. */
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
	int *turn;          /* by transition: its place in the order of its step's
			     * transitions, from 1, if the drawing does not show it; else 0 */
	int lanes, rows;
	struct arena arena; /* for all of it                                   */
};

/**
 * sfc_layout_new - the layout of a chart
 * @sfc: borrowed by the layout
 *
 * The time grows with the size of the chart.
 * Owns: the caller, sfc_layout_free(). Scan-safe: no. Fails: NULL: no memory.
 */
struct sfc_layout *sfc_layout_new(const struct sfc *sfc);
void sfc_layout_free(struct sfc_layout *layout);

/** sfc_layout_step - its shape. Scan-safe: yes. */
const struct sfc_shape *sfc_layout_step(const struct sfc_layout *layout, int step);
/** sfc_step_rows - rows inside the box of a step: its name and times, its actions. */
int sfc_step_rows(const struct sfc *sfc, int step);

#endif
