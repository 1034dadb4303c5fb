/* SPDX-License-Identifier: MIT
 *
 * still - a widget as one image; see still.h.
 */
#include "editor-gtk/kit/gtk48/still.h"

#include <stdbool.h>

#define REST (250 * G_TIME_SPAN_MILLISECOND) /* us without a change                */

struct _LadderStill {
	GtkWidget parent_instance;
	gint64 changed;         /* us, time of the last change                */
	guint timer;            /* looks whether the child is at rest          */
	bool at_rest;           /* draw an image next                           */
};

G_DEFINE_FINAL_TYPE(LadderStill, ladder_still, GTK_TYPE_WIDGET)

static bool is_by_cairo(GtkWidget *widget)
{
	GtkNative *native = gtk_widget_get_native(widget);

	return native && GSK_IS_CAIRO_RENDERER(gtk_native_get_renderer(native));
}

static cairo_surface_t *image_of(GtkWidget *widget, GskRenderNode *node)
{
	const int scale = gtk_widget_get_scale_factor(widget);
	cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_ARGB32,
		gtk_widget_get_width(widget) * scale, gtk_widget_get_height(widget) * scale);
	cairo_t *cr;

	cairo_surface_set_device_scale(image, scale, scale);
	cr = cairo_create(image);
	gsk_render_node_draw(node, cr);
	cairo_destroy(cr);
	return image;
}

static void draw_image(GtkWidget *widget, GtkSnapshot *snapshot, GskRenderNode *node)
{
	cairo_surface_t *image = image_of(widget, node);
	cairo_t *cr = gtk_snapshot_append_cairo(snapshot, &GRAPHENE_RECT_INIT(0, 0,
		(float)gtk_widget_get_width(widget), (float)gtk_widget_get_height(widget)));

	cairo_set_source_surface(cr, image, 0, 0);
	cairo_paint(cr);
	cairo_destroy(cr);
	cairo_surface_destroy(image);
}

static gboolean look(gpointer data)
{
	LadderStill *still = data;

	if (g_get_monotonic_time() - still->changed < REST)
		return G_SOURCE_CONTINUE;
	still->timer = 0;
	still->at_rest = true;
	gtk_widget_queue_draw(GTK_WIDGET(still));
	return G_SOURCE_REMOVE;
}

/* Not at once: if the child changes in the next frame, an image would be wasted. */
static void look_later(LadderStill *still)
{
	still->changed = g_get_monotonic_time();
	if (!still->timer)
		still->timer = g_timeout_add(REST / G_TIME_SPAN_MILLISECOND, look, still);
}

static void ladder_still_snapshot(GtkWidget *widget, GtkSnapshot *snapshot)
{
	LadderStill *still = LADDER_STILL(widget);
	GtkWidget *child = gtk_widget_get_first_child(widget);
	GtkSnapshot *own = gtk_snapshot_new();
	GskRenderNode *node;

	gtk_widget_snapshot_child(widget, child, own);
	node = gtk_snapshot_free_to_node(own);
	if (node && still->at_rest)
		draw_image(widget, snapshot, node);
	else if (node)
		gtk_snapshot_append_node(snapshot, node);
	if (!still->at_rest && is_by_cairo(widget))
		look_later(still);
	still->at_rest = false;
	g_clear_pointer(&node, gsk_render_node_unref);
}

static void ladder_still_dispose(GObject *object)
{
	GtkWidget *child = gtk_widget_get_first_child(GTK_WIDGET(object));

	g_clear_handle_id(&LADDER_STILL(object)->timer, g_source_remove);
	if (child)
		gtk_widget_unparent(child);
	G_OBJECT_CLASS(ladder_still_parent_class)->dispose(object);
}

static void ladder_still_class_init(LadderStillClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = ladder_still_dispose;
	widget->snapshot = ladder_still_snapshot;
	gtk_widget_class_set_layout_manager_type(widget, GTK_TYPE_BIN_LAYOUT);
	gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_GROUP);
}

static void ladder_still_init(LadderStill *still)
{
	gtk_widget_set_overflow(GTK_WIDGET(still), GTK_OVERFLOW_HIDDEN);
}

GtkWidget *ladder_still_new(GtkWidget *child)
{
	GtkWidget *still = g_object_new(LADDER_TYPE_STILL, NULL);

	gtk_widget_set_parent(child, still);
	return still;
}
