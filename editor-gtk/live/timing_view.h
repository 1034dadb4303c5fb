/* SPDX-License-Identifier: MIT
 *
 * timing_view - the timing chart with its buttons, and the choice of its variables.
 *
 * Until a person chooses variables, it shows inputs and outputs of the program.
 */
#ifndef EDITOR_TIMING_VIEW_H
#define EDITOR_TIMING_VIEW_H

#include "editor-gtk/live/timing_area.h"

#define LADDER_TYPE_TIMING_VIEW (ladder_timing_view_get_type())
G_DECLARE_FINAL_TYPE(LadderTimingView, ladder_timing_view, LADDER, TIMING_VIEW, GtkBox)

/** ladder_timing_view_new - @sim: referenced. */
GtkWidget *ladder_timing_view_new(LadderSim *sim);
/** ladder_timing_view_add - a variable or address. False: it is in the chart already, or the
 * chart is full. */
bool ladder_timing_view_add(LadderTimingView *view, const char *name);

#endif
