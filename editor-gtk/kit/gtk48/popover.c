/* SPDX-License-Identifier: MIT
 *
 * popover - opens menus below a place, tells, and takes popovers from their parents.
 */
#include "editor-gtk/kit/gtk48/popover.h"

#include <stdbool.h>

void popover_drop(GtkWidget *popover)
{
	/* An event on its way may have brought the pointer back since it was hidden; what
	 * is insensitive is looked for no more. */
	gtk_widget_set_sensitive(popover, FALSE);
	if (gtk_widget_get_parent(popover))
		gtk_widget_unparent(popover);
}

/* Most widgets take only what they know of from themselves when they go. */
void popover_put(GtkWidget *popover, GtkWidget *parent)
{
	gtk_widget_set_parent(popover, parent);
	g_signal_connect_object(parent, "destroy", G_CALLBACK(popover_drop), popover,
				G_CONNECT_SWAPPED);
}

static int within(int at, int size)
{
	return CLAMP(at, 0, MAX(size - 1, 0));
}

/* GTK 4.8 looks for the monitor where that is, and stumbles over there being none. */
void popover_point(GtkWidget *popover, const GdkRectangle *at)
{
	GtkWidget *parent = gtk_widget_get_parent(popover);
	const int width = gtk_widget_get_width(parent), height = gtk_widget_get_height(parent);
	const int x = within(at->x, width), y = within(at->y, height);
	const GdkRectangle seen = { x, y, MAX(within(at->x + at->width, width) - x, 1),
				    MAX(within(at->y + at->height, height) - y, 1) };

	gtk_popover_set_pointing_to(GTK_POPOVER(popover), &seen);
}

static gboolean drop(gpointer popover)
{
	popover_drop(popover);
	g_object_unref(popover);
	return G_SOURCE_REMOVE;
}

void popover_drop_later(GtkWidget *popover)
{
	g_idle_add_full(G_PRIORITY_DEFAULT_IDLE, drop, g_object_ref(popover), NULL);
}

void popover_menu(GtkWidget *parent, GMenu *menu, const GdkRectangle *at, GtkWidget *then)
{
	GtkWidget *popover = gtk_popover_menu_new_from_model(G_MENU_MODEL(menu));

	popover_put(popover, parent);
	popover_point(popover, at);
	gtk_popover_set_has_arrow(GTK_POPOVER(popover), FALSE);
	gtk_widget_set_halign(popover, GTK_ALIGN_START);
	g_signal_connect(popover, "closed", G_CALLBACK(popover_drop_later), NULL);
	g_signal_connect_object(popover, "closed", G_CALLBACK(gtk_widget_grab_focus), then,
				G_CONNECT_SWAPPED);
	gtk_popover_popup(GTK_POPOVER(popover));
	g_object_unref(menu);
}

/* ---- the menu of a button ---- */

static GtkWidget *focus_of(gpointer button)
{
	GtkRoot *root = gtk_widget_get_root(GTK_WIDGET(button));

	return root ? gtk_root_get_focus(root) : NULL;
}

static bool is_beside(GtkWidget *focus, gpointer button)
{
	return focus && !gtk_widget_is_ancestor(focus, GTK_WIDGET(button));
}

/* What a command gave the keys to keeps them. A text would be selected if it grabbed them. */
static void give_back(GtkMenuButton *button)
{
	GtkWidget *then = g_object_get_data(G_OBJECT(button), "then");

	if (then && gtk_widget_get_root(then) && !is_beside(focus_of(button), button))
		gtk_root_set_focus(gtk_widget_get_root(then), then);
	g_object_set_data(G_OBJECT(button), "then", NULL);
}

/* Before each time it opens. F10 opens one without having been in its button. */
static void make_menu(GtkMenuButton *button, gpointer make)
{
	GtkWidget *focus = focus_of(button);
	GMenu *menu;

	g_object_set_data_full(G_OBJECT(button), "then", is_beside(focus, button) ?
			       g_object_ref(focus) : NULL, g_object_unref);
	if (gtk_menu_button_get_menu_model(button))
		return;
	menu = ((GMenu *(*)(void))make)();
	gtk_menu_button_set_menu_model(button, G_MENU_MODEL(menu));
	g_signal_connect_object(gtk_menu_button_get_popover(button), "closed",
				G_CALLBACK(give_back), button, G_CONNECT_SWAPPED);
	g_object_unref(menu);
}

void popover_menu_of(GtkMenuButton *button, GMenu *(*make)(void))
{
	gtk_menu_button_set_create_popup_func(button, make_menu, (gpointer)make, NULL);
}

/* GTK 4.8 takes a popover's height from more width than it gives to what is inside: of a
 * text that just needs one line more, that line is cut off unless it is asked for. */
void popover_tell(GtkLabel *label, const char *text)
{
	GtkWidget *widget = GTK_WIDGET(label);
	int width, height;

	gtk_widget_set_size_request(widget, -1, -1);
	gtk_label_set_text(label, text);
	gtk_widget_set_visible(widget, text[0]);
	gtk_widget_measure(widget, GTK_ORIENTATION_HORIZONTAL, -1, NULL, &width, NULL, NULL);
	gtk_widget_measure(widget, GTK_ORIENTATION_VERTICAL, width, NULL, &height, NULL, NULL);
	gtk_widget_set_size_request(widget, width, height);
}
