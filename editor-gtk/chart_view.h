/* SPDX-License-Identifier: MIT
 *
 * chart_view - the timing chart with its buttons: what it shows is chosen here.
 *
 * Until a person chooses, it shows the inputs and outputs of the program.
 */
#ifndef EDITOR_CHART_VIEW_H
#define EDITOR_CHART_VIEW_H

#include "editor-gtk/chart_area.h"

#define LADDER_TYPE_CHART_VIEW (ladder_chart_view_get_type())
G_DECLARE_FINAL_TYPE(LadderChartView, ladder_chart_view, LADDER, CHART_VIEW, GtkBox)

/** ladder_chart_view_new - @sim: referenced. */
GtkWidget *ladder_chart_view_new(LadderSim *sim);
/** ladder_chart_view_add - a variable or address; false: it is there, or there is no room. */
bool ladder_chart_view_add(LadderChartView *view, const char *name);
LadderChartArea *ladder_chart_view_area(LadderChartView *view);

#endif
