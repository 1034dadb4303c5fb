/* SPDX-License-Identifier: MIT
 *
 * chart_area - a timing chart: a line a variable, time from left to right, a cursor.
 *
 * The cursor is the scan that the simulation shows: whoever drags it looks at the past, in
 * every view of the window. It follows the newest scan until somebody looks elsewhere.
 *
 * Signals:
 *   lines-changed ()  a person removed or moved one
 *   told (const char *text)
 */
#ifndef EDITOR_CHART_AREA_H
#define EDITOR_CHART_AREA_H

#include "editor-gtk/chart.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_CHART_AREA (ladder_chart_area_get_type())
G_DECLARE_FINAL_TYPE(LadderChartArea, ladder_chart_area, LADDER, CHART_AREA, GtkWidget)

/** ladder_chart_area_new - @sim: referenced. */
GtkWidget *ladder_chart_area_new(LadderSim *sim);
/** ladder_chart_area_chart - its numbers. After lines were added or removed from outside:
 * ladder_chart_area_lines_changed(). */
struct chart *ladder_chart_area_chart(LadderChartArea *area);
void ladder_chart_area_lines_changed(LadderChartArea *area);
/** ladder_chart_area_zoom - @factor: more than 1: less time is seen, round the middle. */
void ladder_chart_area_zoom(LadderChartArea *area, double factor);
/** ladder_chart_area_fit - all that there is. */
void ladder_chart_area_fit(LadderChartArea *area);
/** ladder_chart_area_x - where the end of a scan is, px; for tests. */
double ladder_chart_area_x(LadderChartArea *area, guint64 scan);

#endif
