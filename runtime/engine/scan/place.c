/* SPDX-License-Identifier: MIT
 *
 * place - from a word to a location, checked against the layout of the program.
 */
#include "engine/scan/place.h"

/* Is there a value of this type in the areas? All bytes belong to one area. */
static bool is_in_area(const struct areas *areas, uint32_t offset, uint32_t size)
{
	const enum iec_area area = areas_find(areas, offset);

	return area != AREA_NONE && size <= areas->bytes[area] &&
	       offset - areas->at[area] <= areas->bytes[area] - size;
}

/* An array in an instance has only its first element here. */
static bool is_pin(const struct word_row *row, uint32_t offset, enum iec_type type)
{
	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &word_pins(row)[i];

		if (pin->type == type && pin->offset == offset)
			return true;
	}
	return false;
}

/* @inside: offset from the start of the run. */
static bool is_in_run(const struct code_run *run, uint32_t inside, enum iec_type type)
{
	const uint32_t size = code_run_size(run);

	if (inside / size >= run->count)
		return false;
	if (run->kind == RUN_INSTANCE)
		return is_pin(word_row((enum word)run->word), inside % size, type);
	return run->type == type && inside % size == 0;
}

static struct location locate_bit(const struct areas *areas, uint32_t bit)
{
	struct location at = { .type = IEC_BOOL, .area = areas_find(areas, bit / 8) };

	if (at.area == AREA_NONE)
		at.type = IEC_NONE;
	else
		at.where = bit - areas->at[at.area] * 8;
	return at;
}

struct location place_locate(const struct program *program, uint32_t word)
{
	const enum iec_type type = (enum iec_type)(CODE_TYPE(word) & SYMBOL_TYPE);
	const uint32_t offset = CODE_OFFSET(word);
	struct location at = { .type = type, .where = offset };
	const struct code_run *run;

	if (type <= IEC_NONE || type >= IEC_TYPE_COUNT || CODE_TYPE(word) & ~(uint32_t)
	    (SYMBOL_TYPE | SYMBOL_BIT))
		return (struct location){ .type = IEC_NONE };
	if (CODE_TYPE(word) & SYMBOL_BIT)
		return type == IEC_BOOL ? locate_bit(&program->areas, offset) :
					  (struct location){ .type = IEC_NONE };
	if (offset < program->areas.size) {
		if (type == IEC_BOOL || type == IEC_STRING ||
		    !is_in_area(&program->areas, offset, iec_type_row(type)->size))
			at.type = IEC_NONE;
		return at;
	}
	run = code_run_at(program, offset);
	if (!run || !is_in_run(run, offset - run->offset, type))
		at.type = IEC_NONE;
	else
		at.constant = run->kind == RUN_CONSTANTS;
	return at;
}

uint32_t place_size(const struct program *program, struct location at)
{
	const struct code_run *run;

	if (at.type != IEC_STRING || at.area != AREA_NONE)
		return at.area != AREA_NONE ? 1 : iec_type_row(at.type)->size;
	run = code_run_at(program, at.where);
	if (run && run->kind != RUN_INSTANCE)
		return code_run_size(run);
	/* Inside an instance its room is not known here; memory ends behind it. */
	return program->header->data_size - at.where < iec_type_size(IEC_STRING, IEC_STRING_MOST) ?
		       program->header->data_size - at.where :
		       iec_type_size(IEC_STRING, IEC_STRING_MOST);
}

uint32_t place_byte(const struct program *program, struct location at)
{
	uint32_t slot;

	if (at.area == AREA_NONE)
		return at.where;
	slot = code_bits_find(program->bits, program->bits_count, at.area, at.where);
	return slot ? slot : program->areas.at[at.area] + at.where / 8;
}

void place_address(const struct program *program, struct location at, char *out, size_t size)
{
	const struct areas *areas = &program->areas;
	struct iec_addr addr = { .area = at.area };

	out[0] = '\0';
	if (at.area != AREA_NONE) {
		addr.bits = 1;
		addr.byte = at.where / 8;
		addr.bit = at.where % 8;
	} else if (at.type != IEC_STRING && at.where < areas->size) {
		addr.area = areas_find(areas, at.where);
		addr.bits = (uint8_t)(8 * iec_type_row(at.type)->size);
		addr.byte = at.where - areas->at[addr.area];
	}
	if (addr.area != AREA_NONE)
		iec_addr_print(addr, out, size);
}
