/* SPDX-License-Identifier: MIT
 *
 * task_lane - draws the runs of one task over time, or the ruler below all of them.
 *
 * All lanes of a picture share a GtkAdjustment: value and page size are the visible time in ns.
 */
#ifndef EDITOR_TASK_LANE_H
#define EDITOR_TASK_LANE_H

#include <gtk/gtk.h>

#include "editor-gtk/sim/schedule.h"
#include "editor-gtk/sim/task_runs.h"

#define LADDER_TYPE_TASK_LANE (ladder_task_lane_get_type())
G_DECLARE_FINAL_TYPE(LadderTaskLane, ladder_task_lane, LADDER, TASK_LANE, GtkWidget)

/** ladder_task_lane_new - @time: a reference is kept. */
GtkWidget *ladder_task_lane_new(GtkAdjustment *time);
/** ladder_task_lane_set - @schedule: borrowed until the next call; NULL: draws nothing.
 * @lane: -1: the ruler */
void ladder_task_lane_set(LadderTaskLane *lane, const struct schedule *schedule, int number);
/* A simulation. */
struct task_live {
	const struct task_runs *runs; /* borrowed; NULL: none                   */
	gint64 start_ns;              /* when the tasks were due first          */
	gint64 now_ns;                /* of the scan that is shown              */
	gint64 period_ns;             /* of the scans                           */
};
/** ladder_task_lane_live - draws the runs of a simulation over the plan, which begins with it. */
void ladder_task_lane_live(LadderTaskLane *lane, const struct task_live *live);
/** ladder_task_lane_mark - draws a line at this time; -1: none. */
void ladder_task_lane_mark(LadderTaskLane *lane, gint64 ns);
/** ladder_task_lane_time - the time at pixel @x. */
gint64 ladder_task_lane_time(LadderTaskLane *lane, double x);

#endif
