/* SPDX-License-Identifier: MIT
 *
 * list - scrolling and focus of lists in GTK 4.8; see list.h.
 */
#include "editor-gtk/kit/gtk48/list.h"

#define SCROLL "list.scroll-to-item" /* of GtkListBase */

void list_scroll_to(GtkWidget *view, guint at)
{
	if (GTK_IS_LIST_VIEW(view)) {
		gtk_widget_activate_action(view, SCROLL, "u", at);
		return;
	}
	for (GtkWidget *child = gtk_widget_get_first_child(view); child;
	     child = gtk_widget_get_next_sibling(child))
		if (gtk_widget_activate_action(child, SCROLL, "u", at))
			return;
}

void list_mend_focus(GtkWidget *list)
{
	GtkRoot *root = gtk_widget_get_root(list);
	GtkWidget *focus = root ? gtk_root_get_focus(root) : NULL;

	if (focus && gtk_widget_get_root(focus) != root)
		gtk_root_set_focus(root, NULL);
}
