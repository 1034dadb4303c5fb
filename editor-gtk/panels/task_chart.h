/* SPDX-License-Identifier: MIT
 *
 * task_chart - what runs when: a lane for each task over time, by priority.
 *
 * The pointer, or Left and Right in a lane, show what runs at a time. Ctrl and the wheel zoom.
 * While the simulation is on, it has the runs of the record over the plan, and follows the scan
 * that is shown; a click or Enter shows the scan of a run.
 */
#ifndef EDITOR_TASK_CHART_H
#define EDITOR_TASK_CHART_H

#include <gtk/gtk.h>

#include "editor-gtk/sim/schedule.h"
#include "editor-gtk/sim/sim.h"
#include "editor-gtk/document/task_rows.h"

#define LADDER_TYPE_TASK_CHART (ladder_task_chart_get_type())
G_DECLARE_FINAL_TYPE(LadderTaskChart, ladder_task_chart, LADDER, TASK_CHART, GtkBox)

/** ladder_task_chart_follow - @sim: referenced; once. */
void ladder_task_chart_follow(LadderTaskChart *chart, LadderSim *sim);
/** ladder_task_chart_set - @schedule: taken over; NULL: the program has errors. @tasks: gives the
 * variables of events. */
void ladder_task_chart_set(LadderTaskChart *chart, struct schedule *schedule,
			   const struct task_rows *tasks);

#endif
