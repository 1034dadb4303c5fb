/* SPDX-License-Identifier: MIT
 *
 * load - reads both files even if the first is wrong, so that one run shows all
 * errors; then warns of inputs and outputs that the map does not have.
 */
#include "ladderd/load.h"

#include <stdlib.h>

#define MAP_BYTES (4u << 20)

static bool load_map(struct load *load, const char *path)
{
	size_t len;
	char *text = ladder_read_file(path, MAP_BYTES, &len, &load->diags);
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

static bool load_program(struct load *load, const char *path)
{
	if (ladder_load(load->ladder, path))
		return ladder_build(load->ladder);
	if (!ladder_could_read(load->ladder))
		load->unreadable = true;
	return false;
}

static bool is_mapped(const struct iomap *map, uint32_t area, uint32_t bit)
{
	for (int i = 0; i < map->count; i++) {
		struct iec_addr at = map->point[i].addr;

		if (at.area == area && at.byte * 8 + at.bit == bit)
			return true;
	}
	return false;
}

/* LD515 for each input and output bit of the program without a line. */
static void check_mapped(struct load *load)
{
	const struct program *program = ladder_program(load->ladder);
	struct image *image = arena_alloc(&load->arena, sizeof(*image));
	struct symbol_cursor *cursor = arena_alloc(&load->arena,
						   sizeof(*cursor));
	struct symbol symbol;

	if (!image || !cursor)
		return;
	image->program = program;
	while (image_next_symbol(image, cursor, &symbol)) {
		uint32_t area = symbol.at.area;

		if ((area == AREA_I || area == AREA_Q) &&
		    !is_mapped(&load->map, area, symbol.at.where))
			diag_add(&load->diags, (struct diag){
				.id = DIAG_IO_NOT_MAPPED,
				.file = load->map.file }, "%s", symbol.name);
	}
}

static bool is_named(const struct program *program, uint32_t area, uint32_t bit)
{
	for (uint32_t i = 0; i < program->symbol_count; i++)
		if (program->symbol[i].area == area &&
		    program->symbol[i].where == bit)
			return true;
	return false;
}

/* The same for bits that the program uses by their address. */
static void check_addresses(struct load *load)
{
	const struct program *program = ladder_program(load->ladder);

	for (uint32_t i = 0; i < program->bits_count; i++) {
		const struct code_bits *bits = &program->bits[i];
		uint32_t end = bits->first + bits->count;

		if (bits->area != AREA_I && bits->area != AREA_Q)
			continue;
		for (uint32_t bit = bits->first; bit < end; bit++) {
			struct iec_addr at = {
				.area = (enum iec_area)bits->area, .bits = 1,
				.byte = bit / 8, .bit = bit % 8,
			};
			char text[24];

			if (is_mapped(&load->map, bits->area, bit) ||
			    is_named(program, bits->area, bit))
				continue;
			iec_addr_print(at, text, sizeof(text));
			diag_add(&load->diags, (struct diag){
				.id = DIAG_IO_NOT_MAPPED,
				.file = load->map.file }, "%s", text);
		}
	}
}

bool load_files(struct load *load, const char *file, const char *map)
{
	bool good;

	arena_init(&load->arena);
	diag_init(&load->diags);
	load->unreadable = false;
	load->ladder = ladder_new();
	if (!load->ladder)
		return diag_add(&load->diags, (struct diag){
			.id = DIAG_NO_MEMORY, .file = file }, "%s", "");
	good = load_program(load, file);
	if (!load_map(load, map) || !good)
		return false;
	check_mapped(load);
	check_addresses(load);
	return true;
}

void load_free(struct load *load)
{
	ladder_free(load->ladder);
	arena_free(&load->arena);
}
