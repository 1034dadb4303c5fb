/* SPDX-License-Identifier: MIT
 *
 * sfc_inside - what sfc.c and sfc_lines.c share. Nobody else includes it.
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
	bool waits;             /* SD, SL: since it began; DS: while X        */
	bool stored;            /* S, DS                                      */
	int64_t elapsed;        /* of SD and SL                               */
	bool calls;             /* in this scan                               */
};

/* What lines call: an action, or a BOOL. */
struct target {
	const struct sfc_action *action; /* NULL: a BOOL                      */
	uint32_t fold;          /* of a BOOL: its name                        */
	struct placed place;
	bool called, was_called;         /* in this scan, in the one before   */
	bool in_passing, was_in_passing; /* by P0 and P1 alone                */
};

struct once {
	const struct sfc_use *use;
	struct placed place;
};

struct played_sfc {
	const struct sfc *sfc;
	struct walked_pou *walked;
	struct played_step *step;
	int *order;             /* transitions, the first that is asked first */
	struct placed control[CONTROL_COUNT];
	bool was[CONTROL_COUNT];
	int64_t force;          /* in the scan before                         */
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
/** lines_make - lines and what they call; false: cannot. */
bool lines_make(struct walker *walker, struct played_sfc *played);
/** lines_once - SET and RESET of a step. */
void lines_once(struct walker *walker, struct played_sfc *played, int step);
void lines_pass_time(struct played_sfc *played, int64_t passed);
/** lines_forget - nothing is stored any more. */
void lines_forget(struct played_sfc *played);
/** lines_act - what is called for is done. False: a fault. */
bool lines_act(struct walker *walker, struct played_sfc *played);
#endif
