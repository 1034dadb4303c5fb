/* SPDX-License-Identifier: MIT
 *
 * shrink - buttons that become narrower where there is little room; see shrink.h.
 */
#include "editor-gtk/kit/gtk48/shrink.h"

/* The chosen text of a drop-down is deep in its button. */
static void shrink_chosen(GtkWidget *root)
{
	if (GTK_IS_LABEL(root))
		gtk_label_set_ellipsize(GTK_LABEL(root), PANGO_ELLIPSIZE_END);
	for (GtkWidget *child = gtk_widget_get_first_child(root); child; child = gtk_widget_get_next_sibling(child))
		if (!GTK_IS_NATIVE(child))
			shrink_chosen(child);
}

void shrink_buttons(GtkWidget *root)
{
	if (GTK_IS_DROP_DOWN(root)) {
		shrink_chosen(root);
		return;
	}
	GtkWidget *label = GTK_IS_BUTTON(root) ? gtk_button_get_child(GTK_BUTTON(root)) : NULL;

	if (label && GTK_IS_LABEL(label))
		gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
	for (GtkWidget *child = gtk_widget_get_first_child(root); child;
	     child = gtk_widget_get_next_sibling(child))
		if (!GTK_IS_NATIVE(child)) /* a popup has room */
			shrink_buttons(child);
}
