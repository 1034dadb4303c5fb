/* SPDX-License-Identifier: MIT
 *
 * popovers - what the toolkit leaves undone when a list or a menu closes; see popovers.h.
 */
#include "editor-gtk/kit/gtk48/popovers.h"

#include <gtk/gtk.h>

static gboolean give_up_surface(gpointer data)
{
	GtkWidget *popover = data;

	if (!gtk_widget_get_mapped(popover) && gtk_widget_get_realized(popover))
		gtk_widget_unrealize(popover);
	return G_SOURCE_REMOVE;
}

/* Before any frame, but not in the midst of what hides it. */
static gboolean closed(GSignalInvocationHint *hint, guint count, const GValue *values,
		       gpointer data)
{
	GtkPopover *popover = g_value_get_object(values);

	(void)hint, (void)count, (void)data;
	if (gtk_popover_get_autohide(popover)) /* others never have the pointer grabbed */
		g_idle_add_full(G_PRIORITY_HIGH, give_up_surface, g_object_ref(popover),
				g_object_unref);
	return TRUE; /* of the next one, too */
}

void popovers_let_go(void)
{
	gpointer class = g_type_class_ref(GTK_TYPE_POPOVER); /* stays: its signals live in it */

	(void)class;
	g_signal_add_emission_hook(g_signal_lookup("closed", GTK_TYPE_POPOVER), 0, closed,
				   NULL, NULL);
}
