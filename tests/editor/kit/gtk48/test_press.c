/* SPDX-License-Identifier: MIT
 *
 * test_press - a menu that opens while a button is held makes GTK warn of nothing when the pointer moves, and
 * nothing stays pressed.
 */
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/gtk48/press.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#define TIMES 4

static int warnings, broken;

static GLogWriterOutput note(GLogLevelFlags level, const GLogField *fields, gsize count, gpointer data)
{
	(void)data;
	warnings += (level & (G_LOG_LEVEL_WARNING | G_LOG_LEVEL_CRITICAL)) != 0;
	return g_log_writer_default(level, fields, count, NULL);
}

/* Counts the grabs that are told as broken. */
static gboolean event_comes(GSignalInvocationHint *hint, guint count, const GValue *values, gpointer unused)
{
	(void)hint, (void)count, (void)unused;
	broken += gdk_event_get_event_type(g_value_get_pointer(&values[1])) == GDK_GRAB_BROKEN;
	return TRUE;
}

static GtkWidget *row(GtkWidget *box)
{
	GtkWidget *label = gtk_label_new("Motor");

	gtk_widget_set_size_request(label, 300, 100);
	gtk_box_append(GTK_BOX(box), label);
	return label;
}

static bool hand(const char *what)
{
	char **words = g_strsplit(what, " ", 0);
	const bool good = g_spawn_sync(NULL, words, NULL, G_SPAWN_SEARCH_PATH | G_SPAWN_STDOUT_TO_DEV_NULL,
				       NULL, NULL, NULL, NULL, NULL, NULL);

	g_strfreev(words);
	return good;
}

static bool is_pressed(GtkWidget *widget)
{
	return gtk_widget_get_state_flags(widget) & GTK_STATE_FLAG_ACTIVE;
}

int main(void)
{
	GtkWidget *window, *box, *first, *last, *popover;

	if (!screen_start() || !gtk_init_check() || !hand("xdotool version")) {
		printf("1..0 # SKIP needs Xvfb and xdotool\n");
		return 0;
	}
	g_log_set_always_fatal(G_LOG_FATAL_MASK);
	g_log_set_writer_func(note, NULL, NULL);
	popover_init();
	press_init();
	g_signal_add_emission_hook(g_signal_lookup("event", GDK_TYPE_SURFACE), 0, event_comes, NULL, NULL);
	window = gtk_window_new();
	gtk_window_set_decorated(GTK_WINDOW(window), FALSE);
	box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	first = row(box);
	row(box);
	last = row(box);
	popover = gtk_popover_new();
	gtk_popover_set_child(GTK_POPOVER(popover), gtk_button_new_with_label("Undo"));
	gtk_widget_set_parent(popover, first);
	gtk_widget_set_focusable(first, TRUE);
	gtk_window_set_child(GTK_WINDOW(window), box);
	gtk_window_present(GTK_WINDOW(window));
	CHECK_SOON(gtk_widget_get_mapped(last) && gtk_widget_get_height(last) > 0);
	gtk_widget_grab_focus(first);
	for (int i = 0; i < TIMES; i++) {
		hand("xdotool mousemove 20 50 mousedown 1");
		CHECK_SOON(is_pressed(first));
		gtk_popover_popup(GTK_POPOVER(popover));
		CHECK_SOON(gtk_widget_get_mapped(popover));
		broken = 0;
		hand("xdotool mousemove 20 250 mousemove 21 251");
		CHECK_SOON(broken > 0);
		hand("xdotool mouseup 1");
		gtk_popover_popdown(GTK_POPOVER(popover));
		CHECK_SOON(!gtk_widget_get_mapped(popover) && !is_pressed(first));
		hand("xdotool mousemove 20 50 mousedown 1");
		CHECK_SOON(is_pressed(first));
		hand("xdotool mouseup 1");
		CHECK_SOON(!is_pressed(first) && !is_pressed(window));
	}
	CHECK(warnings == 0);
	gtk_widget_unparent(popover);
	gtk_window_destroy(GTK_WINDOW(window));
	return tap_done();
}
