/* SPDX-License-Identifier: MIT
 *
 * origin - what an unsaved project was made from; see origin.h.
 */
#include "editor-gtk/window/origin.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/side_file.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/panels/project_tree.h"
#include "editor-gtk/window/messages.h"

#include <string.h>

#define FILE_MOST (4 << 20) /* bytes of a file that is copied                   */

struct taking {
	struct origin *origin;
	char *old_stem, *new_stem; /* paths without their ending               */
	GString *taken, *left;     /* file names, separated by commas          */
};

void origin_set_path(struct origin *origin, const char *path)
{
	g_free(origin->path);
	origin->path = g_strdup(path);
}

const char *origin_sample(struct origin *origin)
{
	return origin->classic || ladder_document_path(origin->core->document) ? NULL :
	       origin->path;
}

char *origin_name(struct origin *origin, const char *ending)
{
	const char *path = ladder_document_path(origin->core->document);
	char *name, *dot;

	if (!path && origin->classic)
		path = ladder_origin_path(origin->classic);
	if (!path)
		path = origin_sample(origin);
	name = path ? g_path_get_basename(path) : g_strdup("program");
	dot = strrchr(name, '.');
	if (dot && dot != name)
		*dot = '\0';
	dot = g_strconcat(name, ending, NULL);
	g_free(name);
	return dot;
}

/* ---- the plant ---- */

/* "tank.plant.rung" for "tank.rung", if it exists. Caller frees. */
static char *plant_of(const char *path)
{
	const gsize len = path ? strlen(path) : 0;
	char *plant;

	if (len < 5 || !g_str_has_suffix(path, ".rung") ||
	    g_str_has_suffix(path, ".plant.rung"))
		return NULL;
	plant = g_strdup_printf("%.*s.plant.rung", (int)(len - 5), path);
	if (!g_file_test(plant, G_FILE_TEST_EXISTS))
		g_clear_pointer(&plant, g_free);
	return plant;
}

bool origin_load_plant(struct origin *origin, GError **error)
{
	LadderSim *sim = origin->core->sim;
	const char *path = ladder_document_path(origin->core->document);
	char *found = plant_of(path ? path : origin->path);
	const char *plant = origin->plant_chosen ? origin->plant : found;
	const bool good = (!plant && !ladder_sim_plant(sim)) ||
			  ladder_sim_set_plant(sim, plant, error);

	g_free(found);
	return good;
}

void origin_set_plant(struct origin *origin, const char *path)
{
	GError *error = NULL;

	if (!ladder_sim_set_plant(origin->core->sim, path, &error)) {
		messages_warn(origin->core->messages, error->message);
		g_error_free(error);
		return;
	}
	origin->plant_chosen = true;
	g_free(origin->plant);
	origin->plant = g_strdup(path);
}

/* ---- a sample ---- */

/* "…/garage-door" of "…/garage-door.rung". Caller frees. */
static char *stem_of(const char *path)
{
	const char *name = strrchr(path, '/'), *dot = strrchr(path, '.');

	return g_strndup(path, dot && (!name || dot > name + 1) ? (gsize)(dot - path) :
			 strlen(path));
}

/* @text of a scenario, with the new name of its plant. Caller frees. */
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
		messages_warn(taking->origin->core->messages, error->message);
	g_clear_error(&error);
	g_free(name);
	g_free(to);
}

static void take_all(struct taking *taking, const char *sample)
{
	static const char *const endings[] = { ".scn", ".io" };
	char *plant = plant_of(sample);

	if (plant)
		take(taking, plant);
	for (gsize i = 0; i < G_N_ELEMENTS(endings); i++) {
		GPtrArray *files = side_file_list(sample, endings[i], true);

		for (guint k = 0; k < files->len; k++)
			if (g_str_has_prefix(files->pdata[k], taking->old_stem))
				take(taking, files->pdata[k]);
		g_ptr_array_unref(files);
	}
	g_free(plant);
}

static void tell(const struct taking *taking)
{
	char *text;

	if (taking->taken->len) {
		text = g_strdup_printf(_("Saved, together with the files of the sample: %s"),
				       taking->taken->str);
		messages_log(taking->origin->core->messages, LOG_SYSTEM, text);
		messages_tell(taking->origin->core->messages, text);
		ladder_project_tree_look(taking->origin->core->tree);
		g_free(text);
	}
	if (taking->left->len) {
		text = g_strdup_printf(_("These files of the sample were not copied because "
					 "they already exist: %s"), taking->left->str);
		messages_warn(taking->origin->core->messages, text);
		g_free(text);
	}
}

static void name_file(GString *names, const char *name)
{
	g_string_append_printf(names, "%s%s", names->len ? ", " : "", name);
}

/* @name: relative to the folder of both. */
static void take_part(struct origin *origin, const char *from, const char *folder, const char *name)
{
	char *to = g_build_filename(folder, name, NULL), *in = g_path_get_dirname(to), *text = NULL;
	GError *error = NULL;
	gsize len;

	if (g_file_test(to, G_FILE_TEST_EXISTS)) {
		name_file(origin->left, name);
	} else {
		g_mkdir_with_parents(in, 0777);
		text = disk_read(from, FILE_MOST, &len, &error);
		if (text && disk_save(to, text, len, &error))
			name_file(origin->taken, name);
		else
			messages_warn(origin->core->messages, error->message);
	}
	g_clear_error(&error);
	g_free(text);
	g_free(in);
	g_free(to);
}

void origin_will_save(struct origin *origin, const char *sample, const char *path)
{
	GPtrArray *files = sample && path && g_file_test(sample, G_FILE_TEST_IS_REGULAR) ?
			   ladder_document_files(origin->core->document) : NULL;
	char *of = sample ? g_path_get_dirname(sample) : NULL, *to = path ? g_path_get_dirname(path) : NULL;
	const gsize len = of ? strlen(of) : 0;

	if (!origin->taken) {
		origin->taken = g_string_new(NULL);
		origin->left = g_string_new(NULL);
	}
	g_string_truncate(origin->taken, 0);
	g_string_truncate(origin->left, 0);
	for (guint i = 0; files && i < files->len && !disk_same(of, to); i++) {
		const char *file = files->pdata[i];

		if (g_str_has_prefix(file, of) && file[len] == '/')
			take_part(origin, file, to, file + len + 1);
	}
	g_clear_pointer(&files, g_ptr_array_unref);
	g_free(to);
	g_free(of);
}

static void sample_saved(struct origin *origin, const char *sample)
{
	const char *path = ladder_document_path(origin->core->document);
	struct taking taking = {
		origin, stem_of(sample), stem_of(path), g_string_new(origin->taken ? origin->taken->str : NULL),
		g_string_new(origin->left ? origin->left->str : NULL),
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

/* ---- a project of ClassicLadder ---- */

static void classic_saved(struct origin *origin)
{
	const char *io = origin->classic ? ladder_origin_io(origin->classic) : NULL;
	char *stem = stem_of(ladder_document_path(origin->core->document));
	char *path = g_strconcat(stem, ".io", NULL);
	GError *error = NULL;

	if (io && !g_file_test(path, G_FILE_TEST_EXISTS)) {
		char *name = g_path_get_basename(path);
		char *text = g_strdup_printf(_("Saved, together with its I/O map: %s"), name);

		if (disk_save(path, io, strlen(io), &error))
			messages_toast(origin->core->messages, text);
		else
			messages_warn(origin->core->messages, error->message);
		g_free(text);
		g_free(name);
	}
	g_clear_error(&error);
	g_free(path);
	g_free(stem);
}

void origin_saved(struct origin *origin, const char *sample)
{
	classic_saved(origin);
	if (sample)
		sample_saved(origin, sample);
}

/* ---- life ---- */

void origin_init(struct origin *origin, struct core *core)
{
	origin->core = core;
}

void origin_clear(struct origin *origin)
{
	g_clear_object(&origin->classic);
	g_clear_pointer(&origin->path, g_free);
	g_clear_pointer(&origin->plant, g_free);
	if (origin->taken)
		g_string_free(origin->taken, TRUE);
	if (origin->left)
		g_string_free(origin->left, TRUE);
	origin->taken = origin->left = NULL;
}
