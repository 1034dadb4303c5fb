/* SPDX-License-Identifier: MIT
 *
 * words - the rows of a project beside those of the catalogue.
 *
 * It keeps and finds rows; readers of declarations fill them.
 */
#include "engine/model/words.h"
#include "engine/base/name.h"
#include "engine/base/ascii.h"
#include "engine/base/catalog.h"
#include "engine/base/limits.h"
#include "engine/model/convert.h"

#include <stdio.h>
#include <string.h>

void words_init(struct word_table *table, struct arena *arena)
{
	*table = (struct word_table){ .arena = arena };
}

/* The slot of a name, or the free one where it belongs. */
static uint16_t *slot_of(const struct word_table *table, const char *text,
			 size_t len)
{
	uint32_t at = name_hash(text, len) & table->mask;

	while (table->slot[at] &&
	       !name_is(table->row[table->slot[at] - 1]->word, text, len))
		at = (at + 1) & table->mask;
	return &table->slot[at];
}

static bool grow(struct word_table *table)
{
	uint32_t size = table->slot ? (table->mask + 1) * 2 : 16;
	uint16_t *slot = arena_alloc(table->arena, size * sizeof(*slot));

	if (!slot)
		return false;
	table->slot = slot;
	table->mask = size - 1;
	for (int i = 0; i < table->count; i++) {
		const char *name = table->row[i]->word;
		uint16_t *at = slot_of(table, name, strlen(name));

		if (!*at)
			*at = (uint16_t)(i + 1);
	}
	return true;
}

enum word words_add(struct word_table *table, struct word_row row)
{
	struct word_row *copy, **place;
	uint16_t *slot;

	if (table->count >= LIMIT_OWN_WORDS ||
	    ((uint32_t)table->count * 2 >= table->mask && !grow(table)))
		return WORD_COUNT;
	copy = arena_alloc(table->arena, sizeof(*copy));
	if (!copy)
		return WORD_COUNT;
	*copy = row;
	copy->number = WORD_COUNT;
	place = arena_push(table->arena, &table->row, &table->count,
			   sizeof(*place));
	if (!place)
		return WORD_COUNT;
	*place = copy;
	slot = slot_of(table, row.word, strlen(row.word));
	if (!*slot)
		*slot = (uint16_t)table->count;
	return (enum word)(WORD_FIRST_OWN + table->count - 1);
}

struct word_row *words_own(const struct word_table *table, enum word word)
{
	int index = (int)word - (int)WORD_FIRST_OWN;

	return index >= 0 && index < table->count ? table->row[index] : NULL;
}

const struct word_row *words_row(const struct word_table *table, enum word word)
{
	const struct word_row *own = words_own(table, word);
	int made = (int)word - (int)WORD_FIRST_MADE;

	if (made >= 0 && made < table->made_count)
		return table->made[made];
	return own ? own : word_row(word);
}

/* Made at the first use. */
static enum word find_made(struct word_table *table, const char *text, size_t len)
{
	struct convert_word probe, *kept;
	struct word_row **place;
	int i = 0;

	if (!convert_make(text, len, &probe))
		return WORD_COUNT;
	while (i < table->made_count && strcmp(table->made[i]->word, probe.row.word))
		i++;
	if (i < table->made_count)
		return (enum word)(WORD_FIRST_MADE + i);
	kept = arena_alloc(table->arena, sizeof(*kept));
	place = arena_push(table->arena, &table->made, &table->made_count,
			   sizeof(*place));
	if (!kept || !place || !convert_make(text, len, kept))
		return WORD_COUNT;
	*place = &kept->row;
	return (enum word)(WORD_FIRST_MADE + i);
}

enum word words_conversion(struct word_table *table, enum iec_type from, enum iec_type to)
{
	char text[2 * LIMIT_NAME];
	const int len = snprintf(text, sizeof(text), "%s_TO_%s", iec_type_row(from)->word,
				 iec_type_row(to)->word);

	return find_made(table, text, (size_t)len);
}

enum word words_find_short(const char *text, size_t len)
{
	const struct word_row *row;
	enum iec_type type;
	enum word word;
	size_t head = len;

	while (head > 0 && text[head - 1] != '_')
		head--;
	if (head < 2)
		return WORD_COUNT;
	type = iec_type_find(text + head, len - head);
	word = word_find(text, head - 1);
	row = word_row(word);
	if (type == IEC_NONE || word == WORD_COUNT || row->kind != WORD_FB)
		return WORD_COUNT;
	for (int i = 0; i < row->pin_count; i++)
		if (row->pin[i].dir == PIN_IN && row->pin[i].type != IEC_BOOL)
			return row->pin[i].type == type ? word : WORD_COUNT;
	return WORD_COUNT;
}

/* ADD_LTOD_LTIME is ADD_TOD_TIME: the types with L are those without. Other functions have two names. */
static enum word find_long(const char *text, size_t len)
{
	static const struct { const char *name; enum word word; } other[] = {
		{ "MUL_TIME", FN_MULTIME }, { "DIV_TIME", FN_DIVTIME }, { "FROM_BIG_ENDIAN", FN_BIG_ENDIAN_TO },
		{ "FROM_LITTLE_ENDIAN", FN_LITTLE_ENDIAN_TO },
	};
	static const char *const types[] = { "TIME", "TOD", "DATE", "DT" };
	char out[LIMIT_NAME];
	size_t used = 0;

	for (size_t i = 0; i < len && len < sizeof(out); i++) {
		bool is_long = false;

		for (size_t k = 0; k < sizeof(types) / sizeof(*types) && i && text[i - 1] == '_'; k++)
			is_long |= ascii_upper(text[i]) == 'L' && len - i > strlen(types[k]) &&
				   ascii_same(text + i + 1, types[k], strlen(types[k]));
		if (!is_long)
			out[used++] = text[i];
	}
	for (size_t i = 0; i < sizeof(other) / sizeof(*other); i++)
		if (ascii_is(other[i].name, out, used))
			return other[i].word;
	return used < len && used ? word_find(out, used) : WORD_COUNT;
}

const char *words_number(const char *text, size_t len)
{
	static const char *const pairs[][2] = {
		{ "DWORD_TO_REAL", "UDINT_TO_REAL" }, { "REAL_TO_DWORD", "REAL_TO_UDINT" },
		{ "LWORD_TO_LREAL", "ULINT_TO_LREAL" }, { "LREAL_TO_LWORD", "LREAL_TO_ULINT" },
	};

	for (size_t i = 0; i < sizeof(pairs) / sizeof(*pairs); i++)
		if (ascii_is(pairs[i][0], text, len))
			return pairs[i][1];
	return NULL;
}

static bool is_space(const struct word_table *table, const char *name, size_t len)
{
	for (int i = 0; i < table->space_count; i++)
		if (table->space[i].len == len && name_is(table->space[i].name, name, len))
			return true;
	return false;
}

bool words_space(struct word_table *table, const char *name, size_t len)
{
	struct word_space *space;

	if (is_space(table, name, len))
		return true;
	space = arena_push(table->arena, &table->space, &table->space_count, sizeof(*space));
	if (space)
		*space = (struct word_space){ name, len };
	return space != NULL;
}

const char *words_result(const struct word_row *row)
{
	return row->kind == WORD_FN && row->number == WORD_COUNT && word_pin_find(row, "OUT", 3) >= 0 ? row->word : "OUT";
}

bool words_strip(const struct word_table *table, const char **text, size_t *len)
{
	const char *dot;
	bool found = false;

	while (table->space_count && (dot = memchr(*text, '.', *len)) && dot + 1 < *text + *len &&
	       is_space(table, *text, (size_t)(dot - *text))) {
		*len -= (size_t)(dot + 1 - *text);
		*text = dot + 1;
		found = true;
	}
	return found;
}

static enum word find(struct word_table *table, const char *text, size_t len)
{
	const char *number = table->as_numbers ? words_number(text, len) : NULL;
	enum word word = word_find(text, len);
	uint16_t found = 0;

	if ((word != WORD_COUNT && !table->own_first) || !len)
		return word;
	if (table->count)
		found = *slot_of(table, text, len);
	if (found)
		return (enum word)(WORD_FIRST_OWN + found - 1);
	if (word != WORD_COUNT)
		return word;
	word = words_find_short(text, len);
	if (word == WORD_COUNT)
		word = number ? find_made(table, number, strlen(number)) : find_made(table, text, len);
	return word != WORD_COUNT ? word : find_long(text, len);
}

enum word words_find(struct word_table *table, const char *text, size_t len)
{
	words_strip(table, &text, &len);
	return find(table, text, len);
}

bool words_is_operator(const char *name, size_t len)
{
	const enum word word = word_find(name, len);

	return word != WORD_COUNT && word_row(word)->kind != WORD_FN && word_row(word)->kind != WORD_FB;
}

enum word words_find_type(struct word_table *table, const char *text, size_t len)
{
	uint16_t found = 0;

	words_strip(table, &text, &len);
	if (table->count && words_is_operator(text, len))
		found = *slot_of(table, text, len);
	return found ? (enum word)(WORD_FIRST_OWN + found - 1) : find(table, text, len);
}

const char *words_explain(const struct word_row *row)
{
	/* A made row has the number of its catalogue row, but is another struct; it
	 * begins a struct convert_word. */
	if (row->number < WORD_COUNT && row != word_row(row->number))
		return ((const struct convert_word *)row)->doc ?
		       ((const struct convert_word *)row)->doc : explain_word(word_row(row->number));
	return explain_word(row);
}

bool words_is_taken(const char *name)
{
	size_t len = strlen(name);

	if (word_find(name, len) != WORD_COUNT)
		return true;
	if (len > 1 && ascii_upper(name[len - 1]) == 'N')
		len--;
	if (len > 1 && op_find(name, len) == OP_COUNT &&
	    ascii_upper(name[len - 1]) == 'C')
		len--;
	return op_find(name, len) != OP_COUNT;
}
