/* SPDX-License-Identifier: MIT
 *
 * watch_view - status charts: variables in a table, what they hold now, new values and
 * forces for them.
 *
 * Which variables stand in a chart is kept in the project, one history with everything
 * else. Values come from the simulation and go to it as acts; while it is off the table can
 * be made, and shows no values.
 */
#ifndef EDITOR_WATCH_VIEW_H
#define EDITOR_WATCH_VIEW_H

#include "editor-gtk/sim/sim.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_WATCH_VIEW (ladder_watch_view_get_type())
G_DECLARE_FINAL_TYPE(LadderWatchView, ladder_watch_view, LADDER, WATCH_VIEW, GtkWidget)

GtkWidget *ladder_watch_view_new(LadderDocument *document, LadderSim *sim);
/** ladder_watch_view_add - more rows behind the selected one, for what a line means
 * (watch_names.h); a chart is made if there is none. False: nothing was added. */
bool ladder_watch_view_add(LadderWatchView *view, const char *line);
/** ladder_watch_view_list - the rows shown (LadderWatchRow). Borrowed. */
GListModel *ladder_watch_view_list(LadderWatchView *view);
/** ladder_watch_view_message - what was refused last; "": nothing. Borrowed. */
const char *ladder_watch_view_message(LadderWatchView *view);

#endif
