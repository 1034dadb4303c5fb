/* SPDX-License-Identifier: MIT
 *
 * test_toast - messages that are closed while they appear, in a window that draws no frame
 * meanwhile. Memory that was freed holds rubbish here, so its use ends the test.
 */
#include "editor-gtk/kit/gtk48/toast.h"
#include "tests/editor/screen.h"

#include <malloc.h>
#include <string.h>

static AdwToastOverlay *overlay;

/* A visible button below @widget; NULL: none. */
static GtkWidget *button_in(GtkWidget *widget)
{
	GtkWidget *found = GTK_IS_BUTTON(widget) && gtk_widget_get_mapped(widget) ? widget : NULL;

	for (GtkWidget *child = gtk_widget_get_first_child(widget); child && !found;
	     child = gtk_widget_get_next_sibling(child))
		found = button_in(child);
	return found;
}

static bool is_said(GtkWidget *widget, const char *text)
{
	bool said = GTK_IS_LABEL(widget) && strcmp(gtk_label_get_text(GTK_LABEL(widget)), text) == 0;

	for (GtkWidget *child = gtk_widget_get_first_child(widget); child && !said;
	     child = gtk_widget_get_next_sibling(child))
		said = is_said(child, text);
	return said;
}

/* Closes the message that is shown, as a person does, after @ms in which the window is busy. */
static void close_after(int ms)
{
	WAIT(button_in(GTK_WIDGET(overlay)));
	g_usleep((gulong)ms * 1000);
	g_signal_emit_by_name(button_in(GTK_WIDGET(overlay)), "clicked");
	g_usleep(700 * 1000);
	turn(20);
}

static void test_closed_early(void)
{
	static const int after[] = { 0, 100, 290, 450, 600 };

	for (gsize i = 0; i < G_N_ELEMENTS(after); i++) {
		toast_show(overlay, "Saved");
		close_after(after[i]);
		CHECK_SOON(!is_said(GTK_WIDGET(overlay), "Saved"));
	}
}

static void test_in_turn(void)
{
	toast_show(overlay, "first");
	toast_show(overlay, "second");
	toast_show(overlay, "third");
	CHECK_SOON(is_said(GTK_WIDGET(overlay), "first"));
	CHECK(!is_said(GTK_WIDGET(overlay), "second"));
	close_after(0);
	CHECK_SOON(is_said(GTK_WIDGET(overlay), "second"));
	CHECK_SOON(!is_said(GTK_WIDGET(overlay), "first"));
	close_after(0);
	CHECK_SOON(is_said(GTK_WIDGET(overlay), "third") &&
		   !is_said(GTK_WIDGET(overlay), "second"));
	WAIT(!is_said(GTK_WIDGET(overlay), "third"));
	CHECK_AS(!is_said(GTK_WIDGET(overlay), "third"), "the last one goes by itself");
}

/* The window goes while a message appears, is held back, or waits. */
static void test_gone(GtkWidget *window)
{
	toast_show(overlay, "first");
	toast_show(overlay, "second");
	WAIT(button_in(GTK_WIDGET(overlay)));
	g_signal_emit_by_name(button_in(GTK_WIDGET(overlay)), "clicked");
	gtk_window_destroy(GTK_WINDOW(window));
	turn(700);
	CHECK_AS(!gtk_window_get_toplevels() ||
		 g_list_model_get_n_items(gtk_window_get_toplevels()) == 0, "the window is gone");
}

int main(void)
{
	GtkWidget *window;

	mallopt(M_PERTURB, 165);
	if (!screen_start()) {
		printf("1..0 # SKIP Xvfb is not installed\n");
		return 0;
	}
	adw_init();
	window = gtk_window_new();
	overlay = ADW_TOAST_OVERLAY(adw_toast_overlay_new());
	adw_toast_overlay_set_child(overlay, gtk_label_new("the sheet"));
	gtk_window_set_child(GTK_WINDOW(window), GTK_WIDGET(overlay));
	gtk_window_set_default_size(GTK_WINDOW(window), 600, 400);
	screen_show(window);
	test_closed_early();
	test_in_turn();
	test_gone(window);
	return tap_done();
}
