/* SPDX-License-Identifier: MIT
 *
 * window_board - I/O maps of a window's project, and running it on this machine.
 */
#include "editor-gtk/window_inside.h"

#include "editor-gtk/disk.h"
#include "editor-gtk/iomap_rows.h"
#include "editor-gtk/panels.h"

#include <string.h>

/* ---- a new map ---- */

static void make_map(LadderWindow *window, const char *path)
{
	char *text = iomap_new_text(window->document);
	GError *error = NULL;

	if (disk_save(path, text, strlen(text), &error)) {
		ladder_project_tree_look(gtk_paned_get_start_child(window->side));
		tabs_show_file(window, path);
	} else {
		ladder_window_warn(window, error->message);
	}
	g_clear_error(&error);
	g_free(text);
}

static void map_chosen(GtkNativeDialog *dialog, int response, LadderWindow *window)
{
	char *path = response == GTK_RESPONSE_ACCEPT ? window_chosen_path(dialog) : NULL;
	char *full = path && !g_str_has_suffix(path, ".io") ?
		g_strconcat(path, ".io", NULL) : g_strdup(path);

	if (full)
		make_map(window, full);
	g_free(full);
	g_free(path);
	g_object_unref(dialog);
}

/* "garage-door.io", beside the program. */
void window_new_iomap(LadderWindow *window)
{
	GtkFileChooserNative *chooser = gtk_file_chooser_native_new(_("New I/O map"),
		GTK_WINDOW(window), GTK_FILE_CHOOSER_ACTION_SAVE, _("Save"), _("Cancel"));
	const char *path = ladder_document_path(window->document);
	char *name = path ? g_path_get_basename(path) : g_strdup("board");
	char *folder = path ? g_path_get_dirname(path) : NULL, *file;

	if (g_str_has_suffix(name, ".rung"))
		name[strlen(name) - strlen(".rung")] = '\0';
	file = g_strconcat(name, ".io", NULL);
	gtk_file_chooser_set_current_name(GTK_FILE_CHOOSER(chooser), file);
	if (folder) {
		GFile *place = g_file_new_for_path(folder);

		gtk_file_chooser_set_current_folder(GTK_FILE_CHOOSER(chooser), place, NULL);
		g_object_unref(place);
	}
	gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(chooser), TRUE);
	g_signal_connect(chooser, "response", G_CALLBACK(map_chosen), window);
	gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
	g_free(file);
	g_free(folder);
	g_free(name);
}
