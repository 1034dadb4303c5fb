/* SPDX-License-Identifier: MIT
 *
 * retain_plan - finds the retained variables of a program and their names.
 *
 * Runs when a program is loaded.
 */
#include "engine/base/name.h"
#include "engine/scan/retain.h"


#include <stdio.h>
#include <string.h>

#define TYPE_TEXT 128 /* "TON.TIME", "FIFO.DINT[64]" */
#define TEXT_ALIGN 4u /* of a STRING in memory, and so in a copy */

/* A program may not retain a byte or word of an area that it cannot write. */
static bool can_be_kept(const struct areas *areas, struct location at)
{
	enum iec_area area = at.area;

	if (area == AREA_NONE)
		area = areas_find(areas, at.where);
	return area == AREA_NONE || iec_area_row(area)->access == ACCESS_WRITE;
}

/* Room of the text at @where in the data layout; 0: none is there. */
static uint32_t text_room(const struct program *program, uint32_t where)
{
	uint32_t low = 0, high = program->run_count;

	while (low < high) {
		uint32_t middle = low + (high - low) / 2;

		if (program->run[middle].offset > where)
			high = middle;
		else
			low = middle + 1;
	}
	if (low == 0 || program->run[low - 1].kind == RUN_INSTANCE ||
	    program->run[low - 1].type != IEC_STRING)
		return 0;
	return program->run[low - 1].word;
}

static uint32_t elements_of(const struct symbol *symbol)
{
	return symbol->elements ? symbol->elements : 1;
}

#ifdef RUNGBOARD_SMALL
#define is_byte(...) false
#define is_pointer(...) false
#else
/* A BOOL of a union, where the byte may be another number: the other members keep it. */
static bool is_byte(const struct program *program, const struct symbol *symbol)
{
	const struct code_run *run = symbol->at.area == AREA_NONE && symbol->at.type == IEC_BOOL ?
				     code_run_at(program, symbol->at.where) : NULL;

	return run && run->type != IEC_BOOL && run->kind != RUN_INSTANCE;
}

/* After a restart with another program it would lead elsewhere. */
static bool is_pointer(const struct program *program, const struct symbol *symbol)
{
	return symbol->at.area == AREA_NONE && code_is_pointer(program, symbol->at.where);
}
#endif

/* Bytes of the value; 0: it cannot be retained. */
static uint32_t value_size(const struct program *program,
			   const struct symbol *symbol)
{
	uint32_t room;

	if (is_byte(program, symbol) || is_pointer(program, symbol))
		return 0;
	if (symbol->at.type != IEC_STRING)
		return iec_type_row(symbol->at.type)->size * elements_of(symbol);
	room = text_room(program, symbol->at.where);
	return room ? iec_type_size(IEC_STRING, room) : 0;
}

static bool next_kept(const struct image *image, struct symbol_cursor *cursor,
		      struct symbol *out)
{
	while (image_next_symbol(image, cursor, out))
		if (out->flags & SYMBOL_RETAIN && !out->at.constant &&
		    value_size(image->program, out) &&
		    can_be_kept(&image->program->areas, out->at))
			return true;
	return false;
}

static uint32_t type_text(const struct symbol *symbol, char *out)
{
	char many[16] = "";
	const char *part[4] = { symbol->block, ".",
				iec_type_row(symbol->at.type)->word, many };
	uint32_t len = 0;

	if (symbol->elements)
		snprintf(many, sizeof(many), "[%u]", (unsigned)symbol->elements);
	for (int i = symbol->block ? 0 : 2; i < 4; i++) {
		size_t size = strlen(part[i]);

		if (size > TYPE_TEXT - len)
			size = TYPE_TEXT - len;
		memcpy(out + len, part[i], size);
		len += (uint32_t)size;
	}
	return len;
}

/* All sizes, before memory is allocated. */
static void measure(struct retain *retain, const struct image *image)
{
	struct symbol_cursor cursor = { .whole = true };
	struct symbol symbol;
	char type[TYPE_TEXT];
	uint64_t payload = RETAIN_HEAD;

	while (next_kept(image, &cursor, &symbol)) {
		uint32_t size = value_size(image->program, &symbol);

		payload += RETAIN_RECORD + strlen(symbol.name) +
			   type_text(&symbol, type) + size;
		retain->bytes += size;
		retain->count++;
	}
	retain->payload_size = payload > LIMIT_RETAIN ? LIMIT_RETAIN + 1 :
							(uint32_t)payload;
}

/* Puts each name into the index once; of equal names the first one. */
static void enter(struct retain *retain, int index)
{
	struct retain_record record = retain_record_of(retain, index);
	uint32_t at = name_hash(record.name, record.name_len);

	while (retain->hashed[at & retain->hash_mask])
		at++;
	retain->hashed[at & retain->hash_mask] = (uint32_t)index + 1;
}

/* The place of the value in a copy: in the block of retained data, as in memory, or
 * behind it. */
static void place_copy(struct retain *retain, struct retain_var *var)
{
	const struct code_header *header = retain->program->header;
	uint32_t from = var->at.where - header->retain_offset;

	if (var->at.area == AREA_NONE && var->at.where >= header->retain_offset &&
	    from < header->retain_size && from % TEXT_ALIGN == var->at.where %
	    TEXT_ALIGN && header->retain_size - from >= var->size) {
		var->kept = from;
		return;
	}
	var->kept = (retain->copy_size + TEXT_ALIGN - 1) / TEXT_ALIGN * TEXT_ALIGN;
	retain->copy_size = var->kept + var->size;
	retain->loose[retain->loose_count++] = (uint32_t)(var - retain->var);
}

static uint32_t write_record(uint8_t *record, const struct symbol *symbol,
			     uint32_t size)
{
	uint16_t name_len = (uint16_t)strlen(symbol->name);
	uint8_t *name = record + RETAIN_RECORD;
	uint32_t type_len = type_text(symbol, (char *)name + name_len);

	memcpy(name, symbol->name, name_len);
	memcpy(record, &name_len, sizeof(name_len));
	record[2] = (uint8_t)type_len;
	memcpy(record + 4, &size, sizeof(size));
	return RETAIN_RECORD + name_len + type_len;
}

static void fill(struct retain *retain, const struct image *image)
{
	struct symbol_cursor cursor = { .whole = true };
	struct symbol symbol;
	uint8_t *payload = retain->slot + sizeof(struct retain_slot);
	uint32_t at = RETAIN_HEAD, count = (uint32_t)retain->count;

	memcpy(payload + 8, &count, sizeof(count));
	for (int i = 0; next_kept(image, &cursor, &symbol); i++) {
		struct retain_var *var = &retain->var[i];

		var->at = symbol.at;
		var->elements = elements_of(&symbol);
		var->size = value_size(image->program, &symbol);
		var->record = at;
		var->value = at + write_record(payload + at, &symbol, var->size);
		at = var->value + var->size;
		place_copy(retain, var);
		enter(retain, i);
	}
}

bool retain_plan(struct retain *retain, const struct image *image,
		 struct arena *arena)
{
	size_t count;

	memset(retain, 0, sizeof(*retain));
	retain->program = image->program;
	retain->copy_size = image->program->header->retain_size;
	measure(retain, image);
	if (retain->payload_size > LIMIT_RETAIN)
		return false;
	count = (size_t)retain->count;
	retain->hash_mask = 7;
	while (retain->hash_mask < count * 2)
		retain->hash_mask = retain->hash_mask * 2 + 1;
	retain->var = arena_alloc(arena, count * sizeof(*retain->var));
	retain->loose = arena_alloc(arena, count * sizeof(*retain->loose));
	retain->taken = arena_alloc(arena, count * sizeof(*retain->taken));
	retain->hashed = arena_alloc(arena, (retain->hash_mask + 1u) *
				     sizeof(*retain->hashed));
	retain->slot = arena_alloc(arena, retain_room(retain->payload_size));
	if (!retain->var || !retain->loose || !retain->taken ||
	    !retain->hashed || !retain->slot)
		return false;
	fill(retain, image);
	return true;
}

struct retain_record retain_record_of(const struct retain *retain, int index)
{
	const uint8_t *payload = retain->slot + sizeof(struct retain_slot);
	struct retain_record record = { .name = NULL };
	uint32_t at = retain->var[index].record;

	retain_next(payload, retain->payload_size, &at, &record);
	return record;
}

bool retain_start(struct resource *resource)
{
	struct arena arena;
	struct retain retain;
	uint8_t *copy = NULL;

	arena_init(&arena);
	if (retain_plan(&retain, &resource->image, &arena))
		copy = arena_alloc(&arena, retain.copy_size);
	if (copy) {
		retain_copy(&retain, &resource->image, copy);
		resource_start(resource);
		retain_put(&retain, &resource->image, copy);
		resource->warm = true;
	}
	arena_free(&arena);
	return copy;
}

static bool is_same(const char *a, uint32_t a_len, const char *b, uint32_t b_len)
{
	return name_same(a, a_len, b, b_len);
}

/* The room of the variable may differ from the room when the text was stored. A text
 * that no longer fits is dropped, not cut. */
static bool take_text(const struct retain_var *var,
		      const struct retain_record *record, uint8_t *copy)
{
	struct iec_string *text = (void *)(copy + var->kept);
	uint32_t room = var->size - (uint32_t)sizeof(*text);
	uint16_t length;

	if (record->size < sizeof(*text))
		return false;
	memcpy(&length, record->value + offsetof(struct iec_string, length),
	       sizeof(length));
	if (length > record->size - sizeof(*text) || length > text->capacity ||
	    length > room)
		return false;
	memset(text->text, 0, room);
	memcpy(text->text, record->value + sizeof(*text), length);
	text->length = length;
	return true;
}

static bool take_value(const struct retain_var *var,
		       const struct retain_record *record, uint8_t *copy)
{
	if (var->at.type == IEC_STRING)
		return take_text(var, record, copy);
	if (var->size != record->size)
		return false;
	memcpy(copy + var->kept, record->value, var->size);
	return true;
}

enum retain_fate retain_take(struct retain *retain,
			     const struct retain_record *record, uint8_t *copy)
{
	uint32_t at = name_hash(record->name, record->name_len), found;
	enum retain_fate fate = RETAIN_NO_NAME;

	retain->met = 0;
	for (; (found = retain->hashed[at & retain->hash_mask]) != 0; at++) {
		const struct retain_var *var = &retain->var[found - 1];
		struct retain_record own = retain_record_of(retain,
							    (int)found - 1);

		if (!is_same(own.name, own.name_len, record->name,
			     record->name_len))
			continue;
		fate = RETAIN_NO_TYPE;
		retain->met = found;
		if (is_same(own.type, own.type_len, record->type,
			    record->type_len) &&
		    take_value(var, record, copy)) {
			retain->taken[found - 1] = true;
			return RETAIN_KEPT;
		}
	}
	return fate;
}
