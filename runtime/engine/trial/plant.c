/* SPDX-License-Identifier: MIT
 *
 * plant - finds the inputs that a plant sets, and exchanges bytes with its program.
 */
#include "engine/trial/plant.h"

#include "engine/scan/code.h"

#include <stdlib.h>
#include <string.h>

struct store {
	uint32_t text;      /* word index of the instruction in CODE_TEXT     */
	uint64_t bit, bits; /* of memory: the first, how many. A BOOL outside
			       of the areas is a byte, so 8                   */
	uint32_t table;     /* of a LUT, with bits of a, b, c; else 0         */
	uint32_t read[3];   /* BOOLs that a LUT or BITPUT reads: offsets      */
};

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
static void drive_store(void *context, const struct store *store)
{
	drive_memory(context, store->bit, store->bits);
}

struct visit {
	void (*take)(void *context, const struct store *store);
	void *context;
	uint32_t text;
};

static void take_bytes(const struct visit *visit, uint32_t where, uint64_t bytes)
{
	const struct store store = { .text = visit->text, .bit = 8 * (uint64_t)where,
				     .bits = 8 * bytes };

	visit->take(visit->context, &store);
}

static void take_typed(const struct visit *visit, uint32_t operand)
{
	const uint32_t type = CODE_TYPE(operand);

	if (type > IEC_NONE && type < IEC_TYPE_COUNT)
		take_bytes(visit, CODE_OFFSET(operand),
			   iec_type_row((enum iec_type)type)->size);
}

static void take_lut(const struct visit *visit, const uint32_t *at, uint32_t n)
{
	for (; n; n--, at += 4) {
		const struct store store = {
			.text = visit->text, .bit = 8 * (uint64_t)(at[3] >> 8),
			.bits = 8, .table = at[3] & 0xff,
			.read = { at[0], at[1], at[2] },
		};

		visit->take(visit->context, &store);
	}
}

static void take_bit(const struct visit *visit, const uint32_t *at, uint32_t n)
{
	const struct store store = { .text = visit->text, .bits = 1,
				     .bit = 8 * (uint64_t)at[1] + n, .read = { at[0] } };

	visit->take(visit->context, &store);
}

/* All elements that the indices from @dimension on can select, each of @size; in units
 * of @unit bits. */
static void take_elements(const struct visit *visit, uint64_t first, uint64_t size,
			  const uint32_t *dimension, uint32_t count, uint32_t unit)
{
	struct store store = { .text = visit->text, .bit = first * unit };

	for (uint32_t i = 0; i < count; i++, dimension += CODE_DIMENSION)
		if (dimension[2])
			size += (uint64_t)(dimension[2] - 1) * dimension[3];
	store.bits = size * unit;
	visit->take(visit->context, &store);
}

static void take_put(const struct visit *visit, const uint32_t *at, uint32_t n)
{
	const bool bits = n & 1;
	const uint32_t type = CODE_TYPE(at[3]);

	take_bytes(visit, at[1], 1);
	take_elements(visit, CODE_OFFSET(at[3]),
		      bits || type >= IEC_TYPE_COUNT ? 1 :
		      iec_type_row((enum iec_type)type)->size,
		      at + 4, 1 + (n >> 1), bits ? 1 : 8);
}

static void take_block(const struct visit *visit, const uint32_t *at, uint32_t n)
{
	take_bytes(visit, at[1], 1);
	if (n & 1)
		take_elements(visit, at[2], at[4], at + 5, 1 + (n >> 1), 8);
	else
		take_bytes(visit, at[2], at[4]);
}

static void visit_code(const struct visit *visit, const uint32_t *code)
{
	const uint32_t n = *code >> 8, *at = code + 1;

	switch ((enum vm_op)(*code & 0xff)) {
	case VM_LUT: take_lut(visit, at, n); return;
	case VM_BITGET: take_bytes(visit, at[1], 1); return;
	case VM_BITPUT: take_bit(visit, at, n); return;
	case VM_COPY: take_typed(visit, at[1]); return;
	case VM_CMP:
	case VM_CMP_REAL:
	case VM_CMP_DINT:
	case VM_CMP_INT: take_bytes(visit, at[3], 1); return;
	case VM_REAL:
	case VM_DINT:
	case VM_INT:
		take_bytes(visit, at[1], 1);
		take_typed(visit, CODE_OPERAND(code_type(*code & 0xff), at[2]));
		return;
	case VM_FN:
		take_bytes(visit, at[2], 1);
		take_typed(visit, at[3]);
		return;
	case VM_FB: take_bytes(visit, at[0], word_row((enum word)n)->size); return;
	case VM_BLOCK: take_bytes(visit, at[0], at[2]); return;
	case VM_AGET:
		take_bytes(visit, at[1], 1);
		take_typed(visit, at[2]);
		return;
	case VM_APUT: take_put(visit, at, n); return;
	case VM_ABLOCK: take_block(visit, at, n); return;
	case VM_EACH: take_bytes(visit, at[0], sizeof(uint32_t)); return;
	case VM_TICK:
		take_bytes(visit, at[1], sizeof(int64_t));
		take_bytes(visit, at[2], sizeof(int64_t));
		take_bytes(visit, at[4], n * sizeof(int64_t));
		return;
	case VM_CALL:
	case VM_STOP:
	case VM_JMP:
	case VM_JMPC:
	case VM_END:
	case VM_COUNT: return;
	}
}

/* All stores of CODE_TEXT, in order. A call of a block is one store to its whole
 * instance. Scan-safe: no. */
static void stores_each(const struct program *program,
			void (*take)(void *context, const struct store *store), void *context)
{
	struct visit visit = { .take = take, .context = context };

	for (; visit.text < program->text_words;
	     visit.text += code_words(program->text + visit.text))
		visit_code(&visit, program->text + visit.text);
}

static void find_used(const struct find *find, const struct program *plant)
{
	for (uint32_t i = 0; i < plant->bits_count; i++)
		drive(find, (enum iec_area)plant->bits[i].area, plant->bits[i].first,
		      plant->bits[i].count);
	stores_each(plant, drive_store, (void *)find);
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
		const uint32_t bytes = least(here->bytes[in], there->bytes[out]);

		for (uint32_t b = 0; b < bytes; b++)
			to[b] = (uint8_t)((to[b] & ~mask[b]) | (from[b] & mask[b]));
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
