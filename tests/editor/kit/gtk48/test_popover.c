/* SPDX-License-Identifier: MIT
 *
 * test_popover - a page is destroyed while its menu or entry is open. The warning of GTK
 * about a child that is left ends the test.
 */
#include "editor-gtk/kit/entry_popup.h"
#include "editor-gtk/ladder/grid_view.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/sfc/sfc_view.h"
#include "tests/editor/sheet_window.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include <string.h>

static const char sample[] =
	"RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n\n"
	"PROGRAM Way SFC\n  INITIAL_STEP Start:\n  END_STEP\nEND_PROGRAM\n";

static GtkWidget *window;

static bool is_open(GtkWidget *page)
{
	GtkWidget *child = gtk_widget_get_first_child(page);

	while (child && !(GTK_IS_POPOVER(child) && gtk_widget_get_mapped(child)))
		child = gtk_widget_get_next_sibling(child);
	return child;
}

static void goes(GtkWidget *page, const char *what)
{
	gpointer gone = page;

	g_object_add_weak_pointer(G_OBJECT(page), &gone);
	CHECK_SOON(is_open(page));
	gtk_window_set_child(GTK_WINDOW(window), NULL);
	WAIT(!gone);
	CHECK_AS(!gone, what);
}

static void put(GtkWidget *page)
{
	gtk_window_set_child(GTK_WINDOW(window), page);
	WAIT(gtk_widget_get_width(page) > 0 && gtk_widget_grab_focus(page));
}

static void test_pages(LadderDocument *document)
{
	static const enum verb chart[] = { VERB_context_menu, VERB_chart_comment };
	static const enum verb sheet[] = { VERB_context_menu, VERB_comment };

	for (gsize i = 0; i < G_N_ELEMENTS(chart); i++) {
		GtkWidget *page = ladder_sfc_view_new(document, 1);

		put(page);
		ladder_canvas_do(LADDER_CANVAS(page), chart[i]);
		goes(page, "a page of a chart is freed with its popover open");
	}
	for (gsize i = 0; i < G_N_ELEMENTS(sheet); i++) {
		GtkWidget *page = ladder_grid_view_new(document, 0);

		put(page);
		ladder_canvas_do(LADDER_CANVAS(page), sheet[i]);
		goes(page, "a sheet is freed with its popover open");
	}
}

/* A parent that does not know of its popover. */
static void test_any(void)
{
	GtkWidget *page = gtk_drawing_area_new();
	GMenu *menu = g_menu_new();

	gtk_widget_set_focusable(page, TRUE);
	put(page);
	g_menu_append(menu, "Undo", "win.undo");
	popover_menu(page, menu, &(GdkRectangle){ 5, 5, 1, 1 }, page);
	goes(page, "any widget is freed with its popover open");
}

static GtkWidget *popover_of(GtkWidget *page)
{
	GtkWidget *child = gtk_widget_get_first_child(page);

	while (child && !GTK_IS_POPOVER(child))
		child = gtk_widget_get_next_sibling(child);
	return child;
}

/* A menu that closes is removed from its page, and gives the focus back. */
static void test_closed(void)
{
	GtkWidget *page = gtk_drawing_area_new();
	GMenu *menu = g_menu_new();

	gtk_widget_set_focusable(page, TRUE);
	put(page);
	g_menu_append(menu, "Undo", "win.undo");
	popover_menu(page, menu, &(GdkRectangle){ 5, 5, 1, 1 }, page);
	CHECK_SOON(is_open(page));
	gtk_popover_popdown(GTK_POPOVER(popover_of(page)));
	CHECK_SOON(!popover_of(page) && gtk_widget_has_focus(page));
	gtk_window_set_child(GTK_WINDOW(window), NULL);
}

static GtkWidget *focus_now(void)
{
	return gtk_root_get_focus(GTK_ROOT(window));
}

/* The menu of an entry closes, and the pointer is told late that it moved in an item. */
static void test_late_pointer(void)
{
	GtkWidget *entry = gtk_entry_new(), *text, *item;

	put(entry);
	text = GTK_WIDGET(gtk_editable_get_delegate(GTK_EDITABLE(entry)));
	gtk_widget_activate_action(text, "menu.popup", NULL);
	CHECK_SOON(is_open(text) && focus_now() && gtk_widget_is_ancestor(focus_now(), popover_of(text)));
	item = focus_now();
	gtk_popover_popdown(GTK_POPOVER(popover_of(text)));
	CHECK_SOON(!is_open(text) && gtk_widget_has_focus(text));
	gtk_widget_grab_focus(item);
	CHECK(focus_now() == item);
	CHECK_SOON(gtk_widget_has_focus(text));
	gtk_window_set_child(GTK_WINDOW(window), NULL);
}

/* A menu that is higher than the room below and above its place shows all of its rows. */
static void test_whole(void)
{
	GtkWidget *page = gtk_drawing_area_new(), *popover;
	GMenu *menu = g_menu_new();
	GdkRectangle screen;
	int natural = 0;

	gtk_widget_set_focusable(page, TRUE);
	put(page);
	gdk_monitor_get_geometry(g_list_model_get_item(gdk_display_get_monitors(
		gtk_widget_get_display(page)), 0), &screen);
	for (int i = 0; i < screen.height * 2 / 3 / 32; i++)
		g_menu_append(menu, "Undo", "win.undo");
	popover_menu(page, menu, &(GdkRectangle){ 5, screen.height / 2, 1, 1 }, page);
	CHECK_SOON(is_open(page));
	popover = popover_of(page);
	gtk_widget_measure(gtk_popover_get_child(GTK_POPOVER(popover)), GTK_ORIENTATION_VERTICAL, -1,
			   NULL, &natural, NULL, NULL);
	CHECK(natural > screen.height / 2);
	CHECK_SOON(gtk_widget_get_height(gtk_popover_get_child(GTK_POPOVER(popover))) >= natural);
	goes(page, "the whole menu goes with its page");
}

/* Does the child of the popover have all the room it wants? */
static bool has_room(GtkWidget *child)
{
	int width, height;

	gtk_widget_measure(child, GTK_ORIENTATION_HORIZONTAL, -1, NULL, &width, NULL, NULL);
	gtk_widget_measure(child, GTK_ORIENTATION_VERTICAL, -1, NULL, &height, NULL, NULL);
	return gtk_widget_get_width(child) >= width && gtk_widget_get_height(child) >= height;
}

/* An open popover grows with the reason that is shown in it; its parent does not know of it. */
static void test_told(void)
{
	GtkWidget *page = gtk_drawing_area_new(), *popover = gtk_popover_new();
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6), *label = gtk_label_new("");

	gtk_widget_set_focusable(page, TRUE);
	put(page);
	gtk_box_append(GTK_BOX(box), label);
	gtk_box_append(GTK_BOX(box), gtk_button_new_with_label("Set the type"));
	gtk_popover_set_child(GTK_POPOVER(popover), box);
	popover_put(popover, page);
	popover_tell(GTK_LABEL(label), "");
	gtk_popover_popup(GTK_POPOVER(popover));
	CHECK_SOON(is_open(page) && has_room(box));
	popover_tell(GTK_LABEL(label), "The last index is below the first, which is wider than the button");
	CHECK_SOON(has_room(box));
	goes(page, "a popover with a reason goes with its page");
}

static GdkRectangle points_to(GtkWidget *popover)
{
	GdkRectangle at = { 0, 0, 0, 0 };

	gtk_popover_get_pointing_to(GTK_POPOVER(popover), &at);
	return at;
}

/* GTK looks for a monitor at the place that a popover points to, and complains if there is none. */
static void test_outside(void)
{
	static const GdkRectangle places[] = {
		{ 5, 90000, 10, 10 }, { 5, -90000, 10, 10 }, { 90000, 5, 10, 10 }, { -90000, -90000, 10, 10 },
	};

	for (gsize i = 0; i < G_N_ELEMENTS(places); i++) {
		GtkWidget *page = gtk_drawing_area_new(), *popover = gtk_popover_new();

		gtk_widget_set_focusable(page, TRUE);
		put(page);
		gtk_popover_set_child(GTK_POPOVER(popover), gtk_label_new("Condition"));
		popover_put(popover, page);
		gtk_popover_set_pointing_to(GTK_POPOVER(popover), &places[i]);
		gtk_popover_popup(GTK_POPOVER(popover));
		CHECK_SOON(is_open(page));
		CHECK(points_to(popover).x != places[i].x || points_to(popover).y != places[i].y);
		gtk_popover_popdown(GTK_POPOVER(popover));
		CHECK_SOON(!is_open(page));
		CHECK_AS(points_to(popover).x == places[i].x && points_to(popover).y == places[i].y,
			 "a hidden popover points back to its place");
		gtk_popover_popup(GTK_POPOVER(popover));
		CHECK_SOON(is_open(page));
		goes(page, "a popover that points outside the window is shown in it");
	}
}

int main(void)
{
	LadderDocument *document = sheet_window(sample, 900, 600, &window);

	if (!document)
		return 0;
	popover_init();
	test_pages(document);
	test_any();
	test_closed();
	test_late_pointer();
	test_whole();
	test_told();
	test_outside();
	gtk_window_destroy(GTK_WINDOW(window));
	turn(0);
	g_object_unref(document);
	return tap_done();
}
