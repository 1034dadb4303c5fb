/* SPDX-License-Identifier: MIT
 *
 * style - see style.h.
 */
#include "editor-gtk/kit/style.h"

void style_set(GtkWidget *widget, const char *class, bool on)
{
	if (on)
		gtk_widget_add_css_class(widget, class);
	else
		gtk_widget_remove_css_class(widget, class);
}

void style_wrong(GtkWidget *widget, bool wrong)
{
	style_set(widget, "error", wrong);
	gtk_accessible_update_state(GTK_ACCESSIBLE(widget), GTK_ACCESSIBLE_STATE_INVALID,
		wrong ? GTK_ACCESSIBLE_INVALID_TRUE : GTK_ACCESSIBLE_INVALID_FALSE, -1);
}
