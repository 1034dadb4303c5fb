/* SPDX-License-Identifier: MIT
 *
 * schedule - which task runs at which time from the start, as scan/task.h decides in virtual
 * time. Events are left out: nobody knows when they come.
 */
#ifndef EDITOR_SCHEDULE_H
#define EDITOR_SCHEDULE_H

#include <glib.h>
#include <stdbool.h>

#include "engine/scan/task.h"

#define SCHEDULE_CYCLES 4000 /* cycles of a schedule, at most                   */

/* A run of a task. */
struct schedule_run {
	gint64 at_ns;   /* from the first cycle                                */
	int lane;
	int order;      /* how many tasks run before it in the same cycle      */
};

/* By priority, as the tasks of the program. */
struct schedule_lane {
	char *name;           /* "": programs without a task                   */
	enum task_kind kind;
	gint64 interval_ns;   /* of TASK_INTERVAL                              */
	guint32 priority;
};

struct schedule {
	struct schedule_lane *lane;
	int lane_count;
	GArray *run;          /* of struct schedule_run, in the order of time  */
	gint64 tick_ns;       /* between cycles                                */
	gint64 span_ns;       /* two rounds of all periods, or as much as fits  */
	bool whole;           /* two rounds                                    */
};

/** schedule_new - of a program. Owns: the caller, schedule_free().
 * @period_ns: period of the cycles if no task gives one */
struct schedule *schedule_new(const struct program *program, gint64 period_ns);
void schedule_free(struct schedule *schedule);
/** schedule_lane_text - "Fast: priority 1, every 1 ms, at 0 s, 1 ms, 2 ms …", translated.
 * Caller frees. */
char *schedule_lane_text(const struct schedule *schedule, int lane);
/** schedule_at_text - what runs in the cycle at or before @ns: "At 20 ms: Fast, then Slow",
 * translated. Caller frees. */
char *schedule_at_text(const struct schedule *schedule, gint64 ns);
/** schedule_lane_name - its name, or that of the programs without a task, translated.
 * Borrowed. */
const char *schedule_lane_name(const struct schedule_lane *lane);

#endif
