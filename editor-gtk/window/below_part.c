/* SPDX-License-Identifier: MIT
 *
 * below_part - see below_part.h.
 */
#include "editor-gtk/window/below_part.h"

#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"

void below_part_init(struct below_part *part, int height, GCallback closed, gpointer page)
{
	GtkWidget *bar = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
	GtkWidget *heading = gtk_label_new("");
	GtkWidget *close = gtk_button_new_from_icon_name("window-close-symbolic");

	part->box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	part->place = GTK_BOX(gtk_box_new(GTK_ORIENTATION_VERTICAL, 0));
	part->heading = GTK_LABEL(heading);
	tip_set(close, _("Close"));
	spoken_name(close, _("Close"));
	gtk_widget_add_css_class(close, "flat");
	gtk_label_set_xalign(part->heading, 0);
	gtk_label_set_ellipsize(part->heading, PANGO_ELLIPSIZE_END);
	gtk_widget_add_css_class(heading, "heading");
	gtk_widget_set_hexpand(heading, TRUE);
	gtk_widget_set_margin_start(bar, 12);
	gtk_box_append(GTK_BOX(bar), heading);
	gtk_box_append(GTK_BOX(bar), close);
	gtk_box_append(GTK_BOX(part->box), bar);
	gtk_box_append(GTK_BOX(part->box), GTK_WIDGET(part->place));
	gtk_widget_set_vexpand(GTK_WIDGET(part->place), TRUE);
	gtk_widget_set_size_request(part->box, -1, height);
	gtk_widget_set_visible(part->box, FALSE);
	g_signal_connect_swapped(close, "clicked", closed, page);
}

void below_part_follow(GtkWidget *widget, GCallback entered, gpointer page)
{
	GtkEventController *focus = gtk_event_controller_focus_new();

	g_signal_connect_swapped(focus, "enter", entered, page);
	gtk_widget_add_controller(widget, focus);
}
