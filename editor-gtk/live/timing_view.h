/* SPDX-License-Identifier: MIT
 *
 * timing_view - the timing chart with its buttons: what it shows is chosen here.
 *
 * Until a person chooses, it shows the inputs and outputs of the program.
 */
#ifndef EDITOR_TIMING_VIEW_H
#define EDITOR_TIMING_VIEW_H

#include "editor-gtk/live/timing_area.h"

#define LADDER_TYPE_TIMING_VIEW (ladder_timing_view_get_type())
G_DECLARE_FINAL_TYPE(LadderTimingView, ladder_timing_view, LADDER, TIMING_VIEW, GtkBox)

/** ladder_timing_view_new - @sim: referenced. */
GtkWidget *ladder_timing_view_new(LadderSim *sim);
/** ladder_timing_view_add - a variable or address; false: it is there, or there is no room. */
bool ladder_timing_view_add(LadderTimingView *view, const char *name);
LadderTimingArea *ladder_timing_view_area(LadderTimingView *view);

#endif
