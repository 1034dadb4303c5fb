/* SPDX-License-Identifier: MIT
 *
 * nodes - the render nodes of a drawing as text: "text {", "cairo {".
 */
#ifndef TESTS_EDITOR_NODES_H
#define TESTS_EDITOR_NODES_H

#include <gtk/gtk.h>
#include <stdbool.h>

static inline bool node_has(GskRenderNode *node, const char *kind)
{
	GBytes *text = gsk_render_node_serialize(node);
	const bool found = g_strstr_len(g_bytes_get_data(text, NULL),
					(gssize)g_bytes_get_size(text), kind) != NULL;

	g_bytes_unref(text);
	return found;
}

/** widget_node - the last drawing of a widget; NULL: it is not drawn yet. Owned by the caller. */
static inline GskRenderNode *widget_node(GtkWidget *widget)
{
	GdkPaintable *paintable = gtk_widget_paintable_new(widget);
	GtkSnapshot *snapshot = gtk_snapshot_new();

	gdk_paintable_snapshot(paintable, snapshot, gtk_widget_get_width(widget),
			       gtk_widget_get_height(widget));
	g_object_unref(paintable);
	return gtk_snapshot_free_to_node(snapshot);
}

/** widget_is_drawn - are the widget and its children drawn? */
static inline bool widget_is_drawn(GtkWidget *widget)
{
	GskRenderNode *node = widget_node(widget);
	const bool drawn = node != NULL;

	g_clear_pointer(&node, gsk_render_node_unref);
	return drawn;
}

/** widget_has - does the last drawing have a node of @kind? false: it is not drawn. */
static inline bool widget_has(GtkWidget *widget, const char *kind)
{
	GskRenderNode *node = widget_node(widget);
	const bool found = node && node_has(node, kind);

	g_clear_pointer(&node, gsk_render_node_unref);
	return found;
}

#endif
