/* SPDX-License-Identifier: MIT
 *
 * tasks_view - the page of the tasks: a table of tasks, each with its programs below it, and
 * a picture of what runs when.
 *
 * Actions: tasks.add, tasks.add-program (s: name of the program), tasks.delete, tasks.up,
 * tasks.down, tasks.open (activates win.go-to). Alt+Up and Alt+Down move a row, as dragging its
 * handle does. A refusal is shown in the cell and below the table.
 */
#ifndef EDITOR_TASKS_VIEW_H
#define EDITOR_TASKS_VIEW_H

#include <gtk/gtk.h>

#include "editor-gtk/sim/sim.h"

#define LADDER_TYPE_TASKS_VIEW (ladder_tasks_view_get_type())
G_DECLARE_FINAL_TYPE(LadderTasksView, ladder_tasks_view, LADDER, TASKS_VIEW, GtkWidget)

GtkWidget *ladder_tasks_view_new(LadderDocument *document);
/** ladder_tasks_view_follow - the picture shows the runs of @sim, too; once. */
void ladder_tasks_view_follow(LadderTasksView *view, LadderSim *sim);
/** ladder_tasks_view_show - selects the task of this name, or the programs without a task. */
void ladder_tasks_view_show(LadderTasksView *view, const char *task);

#endif
