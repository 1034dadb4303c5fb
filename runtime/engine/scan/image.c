/* SPDX-License-Identifier: MIT
 *
 * image - areas, bits that live a byte each, forces. Names are in symbols.c.
 */
#include "engine/scan/interrupt.h"

#include <string.h>

/* Loads may read 8 bytes from the last value on. */
#define IMAGE_TAIL 8

size_t image_memory_size(const struct program *program)
{
	return (size_t)program->header->data_size + IMAGE_TAIL + interrupt_bytes(program);
}

/* Somebody outside of the program writes a value. */
static inline void note_change(struct image *image)
{
	if (HAS_STILL)
		image->changed = true;
}

static void load_init(struct image *image)
{
	const struct code_header *header = image->program->header;
	const struct code_section *at = &header->section[CODE_INIT];
	const uint8_t *base = image->program->base + at->offset;
	const uint32_t *word = (const void *)base;
	const uint32_t *end = word + at->size / 4;

	while (word < end) {
		memcpy(image->memory + word[0], word + 2, word[1]);
		word += 2 + (word[1] + 3) / 4;
	}
}

static void bound_text(uint8_t *at, uint16_t room)
{
	struct iec_string *text = (void *)at;

	text->capacity = room;
	if (text->length > room)
		text->length = room;
}

static void bound_instances(uint8_t *memory, const struct code_run *run)
{
	const struct word_row *row = word_row((enum word)run->word);
	const struct word_pin *pin = word_pins(row);

	for (int i = 0; i < row->pin_count; i++)
		for (uint32_t k = 0; pin[i].type == IEC_STRING && k < run->count; k++)
			bound_text(memory + run->offset + k * row->size + pin[i].offset,
				   WORD_TEXT);
}

/* The room of a text is set from the layout, whatever its initial bytes say. */
static void bound_texts(struct image *image)
{
	const struct program *program = image->program;

	for (uint32_t i = 0; i < program->run_count; i++) {
		const struct code_run *run = &program->run[i];
		uint32_t size = code_run_size(run);

		if (run->kind == RUN_INSTANCE)
			bound_instances(image->memory, run);
		for (uint32_t k = 0; run->kind != RUN_INSTANCE &&
				     run->type == IEC_STRING && k < run->count; k++)
			bound_text(image->memory + run->offset + k * size, run->word);
	}
}

/* Bits with an initial value start in their own bytes; the areas must agree. */
static void pack_all(struct image *image)
{
	const struct program *program = image->program;

	for (uint32_t i = 0; i < program->bits_count; i++) {
		const struct code_bits *bits = &program->bits[i];

		for (uint32_t k = 0; k < bits->count; k++)
			image_set_bit(image, (enum iec_area)bits->area,
				      bits->first + k,
				      image->memory[bits->slot + k]);
	}
}

void image_init(struct image *image, const struct program *program, void *memory)
{
	const struct areas *areas = &program->areas;

	image->memory = memory;
	image->program = program;
	image->force_count = 0;
	note_change(image);
	memset(memory, 0, image_memory_size(program));
	load_init(image);
	bound_texts(image);
	image->memory[CODE_FALSE_AT(areas)] = 0;
	image->memory[CODE_TRUE_AT(areas)] = 1;
	pack_all(image);
}

uint8_t *image_area(struct image *image, enum iec_area area)
{
	return image->memory + image->program->areas.at[area];
}

/* The memory of one bit of an area: its own byte, or NULL when it is packed. */
static uint8_t *bit_slot(const struct image *image, enum iec_area area,
			 uint32_t bit)
{
	uint32_t slot = code_bits_find(image->program->bits,
				       image->program->bits_count, area, bit);

	return slot ? image->memory + slot : NULL;
}

static bool inside(const struct image *image, enum iec_area area, uint32_t bit)
{
	return area > AREA_NONE && area < AREA_COUNT &&
	       bit / 8 < image->program->areas.bytes[area];
}

static void set_packed(uint8_t *byte, uint32_t bit, bool value)
{
	*byte = (uint8_t)((*byte & ~(1u << bit)) | (uint32_t)value << bit);
}

bool image_get_bit(const struct image *image, enum iec_area area, uint32_t bit)
{
	const uint8_t *slot;

	if (!inside(image, area, bit))
		return false;
	slot = bit_slot(image, area, bit);
	if (slot)
		return *slot;
	return image->memory[image->program->areas.at[area] + bit / 8] >> bit % 8 & 1;
}

bool image_set_bit(struct image *image, enum iec_area area, uint32_t bit,
		   bool value)
{
	uint8_t *slot;

	if (!inside(image, area, bit))
		return false;
	note_change(image);
	slot = bit_slot(image, area, bit);
	if (slot)
		*slot = value;
	set_packed(image_area(image, area) + bit / 8, bit % 8, value);
	return true;
}

/* Unpacks eight bits that all have their own byte: the common case, without a loop. Bit
 * k of @byte goes to byte k. */
static void unpack8(uint8_t *slot, uint8_t byte)
{
	uint64_t spread = ((uint64_t)byte * 0x0101010101010101u) &
			  0x8040201008040201u;

	spread = (((spread + 0x7f7f7f7f7f7f7f7fu) | spread) >> 7) &
		 0x0101010101010101u;
	memcpy(slot, &spread, 8);
}

static uint8_t pack8(const uint8_t *slot)
{
	uint64_t spread;

	memcpy(&spread, slot, 8);
	return (uint8_t)((spread * 0x0102040810204080u) >> 56);
}

static void unpack(uint8_t *slot, const uint8_t *area, const struct code_bits *bits)
{
	uint32_t bit = bits->first, end = bit + bits->count;

	while (bit < end) {
		if (bit % 8 == 0 && end - bit >= 8) {
			unpack8(slot, area[bit / 8]);
			slot += 8;
			bit += 8;
		} else {
			*slot++ = area[bit / 8] >> bit % 8 & 1;
			bit++;
		}
	}
}

static void pack(const uint8_t *slot, uint8_t *area, const struct code_bits *bits)
{
	uint32_t bit = bits->first, end = bit + bits->count;

	while (bit < end) {
		if (bit % 8 == 0 && end - bit >= 8) {
			area[bit / 8] = pack8(slot);
			slot += 8;
			bit += 8;
		} else {
			set_packed(&area[bit / 8], bit % 8, *slot++);
			bit++;
		}
	}
}

#ifndef RUNGBOARD_SMALL
void image_unpack(struct image *image, const struct code_bits *bits)
{
	unpack(image->memory + bits->slot, image_area(image, (enum iec_area)bits->area), bits);
}

void image_pack(struct image *image, const struct code_bits *bits)
{
	pack(image->memory + bits->slot, image_area(image, (enum iec_area)bits->area), bits);
}
#endif

/* Applies forces at both edges. A value written since the last edge is kept aside,
 * unless it equals the forced value: then perhaps nothing was written. */
static void hold(struct image *image)
{
	for (int i = 0; i < image->force_count; i++) {
		struct force *force = &image->force[i];
		union iec_value written = image_get(image, force->at);

		if (written.i != force->value.i)
			force->aside = written;
		image_set(image, force->at, force->value);
	}
}

/* Areas that only the program writes need no unpacking: no driver writes their bytes,
 * and image_set_bit() writes both copies. */
void image_begin(struct image *image)
{
	const struct program *program = image->program;

	for (uint32_t i = 0; i < program->bits_count; i++) {
		const struct code_bits *bits = &program->bits[i];
		uint8_t *area = image->memory + program->areas.at[bits->area];

		if (iec_area_row((enum iec_area)bits->area)->access == ACCESS_READ)
			unpack(image->memory + bits->slot, area, bits);
	}
	hold(image);
}

void image_end(struct image *image)
{
	const struct program *program = image->program;

	for (uint32_t i = 0; i < program->bits_count; i++) {
		const struct code_bits *bits = &program->bits[i];
		uint8_t *area = image->memory + program->areas.at[bits->area];

		if (iec_area_row((enum iec_area)bits->area)->access == ACCESS_WRITE)
			pack(image->memory + bits->slot, area, bits);
	}
	hold(image);
}

/* The bits of a part of @number. */
static union iec_value part_of(union iec_value number, struct location at)
{
	const uint32_t bits = at.type == IEC_BOOL ? 1 : 8u * iec_type_row(at.type)->size;

	return (union iec_value){ .i = (int64_t)((uint64_t)number.i >> at.first &
						 ((UINT64_C(2) << (bits - 1)) - 1)) };
}

union iec_value image_get(const struct image *image, struct location at)
{
	union iec_value value = { .i = 0 };

	if (at.type == IEC_NONE)
		return value;
	if (LOCATION_IS_PART(at))
		return part_of(iec_load(image->memory + at.where, (enum iec_type)at.number), at);
	if (at.area == AREA_NONE) {
		value = iec_load(image->memory + at.where, at.type);
		if (at.type == IEC_BOOL) /* of a union, which may hold another byte */
			value.i = value.i != 0;
		return value;
	}
	value.i = image_get_bit(image, at.area, at.where);
	return value;
}

/* A byte or word was written: updates the bits in it that have their own byte. */
static void spread(struct image *image, uint32_t where, uint32_t size)
{
	const struct areas *areas = &image->program->areas;
	enum iec_area area = areas_find(areas, where);
	uint32_t first = (where - areas->at[area]) * 8;

	for (uint32_t bit = first; bit < first + size * 8; bit++) {
		uint8_t *slot = bit_slot(image, area, bit);

		if (slot)
			*slot = image->memory[areas->at[area] + bit / 8] >>
				bit % 8 & 1;
	}
}

bool image_set(struct image *image, struct location at, union iec_value value)
{
	if (at.type == IEC_NONE || at.constant)
		return false;
	if (at.area != AREA_NONE)
		return image_set_bit(image, at.area, at.where, value.i != 0);
	note_change(image);
	if (at.type == IEC_BOOL)
		value.i = value.i != 0;
	iec_store(image->memory + at.where, at.type, value);
	if (at.where < image->program->areas.size)
		spread(image, at.where, iec_type_row(at.type)->size);
	return true;
}

static struct force *find_force(const struct image *image, struct location at)
{
	for (int i = 0; i < image->force_count; i++) {
		const struct force *force = &image->force[i];

		if (force->at.area == at.area && force->at.where == at.where &&
		    force->at.type == at.type)
			return (struct force *)force;
	}
	return NULL;
}

bool image_force(struct image *image, struct location at, union iec_value value)
{
	struct force *force = find_force(image, at);

	/* A STRING cannot be forced: there is no room to keep its value aside. */
	if (at.type == IEC_NONE || at.type == IEC_STRING || at.constant)
		return false;
	if (!force) {
		if (image->force_count == LIMIT_FORCES)
			return false;
		force = &image->force[image->force_count++];
		force->at = at;
		force->aside = image_get(image, at);
	}
	/* Rounded or cut to its type. */
	image_set(image, at, value);
	force->value = image_get(image, at);
	return true;
}

bool image_unforce(struct image *image, struct location at)
{
	struct force *force = find_force(image, at);

	if (!force)
		return false;
	image_set(image, at, force->aside);
	*force = image->force[--image->force_count];
	return true;
}

bool image_is_forced(const struct image *image, struct location at)
{
	return find_force(image, at) != NULL;
}

struct location image_locate(const struct image *image, struct iec_addr addr)
{
	struct location at = { .type = iec_addr_type(addr) };
	const struct areas *areas = &image->program->areas;

	if (!areas_have(areas, addr))
		at.type = IEC_NONE;
	else if (addr.bits == 1) {
		at.area = addr.area;
		at.where = addr.byte * 8 + addr.bit;
	} else {
		at.where = areas_byte(areas, addr);
	}
	return at;
}
