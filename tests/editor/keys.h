/* SPDX-License-Identifier: MIT
 *
 * keys - the keyboard focus of a window, for tests.
 */
#ifndef TESTS_EDITOR_KEYS_H
#define TESTS_EDITOR_KEYS_H

#include <gtk/gtk.h>
#include <stdbool.h>

/** keys_arrive - does a widget in @window have the focus, or the window itself none? */
static inline bool keys_arrive(GtkWidget *window)
{
	GtkWidget *focus = gtk_root_get_focus(GTK_ROOT(window));

	return !focus || gtk_widget_is_ancestor(focus, window);
}

#endif
