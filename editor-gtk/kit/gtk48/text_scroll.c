/* SPDX-License-Identifier: MIT
 *
 * text_scroll - scrolls a text to its cursor; see text_scroll.h.
 */
#include "editor-gtk/kit/gtk48/text_scroll.h"

#define MARGIN 0.1 /* of the page                                               */

static void scroll(GtkTextView *text)
{
	gtk_text_view_scroll_to_mark(text, gtk_text_buffer_get_insert(
		gtk_text_view_get_buffer(text)), MARGIN, FALSE, 0, 0);
}

/* Heights of lines are computed at a higher priority. */
static gboolean scroll_again(gpointer text)
{
	g_object_steal_data(text, "scroll-again");
	scroll(text);
	return G_SOURCE_REMOVE;
}

static void stop_source(gpointer source)
{
	g_source_remove(GPOINTER_TO_UINT(source));
}

/* Called once a frame until it has a size. */
static gboolean scroll_later(GtkWidget *widget, GdkFrameClock *clock, gpointer unused)
{
	(void)clock;
	(void)unused;
	if (gtk_widget_get_width(widget) == 0)
		return G_SOURCE_CONTINUE;
	scroll(GTK_TEXT_VIEW(widget));
	g_object_set_data_full(G_OBJECT(widget), "scroll-again",
			       GUINT_TO_POINTER(g_idle_add(scroll_again, widget)), stop_source);
	return G_SOURCE_REMOVE;
}

void text_scroll_to_cursor(GtkTextView *text)
{
	if (scroll_later(GTK_WIDGET(text), NULL, NULL) == G_SOURCE_CONTINUE)
		gtk_widget_add_tick_callback(GTK_WIDGET(text), scroll_later, NULL, NULL);
}
