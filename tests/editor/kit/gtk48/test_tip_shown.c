/* SPDX-License-Identifier: MIT
 *
 * test_tip_shown - a widget shows its tooltip, unless a popover is above it; a widget in the popover shows its own.
 */
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

static GtkTooltip *tooltip;

/* Would the pointer over @widget bring a tooltip? */
static gboolean shows(GtkWidget *widget)
{
	gboolean shown = FALSE;

	g_signal_emit_by_name(widget, "query-tooltip", 1, 1, FALSE, tooltip, &shown);
	return shown;
}

int main(void)
{
	GtkWidget *window, *button, *other, *popover, *inside;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	popover_init();
	tip_init();
	tooltip = g_object_new(GTK_TYPE_TOOLTIP, NULL);
	window = gtk_window_new();
	button = gtk_button_new_with_label("Run");
	other = gtk_button_new_with_label("Stop");
	inside = gtk_button_new_with_label("Force");
	gtk_window_set_child(GTK_WINDOW(window), gtk_box_new(GTK_ORIENTATION_VERTICAL, 0));
	gtk_box_append(GTK_BOX(gtk_window_get_child(GTK_WINDOW(window))), button);
	gtk_box_append(GTK_BOX(gtk_window_get_child(GTK_WINDOW(window))), other);
	tip_set(button, "Starts the program");
	tip_set(inside, "Holds the value");
	popover = gtk_popover_new();
	gtk_popover_set_child(GTK_POPOVER(popover), inside);
	popover_put(popover, button);
	screen_show(window);
	CHECK_AS(shows(button), "a widget shows its tooltip");
	CHECK_AS(!shows(other), "a widget without a text shows none");
	gtk_popover_popup(GTK_POPOVER(popover));
	CHECK_SOON(gtk_widget_get_mapped(popover));
	CHECK_AS(!shows(button), "below a popover no tooltip is shown");
	CHECK_AS(shows(inside), "in the popover it is");
	gtk_popover_popdown(GTK_POPOVER(popover));
	CHECK_SOON(!gtk_widget_get_mapped(popover));
	CHECK_SOON(shows(button));
	popover_drop(popover);
	g_object_unref(tooltip);
	gtk_window_destroy(GTK_WINDOW(window));
	return tap_done();
}
