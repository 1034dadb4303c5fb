/* SPDX-License-Identifier: MIT
 *
 * iec - the types, areas and direct addresses of IEC 61131-3.
 *
 * The part that a scan needs: it uses only the memory functions of libc, so that the
 * smallest target links it. iec_print.c prints values.
 */
#include "engine/base/iec.h"
#include "engine/base/ascii.h"
#include "engine/base/limits.h"

#include <string.h>

/* Values lie in memory as the program image has them: little-endian. */
_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
	       "a big-endian target needs iec_load and iec_store to swap");

static const struct iec_type_row types[IEC_TYPE_COUNT] = {
	[IEC_NONE] = { "", 0, 0, 0, 0 },
#define TYPE(id, ctype, size, class, low, high) \
	[IEC_##id] = { #id, size, class, low, high },
#define TEXT_TYPE(id, class) \
	[IEC_##id] = { #id, sizeof(struct iec_string), class, 0, 0 },
#include "engine/catalog.def"
};

/* Other names of types in IEC 61131-3. */
static const struct { const char *word; enum iec_type type; } alias[] = {
	{ "TOD", IEC_TIME_OF_DAY }, { "DT", IEC_DATE_AND_TIME },
	{ "LTIME", IEC_TIME }, { "LTOD", IEC_TIME_OF_DAY },
	{ "LTIME_OF_DAY", IEC_TIME_OF_DAY }, { "LDATE", IEC_DATE },
	{ "LDT", IEC_DATE_AND_TIME }, { "LDATE_AND_TIME", IEC_DATE_AND_TIME },
};

static const struct iec_area_row areas[AREA_COUNT] = {
	[AREA_NONE] = { "", 0, 0, 0, ACCESS_READ },
#define AREA(id, letters, least, usual, most, access, doc) \
	[AREA_##id] = { letters, least, usual, most, access },
#include "engine/catalog.def"
};

const struct iec_type_row *iec_type_row(enum iec_type type)
{
	return &types[type < IEC_TYPE_COUNT ? type : IEC_NONE];
}

enum iec_type iec_type_find(const char *word, size_t len)
{
	for (int i = IEC_NONE + 1; i < IEC_TYPE_COUNT; i++)
		if (ascii_is(types[i].word, word, len))
			return (enum iec_type)i;
	for (size_t i = 0; i < sizeof(alias) / sizeof(*alias); i++)
		if (ascii_is(alias[i].word, word, len))
			return alias[i].type;
	return IEC_NONE;
}

bool iec_is_wide(enum iec_type type)
{
	return type == IEC_LWORD || type == IEC_ULINT;
}

uint32_t iec_type_size(enum iec_type type, uint32_t capacity)
{
	uint32_t size = iec_type_row(type)->size;

	return type == IEC_STRING ? size + (capacity + 3) / 4 * 4 : size;
}

bool iec_can_widen(enum iec_type from, enum iec_type to)
{
	const struct iec_type_row *a = iec_type_row(from);
	const struct iec_type_row *b = iec_type_row(to);

	if (from == to)
		return true;
	if (a->class == 0)
		return false;
	if (b->class == CLASS_REAL)
		return a->class == CLASS_REAL ? a->size < b->size :
		       (a->class & ANY_INT) && a->size * 2 <= b->size;
	if (a->size >= b->size)
		return false;
	if (a->class == CLASS_BITS || a->class == CLASS_SIGNED)
		return b->class == a->class;
	return a->class == CLASS_UNSIGNED && (b->class & ANY_INT);
}

const struct iec_area_row *iec_area_row(enum iec_area area)
{
	return &areas[area < AREA_COUNT ? area : AREA_NONE];
}

bool iec_area_is_io(enum iec_area area)
{
	return area > AREA_NONE && area < AREA_COUNT && area != AREA_M && area != AREA_V &&
	       area != AREA_S && area != AREA_SM;
}

/* The rest of an address text. */
struct rest {
	const char *at, *end;
};

/* The area whose letters are the longest that match. */
static enum iec_area take_area(struct rest *rest)
{
	size_t left = (size_t)(rest->end - rest->at), best = 0;
	enum iec_area found = AREA_NONE;

	for (int i = AREA_NONE + 1; i < AREA_COUNT; i++) {
		size_t len = ascii_prefix(areas[i].letters, rest->at, left);

		if (len > best) {
			best = len;
			found = (enum iec_area)i;
		}
	}
	rest->at += best;
	return found;
}

/* Reads digits. A number too large for any area is clamped to one that is still too
 * large. False: no digits. */
static bool take_number(struct rest *rest, uint32_t *out)
{
	const char *start = rest->at;
	uint32_t number = 0;

	for (; rest->at != rest->end && ascii_digit(*rest->at); rest->at++)
		if (number < LIMIT_AREAS * 8)
			number = number * 10 + (uint32_t)(*rest->at - '0');
	*out = number;
	return rest->at != start;
}

/* Bits of a size letter; 0: there is none. */
static uint8_t take_size(struct rest *rest)
{
	static const char letters[] = "XBWDL";
	static const uint8_t bits[] = { 1, 8, 16, 32, 64 };

	if (rest->at == rest->end)
		return 0;
	for (size_t i = 0; i < sizeof(bits); i++)
		if (ascii_upper(*rest->at) == letters[i]) {
			rest->at++;
			return bits[i];
		}
	return 0;
}

static enum iec_addr_result check_range(struct iec_addr addr, uint32_t bit)
{
	uint32_t size = areas[addr.area].most;
	uint32_t need = addr.bits == 1 ? 1 : addr.bits / 8u;

	if (bit > 7)
		return ADDR_RANGE;
	return addr.byte < size && need <= size - addr.byte ? ADDR_OK :
							      ADDR_RANGE;
}

/* Analog areas (AI, AQ, XAI, XAQ) hold words. */
static bool is_analog(enum iec_area area)
{
	for (const char *at = areas[area].letters; *at; at++)
		if (*at == 'A')
			return true;
	return false;
}

/* AI3 is the fourth word, I3 is bit 3. */
static void place_short(struct iec_addr *addr, uint32_t number, uint32_t *bit)
{
	if (is_analog(addr->area)) {
		addr->bits = 16;
		addr->byte = number * 2;
	} else {
		addr->bits = 1;
		addr->byte = number / 8;
		*bit = number % 8;
	}
}

enum iec_addr_result iec_addr_parse(const char *text, size_t len,
				    struct iec_addr *out)
{
	struct rest rest = { text, text + len };
	bool percent = len > 1 && text[0] == '%';
	struct iec_addr addr = { 0 };
	uint32_t number, bit = 0;
	bool dot = false;

	rest.at += percent;
	*out = addr;
	if (len == 0)
		return ADDR_NONE;
	addr.area = take_area(&rest);
	addr.bits = take_size(&rest);
	if (addr.area == AREA_NONE || (addr.bits == 64 && !percent) ||
	    !take_number(&rest, &number))
		return ADDR_NONE;
	if (rest.at != rest.end && *rest.at == '.') {
		rest.at++;
		dot = true;
		if (!take_number(&rest, &bit))
			return ADDR_NONE;
	}
	if (rest.at != rest.end)
		return ADDR_NONE;
	addr.byte = number;
	if (dot && bit >= (addr.bits > 1 ? addr.bits : 8))
		return ADDR_RANGE;
	if (dot) {
		addr.byte += bit / 8; /* MW4.11 is bit 3 of byte 5 */
		bit %= 8;
		addr.bits = 1;
	} else if (addr.bits == 1) {
		addr.byte = number / 8;
		bit = number % 8;
	} else if (addr.bits == 0)
		place_short(&addr, number, &bit);
	addr.bit = (uint8_t)(bit & 7);
	if (check_range(addr, bit) != ADDR_OK)
		return ADDR_RANGE;
	*out = addr;
	return ADDR_OK;
}

/* Appends the digits of @value; returns the end. */
static char *put_number(char *at, uint32_t value)
{
	char digit[10];
	int count = 0;

	do
		digit[count++] = (char)('0' + value % 10);
	while (value /= 10);
	while (count > 0)
		*at++ = digit[--count];
	return at;
}

enum diag_id iec_addr_fault(const char *text, size_t len, struct iec_addr *out)
{
	struct rest rest = { text, text + len };
	uint32_t number, bit = 0;
	uint8_t bits;

	switch (iec_addr_parse(text, len, out)) {
	case ADDR_OK:
		return DIAG_COUNT;
	case ADDR_NONE:
		return DIAG_NOT_ADDRESS;
	case ADDR_RANGE:
		break;
	}
	rest.at += *text == '%';
	take_area(&rest);
	bits = take_size(&rest);
	take_number(&rest, &number);
	if (rest.at++ != rest.end) /* the dot */
		take_number(&rest, &bit);
	return bit >= (bits > 8 ? bits : 8) ? DIAG_BAD_BIT : DIAG_BAD_ADDRESS;
}

/* Not snprintf: a load prints an address for each declared line, and this is faster. */
int iec_addr_print(struct iec_addr addr, char *out, size_t size)
{
	const char *letters = iec_area_row(addr.area)->letters;
	char width = addr.bits == 8 ? 'B' : addr.bits == 16 ? 'W' :
		     addr.bits == 32 ? 'D' : 'L';

	char text[32], *at = text;
	size_t len;

	if (addr.area != AREA_NONE) {
		*at++ = '%';
		while (*letters)
			*at++ = *letters++;
		*at++ = addr.bits == 1 ? 'X' : width;
		at = put_number(at, addr.byte);
	}
	if (addr.area != AREA_NONE && addr.bits == 1) {
		*at++ = '.';
		*at++ = (char)('0' + addr.bit);
	}
	len = (size_t)(at - text);
	if (size > 0) {
		size_t fits = len < size ? len : size - 1;

		memcpy(out, text, fits);
		out[fits] = '\0';
	}
	return (int)len;
}

enum iec_type iec_addr_type(struct iec_addr addr)
{
	if (addr.area == AREA_NONE)
		return IEC_NONE;
	switch (addr.bits) {
	case 1:
		return IEC_BOOL;
	case 8:
		return IEC_BYTE;
	case 16:
		return IEC_WORD;
	case 32:
		return IEC_DWORD;
	case 64:
		return IEC_LWORD;
	default:
		return IEC_NONE;
	}
}

/* One case a row of catalog.def; `class` is a constant in each. */
union iec_value iec_load(const void *memory, enum iec_type type)
{
	union iec_value value = { .i = 0 };

	switch (type) {
#define TYPE(id, ctype, size, class, low, high) \
	case IEC_##id: { \
		ctype raw; \
		memcpy(&raw, memory, sizeof(raw)); \
		if ((class) == CLASS_REAL) \
			value.r = (double)raw; \
		else \
			value.i = (int64_t)raw; \
		break; \
	}
#include "engine/catalog.def"
	case IEC_STRING:
		value.s = memory;
		break;
	case IEC_NONE:
	case IEC_TYPE_COUNT:
		break;
	}
	return value;
}

struct iec_string *iec_text_init(struct iec_text *room, uint16_t length)
{
	struct iec_string *text = (void *)room->word;

	text->capacity = IEC_STRING_MOST;
	text->length = length;
	return text;
}

/* Copies as much of a text as fits; the two may be the same. */
static void store_string(struct iec_string *to, const struct iec_string *from)
{
	uint16_t len = from->length < to->capacity ? from->length : to->capacity;

	memmove(to->text, from->text, len);
	to->length = len;
}

void iec_store(void *memory, enum iec_type type, union iec_value value)
{
	switch (type) {
#define TYPE(id, ctype, size, class, low, high) \
	case IEC_##id: { \
		ctype raw = (class) == CLASS_REAL ? (ctype)value.r : \
			    (class) == CLASS_BOOL ? (ctype)(value.i & 1) : \
						    (ctype)value.i; \
		memcpy(memory, &raw, sizeof(raw)); \
		break; \
	}
#include "engine/catalog.def"
	case IEC_STRING:
		store_string(memory, value.s);
		break;
	case IEC_NONE:
	case IEC_TYPE_COUNT:
		break;
	}
}
