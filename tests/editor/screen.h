/* SPDX-License-Identifier: MIT
 *
 * screen - a private X screen for tests of widgets. It needs no session bus and no window
 * manager; without Xvfb there is none.
 */
#ifndef TESTS_EDITOR_SCREEN_H
#define TESTS_EDITOR_SCREEN_H

#include "tests/editor/soon.h"

#include <gtk/gtk.h>
#include <stdbool.h>
#include <unistd.h>

/* An environment that does not depend on the desktop. */
static inline void screen_environment(const char *display)
{
	static const char *const set[][2] = {
		{ "GDK_BACKEND", "x11" }, { "GSK_RENDERER", "cairo" }, { "GTK_A11Y", "test" },
		{ "GSETTINGS_BACKEND", "memory" }, { "ADW_DISABLE_PORTAL", "1" },
		{ "GTK_USE_PORTAL", "0" },
		{ "LC_ALL", "C.UTF-8" }, { "LANGUAGE", "" },
	};

	for (gsize i = 0; i < G_N_ELEMENTS(set); i++)
		g_setenv(set[i][0], set[i][1], TRUE);
	g_setenv("DISPLAY", display, TRUE);
	/* A test ends at the first warning. */
	g_log_set_always_fatal(G_LOG_FATAL_MASK | G_LOG_LEVEL_CRITICAL | G_LOG_LEVEL_WARNING);
}

/* In the server's process: its end of the pipe is number 3. It ends with its last client. */
static inline void screen_pipe(gpointer pipe)
{
	dup2(((int *)pipe)[1], 3);
}

/** screen_start - false: there is no Xvfb. */
static inline bool screen_start(void)
{
	char *argv[] = { "Xvfb", "-displayfd", "3", "-screen", "0", "1440x900x24",
			 "-nolisten", "tcp", "-terminate", NULL };
	char display[16] = ":";
	int pipes[2];
	gsize len = 1;

	if (pipe(pipes) != 0 ||
	    !g_spawn_async(NULL, argv, NULL, G_SPAWN_SEARCH_PATH | G_SPAWN_STDERR_TO_DEV_NULL |
			   G_SPAWN_LEAVE_DESCRIPTORS_OPEN, screen_pipe, pipes, NULL, NULL))
		return false;
	close(pipes[1]);
	while (len < sizeof(display) - 1 && read(pipes[0], display + len, 1) == 1 &&
	       display[len] != '\n')
		len++;
	display[len] = '\0';
	close(pipes[0]);
	screen_environment(display);
	return len > 1;
}

/** screen_show - shows @window and waits until its child is allocated: rows exist then. */
static inline void screen_show(GtkWidget *window)
{
	GtkWidget *child = gtk_window_get_child(GTK_WINDOW(window));

	gtk_window_present(GTK_WINDOW(window));
	CHECK_SOON(gtk_widget_get_mapped(child) && gtk_widget_get_width(child) > 0);
}

#endif
