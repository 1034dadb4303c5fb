/* SPDX-License-Identifier: MIT
 *
 * blink - takes the mark from a hidden line; see blink.h.
 */
#include "editor-gtk/kit/gtk48/blink.h"

/* A row that is being made, or a popup that is not open yet, is not drawn either, but will be. */
static gboolean is_in_hidden_page(GtkWidget *widget)
{
	for (; widget; widget = gtk_widget_get_parent(widget))
		if (!gtk_widget_get_child_visible(widget) && GTK_IS_STACK(gtk_widget_get_parent(widget)))
			return TRUE;
	return FALSE;
}

/* At once: GTK may warn in the next frame. */
static void look(GtkWidget *text)
{
	int from, to;

	if (!gtk_widget_get_mapped(text) && gtk_widget_get_realized(text) && is_in_hidden_page(text) &&
	    gtk_editable_get_selection_bounds(GTK_EDITABLE(text), &from, &to))
		gtk_editable_select_region(GTK_EDITABLE(text), to, to);
}

/* It is marked after it has got the focus, or later, or hidden while it is marked. */
static void focused(GtkWindow *window)
{
	GtkWidget *text = gtk_window_get_focus(window), *before = g_object_get_data(G_OBJECT(window), "blinks");

	if (before == text)
		return;
	if (before)
		g_signal_handlers_disconnect_by_func(before, G_CALLBACK(look), NULL);
	g_object_set_data(G_OBJECT(window), "blinks", NULL);
	if (!GTK_IS_TEXT(text))
		return;
	g_object_set_data_full(G_OBJECT(window), "blinks", g_object_ref(text), g_object_unref);
	g_signal_connect(text, "notify::selection-bound", G_CALLBACK(look), NULL);
	g_signal_connect(text, "notify::cursor-position", G_CALLBACK(look), NULL);
	g_signal_connect(text, "unmap", G_CALLBACK(look), NULL);
	look(text);
}

void blink_follow(GtkWindow *window)
{
	g_signal_connect(window, "notify::focus-widget", G_CALLBACK(focused), NULL);
}
