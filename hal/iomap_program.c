/* SPDX-License-Identifier: MIT
 *
 * iomap_program - compares an I/O map with the inputs and outputs that a program uses.
 */
#include "hal/iomap_read.h"

#include "engine/scan/code_access.h"
#include "engine/scan/image.h"

#include <stdio.h>

/* Two maps with a bit for each bit of the areas. */
struct cover {
	const struct iomap *map;
	const struct program *program;
	struct diag_list *diags;
	uint8_t *mapped, *named; /* has a line; was checked already           */
};

static void set_bits(uint8_t *map, uint64_t bit, uint32_t bits)
{
	for (uint32_t i = 0; i < bits; i++)
		map[(bit + i) / 8] |= (uint8_t)(1u << (bit + i) % 8);
}

static uint32_t count_bits(const uint8_t *map, uint64_t bit, uint64_t bits)
{
	uint32_t count = 0;

	for (const uint64_t end = bit + bits; bit < end; bit++)
		count += map[bit / 8] >> bit % 8 & 1;
	return count;
}

static bool is_outside(const struct cover *cover, uint64_t bit)
{
	return iec_area_is_io(areas_find(&cover->program->areas, (uint32_t)(bit / 8)));
}

/* Warns (LD515) if none of the bits has a line. */
static void check_lines(struct cover *cover, uint64_t bit, uint64_t bits,
			const char *name)
{
	if (!count_bits(cover->mapped, bit, bits))
		diag_add(cover->diags, (struct diag){
			.id = DIAG_IO_NOT_MAPPED, .file = cover->map->file }, "%s", name);
}

/* A variable, or an element of an array. */
static void check_name(struct cover *cover, struct location at, const char *name)
{
	const struct areas *areas = &cover->program->areas;
	const uint32_t bits = at.area ? 1 : 8u * iec_type_row(at.type)->size;
	const uint64_t bit = at.where * (at.area ? UINT64_C(1) : 8) +
			     (at.area ? 8 * (uint64_t)areas->at[at.area] : 0);

	if (!bits || !is_outside(cover, bit))
		return;
	set_bits(cover->named, bit, bits);
	check_lines(cover, bit, bits, name);
}

static void check_array(struct cover *cover, const struct declared_name *array)
{
	char name[LIMIT_NAME + 16];

	for (uint32_t i = 0; i < array->array.count; i++) {
		snprintf(name, sizeof(name), "%.*s[%lld]", (int)array->array.head,
			 array->name, (long long)array->array.low + i);
		check_name(cover, declared_element(array, i), name);
	}
}

static void check_names(struct cover *cover)
{
	struct declared_cursor cursor = { 0 };
	struct declared_name symbol;

	while (image_next_declared(cover->program, &cursor, &symbol)) {
		const bool bit = symbol.at.area;

		if (!bit && !is_outside(cover, 8 * (uint64_t)symbol.at.where))
			continue;
		if (symbol.array.count)
			check_array(cover, &symbol);
		else
			check_name(cover, symbol.at, symbol.name);
	}
}

/* An address that the program uses. Addresses of variables were checked with their
 * names. */
static void check_address(void *context, const struct code_access *access)
{
	struct cover *cover = context;
	const struct areas *areas = &cover->program->areas;
	const bool usual = access->unit == 1 || access->unit == 8 ||
			   access->unit == 16 || access->unit == 32 || access->unit == 64;
	const uint32_t bits = usual ? access->unit : 8;
	struct iec_addr at = { .bits = (uint8_t)bits };
	char text[24];

	if (!is_outside(cover, access->bit) ||
	    count_bits(cover->named, access->bit, bits) == bits)
		return;
	set_bits(cover->named, access->bit, bits);
	at.area = areas_find(areas, (uint32_t)(access->bit / 8));
	at.byte = (uint32_t)(access->bit / 8) - areas->at[at.area];
	at.bit = access->bit % 8;
	iec_addr_print(at, text, sizeof(text));
	check_lines(cover, access->bit, access->bits, text);
}

/* Bits that have a byte of their own. */
static void check_bits(struct cover *cover)
{
	const struct program *program = cover->program;

	for (uint32_t i = 0; i < program->bits_count; i++) {
		const struct code_bits *bits = &program->bits[i];
		const uint64_t first = 8 * (uint64_t)program->areas.at[bits->area] +
				       bits->first;

		for (uint32_t k = 0; k < bits->count; k++) {
			const struct code_access one = { first + k, 1, 1, false };

			check_address(cover, &one);
		}
	}
}

/* Once for all outputs: a map of an older project may name none. */
static void check_safe(const struct iomap *map, struct diag_list *diags)
{
	const struct io_point *first = NULL;
	unsigned others = 0;
	char text[24];

	for (int i = 0; i < map->count; i++) {
		const struct io_point *point = &map->point[i];

		if (!point->output || point->has_safe)
			continue;
		others += first != NULL;
		first = first ? first : point;
	}
	if (!first)
		return;
	iec_addr_print(first->addr, text, sizeof(text));
	if (others)
		diag_add(diags, io_place(map, first, DIAG_IO_NO_SAFE), "%s" DIAG_AND "%u", text, others);
	else
		diag_add(diags, io_place(map, first, DIAG_IO_NO_SAFE), "%s", text);
}

/* What @program uses against the points of @map. */
static bool check_cover(const struct iomap *map, const struct program *program, struct arena *scratch,
			struct diag_list *diags)
{
	const struct areas *areas = &program->areas;
	struct cover cover = { map, program, diags, arena_alloc(scratch, areas->size),
			       arena_alloc(scratch, areas->size) };

	if (!cover.mapped || !cover.named)
		return diag_add(diags, (struct diag){ .id = DIAG_NO_MEMORY,
						      .file = map->file }, "%s", "");
	for (int i = 0; i < map->count; i++) {
		const struct iec_addr at = map->point[i].addr;

		set_bits(cover.mapped, 8 * (uint64_t)areas_byte(areas, at) + at.bit, at.bits);
	}
	check_safe(map, diags);
	check_names(&cover);
	check_bits(&cover);
	code_each_access(program, check_address, &cover);
	return true;
}

bool iomap_check_program(const struct iomap *map, const struct program *program,
			 struct arena *arena, struct diag_list *diags)
{
	const bool fits = iomap_fits(map, &program->areas, diags);
	struct arena scratch;
	bool good;

	if (!check_net(map, program, arena, diags) || !fits)
		return false;
	arena_init(&scratch);
	good = check_cover(map, program, &scratch, diags);
	arena_free(&scratch);
	return good;
}
