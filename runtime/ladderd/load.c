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

static bool load_map(struct load *load, const char *path)
{
	size_t len;
	char *text = file_read(path, MAP_BYTES, &len, &load->diags);
	bool good;

	if (!text) {
		load->unreadable = true;
		return false;
	}
	good = iomap_read(&load->map, &load->arena, path, text, len,
			  &load->diags);
	free(text);
	return good;
}

bool load_files(struct load *load, const char *file, const char *map, bool watch)
{
	bool good;

	arena_init(&load->arena);
	diag_init(&load->diags);
	good = source_load(&load->source, file, watch);
	load->unreadable = load->source.unreadable;
	if (!load_map(load, map) || !good)
		return false;
	return iomap_check_program(&load->map, &load->source.program, &load->arena,
				   &load->diags);
}

void load_free(struct load *load)
{
	source_free(&load->source);
	arena_free(&load->arena);
}
