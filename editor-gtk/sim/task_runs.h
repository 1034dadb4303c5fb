/* SPDX-License-Identifier: MIT
 *
 * task_runs - which task ran at which time of a simulation: from its record, a little at a time and
 * across edits. A scan pays nothing for it. It draws nothing.
 */
#ifndef EDITOR_TASK_RUNS_H
#define EDITOR_TASK_RUNS_H

#include "editor-gtk/sim/sim.h"

#define TASK_RUNS_MOST 60000u /* that are kept; the oldest are dropped first      */

/* Runs of one scan follow each other by priority. With a speed of the board (trial/pace.h) they
 * follow each other in time, and a run that was interrupted is several of them, one behind the
 * other. */
struct task_run {
	gint64 at_ns;        /* virtual time                                    */
	gint64 took_ns;      /* with a speed; else 0                            */
	gint64 paused_ns;    /* it goes on: when it was interrupted; else 0     */
	bool whole;          /* it ended; otherwise it goes on later            */
	guint64 scan;
	const char *task;    /* interned; "": programs without a task           */
	gint64 late_ns;      /* behind its deadline                             */
	guint missed;        /* periods left out before it; events that came too early */
	guint order;         /* how many tasks ran before it in the scan        */
	bool fault;          /* it ended in a FAULT                             */
};

struct task_runs;
/** task_runs_new - of no scan yet. @sim: lives longer. Owns: task_runs_free(). */
struct task_runs *task_runs_new(LadderSim *sim);
void task_runs_free(struct task_runs *runs);
/** task_runs_feed - reads scans from the record for at most @us; true: there are more. If the
 * simulation began anew, older runs are dropped. */
bool task_runs_feed(struct task_runs *runs, gint64 us);
guint task_runs_count(const struct task_runs *runs);
/** task_runs_get - by number, oldest first. Borrowed until the next feed. */
const struct task_run *task_runs_get(const struct task_runs *runs, guint number);
/** task_runs_time - of the newest scan that was read; 0: none was. */
gint64 task_runs_time(const struct task_runs *runs);
/** task_runs_from - the number of the first run at or after @ns; their count: there is none. */
guint task_runs_from(const struct task_runs *runs, gint64 ns);
/** task_runs_at_text - what ran in the scan at or before @ns: "At 20 ms: Fast, then Slow (5 ms late, 1
 * period left out)", translated. With a speed: in that period, and how long. @period_ns: of the scans.
 * Caller frees. */
char *task_runs_at_text(const struct task_runs *runs, gint64 ns, gint64 period_ns);
/** task_runs_sum_text - of a task in the scan that is shown: "24 runs, 3 periods left out",
 * translated; NULL: that program has no such task. Caller frees. */
char *task_runs_sum_text(const struct twin *twin, const char *task);

#endif
