/* SPDX-License-Identifier: MIT
 *
 * fbd_plan - where the boxes of a network stand, and how its wires run.
 *
 * Boxes stand in columns, each right of what it reads; ends of lines (stores, jumps) stand in the last
 * one. Between two columns is a channel for the vertical parts of wires. Pins lie in rows. No box
 * covers another, no wire runs through a box or along another wire. The unit of x is the caller's: the editor
 * has pixels, a terminal has characters. It measures texts with the function that it is given.
 */
#ifndef SHOW_FBD_PLAN_H
#define SHOW_FBD_PLAN_H

#include "engine/model/fbd_graph.h"

enum fbd_text { FBD_TEXT_TYPE, FBD_TEXT_INSTANCE, FBD_TEXT_PIN, FBD_TEXT_OPERAND, FBD_TEXT_TARGET, FBD_TEXT_WIRE };

struct fbd_metrics {
	/** Width of a text. */
	float (*width)(void *context, enum fbd_text kind, const char *text);
	void *context;
	int head;          /* rows above the first pin of a box, with the air above it */
	int instance;      /* so many more if it has a name                        */
	int foot;          /* rows below the last pin                              */
	int end_head, end_foot; /* the same of stores, jumps …                    */
	float pad;         /* from the side of a box to the name of a pin          */
	float middle;      /* least between the names of both sides                */
	float least;       /* width of a box                                       */
	float end_least;   /* of a store                                           */
	float stub;        /* from a value in place to the side                    */
	float circle;      /* more at a negated pin                                */
	float tail;        /* least room behind an output that is connected        */
	float side;        /* from a column to the first vertical wire              */
	float track;       /* from one vertical wire to the next                   */
};

struct fbd_at {
	int column;        /* from 0                                               */
	float x, width;    /* of the box itself                                    */
	int first;         /* row of its first pin                                 */
	int rows;          /* from its first to its last pin                       */
	int top, bottom;   /* the rows that it takes                               */
};
struct fbd_pin_at { float x; int row; };

struct fbd_segment {
	int pin;           /* the output that it comes from                        */
	float x1, x2;      /* x1 == x2: a vertical part                            */
	int row1, row2;    /* row1 <= row2                                         */
	bool feedback;
};
struct fbd_point { int pin; float x; int row; };

struct fbd_plan {
	struct fbd_at *box;          /* by box                                     */
	struct fbd_pin_at *pin;      /* by pin                                     */
	struct fbd_segment *segment;
	int segment_count;
	struct fbd_point *joint;     /* where a wire branches                       */
	int joint_count;
	struct fbd_point *crossing;  /* where a vertical part of @pin crosses another wire */
	int crossing_count;
	int columns, rows;
	float width;
	struct arena arena;
};

/**
 * fbd_plan_make - lays a network out
 * @out: caller's memory; fbd_plan_free()
 *
 * The same graph and metrics give the same plan. Scan-safe: no.
 * Fails: false: no memory; @out is empty.
 */
bool fbd_plan_make(const struct fbd_graph *graph, const struct fbd_metrics *metrics, struct fbd_plan *out);
void fbd_plan_free(struct fbd_plan *plan);
/** fbd_is_end - a store, set, reset, jump or return? Scan-safe: yes. */
bool fbd_is_end(const struct fbd_box *box);

#endif
