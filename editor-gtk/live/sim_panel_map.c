/* SPDX-License-Identifier: MIT
 *
 * sim_panel_map - what the I/O map beside the project calls the panel's inputs and outputs:
 * the pin of each, and the chip or board where that is.
 *
 * The map is looked at as text, so that one with errors gives what can be understood of it.
 * It is never written.
 */
#include "editor-gtk/live/sim_panel_map.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/document/iomap_beside.h"
#include "editor-gtk/document/iomap_text.h"

#include "engine/base/limits.h"
#include "engine/base/iec.h"

#include <stdlib.h>
#include <string.h>

/* ---- what it says ---- */

struct map {
	struct io_text io;
	GHashTable *rows;   /* key of an address -> row of `io`, + 1           */
	char *board;        /* "" if it says none                              */
	GPtrArray *places;  /* in the order of the map                         */
};

static gpointer key_of(struct iec_addr addr)
{
	return GUINT_TO_POINTER(((guint)addr.area << 24 | addr.byte) << 3 | addr.bit);
}

/* Of a bit of I or Q; nothing else has a pin. */
static bool read_address(const char *text, struct iec_addr *addr)
{
	return text && iec_addr_parse(text, strlen(text), addr) == ADDR_OK &&
	       addr->bits == 1 && (addr->area == AREA_I || addr->area == AREA_Q);
}

/* A line has a name of its own on the whole board, an offset is one of a chip. Caller
 * frees. */
static char *place_of(const struct map *map, int at)
{
	char *line = io_text_field(&map->io, at, IO_LINE);
	char *driver = io_text_field(&map->io, at, IO_DRIVER);
	const char *blank = line ? strrchr(line, ' ') : NULL;
	char *place = blank ? g_strndup(line, (gsize)(blank - line)) :
		      line && *line && *map->board ? g_strdup(map->board) :
						     g_strdup(driver ? driver : "");

	free(line);
	free(driver);
	return place;
}

static void read_row(struct map *map, int at)
{
	char *address = io_text_field(&map->io, at, IO_ADDRESS);
	char *place = place_of(map, at);
	struct iec_addr addr;

	if (read_address(address, &addr))
		g_hash_table_insert(map->rows, key_of(addr), GINT_TO_POINTER(at + 1));
	if (!g_ptr_array_find_with_equal_func(map->places, place, g_str_equal, NULL))
		g_ptr_array_add(map->places, g_steal_pointer(&place));
	free(address);
	g_free(place);
}

static bool read_map(struct map *map, const char *text, gsize len)
{
	char *board;

	if (!io_text_read(&map->io, text, len)) {
		io_text_free(&map->io);
		return false;
	}
	map->rows = g_hash_table_new(NULL, NULL);
	map->places = g_ptr_array_new_with_free_func(g_free);
	board = io_text_board(&map->io);
	map->board = g_strdup(board ? board : "");
	free(board);
	for (int i = 0; i < map->io.count; i++)
		read_row(map, i);
	return true;
}

static void clear_map(struct map *map)
{
	io_text_free(&map->io);
	g_hash_table_unref(map->rows);
	g_ptr_array_unref(map->places);
	g_free(map->board);
}

static void put(struct map *map, int at, LadderSimRow *row)
{
	char *line = io_text_field(&map->io, at, IO_LINE);
	char *comment = io_text_field(&map->io, at, IO_COMMENT);
	const char *blank = line ? strrchr(line, ' ') : NULL;
	guint number = 0;

	row->place = place_of(map, at);
	g_ptr_array_find_with_equal_func(map->places, row->place, g_str_equal, &number);
	row->place_number = (int)number;
	row->pin = line && *line ? g_strdup(blank ? blank + 1 : line) : NULL;
	row->pin_told = g_strdup_printf("%s  %s%s%s%s", row->place, row->pin ? row->pin : "",
					comment && *comment ? "  (" : "",
					comment && *comment ? comment : "",
					comment && *comment ? ")" : "");
	free(line);
	free(comment);
}

static void take(struct map *map, LadderSimRow *row)
{
	const char *address = row->address ? row->address : row->name;
	struct iec_addr addr;
	int at;

	if ((row->group != SIM_INPUTS && row->group != SIM_OUTPUTS) ||
	    !read_address(address, &addr))
		return;
	at = GPOINTER_TO_INT(g_hash_table_lookup(map->rows, key_of(addr)));
	if (at > 0) {
		put(map, at - 1, row);
		return;
	}
	row->place = g_strdup(_("not in the I/O map"));
	row->place_number = G_MAXINT;
}

void sim_map_take(const char *path, GPtrArray *rows)
{
	char *file = iomap_beside(path), *text = NULL;
	struct map map;
	gsize len;

	if (file)
		text = disk_read(file, LIMIT_TEXT, &len, NULL);
	if (text && read_map(&map, text, len)) {
		if (map.io.count > 0)
			for (guint i = 0; i < rows->len; i++)
				take(&map, rows->pdata[i]);
		clear_map(&map);
	}
	g_free(text);
	g_free(file);
}
