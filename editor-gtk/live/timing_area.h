/* SPDX-License-Identifier: MIT
 *
 * timing_area - a timing chart: one line for each variable, time from left to right, a cursor.
 *
 * The cursor is the scan that the simulation shows. Dragging it shows the past in all views of
 * the window. The chart follows the newest scan until a person moves it.
 *
 * Signals:
 *   lines-changed ()  a person removed or moved a line
 */
#ifndef EDITOR_TIMING_AREA_H
#define EDITOR_TIMING_AREA_H

#include "editor-gtk/live/timing.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_TIMING_AREA (ladder_timing_area_get_type())
G_DECLARE_FINAL_TYPE(LadderTimingArea, ladder_timing_area, LADDER, TIMING_AREA, GtkWidget)

/** ladder_timing_area_new - @sim: referenced. */
GtkWidget *ladder_timing_area_new(LadderSim *sim);
/** ladder_timing_area_timing - its numbers. Call ladder_timing_area_lines_changed() after
 * adding or removing lines. */
struct timing *ladder_timing_area_timing(LadderTimingArea *area);
void ladder_timing_area_lines_changed(LadderTimingArea *area);
/** ladder_timing_area_zoom - @factor: more than 1 shows less time; the middle stays. */
void ladder_timing_area_zoom(LadderTimingArea *area, double factor);
/** ladder_timing_area_fit - shows all recorded scans. */
void ladder_timing_area_fit(LadderTimingArea *area);

#endif
