/* SPDX-License-Identifier: MIT
 *
 * test_tab_stop - Tab and Shift+Tab enter a list and leave it, whichever row has the keys; arrows go from row to row.
 */
#include "editor-gtk/kit/gtk48/list.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include <adwaita.h>

static GtkWidget *window, *before, *list, *behind;

static GtkWidget *focus(void)
{
	return gtk_window_get_focus(GTK_WINDOW(window));
}

static bool is_in_list(void)
{
	return focus() && gtk_widget_is_ancestor(focus(), list);
}

static void setup_row(GtkListItemFactory *factory, GtkListItem *item)
{
	(void)factory;
	gtk_list_item_set_child(item, gtk_label_new("row"));
}

static void make_window(void)
{
	static const char *const rows[] = { "one", "two", "three", NULL };
	GtkListItemFactory *factory = gtk_signal_list_item_factory_new();
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);

	g_signal_connect(factory, "setup", G_CALLBACK(setup_row), NULL);
	window = gtk_window_new();
	before = gtk_button_new_with_label("before");
	behind = gtk_button_new_with_label("behind");
	list = gtk_list_view_new(GTK_SELECTION_MODEL(gtk_single_selection_new(
		G_LIST_MODEL(gtk_string_list_new(rows)))), factory);
	gtk_box_append(GTK_BOX(box), before);
	gtk_box_append(GTK_BOX(box), list_tab_stop_new(list));
	gtk_box_append(GTK_BOX(box), behind);
	gtk_window_set_child(GTK_WINDOW(window), box);
	screen_show(window);
}

static void go(GtkDirectionType direction)
{
	gtk_widget_child_focus(window, direction);
}

int main(void)
{
	GtkWidget *row;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	adw_init();
	make_window();
	gtk_widget_grab_focus(before);
	go(GTK_DIR_TAB_FORWARD);
	CHECK_AS(is_in_list(), "Tab enters the list");
	row = focus();
	go(GTK_DIR_DOWN);
	CHECK_AS(is_in_list() && focus() != row, "an arrow goes to the next row");
	go(GTK_DIR_TAB_FORWARD);
	CHECK_AS(focus() == behind, "Tab leaves the list from any row");
	go(GTK_DIR_TAB_BACKWARD);
	CHECK_AS(is_in_list(), "Shift+Tab enters it");
	go(GTK_DIR_TAB_BACKWARD);
	CHECK_AS(focus() == before, "Shift+Tab leaves it from any row");
	gtk_window_destroy(GTK_WINDOW(window));
	return tap_done();
}
