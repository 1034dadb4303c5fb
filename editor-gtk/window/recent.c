/* SPDX-License-Identifier: MIT
 *
 * recent - the projects opened or saved last; see recent.h.
 */
#include "editor-gtk/window/recent.h"

#include "editor-gtk/document/classic.h"
#include "editor-gtk/document/plain_file.h"
#include "editor-gtk/kit/i18n.h"

#include <stdbool.h>

#define RECENT_MOST 8
#define PROGRAM "ladder-editor" /* name of this program in the list of the desktop */

void recent_add(const char *path)
{
	char *uri = path ? g_filename_to_uri(path, NULL, NULL) : NULL;
	char *kind = uri ? g_content_type_guess(path, NULL, 0, NULL) : NULL;
	char *mime = kind ? g_content_type_get_mime_type(kind) : NULL;
	/* With a MIME type GTK adds it at once; otherwise the order of several would be
	 * random. */
	GtkRecentData about = {
		.mime_type = mime ? mime : (char *)"application/octet-stream",
		.app_name = (char *)PROGRAM, .app_exec = (char *)PROGRAM " %f",
	};

	if (uri)
		gtk_recent_manager_add_full(gtk_recent_manager_get_default(), uri, &about);
	g_free(mime);
	g_free(kind);
	g_free(uri);
}

/* ---- in their order ---- */

/* When this editor used it last, whatever other programs did since. Borrowed; NULL: never. */
static GDateTime *had_at(GtkRecentInfo *info)
{
	const char *exec;
	GDateTime *time;
	guint count;

	return gtk_recent_info_get_application_info(info, PROGRAM, &exec, &count, &time) ?
	       time : NULL;
}

static int newer_first(gconstpointer a, gconstpointer b)
{
	return g_date_time_compare(had_at((GtkRecentInfo *)b), had_at((GtkRecentInfo *)a));
}

/* GTK's file choosers also add tables, maps and PDFs in the editor's name. */
static bool is_project(const char *path)
{
	return g_file_test(path, G_FILE_TEST_EXISTS) &&
	       (g_str_has_suffix(path, ".rung") || plain_file_is(path) ||
		classic_is_project(path));
}

/* NULL: not to be listed. Actions take UTF-8 only. */
static char *path_of(GtkRecentInfo *info)
{
	char *path = g_filename_from_uri(gtk_recent_info_get_uri(info), NULL, NULL);

	if (path && g_utf8_validate(path, -1, NULL) && is_project(path))
		return path;
	g_free(path);
	return NULL;
}

GPtrArray *recent_paths(void)
{
	GList *all = gtk_recent_manager_get_items(gtk_recent_manager_get_default());
	GPtrArray *paths = g_ptr_array_new_with_free_func(g_free);
	GList *ours = NULL;

	for (GList *at = all; at; at = at->next)
		if (had_at(at->data))
			ours = g_list_prepend(ours, at->data);
	ours = g_list_sort(ours, newer_first);
	for (GList *at = ours; at && paths->len < RECENT_MOST; at = at->next) {
		char *path = path_of(at->data);

		if (path)
			g_ptr_array_add(paths, path);
	}
	g_list_free(ours);
	g_list_free_full(all, (GDestroyNotify)gtk_recent_info_unref);
	return paths;
}

/* ---- as a menu ---- */

struct following {
	GMenu *rows;
	int index;
	bool shown;
};

/* "ladders/door.rung", because many folders have a main.rung. "__" shows one underscore in
 * a menu. Caller frees. */
static char *label_of(const char *path)
{
	char *name = g_path_get_basename(path), *folder = g_path_get_dirname(path);
	char *last = g_path_get_basename(folder);
	char *both = g_build_filename(last, name, NULL);
	char **parts = g_strsplit(both, "_", -1);
	char *label = g_strjoinv("__", parts);

	g_strfreev(parts);
	g_free(both);
	g_free(last);
	g_free(folder);
	g_free(name);
	return label;
}

static void add_row(GMenu *rows, const char *path)
{
	char *label = label_of(path);
	GMenuItem *row = g_menu_item_new(label, NULL);

	g_menu_item_set_action_and_target(row, "win.open-path", "s", path);
	g_menu_append_item(rows, row);
	g_object_unref(row);
	g_free(label);
}

/* An empty submenu is not added. */
static void show(GMenu *menu)
{
	struct following *following = g_object_get_data(G_OBJECT(menu), "recent");
	GPtrArray *paths = recent_paths();
	const bool any = paths->len > 0;

	g_menu_remove_all(following->rows);
	for (guint i = 0; i < paths->len; i++)
		add_row(following->rows, paths->pdata[i]);
	if (any && !following->shown)
		g_menu_insert_submenu(menu, following->index, _("Open recent"),
				      G_MENU_MODEL(following->rows));
	else if (!any && following->shown)
		g_menu_remove(menu, following->index);
	following->shown = any;
	g_ptr_array_unref(paths);
}

static void following_free(gpointer data)
{
	struct following *following = data;

	g_object_unref(following->rows);
	g_free(following);
}

void recent_follow(GMenu *menu, int index)
{
	struct following *following = g_new(struct following, 1);

	*following = (struct following){ g_menu_new(), index, false };
	g_object_set_data_full(G_OBJECT(menu), "recent", following, following_free);
	g_signal_connect_object(gtk_recent_manager_get_default(), "changed",
				G_CALLBACK(show), menu, G_CONNECT_SWAPPED);
	show(menu);
}
