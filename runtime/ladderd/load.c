/* SPDX-License-Identifier: MIT
 *
 * load - reads the program and the map, both even if the first has errors, so that one run
 * shows all. It refuses lines outside the areas of the program and warns about inputs and
 * outputs without a line.
 */
#include "ladderd/load.h"

#include "engine/base/file.h"
#include <stdio.h>
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

static bool is_mapped(const struct iomap *map, uint32_t area, uint32_t bit)
{
	for (int i = 0; i < map->count; i++) {
		struct iec_addr at = map->point[i].addr;

		if (at.area == area && at.byte * 8 + at.bit == bit)
			return true;
	}
	return false;
}

/* Warns (LD515) if a bit has no line. */
static void check_bit(struct load *load, uint8_t *named, struct location at,
		      const char *name)
{
	if (at.area != AREA_I && at.area != AREA_Q)
		return;
	named[load->source.program.areas.at[at.area] + at.where / 8] |=
		(uint8_t)(1u << at.where % 8);
	if (!is_mapped(&load->map, at.area, at.where))
		diag_add(&load->diags, (struct diag){
			.id = DIAG_IO_NOT_MAPPED, .file = load->map.file }, "%s",
			name);
}

static void check_array(struct load *load, uint8_t *named,
			const struct declared_name *array)
{
	char name[LIMIT_NAME + 16];

	for (uint32_t i = 0; i < array->array.count; i++) {
		snprintf(name, sizeof(name), "%.*s[%lld]",
			 (int)array->array.head, array->name,
			 (long long)array->array.low + i);
		check_bit(load, named, declared_element(array, i), name);
	}
}

/* Warns (LD515) about each input and output variable without a line. Sets the bits of all
 * of them in @named, which is as large as all areas. */
static void check_mapped(struct load *load, uint8_t *named)
{
	const struct program *program = &load->source.program;
	struct declared_cursor cursor = { 0 };
	struct declared_name symbol;

	while (image_next_declared(program, &cursor, &symbol)) {
		if (symbol.array.count && symbol.at.area != AREA_NONE)
			check_array(load, named, &symbol);
		else
			check_bit(load, named, symbol.at, symbol.name);
	}
}

/* The same for bits that the program uses by address. */
static void check_addresses(struct load *load, const uint8_t *named)
{
	const struct program *program = &load->source.program;

	for (uint32_t i = 0; i < program->bits_count; i++) {
		const struct code_bits *bits = &program->bits[i];
		uint32_t end = bits->first + bits->count;
		const uint8_t *byte;

		if (bits->area != AREA_I && bits->area != AREA_Q)
			continue;
		byte = named + program->areas.at[bits->area];
		for (uint32_t bit = bits->first; bit < end; bit++) {
			struct iec_addr at = {
				.area = (enum iec_area)bits->area, .bits = 1,
				.byte = bit / 8, .bit = bit % 8,
			};
			char text[24];

			if (is_mapped(&load->map, bits->area, bit) ||
			    byte[bit / 8] & 1u << bit % 8)
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
	uint8_t *named;
	bool good;

	arena_init(&load->arena);
	diag_init(&load->diags);
	good = source_load(&load->source, file);
	load->unreadable = load->source.unreadable;
	if (!load_map(load, map) || !good)
		return false;
	if (!iomap_fits(&load->map, &load->source.program.areas, &load->diags))
		return false;
	named = arena_alloc(&load->arena, load->source.program.areas.size);
	if (!named)
		return diag_add(&load->diags, (struct diag){
			.id = DIAG_NO_MEMORY, .file = map }, "%s", "");
	check_mapped(load, named);
	check_addresses(load, named);
	return true;
}

void load_free(struct load *load)
{
	source_free(&load->source);
	arena_free(&load->arena);
}
