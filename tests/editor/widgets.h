/* SPDX-License-Identifier: MIT
 *
 * widgets - finds a widget below another one.
 */
#ifndef TESTS_EDITOR_WIDGETS_H
#define TESTS_EDITOR_WIDGETS_H

#include <gtk/gtk.h>

/** find_type - the first widget of this type, @widget itself included; NULL: there is none. */
static inline GtkWidget *find_type(GtkWidget *widget, GType type)
{
	GtkWidget *found = g_type_is_a(G_OBJECT_TYPE(widget), type) ? widget : NULL;

	for (GtkWidget *child = gtk_widget_get_first_child(widget); child && !found;
	     child = gtk_widget_get_next_sibling(child))
		found = find_type(child, type);
	return found;
}

#endif
