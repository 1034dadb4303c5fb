/* SPDX-License-Identifier: MIT
 *
 * test_paned - while a child of a paned is hidden, each press meets the other one, also where the handle was.
 */
#include "editor-gtk/kit/gtk48/paned.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#define LEFT 100 /* px of the child that is hidden                            */
#define REACH 20 /* px left and right of the handle that are pressed          */

static int pressed;

static bool hand(const char *format, int x)
{
	char *line = g_strdup_printf(format, x), **words = g_strsplit(line, " ", 0);
	const bool good = g_spawn_sync(NULL, words, NULL, G_SPAWN_SEARCH_PATH | G_SPAWN_STDOUT_TO_DEV_NULL,
				       NULL, NULL, NULL, NULL, NULL, NULL);

	g_strfreev(words);
	g_free(line);
	return good;
}

static void count(void)
{
	pressed++;
}

static void check_drag(GtkWidget *paned)
{
	hand("xdotool mousemove %d 50 mousedown 1", LEFT + 2);
	hand("xdotool mousemove %d 50", LEFT + 20);
	hand("xdotool mousemove %d 50 mouseup 1", LEFT + 50);
	CHECK_SOON(gtk_paned_get_position(GTK_PANED(paned)) > LEFT + 30);
	gtk_paned_set_position(GTK_PANED(paned), LEFT);
}

int main(void)
{
	GtkWidget *window, *paned, *left, *button;

	if (!screen_start() || !gtk_init_check() || !hand("xdotool version", 0)) {
		printf("1..0 # SKIP needs Xvfb and xdotool\n");
		return 0;
	}
	window = gtk_window_new();
	gtk_window_set_decorated(GTK_WINDOW(window), FALSE);
	gtk_window_set_default_size(GTK_WINDOW(window), 400, 100);
	paned = gtk_paned_new(GTK_ORIENTATION_HORIZONTAL);
	paned_mend(GTK_PANED(paned));
	left = gtk_label_new("Motor");
	button = gtk_button_new_with_label("Start");
	gtk_paned_set_start_child(GTK_PANED(paned), left);
	gtk_paned_set_end_child(GTK_PANED(paned), button);
	gtk_paned_set_position(GTK_PANED(paned), LEFT);
	g_signal_connect(button, "clicked", G_CALLBACK(count), NULL);
	gtk_window_set_child(GTK_WINDOW(window), paned);
	gtk_window_present(GTK_WINDOW(window));
	CHECK_SOON(gtk_widget_get_width(left) == LEFT && gtk_widget_get_mapped(button));
	check_drag(paned);
	gtk_widget_set_visible(left, FALSE);
	CHECK_SOON(gtk_widget_get_width(button) > 3 * LEFT);
	for (int x = LEFT - REACH; x <= LEFT + REACH; x++) {
		pressed = 0;
		hand("xdotool mousemove %d 50 mousedown 1 mouseup 1", x);
		CHECK_SOON(pressed == 1);
	}
	gtk_widget_set_visible(left, TRUE);
	CHECK_SOON(gtk_widget_get_width(left) == LEFT);
	check_drag(paned);
	gtk_window_destroy(GTK_WINDOW(window));
	return tap_done();
}
