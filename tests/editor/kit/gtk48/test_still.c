/* SPDX-License-Identifier: MIT
 *
 * test_still - a widget at rest is drawn as an image, and a change is drawn at once.
 */
#include "editor-gtk/kit/gtk48/still.h"
#include "tests/editor/nodes.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

static GtkWidget *window, *still, *label;

static bool is_drawn_by(const char *kind)
{
	return widget_has(still, kind);
}

static void test_rest(void)
{
	CHECK_SOON(is_drawn_by("text {"));
	CHECK_SOON(is_drawn_by("cairo {") && !is_drawn_by("text {"));
	for (int again = 0; again < 3; again++) {
		gtk_label_set_text(GTK_LABEL(label), again % 2 ? "ON" : "OFF");
		CHECK_SOON(is_drawn_by(again % 2 ? "\"ON\"" : "\"OFF\""));
		CHECK_SOON(is_drawn_by("cairo {") && !is_drawn_by("text {"));
	}
}

/* Changes repeatedly, is removed and comes back. */
static void test_change(void)
{
	char text[16];

	for (int i = 0; i < 20; i++) {
		g_snprintf(text, sizeof(text), "%d", 1000 + i);
		gtk_label_set_text(GTK_LABEL(label), text);
		CHECK_SOON(is_drawn_by(text));
	}
	gtk_widget_set_visible(label, FALSE);
	gtk_widget_set_visible(still, FALSE);
	gtk_widget_set_visible(still, TRUE);
	gtk_widget_set_visible(label, TRUE);
	CHECK_SOON(is_drawn_by("\"1019\""));
	CHECK_SOON(is_drawn_by("cairo {"));
}

int main(void)
{
	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	window = gtk_window_new();
	label = gtk_label_new("Stop");
	still = ladder_still_new(label);
	gtk_window_set_child(GTK_WINDOW(window), still);
	gtk_window_present(GTK_WINDOW(window));
	test_rest();
	test_change();
	gtk_label_set_text(GTK_LABEL(label), "it goes while it waits for rest");
	gtk_window_destroy(GTK_WINDOW(window));
	return tap_done();
}
