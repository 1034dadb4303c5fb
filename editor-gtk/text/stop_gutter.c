/* SPDX-License-Identifier: MIT
 *
 * stop_gutter - marks of breakpoints: see stop_gutter.h.
 */
#include "editor-gtk/text/stop_gutter.h"

#include "editor-gtk/kit/theme.h"

#define WIDTH 20

struct _LadderStopGutter {
	GtkSourceGutterRenderer parent;
	unsigned (*marks)(void *context, int line);
	void *context;
};

G_DEFINE_FINAL_TYPE(LadderStopGutter, ladder_stop_gutter, GTK_SOURCE_TYPE_GUTTER_RENDERER)

static guint pressed_signal;

/* ---- shapes, in a square of 1 ---- */

static void disc(cairo_t *cr, const struct theme *theme, unsigned marks)
{
	gdk_cairo_set_source_rgba(cr, &theme->color[TOKEN_ERROR]);
	cairo_arc(cr, 0.5, 0.5, 0.4, 0, 2 * G_PI);
	if (marks & STOP_LOST) {
		cairo_set_line_width(cr, 0.12);
		cairo_stroke(cr);
		return;
	}
	cairo_fill(cr);
	if (!(marks & STOP_IF))
		return;
	gdk_cairo_set_source_rgba(cr, &theme->color[TOKEN_SHEET]);
	cairo_rectangle(cr, 0.28, 0.36, 0.44, 0.1);
	cairo_rectangle(cr, 0.28, 0.54, 0.44, 0.1);
	cairo_fill(cr);
}

/* An arrow at the line; a hollow one in a line that waits. */
static void arrow(cairo_t *cr, const struct theme *theme, bool stands)
{
	gdk_cairo_set_source_rgba(cr, &theme->color[TOKEN_ACCENT]);
	cairo_move_to(cr, 0.15, 0.3);
	cairo_line_to(cr, 0.5, 0.3);
	cairo_line_to(cr, 0.5, 0.08);
	cairo_line_to(cr, 0.95, 0.5);
	cairo_line_to(cr, 0.5, 0.92);
	cairo_line_to(cr, 0.5, 0.7);
	cairo_line_to(cr, 0.15, 0.7);
	cairo_close_path(cr);
	cairo_set_line_width(cr, 0.1);
	if (!stands) {
		cairo_stroke(cr);
		return;
	}
	cairo_fill_preserve(cr);
	gdk_cairo_set_source_rgba(cr, &theme->color[TOKEN_SHEET]);
	cairo_set_line_width(cr, 0.06);
	cairo_stroke(cr);
}

static void ladder_stop_gutter_snapshot_line(GtkSourceGutterRenderer *renderer, GtkSnapshot *snapshot,
					     GtkSourceGutterLines *lines, guint line)
{
	LadderStopGutter *gutter = LADDER_STOP_GUTTER(renderer);
	const unsigned marks = gutter->marks(gutter->context, (int)line);
	const struct theme *theme = theme_screen();
	int y, height, side;
	cairo_t *cr;

	if (!marks)
		return;
	gtk_source_gutter_lines_get_line_yrange(lines, line,
		GTK_SOURCE_GUTTER_RENDERER_ALIGNMENT_MODE_CELL, &y, &height);
	side = MIN(height, WIDTH - 2);
	cr = gtk_snapshot_append_cairo(snapshot, &GRAPHENE_RECT_INIT(0, (float)y, WIDTH,
								     (float)height));
	cairo_translate(cr, (WIDTH - side) / 2.0, y + (height - side) / 2.0);
	cairo_scale(cr, side, side);
	if (marks & STOP_SET)
		disc(cr, theme, marks);
	if (marks & (STOP_STANDS | STOP_CALLS))
		arrow(cr, theme, marks & STOP_STANDS);
	cairo_destroy(cr);
}

/* ---- the pointer ---- */

static gboolean ladder_stop_gutter_query_activatable(GtkSourceGutterRenderer *renderer,
						     GtkTextIter *at, GdkRectangle *area)
{
	(void)renderer;
	(void)at;
	(void)area;
	return TRUE;
}

static void ladder_stop_gutter_activate(GtkSourceGutterRenderer *renderer, GtkTextIter *at,
					GdkRectangle *area, guint button, GdkModifierType state,
					int presses)
{
	(void)area;
	(void)state;
	if (presses == 1 && (button == GDK_BUTTON_PRIMARY || button == GDK_BUTTON_SECONDARY))
		g_signal_emit(renderer, pressed_signal, 0, gtk_text_iter_get_line(at),
			      button == GDK_BUTTON_SECONDARY);
}

static void ladder_stop_gutter_measure(GtkWidget *widget, GtkOrientation orientation, int for_size,
				       int *minimum, int *natural, int *low, int *high)
{
	(void)widget;
	(void)for_size;
	*minimum = *natural = orientation == GTK_ORIENTATION_HORIZONTAL ? WIDTH : 0;
	*low = *high = -1;
}

static void ladder_stop_gutter_class_init(LadderStopGutterClass *class)
{
	GtkSourceGutterRendererClass *renderer = GTK_SOURCE_GUTTER_RENDERER_CLASS(class);

	GTK_WIDGET_CLASS(class)->measure = ladder_stop_gutter_measure;
	renderer->snapshot_line = ladder_stop_gutter_snapshot_line;
	renderer->query_activatable = ladder_stop_gutter_query_activatable;
	renderer->activate = ladder_stop_gutter_activate;
	pressed_signal = g_signal_new("pressed", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0, NULL,
				      NULL, NULL, G_TYPE_NONE, 2, G_TYPE_INT, G_TYPE_BOOLEAN);
}

static void ladder_stop_gutter_init(LadderStopGutter *gutter)
{
	(void)gutter;
}

GtkSourceGutterRenderer *stop_gutter_new(unsigned (*marks)(void *context, int line), void *context)
{
	LadderStopGutter *gutter = g_object_new(LADDER_TYPE_STOP_GUTTER, NULL);

	gutter->marks = marks;
	gutter->context = context;
	return GTK_SOURCE_GUTTER_RENDERER(gutter);
}
