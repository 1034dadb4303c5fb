/* SPDX-License-Identifier: MIT
 *
 * timing_area - a timing chart: a line a variable, time from left to right, a cursor.
 *
 * The cursor is the scan that the simulation shows: whoever drags it looks at the past, in
 * every view of the window. It follows the newest scan until somebody looks elsewhere.
 *
 * Signals:
 *   lines-changed ()  a person removed or moved one
 *   told (const char *text)
 */
#ifndef EDITOR_TIMING_AREA_H
#define EDITOR_TIMING_AREA_H

#include "editor-gtk/live/timing.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_TIMING_AREA (ladder_timing_area_get_type())
G_DECLARE_FINAL_TYPE(LadderTimingArea, ladder_timing_area, LADDER, TIMING_AREA, GtkWidget)

/** ladder_timing_area_new - @sim: referenced. */
GtkWidget *ladder_timing_area_new(LadderSim *sim);
/** ladder_timing_area_timing - its numbers. After lines were added or removed from outside:
 * ladder_timing_area_lines_changed(). */
struct timing *ladder_timing_area_timing(LadderTimingArea *area);
void ladder_timing_area_lines_changed(LadderTimingArea *area);
/** ladder_timing_area_zoom - @factor: more than 1: less time is seen, round the middle. */
void ladder_timing_area_zoom(LadderTimingArea *area, double factor);
/** ladder_timing_area_fit - all that there is. */
void ladder_timing_area_fit(LadderTimingArea *area);
/** ladder_timing_area_x - where the end of a scan is, px; for tests. */
double ladder_timing_area_x(LadderTimingArea *area, guint64 scan);

#endif
