/* SPDX-License-Identifier: MIT
 *
 * timing_draw - the strokes of a timing chart.
 *
 * A pixel tells the least and the most of all scans below it, so that a pulse of one scan
 * is seen however much time the chart shows.
 */
#include "editor-gtk/live/timing_inside.h"
#include "editor-gtk/kit/i18n.h"

#include <adwaita.h>
#include <math.h>
#include <string.h>

#define TICK_APART 90 /* px, at least                                            */

struct drawing {
	LadderTimingArea *area;
	GtkSnapshot *snapshot;
	const struct theme *theme;
	double width, bottom;   /* bottom of what is seen of the widget        */
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

static void time_text(double ns, double step, char *out, gsize size)
{
	if (step < 1e6)
		g_snprintf(out, size, "%.3f ms", ns / 1e6);
	else if (step < 1e9 && ns < 1e9)
		g_snprintf(out, size, "%.0f ms", ns / 1e6);
	else
		g_snprintf(out, size, "%.*f s", step < 1e7 ? 3 : step < 1e8 ? 2 :
			   step < 1e9 ? 1 : 0, ns / 1e9);
}

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
	const double top = drawing->bottom - TIMING_RULER;
	char label[32];

	fill(drawing, TOKEN_SHEET, 1, 0, top, drawing->width, TIMING_RULER);
	fill(drawing, TOKEN_LINE, 1, 0, top, drawing->width, 1);
	for (double ns = ceil(MAX(drawing->left_ns, 0) / step) * step;; ns += step) {
		const double x = timing_x(drawing->area, ns);

		if (x > drawing->width)
			return;
		fill(drawing, TOKEN_LINE, 1, x, 0, 1, top + 5);
		time_text(ns, step, label, sizeof(label));
		text(drawing, LETTER_ADDRESS, TOKEN_COMMENT, label, x + 4, top + 15, 0);
	}
}

/* ---- lines ---- */

/* What a pixel shows of a line. */
struct span {
	double low, high, last;
	bool any;
};

/* Scans are walked through once from left to right: @scan is the next one. */
static struct span span_of(struct drawing *drawing, int line, guint64 *scan, double until)
{
	const struct timing *timing = drawing->area->timing;
	const guint64 end = timing_end(timing);
	struct span span = { 0 };

	while (*scan < end && (double)timing_time(timing, *scan) <= until) {
		span.last = timing_value(timing, line, *scan);
		span.low = span.any ? MIN(span.low, span.last) : span.last;
		span.high = span.any ? MAX(span.high, span.last) : span.last;
		span.any = true;
		(*scan)++;
	}
	return span;
}

static guint64 scan_from(struct drawing *drawing)
{
	return timing_scan_at(drawing->area->timing, (gint64)MAX(drawing->left_ns, 0));
}

struct curve {
	cairo_t *cairo;
	double y, height, low, range;  /* where its values are                */
	double value;                  /* at the pen                          */
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

/* BOOL: what is TRUE is filled, so that it is told by more than a colour. */
static void trace_curve(struct drawing *drawing, int line, struct curve *curve, bool close)
{
	guint64 scan = scan_from(drawing);
	double first = -1, x = TIMING_NAMES;

	for (; x <= drawing->width; x++) {
		const struct span span = span_of(drawing, line, &scan, drawing->left_ns +
			(x - TIMING_NAMES) * drawing->ns_per_px);

		if (!span.any)
			continue;
		if (first < 0)
			first = x;
		curve_add(curve, x, &span);
	}
	if (first < 0)
		return;
	x = MIN(drawing->width, timing_x(drawing->area, (double)timing_time(
		drawing->area->timing, timing_end(drawing->area->timing) - 1)));
	cairo_line_to(curve->cairo, MAX(x, first), y_of(curve, curve->value));
	if (!close)
		return;
	cairo_line_to(curve->cairo, MAX(x, first), y_of(curve, 0));
	cairo_line_to(curve->cairo, first, y_of(curve, 0));
	cairo_close_path(curve->cairo);
}

static void set_color(cairo_t *cairo, const GdkRGBA *color, float alpha)
{
	cairo_set_source_rgba(cairo, (double)color->red, (double)color->green,
			      (double)color->blue, (double)alpha);
}

static void range_of(struct drawing *drawing, int line, struct curve *curve)
{
	const struct timing *timing = drawing->area->timing;
	double low = 0, high = 1;

	if (timing_at(timing, line).type != IEC_BOOL)
		timing_range(timing, line, scan_from(drawing), timing_end(timing), &low, &high);
	if (high - low < 1e-9)
		high = low + 1;
	curve->low = low;
	curve->range = high - low;
}

/* What is above the lower line, again, in the colour of power. */
static void stroke_true(struct drawing *drawing, int line, struct curve *curve, double top)
{
	cairo_rectangle(curve->cairo, TIMING_NAMES, top, drawing->width - TIMING_NAMES,
			TIMING_ROW - 9);
	cairo_clip(curve->cairo);
	curve->begun = false;
	trace_curve(drawing, line, curve, false);
	set_color(curve->cairo, &drawing->theme->color[TOKEN_POWER], 1);
	cairo_set_line_width(curve->cairo, 2);
	cairo_stroke(curve->cairo);
}

static void draw_curve(struct drawing *drawing, int line, double top)
{
	const bool bit = timing_at(drawing->area->timing, line).type == IEC_BOOL;
	const struct theme *theme = drawing->theme;
	struct curve curve = { .y = top + 8, .height = TIMING_ROW - 16 };
	cairo_t *cairo = gtk_snapshot_append_cairo(drawing->snapshot, &GRAPHENE_RECT_INIT(
		TIMING_NAMES, (float)top, (float)(drawing->width - TIMING_NAMES), TIMING_ROW));

	range_of(drawing, line, &curve);
	curve.cairo = cairo;
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

static void value_text(const struct location *at, double value, char *out, gsize size)
{
	if (at->type == IEC_NONE)
		g_strlcpy(out, "?", size);
	else if (iec_type_row(at->type)->class == CLASS_TIME)
		g_snprintf(out, size, "%.2f s", value / 1e3);
	else
		g_snprintf(out, size, "%.10g", value);
}

static guint64 scan_shown(struct drawing *drawing)
{
	const struct twin *twin = ladder_sim_twin(drawing->area->sim);
	const struct timing *timing = drawing->area->timing;

	return CLAMP(twin->scan, timing_first(timing), timing_end(timing) - 1);
}

static void draw_name(struct drawing *drawing, int line, double top)
{
	const struct timing *timing = drawing->area->timing;
	const struct location at = timing_at(timing, line);
	char value[32] = "";

	if (line == drawing->area->selected)
		fill(drawing, TOKEN_ACCENT, drawing->theme->wash, 0, top, TIMING_NAMES,
		     TIMING_ROW);
	if (timing_first(timing) < timing_end(timing))
		value_text(&at, timing_value(timing, line, scan_shown(drawing)), value,
			   sizeof(value));
	text(drawing, LETTER_SYMBOL, TOKEN_INK, timing_name(timing, line), 14, top + 22,
	     TIMING_NAMES - 100);
	text(drawing, LETTER_VALUE, TOKEN_ACCENT, value, TIMING_NAMES - 78, top + 22, 74);
}

/* ---- cursors ---- */

static void draw_cursor(struct drawing *drawing, double ns, enum token token,
			const char *label)
{
	const double x = timing_x(drawing->area, ns);
	float width;

	if (x < TIMING_NAMES || x > drawing->width)
		return;
	fill(drawing, token, 1, x, 0, 1.5, drawing->bottom - TIMING_RULER);
	width = lettering_fit(drawing->area->lettering, LETTER_VALUE, label, -1, 0).width;
	fill(drawing, TOKEN_SHEET, 1, MIN(x + 3, drawing->width - (double)width - 6),
	     drawing->bottom - TIMING_RULER + 1, (double)width + 4, TIMING_RULER - 1);
	text(drawing, LETTER_VALUE, token, label,
	     MIN(x + 5, drawing->width - (double)width - 4), drawing->bottom - 7, 0);
}

static void draw_cursors(struct drawing *drawing)
{
	const struct twin *twin = ladder_sim_twin(drawing->area->sim);
	const gint64 mark = drawing->area->mark_ns;
	char label[64];

	if (mark >= 0)
		draw_cursor(drawing, (double)mark, TOKEN_ACCENT, "");
	if (!ladder_sim_is_past(drawing->area->sim))
		return;
	g_snprintf(label, sizeof(label), "%.2f s", (double)twin->now_ns / 1e9);
	if (mark >= 0)
		g_snprintf(label, sizeof(label), "%.2f s  Δ %g ms",
			   (double)twin->now_ns / 1e9, (double)(twin->now_ns - mark) / 1e6);
	draw_cursor(drawing, (double)twin->now_ns, TOKEN_FORCE, label);
}

static void label_edit(struct drawing *drawing, double x)
{
	const double top = drawing->bottom - TIMING_RULER - 14;
	const float width = lettering_fit(drawing->area->lettering, LETTER_ADDRESS,
					  _("edit"), -1, 0).width;

	fill(drawing, TOKEN_SHEET, 1, x + 2, top, (double)width + 4, 14);
	text(drawing, LETTER_ADDRESS, TOKEN_COMMENT, _("edit"), x + 4, top + 11, 0);
}

/* Where the program was changed. */
static void draw_edits(struct drawing *drawing)
{
	const struct timing *timing = drawing->area->timing;
	guint64 scan = timing_first(timing);
	struct sim_edited edit;

	while (ladder_sim_next_edit(drawing->area->sim, scan, &edit) &&
	       edit.scan < timing_end(timing)) {
		const double x = timing_x(drawing->area, (double)timing_time(timing, edit.scan));

		scan = edit.scan + 1;
		if (x < TIMING_NAMES || x > drawing->width)
			continue;
		for (double y = 0; y < drawing->bottom - TIMING_RULER; y += 6)
			fill(drawing, TOKEN_COMMENT, 1, x, y, 1, 3);
		label_edit(drawing, x);
	}
}

/* Those that are seen. */
static void draw_lines(struct drawing *drawing)
{
	const struct timing *timing = drawing->area->timing;
	const int first = (int)(timing_visible_top(drawing->area) / TIMING_ROW);

	for (int i = first; i < timing_lines(timing) && i * TIMING_ROW < drawing->bottom; i++) {
		draw_name(drawing, i, i * TIMING_ROW);
		if (timing_first(timing) < timing_end(timing))
			draw_curve(drawing, i, i * TIMING_ROW);
	}
}

static void draw_hint(struct drawing *drawing, const char *what)
{
	text(drawing, LETTER_COMMENT, TOKEN_COMMENT, what, 14, 30, drawing->width - 28);
}

void timing_draw(LadderTimingArea *area, GtkSnapshot *snapshot)
{
	const bool dark = adw_style_manager_get_dark(adw_style_manager_get_default());
	struct drawing drawing = {
		.area = area, .snapshot = snapshot,
		.theme = theme_get(dark ? THEME_DARK : THEME_LIGHT, THEME_GREEN),
		.width = gtk_widget_get_width(GTK_WIDGET(area)),
		.bottom = timing_visible_bottom(area),
	};
	const int lines = timing_lines(area->timing);

	fill(&drawing, TOKEN_SHEET, 1, 0, 0, drawing.width,
	     gtk_widget_get_height(GTK_WIDGET(area)));
	if (!ladder_sim_is_on(area->sim)) {
		draw_hint(&drawing, _("What variables were, scan by scan: simulate to see it."));
		return;
	}
	if (!lines) {
		draw_hint(&drawing, _("Add variables to see when they change."));
		return;
	}
	if (timing_plot_width(area) < 1)
		return;
	drawing.left_ns = timing_right(area) - area->span_ns;
	drawing.ns_per_px = area->span_ns / timing_plot_width(area);
	draw_lines(&drawing);
	draw_ruler(&drawing);
	draw_edits(&drawing);
	draw_cursors(&drawing);
	lettering_trim(area->lettering);
}
