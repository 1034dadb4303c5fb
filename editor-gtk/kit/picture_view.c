/* SPDX-License-Identifier: MIT
 *
 * picture_view - see picture_view.h.
 */
#include "editor-gtk/kit/picture_view.h"
#include "editor-gtk/kit/theme.h"

#include <gtk/gtk.h>
#include <math.h>

#define SCALE_LEAST 0.55f /* names stay readable; a wider picture scrolls       */

struct _LadderPictureView {
	GtkWidget parent_instance;
	picture_draw *draw;
	gpointer data;
	struct lettering *lettering;
	struct picture strokes;
};

G_DEFINE_FINAL_TYPE(LadderPictureView, ladder_picture_view, GTK_TYPE_WIDGET)

void ladder_picture_view_again(LadderPictureView *view)
{
	picture_clear(&view->strokes);
	picture_init(&view->strokes);
	gtk_widget_set_direction(GTK_WIDGET(view), GTK_TEXT_DIR_LTR); /* as on a sheet */
	if (!view->lettering)
		view->lettering = lettering_new(gtk_widget_get_pango_context(GTK_WIDGET(view)),
						NULL);
	lettering_trim(view->lettering);
	view->draw(view->data, &view->strokes, view->lettering);
	gtk_widget_queue_resize(GTK_WIDGET(view));
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

void ladder_picture_view_size(LadderPictureView *view, float *width, float *height)
{
	*width = view->strokes.width;
	*height = view->strokes.height;
}

void ladder_picture_view_grow(LadderPictureView *view, float width, float height)
{
	picture_grow(&view->strokes, width, height);
	gtk_widget_queue_resize(GTK_WIDGET(view));
}

/* Fits the width; at most the natural size. */
static float scale_for(LadderPictureView *view, int width)
{
	return width > 0 && view->strokes.width > 0 ?
	       CLAMP((float)width / view->strokes.width, SCALE_LEAST, 1) : 1;
}

float ladder_picture_view_scale(LadderPictureView *view)
{
	return scale_for(view, gtk_widget_get_width(GTK_WIDGET(view)));
}

static GtkSizeRequestMode request_mode(GtkWidget *widget)
{
	(void)widget;
	return GTK_SIZE_REQUEST_HEIGHT_FOR_WIDTH;
}

static void measure(GtkWidget *widget, GtkOrientation orientation, int for_size,
		    int *minimum, int *natural, int *minimum_baseline,
		    int *natural_baseline)
{
	LadderPictureView *view = LADDER_PICTURE_VIEW(widget);

	*minimum_baseline = *natural_baseline = -1;
	if (orientation == GTK_ORIENTATION_HORIZONTAL) {
		*minimum = (int)ceilf(view->strokes.width * SCALE_LEAST);
		*natural = (int)ceilf(view->strokes.width);
		return;
	}
	*minimum = *natural = (int)ceilf(view->strokes.height * scale_for(view, for_size));
}

static void snapshot(GtkWidget *widget, GtkSnapshot *shot)
{
	LadderPictureView *view = LADDER_PICTURE_VIEW(widget);
	const float width = (float)gtk_widget_get_width(widget);
	const float height = (float)gtk_widget_get_height(widget);
	const float scale = scale_for(view, (int)width);
	const struct theme *theme = theme_screen();

	gtk_snapshot_append_color(shot, &theme->color[TOKEN_SHEET],
				  &GRAPHENE_RECT_INIT(0, 0, width, height));
	gtk_snapshot_scale(shot, scale, scale);
	if (view->lettering)
		picture_snapshot(&view->strokes, theme, view->lettering, shot);
}

static void dispose(GObject *object)
{
	LadderPictureView *view = LADDER_PICTURE_VIEW(object);

	picture_clear(&view->strokes);
	g_clear_pointer(&view->lettering, lettering_free);
	G_OBJECT_CLASS(ladder_picture_view_parent_class)->dispose(object);
}

static void ladder_picture_view_class_init(LadderPictureViewClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	widget->get_request_mode = request_mode;
	widget->measure = measure;
	widget->snapshot = snapshot;
	gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_IMG);
}

static void ladder_picture_view_init(LadderPictureView *view)
{
	picture_init(&view->strokes);
	theme_follow(view, G_CALLBACK(ladder_picture_view_again));
}

GtkWidget *ladder_picture_view_new(picture_draw *draw, gpointer data)
{
	LadderPictureView *view = g_object_new(LADDER_TYPE_PICTURE_VIEW, NULL);

	view->draw = draw;
	view->data = data;
	return GTK_WIDGET(view);
}
