/* SPDX-License-Identifier: MIT
 *
 * place - resolves, reads and writes operands. frame.c finds variables.
 *
 * Direct addresses are in plain byte arrays, so that overlaps work. Linear searches:
 * the programs are small.
 */
#include "tests/walker/inside.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* The bytes between the quotes. */
void placed_take_text(struct value *value, const struct literal *literal)
{
	char bytes[IEC_STRING_MOST];
	int len = (int)literal_string(literal, bytes);

	value->len = len < value->room ? len : value->room;
	memcpy(value->text, bytes, (size_t)value->len);
}

struct placed placed_at(struct walker *walker, struct iec_addr addr,
				enum iec_type type)
{
	uint32_t bits = walker->areas.bytes[addr.area] * 8;

	return (struct placed){
		.kind = PLACED_AREA, .type = type,
		.byte = walker->area[addr.area] + addr.byte, .bit = addr.bit,
		.rest = (bits - addr.byte * 8 - addr.bit) / addr.bits,
	};
}

static struct placed of_system(struct walker *walker, const char *text,
			       size_t len)
{
	struct iec_addr addr;

	for (int i = 0; i < SYS_COUNT; i++) {
		const struct sys_row *row = sys_row((enum sys_id)i);

		if (strlen(row->name) == len &&
		    strncasecmp(row->name, text, len) == 0 &&
		    iec_addr_parse(row->address, strlen(row->address),
				   &addr) == ADDR_OK)
			return placed_at(walker, addr, row->type);
	}
	return (struct placed){ .kind = PLACED_NOWHERE };
}

struct placed placed_index(struct walker *walker, const struct frame *frame,
			   struct placed array, const char *at, const char *end)
{
	struct placed none = { .kind = PLACED_NOWHERE }, index, out;

	while (*at == ' ')
		at++;
	while (end > at && end[-1] == ' ')
		end--;
	index = walker_place(walker, frame, at, (size_t)(end - at));
	if (index.kind == PLACED_NOWHERE || array.kind == PLACED_NOWHERE)
		return none;
	if (!array.count)
		array.count = array.rest;
	if (index.kind == PLACED_LITERAL)
		return placed_element(&array, placed_read(&index, IEC_LINT).i,
				      &out) ? out : none;
	array.index = arena_alloc(&walker->arena, sizeof(index));
	if (!array.index)
		return none;
	*array.index = index;
	return array;
}

/* `.3`, `.%X3`, `.%B1` at the end of a text: how many bits, and the lowest of them. 0: none. */
static unsigned int part_at(const char *text, size_t len, size_t *head, unsigned int *first)
{
	static const char letter[] = "XBWD";
	static const unsigned int bits[] = { 1, 8, 16, 32 };
	size_t at = len;
	const char *found;
	unsigned int width = 1;

	while (at > 0 && text[at - 1] >= '0' && text[at - 1] <= '9')
		at--;
	if (at < 2 || at == len)
		return 0;
	*first = (unsigned int)strtoul(text + at, NULL, 10);
	found = at > 3 && text[at - 2] == '%' ? strchr(letter, text[at - 1]) : NULL;
	if (found) {
		width = bits[found - letter];
		at -= 2;
	} else if (*text == '%' && !memchr(text, '[', len)) {
		return 0; /* %MX0.1 is an address */
	}
	*head = at - 1;
	*first *= width;
	return text[at - 1] == '.' ? width : 0;
}

static struct placed part_place(struct walker *walker, const struct frame *frame,
				const char *text, size_t len)
{
	struct placed placed = { .kind = PLACED_NOWHERE }, number;
	size_t head;

	placed.width = part_at(text, len, &head, &placed.first);
	if (!placed.width)
		return placed;
	number = walker_place(walker, frame, text, head);
	placed.number = arena_alloc(&walker->arena, sizeof(number));
	placed.found = arena_alloc(&walker->arena, sizeof(number));
	if (!placed.number || !placed.found || number.kind == PLACED_LITERAL ||
	    number.kind == PLACED_NOWHERE ||
	    !(iec_type_row(number.type)->class & (ANY_INT | CLASS_BITS)))
		return placed;
	*placed.number = *placed.found = number;
	placed.index = number.index;
	placed.type = placed.width == 1 ? IEC_BOOL : placed.width == 8 ? IEC_BYTE :
		      placed.width == 16 ? IEC_WORD : IEC_DWORD;
	placed.kind = PLACED_PART;
	return placed;
}

static uint64_t part_mask(const struct placed *placed)
{
	return ((UINT64_C(1) << placed->width) - 1) << placed->first;
}

static struct value read_part(const struct placed *placed)
{
	const uint64_t all = (uint64_t)placed_read(placed->found, IEC_NONE).i;
	struct value value = { .type = placed->type };

	value.i = (int64_t)((all & part_mask(placed)) >> placed->first);
	return value;
}

static void write_part(const struct placed *placed, struct value value)
{
	const struct iec_type_row *row = iec_type_row(placed->found->type);
	struct value all = placed_read(placed->found, IEC_NONE);
	uint64_t bits = (uint64_t)all.i & ~part_mask(placed);

	bits |= (uint64_t)value.i << placed->first & part_mask(placed);
	if (row->size < 8)
		bits &= (UINT64_C(1) << 8 * row->size) - 1;
	if (row->low < 0 && row->size < 8 && bits >> (8 * row->size - 1))
		bits |= ~UINT64_C(0) << 8 * row->size;
	all.i = (int64_t)bits;
	placed_write(placed->found, all);
}

struct placed walker_place(struct walker *walker, const struct frame *frame,
			   const char *text, size_t len)
{
	struct placed placed = part_place(walker, frame, text, len);
	const char *open = memchr(text, '[', len);
	struct iec_addr addr;

	if (placed.kind != PLACED_NOWHERE)
		return placed;
	placed = frame_place(walker, frame, text, len);
	if (placed.kind != PLACED_NOWHERE)
		return placed;
	placed = of_system(walker, text, len);
	if (placed.kind != PLACED_NOWHERE)
		return placed;
	/* `%MX0.0[i]`: the address, and its index. */
	if (open && text[len - 1] == ']')
		return placed_index(walker, frame, walker_place(walker, frame, text,
				    (size_t)(open - text)), open + 1, text + len - 1);
	if (literal_parse(text, len, &placed.literal) == LITERAL_OK) {
		placed.kind = PLACED_LITERAL;
		placed.type = placed.literal.type;
	} else if (iec_addr_parse(text, len, &addr) == ADDR_OK &&
		   areas_have(&walker->areas, addr)) {
		return placed_at(walker, addr, iec_addr_type(addr));
	}
	return placed;
}

bool placed_element(const struct placed *array, int64_t index, struct placed *out)
{
	uint32_t number = (uint32_t)(index - array->low);
	uint32_t bit = array->bit + number;

	*out = *array;
	out->count = 0;
	out->index = NULL;
	if (index < array->low || index - array->low >= array->count)
		return false;
	if (array->choice)
		*out = array->choice[number];
	else if (array->kind == PLACED_VALUE)
		out->value += number;
	else if (array->type != IEC_BOOL)
		out->byte += number * iec_type_row(array->type)->size;
	else {
		out->byte += bit / 8;
		out->bit = bit % 8;
	}
	return true;
}

bool placed_find(struct walker *walker, const struct placed *placed,
		 struct placed *out)
{
	struct value index;

	*out = *placed;
	if (placed->kind == PLACED_PART) {
		out->index = NULL;
		return placed_find(walker, placed->number, placed->found);
	}
	if (!placed->index)
		return true;
	index = placed_read(placed->index, IEC_NONE);
	if (placed_element(placed, index.i, out))
		return true;
	walker->errors++;
	return false;
}

static struct value read_area(const struct placed *placed)
{
	const struct iec_type_row *row = iec_type_row(placed->type);
	struct value value = { .type = placed->type };
	uint64_t bits = 0;
	uint32_t word;

	if (placed->type == IEC_BOOL)
		return value_bool(*placed->byte >> placed->bit & 1);
	for (int i = 0; i < row->size; i++)
		bits |= (uint64_t)placed->byte[i] << 8 * i;
	if (placed->type == IEC_REAL) {
		word = (uint32_t)bits;
		memcpy(&value.r, &word, sizeof(word));
		return value;
	}
	if (placed->type == IEC_LREAL)
		memcpy(&value.d, &bits, sizeof(bits));
	if (row->low < 0 && row->size < 8 && bits >> (8 * row->size - 1))
		bits |= ~(uint64_t)0 << 8 * row->size;
	value.i = (int64_t)bits;
	return value;
}

static void write_area(const struct placed *placed, struct value value)
{
	uint64_t bits = (uint64_t)value.i;
	uint32_t word;

	if (placed->type == IEC_BOOL) {
		*placed->byte &= (uint8_t)~(1u << placed->bit);
		*placed->byte |= (uint8_t)(value_is_true(value) << placed->bit);
		return;
	}
	if (placed->type == IEC_REAL) {
		memcpy(&word, &value.r, sizeof(word));
		bits = word;
	}
	if (placed->type == IEC_LREAL)
		memcpy(&bits, &value.d, sizeof(bits));
	for (int i = 0; i < iec_type_row(placed->type)->size; i++)
		placed->byte[i] = (uint8_t)(bits >> 8 * i);
}

static struct value read_literal(const struct placed *placed,
				 enum iec_type type)
{
	struct value value = { .type = placed->type };
	union iec_value literal = { 0 };

	if (value.type == IEC_NONE)
		value.type = type;
	if (value.type == IEC_STRING) {
		value.room = sizeof(value.text);
		placed_take_text(&value, &placed->literal);
		return value;
	}
	literal_fit(&placed->literal, value.type, &literal);
	if (value.type == IEC_REAL)
		value.r = (float)literal.r;
	else if (value.type == IEC_LREAL)
		value.d = literal.r;
	else
		value.i = literal.i;
	return value;
}

struct value placed_read(const struct placed *placed, enum iec_type type)
{
	struct value value = { .type = type };

	switch (placed->kind) {
	case PLACED_VALUE:
		value = *placed->value;
		break;
	case PLACED_AREA:
		value = read_area(placed);
		break;
	case PLACED_LITERAL:
		value = read_literal(placed, type);
		break;
	case PLACED_PART:
		value = read_part(placed);
		break;
	case PLACED_NOWHERE:
		break;
	}
	return type == IEC_NONE ? value : value_widen(value, type);
}

void placed_write(const struct placed *placed, struct value value)
{
	value = value_widen(value, placed->type);
	if (value.type == IEC_STRING && placed->kind == PLACED_VALUE) {
		value.room = placed->value->room;
		if (value.len > value.room)
			value.len = value.room;
	}
	if (placed->kind == PLACED_VALUE)
		*placed->value = value;
	else if (placed->kind == PLACED_AREA)
		write_area(placed, value);
	else if (placed->kind == PLACED_PART)
		write_part(placed, value);
}
