/* SPDX-License-Identifier: MIT
 *
 * iomap_beside - finds the I/O map of a project, and reads the outputs of it that are 1 at
 * rest.
 */
#include "editor-gtk/document/iomap_beside.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/side_file.h"

#include "hal/iomap.h"

#include "engine/base/limits.h"

#include <string.h>

char *iomap_beside(const char *path)
{
	const char *dot = path ? strrchr(path, '.') : NULL;
	char *best = dot ? g_strdup_printf("%.*s.io", (int)(dot - path), path) : NULL;
	GPtrArray *files;

	if (best && g_file_test(best, G_FILE_TEST_EXISTS))
		return best;
	g_free(best);
	files = side_file_list(path, ".io", true);
	best = files->len ? g_strdup(files->pdata[0]) : NULL;
	g_ptr_array_unref(files);
	return best;
}

bool iomap_is_own(const char *path, const char *map)
{
	GPtrArray *files = side_file_list(path, ".io", true);
	const bool own = g_ptr_array_find_with_equal_func(files, map, g_str_equal, NULL);

	g_ptr_array_unref(files);
	return own;
}

static guint8 *safe_of(const struct iomap *map, const struct areas *areas)
{
	guint8 *safe = NULL;

	for (int i = 0; i < map->count; i++) {
		const struct io_point *point = &map->point[i];

		if (!point->output || !(point->safe || point->hold))
			continue;
		if (!safe)
			safe = g_malloc0(2 * areas->bytes[AREA_Q]);
		safe[point->addr.byte + (point->hold ? areas->bytes[AREA_Q] : 0)] |=
			(guint8)(1 << point->addr.bit);
	}
	return safe;
}

static guint8 *read_safe(const char *file, const char *text, gsize len,
			 const struct areas *areas)
{
	struct diag_list *diags = g_new0(struct diag_list, 1);
	struct arena arena;
	struct iomap map;
	guint8 *safe = NULL;

	arena_init(&arena);
	diag_init(diags);
	if (iomap_read(&map, &arena, file, text, len, diags) &&
	    iomap_fits(&map, areas, diags))
		safe = safe_of(&map, areas);
	arena_free(&arena);
	g_free(diags);
	return safe;
}

guint8 *iomap_safe_beside(const char *path, const struct areas *areas)
{
	char *file = iomap_beside(path), *text = NULL;
	guint8 *safe = NULL;
	gsize len;

	if (file)
		text = disk_read(file, LIMIT_TEXT, &len, NULL);
	if (text)
		safe = read_safe(file, text, len, areas);
	g_free(text);
	g_free(file);
	return safe;
}
