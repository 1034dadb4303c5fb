/* SPDX-License-Identifier: MIT
 *
 * nodes - what a drawing is made of: "text {", "cairo {", as the toolkit writes its nodes.
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

/** widget_has - its last drawing; false: there is none. */
static inline bool widget_has(GtkWidget *widget, const char *kind)
{
	GdkPaintable *paintable = gtk_widget_paintable_new(widget);
	GtkSnapshot *snapshot = gtk_snapshot_new();
	GskRenderNode *node;
	bool found;

	gdk_paintable_snapshot(paintable, snapshot, gtk_widget_get_width(widget),
			       gtk_widget_get_height(widget));
	node = gtk_snapshot_free_to_node(snapshot);
	found = node && node_has(node, kind);
	g_clear_pointer(&node, gsk_render_node_unref);
	g_object_unref(paintable);
	return found;
}

#endif
