/* SPDX-License-Identifier: MIT
 *
 * popover - takes popovers from their parents.
 */
#include "editor-gtk/popover.h"

void popover_drop(GtkWidget *popover)
{
	/* An event on its way may have brought the pointer back since it was hidden; what
	 * is insensitive is looked for no more. */
	gtk_widget_set_sensitive(popover, FALSE);
	if (gtk_widget_get_parent(popover))
		gtk_widget_unparent(popover);
}

static gboolean drop(gpointer popover)
{
	popover_drop(popover);
	g_object_unref(popover);
	return G_SOURCE_REMOVE;
}

void popover_drop_later(GtkWidget *popover)
{
	g_idle_add_full(G_PRIORITY_DEFAULT_IDLE, drop, g_object_ref(popover), NULL);
}
