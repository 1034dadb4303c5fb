/* SPDX-License-Identifier: MIT
 *
 * layout_constant - constants, one place a value, and initial values.
 */
#include "engine/translate/assembler.h"

#include <stddef.h>
#include <string.h>

/* A place for a text of @capacity bytes. */
static uint32_t layout_string(struct assembler *as, enum code_run_kind kind,
			   uint32_t capacity)
{
	struct code_run run = { .kind = (uint8_t)kind, .type = IEC_STRING,
				.word = (uint16_t)capacity, .count = 1 };

	return layout_place(as, run, iec_type_size(IEC_STRING, capacity),
		     (uint32_t)sizeof(struct iec_string));
}

/* Values next to one another share a record: offset, bytes, data. */
void layout_init_over(struct assembler *as, uint32_t offset, enum iec_type type,
		      union iec_value value)
{
	uint32_t size = iec_type_row(type)->size, used;
	struct words *init = &as->init;
	uint8_t bytes[8];
	int at = as->init_last;

	iec_store(bytes, type, value);
	if (init->count == 0 || as->init_end != init->count ||
	    init->word[at] + init->word[at + 1] != offset) {
		at = init->count;
		words_push(as, init, offset);
		words_push(as, init, 0);
	}
	if (as->failed)
		return;
	used = init->word[at + 1];
	for (uint32_t i = used; i < used + size; i++) {
		if (i % 4 == 0)
			words_push(as, init, 0);
		if (!as->failed)
			((uint8_t *)&init->word[at + 2])[i] = bytes[i - used];
	}
	if (as->failed)
		return;
	init->word[at + 1] = used + size;
	as->init_last = at;
	as->init_end = init->count;
}

void layout_init(struct assembler *as, uint32_t offset, enum iec_type type,
		 union iec_value value)
{
	uint32_t bytes[2] = { 0, 0 };

	iec_store(bytes, type, value);
	if (bytes[0] || bytes[1])
		layout_init_over(as, offset, type, value);
}

void layout_init_pins(struct assembler *as, uint32_t offset,
		      const struct word_row *row)
{
	for (int i = 0; i < row->pin_count; i++)
		if (row->pin[i].has_init)
			layout_init(as, offset + row->pin[i].offset,
				    row->pin[i].type, pin_init(&row->pin[i]));
}

/* A text's first bytes, whole words as long as its room. */
void layout_init_text(struct assembler *as, uint32_t offset, uint32_t capacity,
		      struct literal literal)
{
	char text[IEC_STRING_MOST];
	size_t len = literal_string(&literal, text);
	uint32_t word[(sizeof(struct iec_string) + IEC_STRING_MOST + 3) / 4] = { 0 };
	const struct iec_string head = {
		.capacity = (uint16_t)capacity, .length = (uint16_t)(len < capacity ? len : capacity),
	};
	uint32_t size = iec_type_size(IEC_STRING, capacity);

	memcpy(word, &head, sizeof(head));
	memcpy((char *)word + offsetof(struct iec_string, text), text, head.length);
	words_push(as, &as->init, offset);
	words_push(as, &as->init, size);
	for (uint32_t i = 0; i < size / 4; i++)
		words_push(as, &as->init, word[i]);
}

static void init_texts(struct assembler *as, uint32_t offset,
		       const struct var *var, const struct var_init *init)
{
	const struct names *names = &as->translation->project->names;
	struct literal literal;

	if (!init->text)
		return;
	literal_parse(names_text(names, init->text), names_len(names, init->text),
		      &literal);
	for (uint32_t i = 0; i < init->count; i++)
		layout_init_text(as, offset + i * var_unit(var), var->capacity,
				 literal);
}

/* One value so many times, unless it is 0. */
static void init_values(struct assembler *as, uint32_t offset, enum iec_type type,
			const struct var_init *init)
{
	uint32_t size = iec_type_row(type)->size, bytes[2] = { 0, 0 };
	int first = as->init.count + 2;
	uint8_t *values;

	iec_store(bytes, type, init->value);
	if (!bytes[0] && !bytes[1])
		return;
	words_push(as, &as->init, offset);
	words_push(as, &as->init, init->count * size);
	for (uint32_t i = 0; i < (init->count * size + 3) / 4; i++)
		words_push(as, &as->init, 0);
	if (as->failed)
		return;
	values = (uint8_t *)&as->init.word[first];
	for (uint32_t i = 0; i < init->count; i++)
		memcpy(values + i * size, bytes, size);
}

void layout_init_array(struct assembler *as, uint32_t offset,
		       const struct var *var)
{
	for (int i = 0; i < var->init_count && !as->failed; i++) {
		const struct var_init *init = &var->init_list[i];

		if (var->type == IEC_STRING)
			init_texts(as, offset, var, init);
		else
			init_values(as, offset, var->type, init);
		offset += init->count * var_unit(var);
	}
}

void layout_init_parts(struct assembler *as, uint32_t offset, const struct var *var)
{
	struct init_value value;

	if (!as->walk)
		as->walk = arena_alloc(as->arena, sizeof(*as->walk));
	if (!as->walk) {
		as->failed = true;
		return;
	}
	init_begin(as->walk, as->translation->project, var, NULL);
	while (!as->failed && init_next(as->walk, &value))
		if (value.type == IEC_STRING)
			layout_init_text(as, offset + value.offset,
					 value.capacity, value.literal);
		else
			layout_init_over(as, offset + value.offset, value.type,
					 value.value);
}

uint32_t layout_text(struct assembler *as, const struct literal *literal)
{
	char text[IEC_STRING_MOST];
	size_t len = literal_string(literal, text);
	struct text_key *key;

	for (int i = 0; i < as->text_count; i++)
		if (as->text_key[i].len == len &&
		    memcmp(as->text_key[i].text, text, len) == 0)
			return as->text_key[i].offset;
	key = arena_push(as->arena, &as->text_key, &as->text_count, sizeof(*key));
	if (!key) {
		as->failed = true;
		return as->areas->size;
	}
	*key = (struct text_key){
		.text = arena_copy(as->arena, text, len), .len = len,
		.offset = layout_string(as, RUN_CONSTANTS, len ? (uint32_t)len : 1),
	};
	layout_init_text(as, key->offset, len ? (uint32_t)len : 1, *literal);
	return key->offset;
}

static uint32_t constant_hash(enum iec_type type, int64_t bits)
{
	uint64_t hash = ((uint64_t)bits ^ (uint64_t)type << 56) *
			0x9e3779b97f4a7c15u;

	return (uint32_t)(hash >> 32);
}

static bool grow_constants(struct assembler *as)
{
	uint32_t size = as->constant_mask ? (as->constant_mask + 1) * 2 : 64;
	uint32_t *table = arena_alloc(as->arena, size * sizeof(*table));

	if (!table)
		return false;
	as->constant = table;
	as->constant_mask = size - 1;
	for (int i = 0; i < as->constant_count; i++) {
		const struct constant_key *key = &as->constant_key[i];
		uint32_t at = constant_hash(key->type, key->bits);

		while (table[at & as->constant_mask])
			at++;
		table[at & as->constant_mask] = (uint32_t)i + 1;
	}
	return true;
}

uint32_t layout_constant(struct assembler *as, enum iec_type type,
			 union iec_value value)
{
	const struct areas *areas = as->areas;
	uint32_t at;
	struct constant_key *key;

	if (type == IEC_BOOL)
		return value.i ? CODE_TRUE_AT(areas) : CODE_FALSE_AT(areas);
	if ((uint32_t)as->constant_count * 2 >= as->constant_mask &&
	    !grow_constants(as)) {
		as->failed = true;
		return areas->size;
	}
	at = constant_hash(type, value.i);
	for (; as->constant[at & as->constant_mask]; at++) {
		key = &as->constant_key[as->constant[at & as->constant_mask] - 1];
		if (key->type == type && key->bits == value.i)
			return key->offset;
	}
	key = arena_push(as->arena, &as->constant_key, &as->constant_count,
			 sizeof(*key));
	if (!key) {
		as->failed = true;
		return areas->size;
	}
	as->constant[at & as->constant_mask] = (uint32_t)as->constant_count;
	*key = (struct constant_key){ type, value.i,
		layout_tail(as, RUN_CONSTANTS, type) };
	layout_init(as, key->offset, type, value);
	return key->offset;
}
