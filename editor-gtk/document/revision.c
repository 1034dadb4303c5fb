/* SPDX-License-Identifier: MIT
 *
 * revision - reads the project file, then what the engine asks for while it reads that, until
 * nothing is missing.
 */
#include "editor-gtk/document/revision.h"

#include "editor-gtk/document/git_log.h"
#include "editor-gtk/document/iomap_beside.h"

#include <string.h>

struct reading {
	char *path, *hash, *asked; /* asked: the name of the file that is awaited */
	struct compare_side side;
	GPtrArray *maps;           /* names that its I/O map may have, the likely one last */
	char *map;                 /* the path of the map now; NULL: none, or its names are read */
	GCancellable *cancel;
	gulong cancelled;          /* handler; 0: none                              */
	revision_take *take;
	gpointer data;
};

static void ignore_cancel(struct reading *reading)
{
	if (reading->cancelled)
		g_cancellable_disconnect(reading->cancel, reading->cancelled);
	reading->cancelled = 0;
}

static void reading_free(gpointer data)
{
	struct reading *reading = data;

	compare_side_clear(&reading->side);
	ignore_cancel(reading);
	g_clear_object(&reading->cancel);
	g_ptr_array_unref(reading->maps);
	g_free(reading->map);
	g_free(reading->path);
	g_free(reading->hash);
	g_free(reading->asked);
	g_free(reading);
}

static void take(gpointer data, char *text, gsize len, const char *why);

static void ask(struct reading *reading, char *name)
{
	g_free(reading->asked);
	reading->asked = name;
	git_log_show(reading->path, reading->hash, name, reading->cancel, take, reading);
}

static void take_names(gpointer data, GPtrArray *revisions, const char *why);

/* The name of the map now, beside the project as it was. */
static void add_beside(struct reading *reading, const char *map)
{
	char *base = g_path_get_basename(map), *folder = g_path_get_dirname(reading->side.path);

	g_ptr_array_add(reading->maps, strcmp(folder, ".") == 0 ? g_strdup(base) :
			g_build_filename(folder, base, NULL));
	g_free(folder);
	g_free(base);
}

static void ask_next(struct reading *reading)
{
	char *name = compare_side_wants(&reading->side), *map;

	if (!name && !reading->side.map && reading->maps->len)
		name = g_ptr_array_steal_index(reading->maps, reading->maps->len - 1);
	if (name) {
		ask(reading, name);
		return;
	}
	if (!reading->side.map && reading->map) {
		map = g_steal_pointer(&reading->map);
		add_beside(reading, map);
		git_log_read(map, reading->cancel, take_names, reading);
		g_free(map);
		return;
	}
	ignore_cancel(reading); /* the callee may cancel */
	reading->take(reading->data, &reading->side, NULL);
	reading_free(reading);
}

/* As the likeliest name. */
static void add_once(struct reading *reading, const char *name)
{
	guint at;

	if (g_ptr_array_find_with_equal_func(reading->maps, name, g_str_equal, &at))
		g_ptr_array_remove_index(reading->maps, at);
	g_ptr_array_add(reading->maps, g_strdup(name));
}

/* The map has its name of that revision, or an older one, if it was renamed since. */
static void take_names(gpointer data, GPtrArray *revisions, const char *why)
{
	struct reading *reading = data;

	(void)why; /* a map that git does not know has no other name */
	for (guint i = revisions ? revisions->len : 0; i > 0; i--) {
		const char *name = ((struct git_revision *)revisions->pdata[i - 1])->name;

		add_once(reading, name);
	}
	g_clear_pointer(&revisions, g_ptr_array_unref);
	ask_next(reading);
}

static bool is_map(const struct reading *reading)
{
	return g_str_has_suffix(reading->asked, ".io");
}

/* Files that are not there are errors of the project, or no map. */
static void take(gpointer data, char *text, gsize len, const char *why)
{
	struct reading *reading = data;

	if (!reading->side.text && !text) {
		ignore_cancel(reading);
		reading->take(reading->data, NULL, why);
		reading_free(reading);
		return;
	}
	if (!reading->side.text) {
		reading->side.text = text;
		reading->side.len = len;
	} else if (is_map(reading) && !reading->side.map) {
		reading->side.map = text;
	} else {
		g_hash_table_insert(reading->side.files, g_strdup(reading->asked),
				    text ? g_bytes_new_take(text, len) : NULL);
	}
	ask_next(reading);
}

static void bytes_free(gpointer bytes)
{
	if (bytes)
		g_bytes_unref(bytes);
}

static gboolean drop(gpointer reading)
{
	reading_free(reading);
	return G_SOURCE_REMOVE;
}

/* No answer of git comes any more. A handler cannot disconnect itself. */
static void cancelled(GCancellable *cancel, gpointer reading)
{
	(void)cancel;
	g_idle_add(drop, reading);
}

void revision_read(const char *path, const char *hash, const char *name, const char *title,
		   GCancellable *cancel, revision_take *taken, gpointer data)
{
	struct reading *reading = g_new0(struct reading, 1);
	const char *dot = strrchr(name, '.');

	*reading = (struct reading){ .path = g_strdup(path), .hash = g_strdup(hash),
		.side = { .name = g_strdup(title), .path = g_strdup(name),
			  .files = g_hash_table_new_full(g_str_hash, g_str_equal, g_free,
							 bytes_free) },
		.maps = g_ptr_array_new_with_free_func(g_free),
		.cancel = cancel ? g_object_ref(cancel) : NULL, .take = taken, .data = data };
	reading->map = iomap_beside(path);
	if (dot)
		g_ptr_array_add(reading->maps, g_strdup_printf("%.*s.io", (int)(dot - name),
							       name));
	if (cancel)
		reading->cancelled = g_cancellable_connect(cancel, G_CALLBACK(cancelled), reading,
							   NULL);
	ask(reading, g_strdup(name));
}
