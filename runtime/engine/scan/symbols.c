/* SPDX-License-Identifier: MIT
 *
 * symbols - from a name to a location, and steps through all variables.
 *
 * Used between scans, to show, record or set variables.
 */
#include "engine/base/name.h"
#include "engine/scan/symbol_index.h"

#include "engine/base/ascii.h"

#include <stdio.h>
#include <string.h>

/* ---- VAR_ACCESS ---- */

bool image_as_access(struct declared_name *symbol)
{
	static const struct {
		char word[12];
		uint32_t flags;
	} kind[] = {
		{ "READ_ONLY ", SYMBOL_EXPORTED },
		{ "READ_WRITE ", SYMBOL_EXPORTED | SYMBOL_WRITABLE },
	};

	for (int i = 0; symbol->flags & SYMBOL_HIDDEN && i < 2; i++) {
		const size_t len = strlen(kind[i].word);

		if (strncmp(symbol->name, kind[i].word, len) != 0)
			continue;
		symbol->name += len;
		symbol->array.head -= len;
		symbol->flags = kind[i].flags;
		return true;
	}
	return false;
}

bool image_next_access(const struct program *p, struct declared_cursor *cursor,
		       struct declared_name *out)
{
	cursor->memories = true;
	while (image_next_declared(p, cursor, out))
		if (image_as_access(out))
			return true;
	return false;
}

/* Whether a symbol has a name that a person may write: memories of edges have none. */
static bool has_name(struct declared_name *symbol)
{
	return image_as_access(symbol) || !(symbol->flags & SYMBOL_HIDDEN) ||
	       !strchr(symbol->name, ' ');
}

/* The next of all symbols that a person may name. */
static bool next_named(const struct program *p, struct declared_cursor *cursor,
		       struct declared_name *out)
{
	cursor->memories = true;
	while (image_next_declared(p, cursor, out))
		if (has_name(out))
			return true;
	return false;
}

/* ---- names ---- */

static void skip_blanks(const char **at, const char *end)
{
	while (*at < end && **at == ' ')
		(*at)++;
}

/* Reads `[3]` behind the name of an array; false: no such element. */
static bool parse_index(const struct declared_name *array, const char *text,
			size_t len, uint32_t *number)
{
	const char *at = text, *end = text + len, *digits;
	bool negative;
	int64_t index = 0;

	skip_blanks(&at, end);
	if (at == end || *at++ != '[')
		return false;
	skip_blanks(&at, end);
	negative = at < end && *at == '-';
	digits = at += negative;
	for (; at < end && ascii_digit(*at) && at - digits < 12; at++)
		index = index * 10 + (*at - '0');
	if (at == digits)
		return false;
	skip_blanks(&at, end);
	if (end - at != 1 || *at != ']')
		return false;
	index = (negative ? -index : index) - array->array.low;
	*number = (uint32_t)index;
	return index >= 0 && index < array->array.count;
}

/* The FB of a symbol that is an instance. */
static const struct word_row *instance_row(const struct program *p,
					   const struct declared_name *symbol)
{
	return word_row(code_instance(p, symbol->at.where));
}

static struct location pin_location(const struct declared_name *symbol,
				    const struct word_pin *pin)
{
	struct location at = {
		.type = pin->type, .where = symbol->at.where + pin->offset,
	};
	return at;
}

/* The location if @text spells @symbol or a pin of it. */
static struct location match(const struct program *p,
			     const struct declared_name *symbol,
			     const char *text, size_t len)
{
	struct location none = { .type = IEC_NONE };
	const struct word_row *row;
	size_t own = name_head(symbol->name, symbol->array.head, text, len);
	uint32_t number;
	int pin;

	if (own == 0)
		return none;
	if (symbol->array.count)
		return parse_index(symbol, text + own, len - own, &number) ?
		       declared_element(symbol, number) : none;
	if (symbol->at.type != IEC_NONE)
		return len == own ? symbol->at : none;
	if (len <= own + 1 || text[own] != '.')
		return none;
	row = instance_row(p, symbol);
	pin = word_pin_find(row, text + own + 1, len - own - 1);
	return pin < 0 ? none : pin_location(symbol, &row->pin[pin]);
}

/* Likewise, perhaps with the name of its program in front. */
static struct location match_whole(const struct program *p,
				   const struct declared_name *symbol,
				   const char *text, size_t len)
{
	struct location at = match(p, symbol, text, len);
	size_t skip = name_head(symbol->pou, strlen(symbol->pou), text, len);

	if (at.type == IEC_NONE && skip && len > skip + 1 && text[skip] == '.')
		at = match(p, symbol, text + skip + 1, len - skip - 1);
	return at;
}

/* If several match, the one that was declared first. */
static struct location find_declared(const struct program *p, const char *text,
				     size_t len)
{
	struct symbol_search search = { .text = text, .len = len, .all.memories = true };
	struct location first = { .type = IEC_NONE }, at;
	uint32_t number = UINT32_MAX;
	struct declared_name symbol;

	while (symbol_search_next(p, &search, &symbol)) {
		if (search.number >= number || !has_name(&symbol))
			continue;
		at = match_whole(p, &symbol, text, len);
		if (at.type == IEC_NONE)
			continue;
		first = at;
		number = search.number;
	}
	return first;
}

/* Whether @text is this name, perhaps with its program's in front. */
static bool is_named(const struct declared_name *symbol, const char *text, size_t len)
{
	size_t skip = name_head(symbol->pou, strlen(symbol->pou), text, len);
	size_t own = symbol->array.head;

	if (skip && len > skip + 1 && text[skip] == '.' &&
	    name_same(symbol->name, own, text + skip + 1, len - skip - 1))
		return true;
	return name_same(symbol->name, own, text, len);
}

bool image_find_array(const struct image *image, const char *name, size_t len,
		      struct declared_name *out)
{
	struct declared_cursor cursor = { 0 };

	while (next_named(image->program, &cursor, out))
		if (out->array.count && is_named(out, name, len))
			return true;
	return false;
}

/* The rest of a symbol's name behind `Head[3]`, or NULL; @index gets the 3. */
static bool is_member(const struct declared_name *symbol, const char *head, size_t len,
		      int64_t *index)
{
	size_t skip = name_head(symbol->pou, strlen(symbol->pou), head, len);
	const char *at;
	bool negative;

	if (skip && len > skip && head[skip] == '.') {
		head += skip + 1;
		len -= skip + 1;
	}
	at = symbol->name + name_head(head, len, symbol->name, strlen(symbol->name));
	if (at == symbol->name || *at++ != '[')
		return false;
	negative = *at == '-';
	at += negative;
	for (*index = 0; ascii_digit(*at) && *index <= INT32_MAX / 10; at++)
		*index = *index * 10 + (*at - '0');
	if (negative)
		*index = -*index;
	return *at == ']';
}

static struct location find_member(const struct image *image, const char *head,
				   size_t len, const char *tail, size_t tail_len,
				   int64_t index)
{
	char text[2 * LIMIT_NAME + 64];
	int size = snprintf(text, sizeof(text), "%.*s[%d]%.*s", (int)len, head,
			    (int)index, (int)tail_len, tail);

	if (size < 0 || (size_t)size >= sizeof(text))
		return (struct location){ .type = IEC_NONE };
	return image_find(image, text, (size_t)size);
}

bool image_find_members(const struct image *image, const char *head, size_t len,
			const char *tail, size_t tail_len, struct declared_name *out)
{
	struct declared_cursor cursor = { 0 };
	struct declared_name symbol;
	int64_t low = 0, high = 0, index;
	bool found = false;

	while (next_named(image->program, &cursor, &symbol)) {
		if (!is_member(&symbol, head, len, &index))
			continue;
		low = !found || index < low ? index : low;
		high = !found || index > high ? index : high;
		found = true;
	}
	if (!found)
		return false;
	*out = (struct declared_name){
		.name = "", .pou = "", .array.low = (int32_t)low,
		.array.count = (uint32_t)(high - low) + 1,
		.at = find_member(image, head, len, tail, tail_len, low),
	};
	out->stride = find_member(image, head, len, tail, tail_len, low + 1).where -
		      out->at.where;
	/* The names of an image are not verified: the last element must exist. Elements
	 * that are texts are all checked, as each has its own length. */
	for (index = out->at.type == IEC_STRING ? low : high; index <= high; index++) {
		struct location at = find_member(image, head, len, tail, tail_len,
						 index);

		if (at.type != out->at.type || at.area != out->at.area ||
		    at.where != out->at.where + (uint64_t)(index - low) * out->stride)
			return false;
	}
	return out->at.type != IEC_NONE;
}

/* Has the type of the pin's row: a DATE, not just 64 bits. */
static bool find_system(const struct image *image, const char *text, size_t len,
			struct location *at)
{
	struct iec_addr addr;

	for (int i = 0; i < SYS_COUNT; i++) {
		const struct sys_row *row = sys_row((enum sys_id)i);

		if (!ascii_is(row->name, text, len))
			continue;
		iec_addr_parse(row->address, strlen(row->address), &addr);
		*at = image_locate(image, addr);
		at->type = row->type;
		return true;
	}
	return false;
}

/* What no part of a number is. */
static struct location find_whole(const struct image *image, const char *name, size_t len)
{
	struct location at = find_declared(image->program, name, len);
	struct iec_addr addr;

	if (at.type != IEC_NONE)
		return at;
	if (!find_system(image, name, len, &at) &&
	    iec_addr_parse(name, len, &addr) == ADDR_OK)
		return image_locate(image, addr);
	return at;
}

/* Bits of a size letter, of the digits alone 1; 0: it is none. @at moves behind it. */
static uint32_t part_size(const char **at, const char *end)
{
	static const char letters[] = "XBWDL";
	const char *letter;

	if (*at < end && ascii_digit(**at))
		return 1;
	if (end - *at < 3 || **at != '%')
		return 0;
	letter = strchr(letters, ascii_upper((*at)[1]));
	*at += 2;
	return !letter || !*letter ? 0 : letter == letters ? 1 : 4u << (letter - letters);
}

/* `Word.3`, `Table[2].%B1` */
static struct location find_part(const struct image *image, const char *name, size_t len)
{
	struct location part = { .type = IEC_NONE }, at;
	const char *end = name + len, *tail = end;
	uint32_t bits, number = 0;

	while (tail > name && tail[-1] != '.')
		tail--;
	if (tail - name < 2)
		return part;
	len = (size_t)(tail - name) - 1;
	bits = part_size(&tail, end);
	for (; tail < end && ascii_digit(*tail) && number < 100; tail++)
		number = number * 10 + (uint32_t)(*tail - '0');
	if (!bits || tail < end)
		return part;
	at = find_whole(image, name, len);
	if (at.area != AREA_NONE || !(iec_type_row(at.type)->class & (ANY_INT | CLASS_BITS)) ||
	    bits * (number + 1) > 8u * iec_type_row(at.type)->size)
		return part;
	at.number = (uint8_t)at.type;
	at.first = (uint8_t)(bits * number);
	at.constant = true;
	at.type = bits == 1 ? IEC_BOOL : bits == 8 ? IEC_BYTE : bits == 16 ? IEC_WORD :
		  bits == 32 ? IEC_DWORD : IEC_LWORD;
	return at;
}

struct location image_find(const struct image *image, const char *name,
			   size_t len)
{
	const struct location at = find_whole(image, name, len);

	return at.type == IEC_NONE ? find_part(image, name, len) : at;
}

/* A local is shown without its POU unless another symbol has the same name. */
static void print_name(const struct declared_name *symbol, const char *pin,
		       struct symbol_cursor *cursor)
{
	bool pou = *symbol->pou &&
		   (cursor->whole || symbol->flags & SYMBOL_SHARED);
	int own = symbol->array.head < LIMIT_NAME ? (int)symbol->array.head
						  : LIMIT_NAME;

	snprintf(cursor->text, sizeof(cursor->text), "%.255s%s%.*s%s%.40s",
		 pou ? symbol->pou : "", pou ? "." : "", own, symbol->name,
		 pin ? "." : "", pin ? pin : "");
}

/* The next element of the array at @cursor; false: no more. */
static bool next_element(const struct declared_name *array,
			 struct symbol_cursor *cursor, struct symbol *out)
{
	size_t used;

	if (cursor->pin >= array->array.count)
		return false;
	print_name(array, NULL, cursor);
	used = strlen(cursor->text);
	snprintf(cursor->text + used, sizeof(cursor->text) - used, "[%d]",
		 (int)(array->array.low + (int64_t)cursor->pin));
	out->at = declared_element(array, cursor->pin++);
	return true;
}

/* The next pin of the instance at @cursor; false: no more. */
static bool next_pin(const struct program *p, const struct declared_name *whole,
		     struct symbol_cursor *cursor, struct symbol *out)
{
	const struct word_row *row = instance_row(p, whole);
	const struct word_pin *pin;

	while (cursor->pin < row->pin_count && !cursor->whole &&
	       row->pin[cursor->pin].dir == PIN_VAR)
		cursor->pin++;
	if (cursor->pin >= row->pin_count)
		return false;
	pin = &row->pin[cursor->pin++];
	out->at = pin_location(whole, pin);
	out->is_input = pin->dir == PIN_IN;
	out->block = row->word;
	out->elements = pin->elements;
	print_name(whole, pin->name, cursor);
	return true;
}

static bool next_of(const struct program *p, bool access, struct declared_cursor *cursor,
		    struct declared_name *out)
{
	return access ? image_next_access(p, cursor, out) : image_next_declared(p, cursor, out);
}

bool image_next_symbol(const struct image *image, struct symbol_cursor *cursor,
		       struct symbol *out)
{
	const struct program *p = image->program;
	struct declared_cursor next = cursor->declared;
	struct declared_name symbol;

	for (; next_of(p, cursor->access, &next, &symbol); cursor->declared = next) {
		*out = (struct symbol){
			.name = cursor->text, .flags = symbol.flags,
			.at = symbol.at,
		};
		if (symbol.array.count || symbol.at.type == IEC_NONE) {
			if (symbol.array.count ?
			    next_element(&symbol, cursor, out) :
			    next_pin(p, &symbol, cursor, out))
				return true;
			cursor->pin = 0;
			continue;
		}
		print_name(&symbol, NULL, cursor);
		cursor->declared = next;
		return true;
	}
	return false;
}
