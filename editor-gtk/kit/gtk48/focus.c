/* SPDX-License-Identifier: MIT
 *
 * focus - keys go somewhere at any time.
 */
#include "editor-gtk/kit/gtk48/focus.h"

void focus_mend(GtkWidget *list)
{
	GtkRoot *root = gtk_widget_get_root(list);
	GtkWidget *focus = root ? gtk_root_get_focus(root) : NULL;

	if (focus && gtk_widget_get_root(focus) != root)
		gtk_root_set_focus(root, NULL);
}
