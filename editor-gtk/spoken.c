/* SPDX-License-Identifier: MIT
 *
 * spoken - names for parts of the toolkit's widgets; see spoken.h.
 */
#include "editor-gtk/spoken.h"

#include <string.h>

/* In the order in which a reader would come to them. */
static GtkWidget *next(GtkWidget *widget, GtkWidget *root)
{
	GtkWidget *found = gtk_widget_get_first_child(widget);

	while (!found && widget != root) {
		found = gtk_widget_get_next_sibling(widget);
		widget = gtk_widget_get_parent(widget);
	}
	return found;
}

static void name_part(GtkWidget *widget)
{
	GtkWidget *parent = gtk_widget_get_parent(widget);
	const char *tip = gtk_widget_get_tooltip_text(widget);

	if (GTK_IS_TOGGLE_BUTTON(widget) && GTK_IS_DROP_DOWN(parent))
		gtk_accessible_update_relation(GTK_ACCESSIBLE(widget),
			GTK_ACCESSIBLE_RELATION_LABELLED_BY, parent, NULL, -1);
	else if (GTK_IS_BUTTON(widget) && tip &&
		 strcmp(G_OBJECT_TYPE_NAME(parent), "AdwTab") == 0)
		gtk_accessible_update_property(GTK_ACCESSIBLE(widget),
			GTK_ACCESSIBLE_PROPERTY_LABEL, tip, -1);
}

void spoken_parts(GtkWidget *root)
{
	for (GtkWidget *widget = next(root, root); widget; widget = next(widget, root))
		name_part(widget);
}
