/* SPDX-License-Identifier: MIT
 *
 * blink - takes the mark from a hidden line before the next frame; see blink.h.
 */
#include "editor-gtk/kit/gtk48/blink.h"

static gboolean look(gpointer data)
{
	GtkEditable *text = data;
	int from, to;

	if (!gtk_widget_get_mapped(data) && gtk_editable_get_selection_bounds(text, &from, &to))
		gtk_editable_select_region(text, to, to);
	return G_SOURCE_REMOVE;
}

/* It is marked after it has got the focus. */
static void focused(GtkWindow *window)
{
	GtkWidget *text = gtk_window_get_focus(window);

	if (GTK_IS_TEXT(text) && gtk_widget_get_mapped(GTK_WIDGET(window)) && !gtk_widget_get_mapped(text))
		g_idle_add_full(G_PRIORITY_HIGH_IDLE, look, g_object_ref(text), g_object_unref);
}

void blink_follow(GtkWindow *window)
{
	g_signal_connect(window, "notify::focus-widget", G_CALLBACK(focused), NULL);
}
