/* SPDX-License-Identifier: MIT
 *
 * load - reads the program and the map, both even if the first has errors, so that one run
 * shows all. It refuses lines outside the areas of the program and warns about inputs and
 * outputs without a line.
 */
#include "ladderd/load.h"

#include "engine/base/file.h"

#include <stdlib.h>

#define MAP_BYTES (4u << 20)

/* The text stays in the arena: a download compares its map with it. */
static bool take_map(struct load *load, const char *file, const char *text, size_t len)
{
	load->map_text = arena_copy(&load->arena, text, len);
	load->map_len = len;
	return load->map_text && iomap_read(&load->map, &load->arena, file, load->map_text, len,
					    &load->diags);
}

static bool load_map(struct load *load, const char *path)
{
	size_t len;
	char *text = file_read(path, MAP_BYTES, &len, &load->diags);
	bool good;

	if (!text) {
		load->unreadable = true;
		return false;
	}
	good = take_map(load, path, text, len);
	free(text);
	return good;
}

static bool check_both(struct load *load, bool program, bool map)
{
	return program && map &&
	       iomap_check_program(&load->map, &load->source.program, &load->arena,
				   &load->diags);
}

bool load_files(struct load *load, const char *file, const char *map, bool watch)
{
	bool good;

	arena_init(&load->arena);
	diag_init(&load->diags);
	good = source_load(&load->source, file, watch);
	load->unreadable = load->source.unreadable;
	return check_both(load, good, load_map(load, map));
}

bool load_texts(struct load *load, const void *program, size_t program_len, const char *map,
		size_t map_len)
{
	bool good;

	arena_init(&load->arena);
	diag_init(&load->diags);
	good = source_load_text(&load->source, "program", program, program_len, true);
	return check_both(load, good, take_map(load, "map", map, map_len));
}

void load_free(struct load *load)
{
	source_free(&load->source);
	arena_free(&load->arena);
}
