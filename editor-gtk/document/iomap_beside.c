/* SPDX-License-Identifier: MIT
 *
 * iomap_beside - finds the I/O map of a project, and reads what a simulation needs of it.
 */
#include "editor-gtk/document/iomap_beside.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/side_file.h"

#include "hal/channel.h"
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

/* Bits of Q have a level; other values of Q their safe number. Other areas are not held in STOP. */
static void put_safe(const struct io_point *point, guint8 *safe, guint8 *holds)
{
	const struct iec_addr addr = point->addr;
	const guint8 bit = (guint8)(addr.bits == 1 ? 1 << addr.bit : 0xff);

	for (guint i = 0; point->hold && i < MAX(addr.bits / 8u, 1u); i++)
		holds[addr.byte + i] |= bit;
	if (point->hold)
		return;
	if (addr.bits != 1)
		iec_store(safe + addr.byte, point->channel->type, point->channel->safe);
	else
		safe[addr.byte] |= bit;
}

static bool has_safe(const struct io_point *point)
{
	return point->channel ? point->channel->safe.i != 0 : point->safe;
}

static guint8 *safe_of(const struct iomap *map, const struct areas *areas)
{
	guint8 *safe = NULL;

	for (int i = 0; i < map->count; i++) {
		const struct io_point *point = &map->point[i];

		if (!point->output || point->addr.area != AREA_Q || !(point->hold || has_safe(point)))
			continue;
		if (!safe)
			safe = g_malloc0(2 * areas->bytes[AREA_Q]);
		put_safe(point, safe, safe + areas->bytes[AREA_Q]);
	}
	return safe;
}

static void take_map(struct iomap_at_rest *out, const struct iomap *map, const struct areas *areas)
{
	out->safe = safe_of(map, areas);
	out->said_count = io_said_list(map, areas, NULL, 0);
	out->said = g_new(struct io_said, (gsize)out->said_count);
	io_said_list(map, areas, out->said, out->said_count);
}

static void read_map(struct iomap_at_rest *out, const char *file, const char *text, gsize len,
		     const struct areas *areas)
{
	struct diag_list *diags = g_new0(struct diag_list, 1);
	struct arena arena;
	struct iomap map;

	arena_init(&arena);
	diag_init(diags);
	if (iomap_read(&map, &arena, file, text, len, diags) && iomap_fits(&map, areas, diags))
		take_map(out, &map, areas);
	arena_free(&arena);
	g_free(diags);
}

struct iomap_at_rest iomap_read_beside(const char *path, const struct areas *areas)
{
	char *file = iomap_beside(path), *text = NULL;
	struct iomap_at_rest out = { NULL, NULL, 0 };
	gsize len;

	if (file)
		text = disk_read(file, LIMIT_TEXT, &len, NULL);
	if (text)
		read_map(&out, file, text, len, areas);
	g_free(text);
	g_free(file);
	return out;
}
