/* SPDX-License-Identifier: MIT
 *
 * sfc_inside - data of a played chart, for sfc.c and sfc_lines.c only.
 */
#ifndef WALKER_SFC_INSIDE_H
#define WALKER_SFC_INSIDE_H

#include "tests/walker/sfc.h"

struct played_step {
	struct value *x, *t;
	struct placed min, max, alarm;
	bool leaving, entering; /* marks of one evolution                     */
	bool begins;            /* became active in this evolution            */
	bool entered, left;     /* in this scan                               */
};

/* A line that calls an action or a BOOL. */
struct played_line {
	const struct sfc_use *use;
	int target;
	struct placed time;
	bool waits;             /* SD, SL: time since its start; DS: while X  */
	bool stored;            /* S, DS                                      */
	int64_t elapsed;        /* of SD and SL                               */
	bool calls;             /* in this scan                               */
};

/* The target of lines: an action, or a BOOL. */
struct target {
	const struct sfc_action *action; /* NULL: a BOOL                      */
	uint32_t fold;          /* of a BOOL: its name                        */
	struct placed place;
	bool called, was_called;         /* in this scan, in the previous one */
	bool in_passing, was_in_passing; /* only by P0 and P1                 */
};

struct once {
	const struct sfc_use *use;
	struct placed place;
};

struct played_sfc {
	const struct sfc *sfc;
	struct walked_pou *walked;
	struct played_step *step;
	int *order;             /* transitions, in the order of evaluation */
	struct placed control[CONTROL_COUNT];
	bool was[CONTROL_COUNT];
	int64_t force;          /* in the previous scan                       */
	bool started;
	int64_t before_ns;
	struct played_line *line;
	int line_count;
	struct target *target;
	int target_count;
	struct once *once;      /* SET and RESET                              */
	int once_count;
};

/* sfc.c */
int64_t sfc_time(const struct placed *at);

/* sfc_lines.c */
/** lines_make - lines and their targets; false: not supported. */
bool lines_make(struct walker *walker, struct played_sfc *played);
/** lines_once - SET and RESET of a step. */
void lines_once(struct walker *walker, struct played_sfc *played, int step);
void lines_pass_time(struct played_sfc *played, int64_t passed);
/** lines_forget - resets all stored lines. */
void lines_forget(struct played_sfc *played);
/** lines_act - executes the called actions. False: a fault. */
bool lines_act(struct walker *walker, struct played_sfc *played);
#endif
