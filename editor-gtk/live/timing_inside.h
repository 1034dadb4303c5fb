/* SPDX-License-Identifier: MIT
 *
 * timing_inside - what the files of the timing chart share. Only timing_*.c include it.
 */
#ifndef EDITOR_TIMING_INSIDE_H
#define EDITOR_TIMING_INSIDE_H

#include "editor-gtk/live/timing_area.h"
#include "editor-gtk/kit/lettering.h"
#include "editor-gtk/kit/theme.h"

#define TIMING_NAMES 210   /* px of the names and values at the left              */
#define TIMING_RULER 22    /* px of the times below                               */
#define TIMING_ROW   34    /* px of a line                                        */

struct _LadderTimingArea {
	GtkWidget parent;
	LadderSim *sim;
	struct timing *timing;
	struct lettering *lettering;
	double span_ns;           /* of the time that is seen                   */
	double right_ns;          /* time at the right edge, unless it follows  */
	bool follows;             /* the newest scan                            */
	int selected;             /* line; -1: none                             */
	guint64 life;             /* of the simulation, that it was seen in last */
	gint64 mark_ns;           /* second cursor, to measure from; -1: none   */
	double drag_x;            /* where a drag began                         */
	double pan_ns;            /* right_ns when a pan began                  */
	guint idle;               /* fills what is not there yet                */
	GtkAdjustment *scrolled;  /* up and down; NULL: not at all             */
};

/** timing_right - time at the right edge now, ns. */
double timing_right(LadderTimingArea *area);
/** timing_plot_width - px; 0 if there is no room. */
double timing_plot_width(LadderTimingArea *area);
/** timing_x - of a time. */
double timing_x(LadderTimingArea *area, double ns);
/** timing_visible_top, timing_visible_bottom - of the widget, px: it is scrolled. */
double timing_visible_top(LadderTimingArea *area);
double timing_visible_bottom(LadderTimingArea *area);
/** timing_draw - timing_draw.c: all of it. */
void timing_draw(LadderTimingArea *area, GtkSnapshot *snapshot);

#endif
