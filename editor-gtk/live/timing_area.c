/* SPDX-License-Identifier: MIT
 *
 * timing_area - the widget of a timing chart: cursor, zoom, pan, lines, and its drawing.
 *
 * A pixel shows the least and the greatest value of all scans in it, so that a pulse of one
 * scan is visible however much time the chart shows.
 */
#include "editor-gtk/live/timing_area.h"

#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/lettering.h"
#include "editor-gtk/kit/settings.h"
#include "editor-gtk/kit/spelling.h"
#include "editor-gtk/kit/theme.h"
#include "editor-gtk/sim/live_value.h"

#include <gtk/gtk.h>
#include <math.h>

#define NAMES_PX 210      /* names and values at the left                        */
#define RULER_PX 22       /* times below                                         */
#define ROW_PX   34       /* a line                                              */
#define TICK_APART 90     /* px between two times of the ruler, at least           */
#define SPAN_LEAST_NS 1e6
#define SPAN_MOST_NS  4e12
#define SPAN_FIRST_NS 1e10
#define FEED_US    2000   /* time for taking new scans in a frame                */

static guint lines_changed_signal;

struct _LadderTimingArea {
	GtkWidget parent;
	LadderSim *sim;
	struct timing *timing;
	struct lettering *lettering;
	double span_ns;           /* from the left edge to the right            */
	double right_ns;          /* time at the right edge, unless `follows`   */
	bool follows;             /* the right edge is the newest scan          */
	int selected;             /* a line; -1: none                           */
	guint64 life;             /* of the simulation, as it was last seen     */
	gint64 mark_ns;           /* second cursor, to measure from; -1: none   */
	double drag_x;            /* where a drag began                         */
	double pan_ns;            /* right_ns when a pan began                  */
	char *bad;                /* what a screen reader says of values that are not good */
	guint idle;               /* takes the scans that are missing           */
	GtkAdjustment *scrolled;  /* vertical scrolling; NULL: none             */
};

G_DEFINE_FINAL_TYPE(LadderTimingArea, ladder_timing_area, GTK_TYPE_WIDGET)

/* ---- time and place ---- */

static double newest(LadderTimingArea *area)
{
	const struct timing *timing = area->timing;

	return timing_first(timing) < timing_end(timing) ?
	       (double)timing_time(timing, timing_end(timing) - 1) : 0;
}

static double right_edge(LadderTimingArea *area)
{
	return area->follows ? MAX(newest(area), area->span_ns) : area->right_ns;
}

static double plot_width(LadderTimingArea *area)
{
	return MAX(gtk_widget_get_width(GTK_WIDGET(area)) - NAMES_PX, 0);
}

static double x_of(LadderTimingArea *area, double ns)
{
	return NAMES_PX + plot_width(area) -
	       (right_edge(area) - ns) / area->span_ns * plot_width(area);
}

static double visible_top(LadderTimingArea *area)
{
	return area->scrolled ? gtk_adjustment_get_value(area->scrolled) : 0;
}

static double visible_bottom(LadderTimingArea *area)
{
	const double height = gtk_widget_get_height(GTK_WIDGET(area));

	return area->scrolled ? MIN(height, visible_top(area) +
				    gtk_adjustment_get_page_size(area->scrolled)) : height;
}

static double ns_at(LadderTimingArea *area, double x)
{
	return right_edge(area) - (NAMES_PX + plot_width(area) - x) *
	       area->span_ns / MAX(plot_width(area), 1);
}

static void see(LadderTimingArea *area, double right_ns)
{
	const double most = newest(area), least = area->span_ns;

	area->follows = right_ns >= most;
	area->right_ns = CLAMP(right_ns, MIN(least, most), MAX(most, least));
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

static void zoom_at(LadderTimingArea *area, double factor, double x)
{
	const double ns = ns_at(area, x);
	const double part = (x - NAMES_PX) / MAX(plot_width(area), 1);

	area->span_ns = CLAMP(area->span_ns / factor, SPAN_LEAST_NS, SPAN_MOST_NS);
	if (!area->follows)
		see(area, ns + (1 - part) * area->span_ns);
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

void ladder_timing_area_zoom(LadderTimingArea *area, double factor)
{
	zoom_at(area, factor, NAMES_PX + plot_width(area) / 2);
}

void ladder_timing_area_fit(LadderTimingArea *area)
{
	const struct timing *timing = area->timing;

	if (timing_first(timing) < timing_end(timing))
		area->span_ns = CLAMP(newest(area) -
			(double)timing_time(timing, timing_first(timing)), SPAN_LEAST_NS, SPAN_MOST_NS);
	area->follows = true;
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

/* ---- the record ---- */

static gboolean fill_idle(gpointer data)
{
	LadderTimingArea *area = data;
	const bool more = timing_feed(area->timing, FEED_US);

	gtk_widget_queue_draw(GTK_WIDGET(area));
	if (more)
		return G_SOURCE_CONTINUE;
	area->idle = 0;
	return G_SOURCE_REMOVE;
}

static bool has_scan(LadderTimingArea *area, guint64 scan)
{
	return scan >= timing_first(area->timing) && scan < timing_end(area->timing);
}

/* As the preferences spell addresses. Caller: g_free(). */
static char *shown_name(const struct timing *timing, int line)
{
	return spelling_shown(timing_name(timing, line));
}

/* The lines whose values are not good at the scan that is shown. */
static void say_bad(LadderTimingArea *area)
{
	const struct twin *twin = ladder_sim_twin(area->sim);
	GString *text = g_string_new(NULL);

	for (int i = 0; twin && has_scan(area, twin->scan) && i < timing_lines(area->timing); i++) {
		const enum sim_quality quality = timing_quality(area->timing, i, twin->scan);
		char *name;

		if (quality == SIM_GOOD)
			continue;
		name = shown_name(area->timing, i);
		g_string_append(text, text->len ? ", " : "");
		g_string_append_printf(text, _("%s: %s"), name, live_quality_word(quality));
		g_free(name);
	}
	if (g_strcmp0(area->bad, text->str) != 0)
		gtk_accessible_update_property(GTK_ACCESSIBLE(area), GTK_ACCESSIBLE_PROPERTY_DESCRIPTION, text->str, -1);
	g_free(area->bad);
	area->bad = g_string_free(text, FALSE);
}

static void tell_cursor(LadderTimingArea *area)
{
	const struct twin *twin = ladder_sim_twin(area->sim);
	char *text, time[32];

	if (!twin)
		return;
	live_time_print(twin->now_ns, time, sizeof(time));
	text = g_strdup_printf(_("scan %llu, %s"), (unsigned long long)twin->scan, time);
	gtk_accessible_update_property(GTK_ACCESSIBLE(area),
		GTK_ACCESSIBLE_PROPERTY_VALUE_NOW, (double)twin->scan,
		GTK_ACCESSIBLE_PROPERTY_VALUE_TEXT, text, -1);
	g_free(text);
}

static void shown(LadderTimingArea *area)
{
	const guint64 end = timing_end(area->timing);

	if (!gtk_widget_get_mapped(GTK_WIDGET(area)))
		return;
	if (!area->idle && timing_feed(area->timing, FEED_US))
		area->idle = g_idle_add(fill_idle, area);
	if (ladder_sim_is_past(area->sim))
		tell_cursor(area);
	say_bad(area);
	if (end != timing_end(area->timing) || ladder_sim_state(area->sim) != SIM_RUN)
		gtk_widget_queue_draw(GTK_WIDGET(area));
}

static void program_changed(LadderTimingArea *area)
{
	const guint64 life = ladder_sim_life(area->sim);

	timing_program_changed(area->timing);
	if (area->life != life) {
		area->mark_ns = -1;
		area->follows = true;
	}
	area->life = life;
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

struct timing *ladder_timing_area_timing(LadderTimingArea *area)
{
	return area->timing;
}

void ladder_timing_area_lines_changed(LadderTimingArea *area)
{
	area->selected = MIN(area->selected, timing_lines(area->timing) - 1);
	gtk_widget_queue_resize(GTK_WIDGET(area));
	shown(area);
}

/* ---- the cursor ---- */

static void show_scan(LadderTimingArea *area, guint64 scan)
{
	const struct timing *timing = area->timing;

	if (timing_first(timing) >= timing_end(timing))
		return;
	scan = CLAMP(scan, timing_first(timing), timing_end(timing) - 1);
	/* The chart stands still while a scan of the past is shown. */
	area->right_ns = right_edge(area);
	area->follows = false;
	ladder_sim_show(area->sim, scan);
	const double x = x_of(area, (double)timing_time(timing, scan));

	if (x < NAMES_PX || x > NAMES_PX + plot_width(area))
		see(area, (double)timing_time(timing, scan) + area->span_ns / 2);
}

static void show_now(LadderTimingArea *area)
{
	area->follows = true;
	ladder_sim_show_now(area->sim);
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

static void show_at(LadderTimingArea *area, double x)
{
	const double ns = ns_at(area, x);

	show_scan(area, timing_scan_at(area->timing, (gint64)MAX(ns, 0)));
}

/* ---- pointer ---- */

static int line_at(LadderTimingArea *area, double y)
{
	const int line = (int)(y / ROW_PX);

	return y >= 0 && line < timing_lines(area->timing) ? line : -1;
}

static void drag_begin(LadderTimingArea *area, double x, double y, GtkGestureDrag *drag)
{
	const GdkModifierType state = gtk_event_controller_get_current_event_state(
		GTK_EVENT_CONTROLLER(drag));

	gtk_widget_grab_focus(GTK_WIDGET(area));
	area->drag_x = x;
	area->selected = line_at(area, y);
	if (x >= NAMES_PX && (state & GDK_SHIFT_MASK))
		area->mark_ns = (gint64)MAX(ns_at(area, x), 0);
	else if (x >= NAMES_PX)
		show_at(area, x);
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

static void drag_update(LadderTimingArea *area, double dx)
{
	if (area->drag_x >= NAMES_PX)
		show_at(area, MAX(area->drag_x + dx, NAMES_PX));
}

static void pan_begin(LadderTimingArea *area)
{
	area->pan_ns = right_edge(area);
}

static void pan_update(LadderTimingArea *area, double dx)
{
	see(area, area->pan_ns - dx * area->span_ns / MAX(plot_width(area), 1));
}

static gboolean scroll(GtkEventControllerScroll *scroll, double dx, double dy,
		       LadderTimingArea *area)
{
	const GdkModifierType state = gtk_event_controller_get_current_event_state(
		GTK_EVENT_CONTROLLER(scroll));

	if (state & GDK_CONTROL_MASK)
		ladder_timing_area_zoom(area, dy < 0 ? 1.25 : 0.8);
	else if (dx != 0 || (state & GDK_SHIFT_MASK))
		see(area, right_edge(area) + (dx != 0 ? dx : dy) * area->span_ns / 20);
	else
		return GDK_EVENT_PROPAGATE;
	return GDK_EVENT_STOP;
}

/* ---- lines ---- */

static void move_line(LadderTimingArea *area, int by)
{
	const int to = area->selected + by;

	if (area->selected < 0 || to < 0 || to >= timing_lines(area->timing))
		return;
	timing_move(area->timing, area->selected, to);
	area->selected = to;
	ladder_timing_area_lines_changed(area);
	g_signal_emit(area, lines_changed_signal, 0);
}

static void remove_line(LadderTimingArea *area)
{
	if (area->selected < 0)
		return;
	timing_remove(area->timing, area->selected);
	ladder_timing_area_lines_changed(area);
	g_signal_emit(area, lines_changed_signal, 0);
}

static void do_line(GtkWidget *widget, const char *name, GVariant *unused)
{
	LadderTimingArea *area = LADDER_TIMING_AREA(widget);

	(void)unused;
	if (g_str_equal(name, "line.remove"))
		remove_line(area);
	else
		move_line(area, g_str_equal(name, "line.up") ? -1 : 1);
}

static void open_menu(LadderTimingArea *area, int count, double x, double y)
{
	GMenu *menu;

	(void)count;
	area->selected = line_at(area, y);
	gtk_widget_queue_draw(GTK_WIDGET(area));
	if (area->selected < 0)
		return;
	menu = g_menu_new();
	g_menu_append(menu, _("Move up"), "line.up");
	g_menu_append(menu, _("Move down"), "line.down");
	g_menu_append(menu, _("Remove"), "line.remove");
	popover_menu(GTK_WIDGET(area), menu, &(GdkRectangle){ (int)x, (int)y, 1, 1 },
		     GTK_WIDGET(area));
}

/* ---- keys ---- */

static void step(LadderTimingArea *area, gint64 by)
{
	const struct twin *twin = ladder_sim_twin(area->sim);

	if (twin)
		show_scan(area, by < 0 && twin->scan < (guint64)-by ? 0 :
			  twin->scan + (guint64)by);
}

static gboolean key_pressed(GtkEventControllerKey *keys, guint key, guint code,
			    GdkModifierType state, LadderTimingArea *area)
{
	const gint64 far = state & GDK_CONTROL_MASK ? 100 : state & GDK_SHIFT_MASK ? 10 : 1;

	(void)keys;
	(void)code;
	if (state & GDK_ALT_MASK)
		return GDK_EVENT_PROPAGATE;
	switch (key) {
	case GDK_KEY_Left: step(area, -far); break;
	case GDK_KEY_Right: step(area, far); break;
	case GDK_KEY_Home: show_scan(area, 0); break;
	case GDK_KEY_End: case GDK_KEY_Escape: show_now(area); break;
	case GDK_KEY_Up: area->selected = MAX(area->selected - 1, 0); break;
	case GDK_KEY_Down:
		area->selected = MIN(area->selected + 1, timing_lines(area->timing) - 1);
		break;
	case GDK_KEY_plus: case GDK_KEY_KP_Add: ladder_timing_area_zoom(area, 1.25); break;
	case GDK_KEY_minus: case GDK_KEY_KP_Subtract:
		ladder_timing_area_zoom(area, 0.8);
		break;
	case GDK_KEY_Delete: remove_line(area); break;
	default: return GDK_EVENT_PROPAGATE;
	}
	gtk_widget_queue_draw(GTK_WIDGET(area));
	return GDK_EVENT_STOP;
}

/* ---- drawing ---- */

struct drawing {
	LadderTimingArea *area;
	const struct timing *timing;
	GtkSnapshot *snapshot;
	const struct theme *theme;
	double width, bottom;   /* bottom of the visible part                  */
	double left_ns, ns_per_px;
};

static void text(struct drawing *drawing, enum letter letter, enum token token,
		 const char *what, double x, double y, double bound)
{
	const struct lettered fit = lettering_fit(drawing->area->lettering, letter, what, -1,
						  (float)bound);
	float baseline;
	PangoLayout *layout = lettering_layout(drawing->area->lettering, letter, fit.text,
					       &baseline);

	gtk_snapshot_save(drawing->snapshot);
	gtk_snapshot_translate(drawing->snapshot, &GRAPHENE_POINT_INIT(
		(float)x, (float)y - baseline));
	gtk_snapshot_append_layout(drawing->snapshot, layout,
				   &drawing->theme->color[token]);
	gtk_snapshot_restore(drawing->snapshot);
}

static void fill(struct drawing *drawing, enum token token, float alpha, double x, double y,
		 double width, double height)
{
	GdkRGBA color = drawing->theme->color[token];

	color.alpha = alpha;
	gtk_snapshot_append_color(drawing->snapshot, &color,
		&GRAPHENE_RECT_INIT((float)x, (float)y, (float)width, (float)height));
}

/* ---- times ---- */

static double tick_step(double least)
{
	const double power = pow(10, floor(log10(least)));

	for (int i = 1; i < 10; i = i == 1 ? 2 : i == 2 ? 5 : 10)
		if (i * power >= least)
			return i * power;
	return 10 * power;
}

static void draw_ruler(struct drawing *drawing)
{
	const double step = tick_step(TICK_APART * drawing->ns_per_px);
	const double top = drawing->bottom - RULER_PX;
	char label[32];

	fill(drawing, TOKEN_SHEET, 1, 0, top, drawing->width, RULER_PX);
	fill(drawing, TOKEN_LINE, 1, 0, top, drawing->width, 1);
	for (double ns = ceil(MAX(drawing->left_ns, 0) / step) * step;; ns += step) {
		const double x = x_of(drawing->area, ns);

		if (x > drawing->width)
			return;
		fill(drawing, TOKEN_LINE, 1, x, 0, 1, top + 5);
		live_time_print_tick((gint64)(round(ns / step) * step), (gint64)step, label, sizeof(label));
		text(drawing, LETTER_ADDRESS, TOKEN_COMMENT, label, x + 4, top + 15, 0);
	}
}

/* ---- lines ---- */

/* The values of a line in one pixel. */
struct span {
	double low, high, last;
	bool any;
};

/* @scan: the next scan, counted on; pixels are asked for from left to right. */
static struct span span_of(struct drawing *drawing, int line, guint64 *scan, double until)
{
	const guint64 end = timing_end(drawing->timing);
	struct span span = { 0 };

	while (*scan < end && (double)timing_time(drawing->timing, *scan) <= until) {
		span.last = timing_value(drawing->timing, line, *scan);
		span.low = span.any ? MIN(span.low, span.last) : span.last;
		span.high = span.any ? MAX(span.high, span.last) : span.last;
		span.any = true;
		(*scan)++;
	}
	return span;
}

static guint64 scan_from(struct drawing *drawing)
{
	return timing_scan_at(drawing->timing, (gint64)MAX(drawing->left_ns, 0));
}

static void set_color(cairo_t *cairo, const GdkRGBA *color, float alpha)
{
	cairo_set_source_rgba(cairo, (double)color->red, (double)color->green,
			      (double)color->blue, (double)alpha);
}

/* ---- stretches that are not good ---- */

#define HATCH_PX 7

/* Slanted strokes, as colour alone would not be enough; those of a fault cross, those of a force are upright. */
static void hatch(cairo_t *cairo, double x, double y, double width, double height, enum sim_quality quality)
{
	cairo_save(cairo);
	cairo_rectangle(cairo, x, y, width, height);
	cairo_clip(cairo);
	for (double at = floor((x - height) / HATCH_PX) * HATCH_PX; at < x + width + height; at += HATCH_PX) {
		cairo_move_to(cairo, at, y + height);
		cairo_line_to(cairo, quality == SIM_FORCED ? at : at + height, y);
		if (quality != SIM_VALUE_FAULT)
			continue;
		cairo_move_to(cairo, at, y);
		cairo_line_to(cairo, at + height, y + height);
	}
	cairo_stroke(cairo);
	cairo_restore(cairo);
}

static double x_in_plot(struct drawing *drawing, guint64 scan)
{
	return CLAMP(x_of(drawing->area, (double)timing_time(drawing->timing, scan)), NAMES_PX, drawing->width);
}

/* The first scan from @scan on with another quality. */
static guint64 stretch_end(const struct timing *timing, int line, guint64 scan)
{
	const enum sim_quality quality = timing_quality(timing, line, scan);

	do
		scan++;
	while (scan < timing_end(timing) && timing_quality(timing, line, scan) == quality);
	return scan;
}

/* The plot behind the curve is grey where the value was not good, and has the colour of forces where it was forced. A stretch of one scan has a pixel at least. */
static void draw_stretches(struct drawing *drawing, int line, double top, cairo_t *cairo)
{
	const struct timing *timing = drawing->timing;
	guint64 end;

	cairo_set_line_width(cairo, 1);
	cairo_set_antialias(cairo, CAIRO_ANTIALIAS_DEFAULT);
	for (guint64 scan = scan_from(drawing); scan < timing_end(timing); scan = end) {
		const enum sim_quality quality = timing_quality(timing, line, scan);
		const GdkRGBA *color = &drawing->theme->color[quality == SIM_FORCED ? TOKEN_FORCE : TOKEN_COMMENT];
		const double x = x_in_plot(drawing, scan);
		double width;

		end = stretch_end(timing, line, scan);
		if (quality == SIM_GOOD)
			continue;
		if (x >= drawing->width)
			return;
		width = MAX(x_in_plot(drawing, MIN(end, timing_end(timing) - 1)) - x, 1);
		set_color(cairo, color, 0.16f);
		cairo_rectangle(cairo, x, top + 4, width, ROW_PX - 8);
		cairo_fill(cairo);
		set_color(cairo, color, 0.6f);
		hatch(cairo, x, top + 4, width, ROW_PX - 8, quality);
	}
}

struct curve {
	cairo_t *cairo;
	double y, height, low, range;  /* place and range of its values       */
	double value;                  /* at the end of the path              */
	bool begun;
};

static double y_of(const struct curve *curve, double value)
{
	return curve->y + curve->height -
	       (value - curve->low) / curve->range * curve->height;
}

static void curve_add(struct curve *curve, double x, const struct span *span)
{
	if (!curve->begun) {
		cairo_move_to(curve->cairo, x, y_of(curve, span->last));
		curve->begun = true;
		curve->value = span->last;
		return;
	}
	if (span->low == span->high && span->last == curve->value)
		return;
	cairo_line_to(curve->cairo, x, y_of(curve, curve->value));
	if (span->low < MIN(curve->value, span->last))
		cairo_line_to(curve->cairo, x, y_of(curve, span->low));
	if (span->high > MAX(curve->value, span->last))
		cairo_line_to(curve->cairo, x, y_of(curve, span->high));
	cairo_line_to(curve->cairo, x, y_of(curve, span->last));
	curve->value = span->last;
}

/* @close: closes the path at value 0, to be filled. TRUE is filled, because colour alone would
 * not be enough. */
static void trace_curve(struct drawing *drawing, int line, struct curve *curve, bool close)
{
	guint64 scan = scan_from(drawing);
	double first = -1, x = NAMES_PX;

	for (; x <= drawing->width; x++) {
		const struct span span = span_of(drawing, line, &scan, drawing->left_ns +
			(x - NAMES_PX) * drawing->ns_per_px);

		if (!span.any)
			continue;
		if (first < 0)
			first = x;
		curve_add(curve, x, &span);
	}
	if (first < 0)
		return;
	x = MIN(drawing->width, x_of(drawing->area, (double)timing_time(
		drawing->timing, timing_end(drawing->timing) - 1)));
	cairo_line_to(curve->cairo, MAX(x, first), y_of(curve, curve->value));
	if (!close)
		return;
	cairo_line_to(curve->cairo, MAX(x, first), y_of(curve, 0));
	cairo_line_to(curve->cairo, first, y_of(curve, 0));
	cairo_close_path(curve->cairo);
}

static void range_of(struct drawing *drawing, int line, struct curve *curve)
{
	double low = 0, high = 1;

	if (timing_at(drawing->timing, line).type != IEC_BOOL)
		timing_range(drawing->timing, line, scan_from(drawing), timing_end(drawing->timing), &low, &high);
	if (high - low < 1e-9)
		high = low + 1;
	curve->low = low;
	curve->range = high - low;
}

/* Draws the part above the lower line again in the colour of power. */
static void stroke_true(struct drawing *drawing, int line, struct curve *curve, double top)
{
	cairo_rectangle(curve->cairo, NAMES_PX, top, drawing->width - NAMES_PX,
			ROW_PX - 9);
	cairo_clip(curve->cairo);
	curve->begun = false;
	trace_curve(drawing, line, curve, false);
	set_color(curve->cairo, &drawing->theme->color[TOKEN_POWER], 1);
	cairo_set_line_width(curve->cairo, 2);
	cairo_stroke(curve->cairo);
}

static void draw_curve(struct drawing *drawing, int line, double top)
{
	const bool bit = timing_at(drawing->timing, line).type == IEC_BOOL;
	const struct theme *theme = drawing->theme;
	struct curve curve = { .y = top + 8, .height = ROW_PX - 16 };
	cairo_t *cairo = gtk_snapshot_append_cairo(drawing->snapshot, &GRAPHENE_RECT_INIT(
		NAMES_PX, (float)top, (float)(drawing->width - NAMES_PX), ROW_PX));

	range_of(drawing, line, &curve);
	curve.cairo = cairo;
	draw_stretches(drawing, line, top, cairo);
	cairo_set_antialias(cairo, bit ? CAIRO_ANTIALIAS_NONE : CAIRO_ANTIALIAS_DEFAULT);
	if (bit) {
		trace_curve(drawing, line, &curve, true);
		set_color(cairo, &theme->color[TOKEN_POWER], theme->fill);
		cairo_fill(cairo);
		curve.begun = false;
	}
	trace_curve(drawing, line, &curve, false);
	set_color(cairo, &theme->color[bit ? TOKEN_IDLE : TOKEN_ACCENT], 1);
	cairo_set_line_width(cairo, 1.5);
	cairo_stroke(cairo);
	if (bit)
		stroke_true(drawing, line, &curve, top);
	cairo_destroy(cairo);
}

/* ---- names ---- */

static guint64 scan_shown(struct drawing *drawing)
{
	const struct twin *twin = ladder_sim_twin(drawing->area->sim);

	return CLAMP(twin->scan, timing_first(drawing->timing), timing_end(drawing->timing) - 1);
}

static void draw_name(struct drawing *drawing, int line, double top)
{
	const struct location at = timing_at(drawing->timing, line);
	enum sim_quality quality = SIM_GOOD;
	char value[32] = "", *name = shown_name(drawing->timing, line);

	if (line == drawing->area->selected)
		fill(drawing, TOKEN_ACCENT, drawing->theme->wash, 0, top, NAMES_PX,
		     ROW_PX);
	if (timing_first(drawing->timing) < timing_end(drawing->timing)) {
		live_number_print(at.type, timing_value(drawing->timing, line, scan_shown(drawing)),
				  value, sizeof(value));
		quality = timing_quality(drawing->timing, line, scan_shown(drawing));
	}
	text(drawing, LETTER_SYMBOL, TOKEN_INK, name, 14,
	     top + (quality == SIM_GOOD ? 22 : 15), NAMES_PX - 100);
	if (quality != SIM_GOOD)
		text(drawing, LETTER_ADDRESS, quality == SIM_FORCED ? TOKEN_FORCE : TOKEN_ERROR, live_quality_text(quality), 14, top + 29,
		     NAMES_PX - 100);
	text(drawing, LETTER_VALUE, TOKEN_ACCENT, value, NAMES_PX - 78, top + 22, 74);
	g_free(name);
}

/* ---- cursors ---- */

static void draw_cursor(struct drawing *drawing, double ns, enum token token,
			const char *label)
{
	const double x = x_of(drawing->area, ns);
	float width;

	if (x < NAMES_PX || x > drawing->width)
		return;
	fill(drawing, token, 1, x, 0, 1.5, drawing->bottom - RULER_PX);
	width = lettering_fit(drawing->area->lettering, LETTER_VALUE, label, -1, 0).width;
	fill(drawing, TOKEN_SHEET, 1, MIN(x + 3, drawing->width - (double)width - 6),
	     drawing->bottom - RULER_PX + 1, (double)width + 4, RULER_PX - 1);
	text(drawing, LETTER_VALUE, token, label,
	     MIN(x + 5, drawing->width - (double)width - 4), drawing->bottom - 7, 0);
}

static void draw_cursors(struct drawing *drawing)
{
	const struct twin *twin = ladder_sim_twin(drawing->area->sim);
	const gint64 mark = drawing->area->mark_ns;
	char label[80], now[32], since[32];

	if (mark >= 0)
		draw_cursor(drawing, (double)mark, TOKEN_ACCENT, "");
	if (!ladder_sim_is_past(drawing->area->sim))
		return;
	live_time_print(twin->now_ns, now, sizeof(now));
	live_time_print(twin->now_ns - mark, since, sizeof(since));
	if (mark >= 0)
		g_snprintf(label, sizeof(label), "%s  Δ %s", now, since);
	else
		g_strlcpy(label, now, sizeof(label));
	draw_cursor(drawing, (double)twin->now_ns, TOKEN_FORCE, label);
}

static void label_edit(struct drawing *drawing, double x)
{
	const double top = drawing->bottom - RULER_PX - 14;
	const float width = lettering_fit(drawing->area->lettering, LETTER_ADDRESS,
					  _("edit"), -1, 0).width;

	fill(drawing, TOKEN_SHEET, 1, x + 2, top, (double)width + 4, 14);
	text(drawing, LETTER_ADDRESS, TOKEN_COMMENT, _("edit"), x + 4, top + 11, 0);
}

/* A dotted line where an edit changed the program. */
static void draw_edits(struct drawing *drawing)
{
	guint64 scan = timing_first(drawing->timing);
	struct sim_edited edit;

	while (ladder_sim_next_edit(drawing->area->sim, scan, &edit) &&
	       edit.scan < timing_end(drawing->timing)) {
		const double x = x_of(drawing->area, (double)timing_time(drawing->timing, edit.scan));

		scan = edit.scan + 1;
		if (x < NAMES_PX || x > drawing->width)
			continue;
		for (double y = 0; y < drawing->bottom - RULER_PX; y += 6)
			fill(drawing, TOKEN_COMMENT, 1, x, y, 1, 3);
		label_edit(drawing, x);
	}
}

static void draw_lines(struct drawing *drawing)
{
	const int first = (int)(visible_top(drawing->area) / ROW_PX);

	for (int i = first; i < timing_lines(drawing->timing) && i * ROW_PX < drawing->bottom; i++) {
		draw_name(drawing, i, i * ROW_PX);
		if (timing_first(drawing->timing) < timing_end(drawing->timing))
			draw_curve(drawing, i, i * ROW_PX);
	}
}

static void draw_hint(struct drawing *drawing, const char *what)
{
	text(drawing, LETTER_COMMENT, TOKEN_COMMENT, what, 14, 30, drawing->width - 28);
}

static void area_snapshot(GtkWidget *widget, GtkSnapshot *snapshot)
{
	LadderTimingArea *area = LADDER_TIMING_AREA(widget);
	struct drawing drawing = {
		.area = area, .timing = area->timing, .snapshot = snapshot,
		.theme = theme_screen(),
		.width = gtk_widget_get_width(GTK_WIDGET(area)),
		.bottom = visible_bottom(area),
	};
	const int lines = timing_lines(area->timing);

	fill(&drawing, TOKEN_SHEET, 1, 0, 0, drawing.width,
	     gtk_widget_get_height(GTK_WIDGET(area)));
	if (!ladder_sim_is_on(area->sim)) {
		draw_hint(&drawing, _("Start the simulation to see the values of variables, scan by scan."));
		return;
	}
	if (!lines) {
		draw_hint(&drawing, _("Add variables to see when they change."));
		return;
	}
	if (plot_width(area) < 1)
		return;
	drawing.left_ns = right_edge(area) - area->span_ns;
	drawing.ns_per_px = area->span_ns / plot_width(area);
	draw_lines(&drawing);
	draw_ruler(&drawing);
	draw_edits(&drawing);
	draw_cursors(&drawing);
	lettering_trim(area->lettering);
}

/* ---- words below the pointer ---- */

/* A scan of the stretch that is below @x: the one that stands there, or, as a stretch may be narrower than a
 * pixel, a bad one of that pixel. */
static bool find_bad(LadderTimingArea *area, int line, double x, guint64 *scan)
{
	const guint64 end = timing_end(area->timing);
	const double until = ns_at(area, x + 1);

	*scan = timing_scan_at(area->timing, (gint64)MAX(ns_at(area, x - 1), 0));
	for (; *scan < end && (double)timing_time(area->timing, *scan) <= until; (*scan)++)
		if (timing_quality(area->timing, line, *scan) != SIM_GOOD)
			return true;
	return false;
}

static guint64 stretch_begin(const struct timing *timing, int line, guint64 scan)
{
	const enum sim_quality quality = timing_quality(timing, line, scan);

	while (scan > timing_first(timing) && timing_quality(timing, line, scan - 1) == quality)
		scan--;
	return scan;
}

static gboolean query_tooltip(GtkWidget *widget, int x, int y, gboolean keyboard, GtkTooltip *tooltip,
			      gpointer unused)
{
	LadderTimingArea *area = LADDER_TIMING_AREA(widget);
	const struct timing *timing = area->timing;
	const int line = keyboard ? -1 : line_at(area, y);
	char *text, *name, from[32], to[32];
	guint64 scan, end;

	(void)unused;
	if (line < 0 || x < NAMES_PX || timing_first(timing) >= timing_end(timing) ||
	    !ladder_sim_is_on(area->sim) || !find_bad(area, line, x, &scan))
		return FALSE;
	end = MIN(stretch_end(timing, line, scan), timing_end(timing) - 1);
	live_time_print(timing_time(timing, stretch_begin(timing, line, scan)), from, sizeof(from));
	live_time_print(timing_time(timing, end), to, sizeof(to));
	name = shown_name(timing, line);
	text = g_strdup_printf(_("%s: %s, from %s to %s"), name,
			       live_quality_word(timing_quality(timing, line, scan)), from, to);
	gtk_tooltip_set_text(tooltip, text);
	g_free(name);
	g_free(text);
	return TRUE;
}

/* ---- the widget ---- */

static void area_measure(GtkWidget *widget, GtkOrientation orientation, int for_size,
			 int *minimum, int *natural, int *baseline, int *natural_baseline)
{
	(void)for_size;
	*minimum = *natural = orientation == GTK_ORIENTATION_HORIZONTAL ? NAMES_PX + 100 :
		ROW_PX * MAX(timing_lines(LADDER_TIMING_AREA(widget)->timing), 1) +
		RULER_PX;
	*baseline = *natural_baseline = -1;
}

/* The ruler stays visible at the bottom when the chart is scrolled. */
static void watch_scrolling(LadderTimingArea *area)
{
	GtkWidget *scroller = gtk_widget_get_ancestor(GTK_WIDGET(area),
						      GTK_TYPE_SCROLLED_WINDOW);

	if (!scroller || area->scrolled)
		return;
	area->scrolled = g_object_ref(gtk_scrolled_window_get_vadjustment(
		GTK_SCROLLED_WINDOW(scroller)));
	g_signal_connect_object(area->scrolled, "value-changed",
				G_CALLBACK(gtk_widget_queue_draw), area, G_CONNECT_SWAPPED);
}

static void area_map(GtkWidget *widget)
{
	GTK_WIDGET_CLASS(ladder_timing_area_parent_class)->map(widget);
	watch_scrolling(LADDER_TIMING_AREA(widget));
	shown(LADDER_TIMING_AREA(widget));
}

static void ladder_timing_area_dispose(GObject *object)
{
	LadderTimingArea *area = LADDER_TIMING_AREA(object);

	g_clear_handle_id(&area->idle, g_source_remove);
	g_clear_pointer(&area->timing, timing_free);
	g_clear_pointer(&area->bad, g_free);
	g_clear_pointer(&area->lettering, lettering_free);
	g_clear_object(&area->scrolled);
	g_clear_object(&area->sim);
	G_OBJECT_CLASS(ladder_timing_area_parent_class)->dispose(object);
}

static void ladder_timing_area_class_init(LadderTimingAreaClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = ladder_timing_area_dispose;
	widget->measure = area_measure;
	widget->snapshot = area_snapshot;
	widget->map = area_map;
	gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_SLIDER);
	gtk_widget_class_install_action(widget, "line.up", NULL, do_line);
	gtk_widget_class_install_action(widget, "line.down", NULL, do_line);
	gtk_widget_class_install_action(widget, "line.remove", NULL, do_line);
	lines_changed_signal = g_signal_new("lines-changed", G_TYPE_FROM_CLASS(class),
		G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE, 0);
}

static void add_drag(LadderTimingArea *area, guint button, GCallback begin, GCallback update)
{
	GtkGesture *drag = gtk_gesture_drag_new();

	gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(drag), button);
	g_signal_connect_swapped(drag, "drag-begin", begin, area);
	g_signal_connect_swapped(drag, "drag-update", update, area);
	gtk_widget_add_controller(GTK_WIDGET(area), GTK_EVENT_CONTROLLER(drag));
}

static void add_menu(LadderTimingArea *area)
{
	GtkGesture *click = gtk_gesture_click_new();

	gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(click), GDK_BUTTON_SECONDARY);
	g_signal_connect_swapped(click, "pressed", G_CALLBACK(open_menu), area);
	gtk_widget_add_controller(GTK_WIDGET(area), GTK_EVENT_CONTROLLER(click));
}

static void ladder_timing_area_init(LadderTimingArea *area)
{
	GtkEventController *wheel = gtk_event_controller_scroll_new(
		GTK_EVENT_CONTROLLER_SCROLL_BOTH_AXES);
	GtkEventController *keys = gtk_event_controller_key_new();

	area->span_ns = SPAN_FIRST_NS;
	area->follows = true;
	area->selected = -1;
	area->mark_ns = -1;
	gtk_widget_set_direction(GTK_WIDGET(area), GTK_TEXT_DIR_LTR); /* time goes to the right */
	area->lettering = lettering_new(gtk_widget_get_pango_context(GTK_WIDGET(area)), NULL);
	gtk_widget_set_focusable(GTK_WIDGET(area), TRUE);
	spoken_name(area, _("Timing chart, cursor"));
	add_drag(area, GDK_BUTTON_PRIMARY, G_CALLBACK(drag_begin), G_CALLBACK(drag_update));
	add_drag(area, GDK_BUTTON_MIDDLE, G_CALLBACK(pan_begin), G_CALLBACK(pan_update));
	add_menu(area);
	gtk_widget_set_has_tooltip(GTK_WIDGET(area), TRUE);
	g_signal_connect(area, "query-tooltip", G_CALLBACK(query_tooltip), NULL);
	g_signal_connect(wheel, "scroll", G_CALLBACK(scroll), area);
	gtk_widget_add_controller(GTK_WIDGET(area), wheel);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), area);
	gtk_widget_add_controller(GTK_WIDGET(area), keys);
}

GtkWidget *ladder_timing_area_new(LadderSim *sim)
{
	LadderTimingArea *area = g_object_new(LADDER_TYPE_TIMING_AREA, NULL);

	area->sim = g_object_ref(sim);
	area->timing = timing_new(sim);
	g_signal_connect_object(sim, "shown", G_CALLBACK(shown), area, G_CONNECT_SWAPPED);
	g_signal_connect_object(sim, "program-changed", G_CALLBACK(program_changed), area,
				G_CONNECT_SWAPPED);
	theme_follow(area, G_CALLBACK(gtk_widget_queue_draw));
	if (settings_get())
		g_signal_connect_object(settings_get(), "changed::spelling", G_CALLBACK(gtk_widget_queue_draw),
					area, G_CONNECT_SWAPPED);
	return GTK_WIDGET(area);
}
