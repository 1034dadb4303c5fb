/* SPDX-License-Identifier: MIT
 *
 * window_sample - what belongs to a sample that is a copy here: its plant and its scenarios
 * lie beside the sample, and come along when the copy is saved.
 *
 * They get the name of the copy, by which they are found (side_file.h); so does the plant in
 * the scenarios that name it. Nothing is written over.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/panels/panels.h"

#include <string.h>

#define FILE_MOST (4 << 20) /* bytes of a file that comes along                 */

struct taking {
	LadderWindow *window;
	char *old_stem, *new_stem; /* paths without their ending               */
	GString *taken, *left;     /* names, with commas between               */
};

const char *window_sample(LadderWindow *window)
{
	return window->classic || ladder_document_path(window->document) ? NULL :
		window->origin;
}

/* "…/garage-door" of "…/garage-door.rung". Caller frees. */
static char *stem_of(const char *path)
{
	const char *name = strrchr(path, '/'), *dot = strrchr(path, '.');

	return g_strndup(path, dot && (!name || dot > name + 1) ? (gsize)(dot - path) :
			 strlen(path));
}

/* A scenario says in a line which plant it has. Caller frees. */
static char *renamed(const struct taking *taking, const char *text)
{
	char *was = g_path_get_basename(taking->old_stem);
	char *is = g_path_get_basename(taking->new_stem);
	char *old_name = g_strdup_printf("\"%s.plant.rung\"", was);
	char *new_name = g_strdup_printf("\"%s.plant.rung\"", is);
	char **parts = g_strsplit(text, old_name, -1);
	char *whole = g_strjoinv(new_name, parts);

	g_strfreev(parts);
	g_free(new_name);
	g_free(old_name);
	g_free(is);
	g_free(was);
	return whole;
}

static bool copy(const struct taking *taking, const char *from, const char *to, GError **error)
{
	gsize len;
	char *text = disk_read(from, FILE_MOST, &len, error), *whole;
	bool good;

	if (!text)
		return false;
	whole = renamed(taking, text);
	good = disk_save(to, whole, strlen(whole), error);
	g_free(whole);
	g_free(text);
	return good;
}

static void take(struct taking *taking, const char *from)
{
	char *to = g_strconcat(taking->new_stem, from + strlen(taking->old_stem), NULL);
	char *name = g_path_get_basename(to);
	const bool there = g_file_test(to, G_FILE_TEST_EXISTS);
	GString *names = there ? taking->left : taking->taken;
	GError *error = NULL;

	if (there || copy(taking, from, to, &error))
		g_string_append_printf(names, "%s%s", names->len ? ", " : "", name);
	else
		ladder_window_warn(taking->window, error->message);
	g_clear_error(&error);
	g_free(name);
	g_free(to);
}

static void take_all(struct taking *taking, const char *sample)
{
	char *plant = window_plant_of(sample);
	GPtrArray *scenarios = side_file_list(sample, ".scn", true);

	if (plant)
		take(taking, plant);
	for (guint i = 0; i < scenarios->len; i++)
		if (g_str_has_prefix(scenarios->pdata[i], taking->old_stem))
			take(taking, scenarios->pdata[i]); /* not of another folder */
	g_ptr_array_unref(scenarios);
	g_free(plant);
}

static void tell(const struct taking *taking)
{
	char *text;

	if (taking->taken->len) {
		text = g_strdup_printf(_("Saved, and what belongs to the sample beside it: "
					 "%s"), taking->taken->str);
		window_log(taking->window, _("system"), text);
		ladder_window_tell(taking->window, text);
		ladder_project_tree_look(taking->window->tree);
		g_free(text);
	}
	if (taking->left->len) {
		text = g_strdup_printf(_("Not copied from the sample, because files of that "
					 "name were there already: %s"), taking->left->str);
		ladder_window_warn(taking->window, text);
		g_free(text);
	}
}

void window_sample_saved(LadderWindow *window, const char *sample)
{
	const char *path = ladder_document_path(window->document);
	struct taking taking = {
		window, stem_of(sample), stem_of(path), g_string_new(NULL), g_string_new(NULL),
	};

	if (!disk_same(sample, path)) {
		take_all(&taking, sample);
		tell(&taking);
	}
	g_string_free(taking.left, TRUE);
	g_string_free(taking.taken, TRUE);
	g_free(taking.new_stem);
	g_free(taking.old_stem);
}
