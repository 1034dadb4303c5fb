/* SPDX-License-Identifier: MIT
 *
 * test_hidden_column - a hidden column takes no width: the others fill the list to its end, and
 * it has its width again when it is shown.
 */
#include "editor-gtk/kit/gtk48/list.h"
#include "tests/editor/screen.h"
#include "tests/tap.h"

static GtkColumnViewColumn *column(GtkWidget *view, int width)
{
	GtkColumnViewColumn *one = gtk_column_view_column_new("Name", gtk_signal_list_item_factory_new());

	gtk_column_view_column_set_fixed_width(one, width);
	gtk_column_view_column_set_expand(one, width < 0);
	gtk_column_view_append_column(GTK_COLUMN_VIEW(view), one);
	g_object_unref(one); /* the list has a reference */
	return one;
}

int main(void)
{
	GtkWidget *window, *scroller, *view;
	GtkColumnViewColumn *address;
	GtkAdjustment *across;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	window = gtk_window_new();
	scroller = gtk_scrolled_window_new();
	view = gtk_column_view_new(NULL);
	address = column(view, 120);
	column(view, -1);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), view);
	gtk_window_set_child(GTK_WINDOW(window), scroller);
	gtk_window_set_default_size(GTK_WINDOW(window), 600, 200);
	list_show_column(address, false);
	screen_show(window);
	across = gtk_scrolled_window_get_hadjustment(GTK_SCROLLED_WINDOW(scroller));
	CHECK_SOON(gtk_adjustment_get_page_size(across) > 0);
	CHECK(gtk_adjustment_get_upper(across) >= gtk_adjustment_get_page_size(across));
	list_show_column(address, true);
	CHECK(gtk_column_view_column_get_visible(address));
	CHECK(gtk_column_view_column_get_fixed_width(address) == 120);
	list_show_column(address, true);
	CHECK(gtk_column_view_column_get_fixed_width(address) == 120);
	gtk_window_destroy(GTK_WINDOW(window));
	turn(0);
	return tap_done();
}
