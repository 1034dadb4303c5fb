/* SPDX-License-Identifier: MIT
 *
 * welcome - what an editor without a file shows: begin anew, go on, look at a sample.
 */
#include "editor-gtk/window/welcome.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/installed.h"
#include "editor-gtk/window/recent.h"

#include "engine/base/limits.h"

#include <adwaita.h>
#include <string.h>

/* The folder of the samples; NULL: none. Caller frees. */
static char *samples_folder(void)
{
	const char *told = g_getenv("RUNGBOARD_LADDERS");
	char *found = told ? g_strdup(told) : installed_folder("ladders", "rungboard/ladders");
	char *samples = found ? g_canonicalize_filename(found, NULL) : NULL;

	g_free(found);
	return samples;
}

/* ---- rows ---- */

static void activated(AdwActionRow *row)
{
	const char *action = g_object_get_data(G_OBJECT(row), "action");
	const char *path = g_object_get_data(G_OBJECT(row), "path");

	if (path)
		gtk_widget_activate_action(GTK_WIDGET(row), action, "s", path);
	else
		gtk_widget_activate_action(GTK_WIDGET(row), action, NULL);
}

static void add_row(GtkWidget *group, const char *title, const char *subtitle,
		    const char *action, const char *path)
{
	GtkWidget *row = adw_action_row_new();
	char *escaped = g_markup_escape_text(title, -1);
	char *below = subtitle ? g_markup_escape_text(subtitle, -1) : NULL;

	adw_preferences_row_set_title(ADW_PREFERENCES_ROW(row), escaped);
	if (below)
		adw_action_row_set_subtitle(ADW_ACTION_ROW(row), below);
	gtk_list_box_row_set_activatable(GTK_LIST_BOX_ROW(row), TRUE);
	g_object_set_data_full(G_OBJECT(row), "action", g_strdup(action), g_free);
	g_object_set_data_full(G_OBJECT(row), "path", g_strdup(path), g_free);
	g_signal_connect(row, "activated", G_CALLBACK(activated), NULL);
	adw_preferences_group_add(ADW_PREFERENCES_GROUP(group), row);
	g_free(escaped);
	g_free(below);
}

static GtkWidget *add_group(GtkWidget *page, const char *title)
{
	GtkWidget *group = adw_preferences_group_new();

	adw_preferences_group_set_title(ADW_PREFERENCES_GROUP(group), title);
	adw_preferences_page_add(ADW_PREFERENCES_PAGE(page), ADW_PREFERENCES_GROUP(group));
	return group;
}

/* ---- what there is to open ---- */

static void add_recent(GtkWidget *page)
{
	GPtrArray *paths = recent_paths();
	GtkWidget *group = paths->len ? add_group(page, _("Recent")) : NULL;

	for (guint i = 0; i < paths->len; i++) {
		char *name = g_path_get_basename(paths->pdata[i]);

		add_row(group, name, paths->pdata[i], "win.open-path", paths->pdata[i]);
		g_free(name);
	}
	g_ptr_array_unref(paths);
}

/* The text after PROJECT; NULL: none. Caller frees. */
static char *title_of(const char *path)
{
	char *found, *end, *title = NULL;
	gsize len;
	char *text = disk_read(path, LIMIT_TEXT, &len, NULL);

	if (!text)
		return NULL;
	found = strstr(text, "\nPROJECT \"");
	if (found) {
		found += strlen("\nPROJECT \"");
		end = strchr(found, '"');
		if (end)
			title = g_strndup(found, (gsize)(end - found));
	}
	g_free(text);
	return title;
}

static int by_name(gconstpointer a, gconstpointer b)
{
	return strcmp(*(char *const *)a, *(char *const *)b);
}

static void add_samples(GtkWidget *page)
{
	char *folder = samples_folder();
	GDir *dir = folder ? g_dir_open(folder, 0, NULL) : NULL;
	GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
	GtkWidget *group = dir ? add_group(page, _("Samples, opened as copies")) : NULL;
	const char *name;

	while (dir && (name = g_dir_read_name(dir)))
		if (g_str_has_suffix(name, ".rung"))
			g_ptr_array_add(names, g_strdup(name));
	g_ptr_array_sort(names, by_name);
	for (guint i = 0; i < names->len; i++) {
		char *path = g_build_filename(folder, names->pdata[i], NULL);
		char *title = title_of(path);

		add_row(group, title ? title : names->pdata[i], names->pdata[i],
			"win.open-sample", path);
		g_free(title);
		g_free(path);
	}
	if (dir)
		g_dir_close(dir);
	g_ptr_array_unref(names);
	g_free(folder);
}

GtkWidget *welcome_new(void)
{
	GtkWidget *page = adw_preferences_page_new();
	GtkWidget *begin = add_group(page, _("Begin"));

	add_row(begin, _("New project"), _("An empty sheet. Type a name to make a contact."),
		"win.begin", NULL);
	add_row(begin, _("Open a file…"), _("Rung files. A damaged file opens as text."),
		"win.open", NULL);
	add_recent(page);
	add_samples(page);
	return page;
}
