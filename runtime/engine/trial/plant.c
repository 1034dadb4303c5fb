/* SPDX-License-Identifier: MIT
 *
 * plant - finds the inputs that a plant sets, and exchanges bytes with its program.
 */
#include "engine/trial/plant.h"

#include "engine/scan/code_access.h"

#include <stdlib.h>
#include <string.h>

const struct plant_pair plant_pairs[PLANT_PAIRS] = {
	{ AREA_Q, AREA_I }, { AREA_AQ, AREA_AI },
	{ AREA_XQ, AREA_XI }, { AREA_XAQ, AREA_XAI },
};

/* ---- inputs that it sets ---- */

struct find {
	const struct areas *here;  /* of the program                          */
	const struct areas *there; /* of the plant                            */
	uint8_t *drives;
};

static void drive(const struct find *find, enum iec_area area, uint32_t bit,
		  uint32_t bits)
{
	for (size_t i = 0; i < PLANT_PAIRS; i++) {
		const enum iec_area in = plant_pairs[i].in;
		const uint32_t most = 8 * find->here->bytes[in];

		if (plant_pairs[i].out != area || bit >= most)
			continue;
		if (bits > most - bit)
			bits = most - bit;
		for (uint32_t b = bit; b < bit + bits; b++)
			find->drives[find->here->at[in] + b / 8] |=
				(uint8_t)(1u << b % 8);
	}
}

static void drive_memory(const struct find *find, uint64_t bit, uint64_t bits)
{
	const enum iec_area area = areas_find(find->there, (uint32_t)(bit / 8));

	if (area != AREA_NONE)
		drive(find, area, (uint32_t)bit - 8 * find->there->at[area],
		      bits < UINT32_MAX ? (uint32_t)bits : UINT32_MAX);
}

/* The stores of its instructions, without names. */
static void drive_store(void *context, const struct code_access *access)
{
	if (access->write)
		drive_memory(context, access->bit, access->bits);
}

static void find_used(const struct find *find, const struct program *plant)
{
	for (uint32_t i = 0; i < plant->bits_count; i++)
		drive(find, (enum iec_area)plant->bits[i].area, plant->bits[i].first,
		      plant->bits[i].count);
	code_each_access(plant, drive_store, (void *)find);
}

static void find_declared(const struct find *find, const struct image *plant)
{
	struct symbol_cursor cursor = { .whole = true };
	struct symbol symbol;

	while (image_next_symbol(plant, &cursor, &symbol)) {
		const struct location at = symbol.at;

		if (at.type == IEC_NONE)
			continue;
		if (at.area != AREA_NONE)
			drive(find, at.area, at.where, 1);
		else
			drive_memory(find, 8 * (uint64_t)at.where,
				     8 * (uint64_t)iec_type_row(at.type)->size);
	}
}

void plant_find(const struct image *plant, const struct areas *areas, uint8_t *drives)
{
	const struct find find = { .here = areas, .there = &plant->program->areas,
				   .drives = drives };

	find_declared(&find, plant);
	find_used(&find, plant->program);
}

/* ---- a turn ---- */

static uint32_t least(uint32_t a, uint32_t b)
{
	return a < b ? a : b;
}

static void to_plant(struct image *plant, struct image *program)
{
	for (size_t i = 0; i < PLANT_PAIRS; i++) {
		const enum iec_area out = plant_pairs[i].out, in = plant_pairs[i].in;

		memcpy(image_area(plant, in), image_area(program, out),
		       least(plant->program->areas.bytes[in],
			     program->program->areas.bytes[out]));
	}
}

/* Takes the bits of @mask from @from. It runs after each scan and most of a mask is empty, so eight bytes are one step. */
static void mix(uint8_t *to, const uint8_t *from, const uint8_t *mask, uint32_t bytes)
{
	uint32_t at = 0;

	for (; bytes - at >= 8; at += 8) {
		uint64_t m, t, f;

		memcpy(&m, mask + at, 8);
		if (m == 0)
			continue;
		memcpy(&t, to + at, 8);
		memcpy(&f, from + at, 8);
		t = (t & ~m) | (f & m);
		memcpy(to + at, &t, 8);
	}
	for (; at < bytes; at++)
		to[at] = (uint8_t)((to[at] & ~mask[at]) | (from[at] & mask[at]));
}

static void from_plant(struct image *plant, const uint8_t *drives,
		       struct image *program)
{
	const struct areas *here = &program->program->areas;
	const struct areas *there = &plant->program->areas;

	for (size_t i = 0; i < PLANT_PAIRS; i++) {
		const enum iec_area out = plant_pairs[i].out, in = plant_pairs[i].in;
		uint8_t *to = image_area(program, in);
		const uint8_t *from = image_area(plant, out);
		const uint8_t *mask = drives + here->at[in];
		mix(to, from, mask, least(here->bytes[in], there->bytes[out]));
	}
}

void plant_turn(struct resource *plant, const uint8_t *drives, struct image *program,
		int64_t now_ns)
{
	to_plant(&plant->image, program);
	resource_scan(plant, now_ns);
	from_plant(&plant->image, drives, program);
}

/* ---- a plant with its own resource ---- */

bool plant_init(struct plant *plant, const struct program *program,
		const struct program *beside)
{
	const size_t size = (image_memory_size(program) + 7) & ~(size_t)7;
	uint8_t *memory = calloc(1, size + beside->areas.size);

	memset(plant, 0, sizeof(*plant));
	if (!memory)
		return false;
	plant->memory = memory;
	plant->drives = memory + size;
	resource_init(&plant->resource, program, memory);
	plant_find(&plant->resource.image, &beside->areas, plant->drives);
	return true;
}

void plant_free(struct plant *plant)
{
	free(plant->memory);
	memset(plant, 0, sizeof(*plant));
}

void plant_scan(struct plant *plant, struct image *program, int64_t now_ns)
{
	plant_turn(&plant->resource, plant->drives, program, now_ns);
}
