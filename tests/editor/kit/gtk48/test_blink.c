/* SPDX-License-Identifier: MIT
 *
 * test_blink - a hidden line that gets the keys makes GTK warn of nothing; a line that is seen stays marked.
 */
#include "editor-gtk/kit/gtk48/blink.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

static int warnings;

static GLogWriterOutput note(GLogLevelFlags level, const GLogField *fields, gsize count, gpointer data)
{
	(void)data;
	warnings += (level & G_LOG_LEVEL_WARNING) != 0;
	return g_log_writer_default(level, fields, count, NULL);
}

static bool is_marked(GtkWidget *entry)
{
	return gtk_editable_get_selection_bounds(GTK_EDITABLE(entry), NULL, NULL);
}

int main(void)
{
	GtkWidget *window, *stack, *seen, *hidden;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	g_log_set_writer_func(note, NULL, NULL);
	window = gtk_window_new();
	stack = gtk_stack_new();
	seen = gtk_entry_new();
	hidden = gtk_entry_new();
	gtk_editable_set_text(GTK_EDITABLE(seen), "Start");
	gtk_editable_set_text(GTK_EDITABLE(hidden), "Motor");
	gtk_stack_add_named(GTK_STACK(stack), hidden, "hidden");
	gtk_stack_add_named(GTK_STACK(stack), seen, "seen");
	gtk_window_set_child(GTK_WINDOW(window), stack);
	blink_follow(GTK_WINDOW(window));
	screen_show(window);
	gtk_stack_set_visible_child(GTK_STACK(stack), seen);
	gtk_widget_grab_focus(seen);
	CHECK_SOON(is_marked(seen));
	gtk_widget_grab_focus(hidden);
	turn(300);
	CHECK_AS(!is_marked(hidden), "a hidden line is not marked");
	CHECK_AS(warnings == 0, "GTK warns of nothing");
	gtk_stack_set_visible_child(GTK_STACK(stack), hidden);
	CHECK_SOON(gtk_widget_get_mapped(hidden));
	turn(100);
	gtk_window_set_focus(GTK_WINDOW(window), NULL);
	gtk_widget_grab_focus(hidden);
	CHECK_SOON(is_marked(hidden));
	turn(300);
	CHECK_AS(is_marked(hidden), "a line that is seen stays marked");
	gtk_window_destroy(GTK_WINDOW(window));
	return tap_done();
}
