/* SPDX-License-Identifier: MIT
 *
 * keys - where they go.
 */
#ifndef TESTS_EDITOR_KEYS_H
#define TESTS_EDITOR_KEYS_H

#include <gtk/gtk.h>
#include <stdbool.h>

/** keys_arrive - at something in @window; without a focus it has them itself. */
static inline bool keys_arrive(GtkWidget *window)
{
	GtkWidget *focus = gtk_root_get_focus(GTK_ROOT(window));

	return !focus || gtk_widget_is_ancestor(focus, window);
}

#endif
