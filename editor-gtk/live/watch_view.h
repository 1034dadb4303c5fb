/* SPDX-License-Identifier: MIT
 *
 * watch_view - status charts: a table of variables with their values, new values and forces.
 *
 * The charts are kept in the project and are part of its history. Values come from the
 * simulation and are set as acts; while it is off, charts can be edited and show no values.
 */
#ifndef EDITOR_WATCH_VIEW_H
#define EDITOR_WATCH_VIEW_H

#include "editor-gtk/live/watch_row.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_WATCH_VIEW (ladder_watch_view_get_type())
G_DECLARE_FINAL_TYPE(LadderWatchView, ladder_watch_view, LADDER, WATCH_VIEW, GtkWidget)

GtkWidget *ladder_watch_view_new(LadderDocument *document, LadderSim *sim);
/** ladder_watch_view_add - adds rows for the names of a line (watch_names.h) behind the selected
 * row; makes a chart if there is none. False: nothing was added. */
bool ladder_watch_view_add(LadderWatchView *view, const char *line);
/** ladder_watch_view_show - brings a chart of the project to the front, by its name in the file. */
void ladder_watch_view_show(LadderWatchView *view, const char *name);

#endif
