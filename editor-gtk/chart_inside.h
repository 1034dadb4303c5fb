/* SPDX-License-Identifier: MIT
 *
 * chart_inside - what the files of the timing chart share. Only chart_*.c include it.
 */
#ifndef EDITOR_CHART_INSIDE_H
#define EDITOR_CHART_INSIDE_H

#include "editor-gtk/chart_area.h"
#include "editor-gtk/lettering.h"
#include "editor-gtk/theme.h"

#define CHART_NAMES 210   /* px of the names and values at the left              */
#define CHART_RULER 22    /* px of the times below                               */
#define CHART_ROW   34    /* px of a line                                        */

struct _LadderChartArea {
	GtkWidget parent;
	LadderSim *sim;
	struct chart *chart;
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

/** chart_right - time at the right edge now, ns. */
double chart_right(LadderChartArea *area);
/** chart_plot_width - px; 0 if there is no room. */
double chart_plot_width(LadderChartArea *area);
/** chart_x - of a time. */
double chart_x(LadderChartArea *area, double ns);
/** chart_visible_top, chart_visible_bottom - of the widget, px: it is scrolled. */
double chart_visible_top(LadderChartArea *area);
double chart_visible_bottom(LadderChartArea *area);
/** chart_draw - chart_draw.c: all of it. */
void chart_draw(LadderChartArea *area, GtkSnapshot *snapshot);

#endif
