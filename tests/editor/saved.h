/* SPDX-License-Identifier: MIT
 *
 * saved - pictures of a window, for a person to look at.
 */
#ifndef TESTS_EDITOR_SAVED_H
#define TESTS_EDITOR_SAVED_H

#include "tests/editor/soon.h"

#include <adwaita.h>

static inline void save_window(GtkWidget *window, const char *path)
{
	GdkPaintable *paintable = gtk_widget_paintable_new(window);
	GtkSnapshot *snapshot = gtk_snapshot_new();
	GskRenderNode *node;
	GdkTexture *texture;

	gdk_paintable_snapshot(paintable, snapshot, gtk_widget_get_width(window),
			       gtk_widget_get_height(window));
	node = gtk_snapshot_free_to_node(snapshot);
	texture = gsk_renderer_render_texture(gtk_native_get_renderer(GTK_NATIVE(window)),
					      node, NULL);
	gdk_texture_save_to_png(texture, path);
	g_object_unref(texture);
	gsk_render_node_unref(node);
	g_object_unref(paintable);
}

/** save_pictures - saves the window of @widget, light and dark, as NAME-light.png and
 * NAME-dark.png in the folder that the environment variable @folder names; nothing without it. */
static inline void save_pictures(GtkWidget *widget, const char *folder, const char *name)
{
	AdwStyleManager *style = adw_style_manager_get_default();

	for (int dark = 0; dark < 2 && g_getenv(folder); dark++) {
		char *path = g_strdup_printf("%s/%s-%s.png", g_getenv(folder), name,
					     dark ? "dark" : "light");

		adw_style_manager_set_color_scheme(style, dark ?
			ADW_COLOR_SCHEME_FORCE_DARK : ADW_COLOR_SCHEME_FORCE_LIGHT);
		turn(400);
		save_window(GTK_WIDGET(gtk_widget_get_root(widget)), path);
		g_free(path);
	}
	adw_style_manager_set_color_scheme(style, ADW_COLOR_SCHEME_DEFAULT);
}

#endif
