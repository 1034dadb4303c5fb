/* SPDX-License-Identifier: MIT
 *
 * test_slow_bar - the slider of a bar follows after scrolling, but not for part of a pixel.
 */
#include "editor-gtk/kit/gtk48/slow_bar.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include <math.h>

static GtkScrolledWindow *scroller;
static GtkAdjustment *down;

/* px from the top of the bar. */
static int slider(void)
{
	GtkWidget *bar = gtk_scrolled_window_get_vscrollbar(scroller);
	int start, end;

	gtk_range_get_slider_range(GTK_RANGE(gtk_widget_get_first_child(bar)), &start, &end);
	return start;
}

/* Is it in its place, to a pixel? */
static bool is_there(void)
{
	GtkWidget *bar = gtk_scrolled_window_get_vscrollbar(scroller);
	GtkWidget *range = gtk_widget_get_first_child(bar);
	const double page = gtk_adjustment_get_page_size(down);
	const double rest = gtk_adjustment_get_upper(down) - page;
	int start, end;

	gtk_range_get_slider_range(GTK_RANGE(range), &start, &end);
	return fabs(gtk_adjustment_get_value(down) / rest *
		    (gtk_widget_get_height(range) - (end - start)) - start) < 4;
}

static void test_follows(void)
{
	const double rest = gtk_adjustment_get_upper(down) -
			    gtk_adjustment_get_page_size(down);
	int before;

	CHECK(slider() < 4);
	for (int i = 1; i <= 10; i++) {
		before = slider();
		gtk_adjustment_set_value(down, rest * i / 10);
		CHECK_SOON(slider() > before && is_there());
	}
	gtk_adjustment_set_value(down, 0);
	CHECK_SOON(slider() < 4);
}

static void count(int *times)
{
	++*times;
}

/* Only a visible step lays out the window. */
static void test_less(void)
{
	GtkWidget *bar = gtk_scrolled_window_get_vscrollbar(scroller);
	const double pixel = gtk_adjustment_get_upper(down) / gtk_widget_get_height(bar);
	const int before = slider();
	int times = 0;

	g_signal_connect_swapped(down, "changed", G_CALLBACK(count), &times);
	for (int i = 1; i <= 20; i++) {
		gtk_adjustment_set_value(down, pixel * i / 25);
		turn(10);
	}
	turn(200);
	CHECK_AS(times == 0, "20 steps of 1/25 pixel move no slider");
	for (int i = 21; i <= 500; i++)
		gtk_adjustment_set_value(down, pixel * i / 25);
	CHECK_SOON(slider() > before && is_there());
	CHECK_AS(times > 0, "the slider follows larger steps");
	g_signal_handlers_disconnect_by_data(down, &times);
}

static bool has_policy(GtkWidget *which, GtkPolicyType across, GtkPolicyType along)
{
	GtkPolicyType has_across, has_along;

	gtk_scrolled_window_get_policy(GTK_SCROLLED_WINDOW(which), &has_across, &has_along);
	return has_across == across && has_along == along;
}

/* Bars come and go after the layout, in any window; one that is never shown stays so, and those of popups. */
static void test_all(void)
{
	GtkWidget *window = gtk_window_new(), *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	GtkWidget *outer = gtk_scrolled_window_new(), *fixed = gtk_scrolled_window_new();
	GtkWidget *child = gtk_drawing_area_new(), *button = gtk_menu_button_new();
	GtkWidget *popover = gtk_popover_new(), *inner = gtk_scrolled_window_new();

	gtk_widget_set_size_request(child, 20, 20000);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(fixed), child);
	gtk_popover_set_child(GTK_POPOVER(popover), inner);
	gtk_menu_button_set_popover(GTK_MENU_BUTTON(button), popover);
	gtk_box_append(GTK_BOX(box), button);
	gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(fixed), GTK_POLICY_NEVER,
				       GTK_POLICY_AUTOMATIC);
	gtk_widget_set_vexpand(outer, TRUE);
	gtk_widget_set_vexpand(fixed, TRUE);
	gtk_box_append(GTK_BOX(box), outer);
	gtk_box_append(GTK_BOX(box), fixed);
	gtk_window_set_child(GTK_WINDOW(window), box);
	gtk_window_set_default_size(GTK_WINDOW(window), 300, 400);
	slow_bar_choose_all();
	screen_show(window);
	CHECK(has_policy(outer, GTK_POLICY_EXTERNAL, GTK_POLICY_EXTERNAL));
	CHECK_SOON(has_policy(fixed, GTK_POLICY_NEVER, GTK_POLICY_ALWAYS));
	gtk_menu_button_popup(GTK_MENU_BUTTON(button));
	CHECK_SOON(gtk_widget_get_mapped(inner));
	CHECK(has_policy(inner, GTK_POLICY_AUTOMATIC, GTK_POLICY_AUTOMATIC));
	gtk_menu_button_popdown(GTK_MENU_BUTTON(button));
	gtk_widget_set_size_request(child, 20, 20);
	CHECK_SOON(has_policy(fixed, GTK_POLICY_NEVER, GTK_POLICY_EXTERNAL));
	gtk_window_destroy(GTK_WINDOW(window));
}

int main(void)
{
	GtkWidget *window, *child;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	window = gtk_window_new();
	child = gtk_drawing_area_new();
	scroller = GTK_SCROLLED_WINDOW(gtk_scrolled_window_new());
	gtk_widget_set_size_request(child, 200, 20000);
	gtk_scrolled_window_set_child(scroller, child);
	gtk_window_set_child(GTK_WINDOW(window), GTK_WIDGET(scroller));
	gtk_window_set_default_size(GTK_WINDOW(window), 300, 400);
	slow_bar_make(scroller);
	down = gtk_scrolled_window_get_vadjustment(scroller);
	screen_show(window);
	CHECK_SOON(gtk_adjustment_get_upper(down) >= 20000);
	/* The bar is shown after the layout, beside the child. */
	CHECK_SOON(gtk_widget_get_width(child) < gtk_widget_get_width(GTK_WIDGET(scroller)));
	test_follows();
	test_less();
	test_all();
	gtk_window_destroy(GTK_WINDOW(window));
	return tap_done();
}
