/* SPDX-License-Identifier: MIT
 *
 * fold_gutter - numbers of lines and triangles of blocks: see fold_gutter.h.
 */
#include "editor-gtk/text/fold_gutter.h"

#include "editor-gtk/kit/theme.h"

#define WIDTH 16
#define SIDE  8  /* of a triangle                                               */
#define PAD   4  /* beside a number                                             */

struct _LadderFoldGutter {
	GtkSourceGutterRenderer parent;
	unsigned (*marks)(void *context, int line);
	void *context;
};

struct _LadderLineNumbers {
	GtkSourceGutterRendererText parent;
	unsigned (*marks)(void *context, int line);
	void *context;
};

G_DEFINE_FINAL_TYPE(LadderFoldGutter, ladder_fold_gutter, GTK_SOURCE_TYPE_GUTTER_RENDERER)
G_DEFINE_FINAL_TYPE(LadderLineNumbers, ladder_line_numbers, GTK_SOURCE_TYPE_GUTTER_RENDERER_TEXT)

static guint pressed_signal;

/* ---- triangles ---- */

/* It points down, or to the right where the block is folded. */
static void triangle(cairo_t *cr, const struct theme *theme, bool closed)
{
	gdk_cairo_set_source_rgba(cr, &theme->color[closed ? TOKEN_ACCENT : TOKEN_COMMENT]);
	if (closed)
		cairo_rotate(cr, -G_PI / 2);
	cairo_move_to(cr, -SIDE / 2.0, -SIDE / 4.0);
	cairo_line_to(cr, SIDE / 2.0, -SIDE / 4.0);
	cairo_line_to(cr, 0, SIDE / 2.0);
	cairo_close_path(cr);
	cairo_fill(cr);
}

static void ladder_fold_gutter_snapshot_line(GtkSourceGutterRenderer *renderer, GtkSnapshot *snapshot,
					     GtkSourceGutterLines *lines, guint line)
{
	LadderFoldGutter *gutter = LADDER_FOLD_GUTTER(renderer);
	const unsigned marks = gutter->marks(gutter->context, (int)line);
	int y, height;
	cairo_t *cr;

	if (!(marks & FOLD_BEGINS) || marks & FOLD_HIDDEN)
		return;
	gtk_source_gutter_lines_get_line_yrange(lines, line,
		GTK_SOURCE_GUTTER_RENDERER_ALIGNMENT_MODE_CELL, &y, &height);
	cr = gtk_snapshot_append_cairo(snapshot, &GRAPHENE_RECT_INIT(0, (float)y, WIDTH,
								     (float)height));
	cairo_translate(cr, WIDTH / 2.0, y + height / 2.0);
	triangle(cr, theme_screen(), marks & FOLD_CLOSED);
	cairo_destroy(cr);
}

static gboolean ladder_fold_gutter_query_activatable(GtkSourceGutterRenderer *renderer,
						     GtkTextIter *at, GdkRectangle *area)
{
	LadderFoldGutter *gutter = LADDER_FOLD_GUTTER(renderer);

	(void)area;
	return (gutter->marks(gutter->context, gtk_text_iter_get_line(at)) & FOLD_BEGINS) != 0;
}

static void ladder_fold_gutter_activate(GtkSourceGutterRenderer *renderer, GtkTextIter *at,
					GdkRectangle *area, guint button, GdkModifierType state,
					int presses)
{
	(void)area;
	(void)state;
	(void)presses;
	if (button == GDK_BUTTON_PRIMARY)
		g_signal_emit(renderer, pressed_signal, 0, gtk_text_iter_get_line(at));
}

static void ladder_fold_gutter_measure(GtkWidget *widget, GtkOrientation orientation, int for_size,
				       int *minimum, int *natural, int *low, int *high)
{
	(void)widget;
	(void)for_size;
	*minimum = *natural = orientation == GTK_ORIENTATION_HORIZONTAL ? WIDTH : 0;
	*low = *high = -1;
}

static void ladder_fold_gutter_class_init(LadderFoldGutterClass *class)
{
	GtkSourceGutterRendererClass *renderer = GTK_SOURCE_GUTTER_RENDERER_CLASS(class);

	GTK_WIDGET_CLASS(class)->measure = ladder_fold_gutter_measure;
	renderer->snapshot_line = ladder_fold_gutter_snapshot_line;
	renderer->query_activatable = ladder_fold_gutter_query_activatable;
	renderer->activate = ladder_fold_gutter_activate;
	pressed_signal = g_signal_new("pressed", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0, NULL,
				      NULL, NULL, G_TYPE_NONE, 1, G_TYPE_INT);
}

static void ladder_fold_gutter_init(LadderFoldGutter *gutter)
{
	(void)gutter;
}

GtkSourceGutterRenderer *fold_gutter_new(unsigned (*marks)(void *context, int line), void *context)
{
	LadderFoldGutter *gutter = g_object_new(LADDER_TYPE_FOLD_GUTTER, NULL);

	gutter->marks = marks;
	gutter->context = context;
	return GTK_SOURCE_GUTTER_RENDERER(gutter);
}

/* ---- numbers ---- */

static void ladder_line_numbers_query_data(GtkSourceGutterRenderer *renderer,
					   GtkSourceGutterLines *lines, guint line)
{
	char text[16];

	(void)lines;
	g_snprintf(text, sizeof(text), "%u", line + 1);
	gtk_source_gutter_renderer_text_set_text(GTK_SOURCE_GUTTER_RENDERER_TEXT(renderer), text, -1);
}

static void ladder_line_numbers_snapshot_line(GtkSourceGutterRenderer *renderer,
					      GtkSnapshot *snapshot, GtkSourceGutterLines *lines,
					      guint line)
{
	LadderLineNumbers *numbers = LADDER_LINE_NUMBERS(renderer);

	if (!(numbers->marks(numbers->context, (int)line) & FOLD_HIDDEN))
		GTK_SOURCE_GUTTER_RENDERER_CLASS(ladder_line_numbers_parent_class)->snapshot_line(
			renderer, snapshot, lines, line);
}

static void ladder_line_numbers_measure(GtkWidget *widget, GtkOrientation orientation, int for_size,
					int *minimum, int *natural, int *low, int *high)
{
	GtkSourceGutterRenderer *renderer = GTK_SOURCE_GUTTER_RENDERER(widget);
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(gtk_source_gutter_renderer_get_buffer(renderer));
	int width = 0, height;
	char text[16];

	(void)for_size;
	if (orientation == GTK_ORIENTATION_HORIZONTAL && buffer) {
		g_snprintf(text, sizeof(text), "%d", MAX(gtk_text_buffer_get_line_count(buffer), 99));
		for (char *digit = text; *digit; digit++)
			*digit = '0';
		gtk_source_gutter_renderer_text_measure(GTK_SOURCE_GUTTER_RENDERER_TEXT(widget), text,
							&width, &height);
		width += 2 * PAD;
	}
	*minimum = *natural = width;
	*low = *high = -1;
}

/* One more line may need one more digit. */
static void ladder_line_numbers_change_buffer(GtkSourceGutterRenderer *renderer,
					      GtkSourceBuffer *before)
{
	GtkSourceBuffer *buffer = gtk_source_gutter_renderer_get_buffer(renderer);

	if (before)
		g_signal_handlers_disconnect_by_func(before, gtk_widget_queue_resize, renderer);
	if (buffer)
		g_signal_connect_object(buffer, "changed", G_CALLBACK(gtk_widget_queue_resize),
					renderer, G_CONNECT_SWAPPED);
}

static void ladder_line_numbers_class_init(LadderLineNumbersClass *class)
{
	GtkSourceGutterRendererClass *renderer = GTK_SOURCE_GUTTER_RENDERER_CLASS(class);

	GTK_WIDGET_CLASS(class)->measure = ladder_line_numbers_measure;
	renderer->query_data = ladder_line_numbers_query_data;
	renderer->snapshot_line = ladder_line_numbers_snapshot_line;
	renderer->change_buffer = ladder_line_numbers_change_buffer;
}

static void ladder_line_numbers_init(LadderLineNumbers *numbers)
{
	gtk_source_gutter_renderer_set_xalign(GTK_SOURCE_GUTTER_RENDERER(numbers), 1);
	gtk_source_gutter_renderer_set_xpad(GTK_SOURCE_GUTTER_RENDERER(numbers), PAD);
}

GtkSourceGutterRenderer *line_numbers_new(unsigned (*marks)(void *context, int line), void *context)
{
	LadderLineNumbers *numbers = g_object_new(LADDER_TYPE_LINE_NUMBERS, NULL);

	numbers->marks = marks;
	numbers->context = context;
	return GTK_SOURCE_GUTTER_RENDERER(numbers);
}
