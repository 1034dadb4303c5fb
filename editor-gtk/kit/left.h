/* SPDX-License-Identifier: MIT
 *
 * left - work for the moment after GTK has moved the focus away from a widget.
 *
 * GTK tells that the focus leaves while it moves it. A handler that replaces widgets then, because it
 * sets what was typed, may remove the very widget that gets the focus. Such work waits here until GTK
 * has done its own, and no later event comes before it. Other places that need what was typed, such as
 * saving, call left_now() first.
 */
#ifndef EDITOR_LEFT_H
#define EDITOR_LEFT_H

#include <gtk/gtk.h>

/** left_connect - when the focus leaves @widget, @note tells with what @then is called soon; NULL:
 * nothing is to be done. @gone frees it afterwards. @data: for @note, borrowed. Returns the controller,
 * which @widget owns. */
GtkEventController *left_connect(GtkWidget *widget, gpointer (*note)(GtkWidget *widget, gpointer data),
				 void (*then)(gpointer noted), GDestroyNotify gone, gpointer data);
/** left_now - does at once what waits, in the order in which the focus left. */
void left_now(void);

#endif
