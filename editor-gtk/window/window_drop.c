/* SPDX-License-Identifier: MIT
 *
 * window_drop - files that are dropped on the window open as if they had been chosen. What
 * is none of ours is told, and nothing is done with it.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/window/app.h"
#include "editor-gtk/document/classic.h"

#include <string.h>

static bool can_open(const char *path)
{
	const char *dot = strrchr(path, '.');

	return (dot && g_ascii_strcasecmp(dot, ".rung") == 0) || side_file_is(path) ||
	       classic_is_project(path);
}

static void tell_refused(LadderWindow *window, const GPtrArray *refused)
{
	GString *names = g_string_new(NULL);
	char *text;

	for (guint i = 0; i < refused->len; i++)
		g_string_append_printf(names, "%s%s", i ? ", " : "",
				       (const char *)refused->pdata[i]);
	text = g_strdup_printf(_("Not opened: %s. Rung files, scenarios, I/O maps and projects "
				 "of ClassicLadder can be dropped here."), names->str);
	ladder_window_warn(window, text);
	gtk_window_present(GTK_WINDOW(window)); /* others opened before it          */
	g_free(text);
	g_string_free(names, TRUE);
}

void window_drop_files(LadderWindow *window, const GSList *files)
{
	GPtrArray *refused = g_ptr_array_new_with_free_func(g_free);

	for (; files; files = files->next) {
		char *path = g_file_get_path(files->data);

		if (path && can_open(path))
			app_open_path(window, path);
		else
			g_ptr_array_add(refused, g_file_get_basename(files->data));
		g_free(path);
	}
	if (refused->len)
		tell_refused(window, refused);
	g_ptr_array_unref(refused);
}

static gboolean dropped(GtkDropTarget *target, const GValue *value, double x, double y,
			LadderWindow *window)
{
	(void)target;
	(void)x;
	(void)y;
	window_drop_files(window, g_value_get_boxed(value));
	return TRUE;
}

/* Before what is inside: a text would take the name of the file. */
void window_drop_init(LadderWindow *window)
{
	GtkDropTarget *drop = gtk_drop_target_new(GDK_TYPE_FILE_LIST, GDK_ACTION_COPY);

	gtk_event_controller_set_propagation_phase(GTK_EVENT_CONTROLLER(drop),
						   GTK_PHASE_CAPTURE);
	g_signal_connect(drop, "drop", G_CALLBACK(dropped), window);
	gtk_widget_add_controller(GTK_WIDGET(window->toasts), GTK_EVENT_CONTROLLER(drop));
}
