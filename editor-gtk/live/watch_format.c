/* SPDX-License-Identifier: MIT
 *
 * watch_format - values of a status chart to text and back.
 */
#include "editor-gtk/live/watch_format.h"

#include "editor-gtk/kit/i18n.h"

#include "engine/trial/value.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static const struct { const char *word, *label; } row[WATCH_FORMATS] = {
	[WATCH_AUTO] = { "auto", N_("As its type") },
	[WATCH_BIN] = { "bin", N_("Binary") },
	[WATCH_HEX] = { "hex", N_("Hexadecimal") },
	[WATCH_SIGNED] = { "signed", N_("Signed") },
	[WATCH_UNSIGNED] = { "unsigned", N_("Unsigned") },
	[WATCH_FLOAT] = { "float", N_("Floating point") },
	[WATCH_TIME] = { "time", N_("Time") },
};

const char *watch_format_word(enum watch_format format)
{
	return row[format].word;
}

const char *watch_format_label(enum watch_format format)
{
	return row[format].label;
}

enum watch_format watch_format_find(const char *word, size_t len)
{
	for (int i = 0; i < WATCH_FORMATS; i++)
		if (strlen(row[i].word) == len && memcmp(row[i].word, word, len) == 0)
			return (enum watch_format)i;
	return WATCH_FORMATS;
}

static bool is_number(enum iec_type type)
{
	return iec_type_row(type)->class & (CLASS_BITS | ANY_INT);
}

bool watch_format_fits(enum watch_format format, enum iec_type type)
{
	const int size = iec_type_row(type)->size;

	switch (format) {
	case WATCH_AUTO: return true;
	case WATCH_BIN:
	case WATCH_HEX: return is_number(type) || iec_type_row(type)->class == CLASS_REAL;
	case WATCH_SIGNED:
	case WATCH_UNSIGNED: return is_number(type);
	case WATCH_FLOAT: return is_number(type) && size >= 4;
	case WATCH_TIME: return is_number(type) && size >= 2;
	case WATCH_FORMATS: break;
	}
	return false;
}

/* ---- bits ---- */

static int width_of(enum iec_type type)
{
	return 8 * iec_type_row(type)->size;
}

static uint64_t bits_of(enum iec_type type, union iec_value value)
{
	unsigned char memory[8] = { 0 };

	iec_store(memory, type, value);
	return (uint64_t)iec_load(memory, IEC_LWORD).i;
}

static union iec_value of_bits(enum iec_type type, uint64_t bits)
{
	unsigned char memory[8] = { 0 };

	iec_store(memory, IEC_LWORD, (union iec_value){ .i = (int64_t)bits });
	return iec_load(memory, type);
}

static int64_t sign_extended(uint64_t bits, int width)
{
	if (width < 64 && bits >> (width - 1))
		bits |= UINT64_MAX << width;
	return (int64_t)bits;
}

static enum iec_type real_of(enum iec_type type)
{
	return width_of(type) == 64 ? IEC_LREAL : IEC_REAL;
}

/* ---- to text ---- */

/* "2#0001_0010": a group for each digit that hexadecimal has. */
static int print_bin(uint64_t bits, int width, char *out, size_t size)
{
	char text[2 + 64 + 16];
	int len = 2;

	memcpy(text, "2#", 2);
	for (int bit = width - 1; bit >= 0; bit--) {
		text[len++] = (char)('0' + (bits >> bit & 1));
		if (bit % 4 == 0 && bit > 0)
			text[len++] = '_';
	}
	return snprintf(out, size, "%.*s", len, text);
}

static int print_auto(enum iec_type type, union iec_value value, char *out, size_t size)
{
	if (iec_type_row(type)->class == CLASS_TIME)
		return literal_print(type, value, out, size);
	return iec_value_print(type, value, out, size);
}

/* A number as so many ms; too many for ns stay a number. */
static int print_ms(enum iec_type type, union iec_value value, char *out, size_t size)
{
	const bool large = iec_is_wide(type) && value.i < 0;

	if (large || value.i > INT64_MAX / VALUE_MS || value.i < INT64_MIN / VALUE_MS)
		return print_auto(type, value, out, size);
	value.i *= VALUE_MS;
	return literal_print(IEC_TIME, value, out, size);
}

int watch_print(enum watch_format format, enum iec_type type, union iec_value value,
		char *out, size_t size)
{
	const int width = width_of(type);
	uint64_t bits;

	if (format == WATCH_AUTO || !watch_format_fits(format, type))
		return print_auto(type, value, out, size);
	bits = bits_of(type, value);
	switch (format) {
	case WATCH_BIN: return print_bin(bits, width, out, size);
	case WATCH_HEX:
		return snprintf(out, size, "16#%0*" PRIX64, width / 4, bits);
	case WATCH_SIGNED:
		return snprintf(out, size, "%" PRId64, sign_extended(bits, width));
	case WATCH_UNSIGNED: return snprintf(out, size, "%" PRIu64, bits);
	case WATCH_FLOAT:
		return iec_value_print(real_of(type), of_bits(real_of(type), bits), out,
				       size);
	case WATCH_TIME: return print_ms(type, value, out, size);
	case WATCH_AUTO:
	case WATCH_FORMATS: break;
	}
	return 0;
}

/* ---- from text ---- */

/* Any number of that width, of either sign. */
static bool parse_bits(const char *text, int width, uint64_t *bits, enum diag_id *why)
{
	struct literal literal;
	union iec_value value;
	const enum literal_result result = literal_parse(text, strlen(text), &literal);

	*why = result == LITERAL_RANGE ? DIAG_LITERAL_RANGE : DIAG_BAD_LITERAL;
	if (result != LITERAL_OK)
		return false;
	if (literal_fit(&literal, IEC_LWORD, &value)) {
		*bits = (uint64_t)value.i;
		*why = DIAG_LITERAL_RANGE;
		return width == 64 || *bits >> width == 0;
	}
	if (!literal_fit(&literal, IEC_LINT, &value))
		return false;
	*why = DIAG_LITERAL_RANGE;
	*bits = (uint64_t)value.i & (width == 64 ? UINT64_MAX : (UINT64_C(1) << width) - 1);
	return sign_extended(*bits, width) == value.i;
}

static bool parse_digits(const char *base, enum iec_type type, const char *text,
			 union iec_value *out, enum diag_id *why)
{
	char whole[IEC_VALUE_TEXT + 4];
	uint64_t bits;

	*why = DIAG_BAD_LITERAL;
	if (strlen(text) >= IEC_VALUE_TEXT)
		return false;
	snprintf(whole, sizeof(whole), "%s%s", strchr(text, '#') ? "" : base, text);
	if (!parse_bits(whole, width_of(type), &bits, why))
		return false;
	*out = of_bits(type, bits);
	return true;
}

static bool parse_time(enum iec_type type, const char *text, struct iec_text *room,
		       union iec_value *out, enum diag_id *why)
{
	int64_t ns;

	if (literal_parse_duration(text, strlen(text), &ns)) {
		out->i = ns;
		return true;
	}
	return value_parse(type, text, strlen(text), room, out, why);
}

static bool parse_ms(enum iec_type type, const char *text, struct iec_text *room,
		     union iec_value *out, enum diag_id *why)
{
	char number[24];

	if (!parse_time(IEC_TIME, text, room, out, why))
		return false;
	*why = DIAG_LITERAL_RANGE;
	if (out->i % VALUE_MS)
		return false;
	snprintf(number, sizeof(number), "%" PRId64, out->i / VALUE_MS);
	return value_parse(type, number, strlen(number), room, out, why);
}

static bool parse_float(enum iec_type type, const char *text, struct iec_text *room,
			union iec_value *out, enum diag_id *why)
{
	if (!value_parse(real_of(type), text, strlen(text), room, out, why))
		return false;
	*out = of_bits(type, bits_of(real_of(type), *out));
	return true;
}

/* Where nothing but a number can be meant, blanks before and behind it mean nothing. */
static const char *trimmed(const char *text, char *out, size_t size)
{
	size_t len;

	while (isspace((unsigned char)*text))
		text++;
	len = strlen(text);
	while (len > 0 && isspace((unsigned char)text[len - 1]))
		len--;
	if (len >= size)
		return text;
	memcpy(out, text, len);
	out[len] = '\0';
	return out;
}

bool watch_parse(enum watch_format format, enum iec_type type, const char *text,
		 struct iec_text *room, union iec_value *out, enum diag_id *why)
{
	char plain[IEC_VALUE_TEXT + 8];

	text = trimmed(text, plain, sizeof(plain));
	*why = DIAG_BAD_LITERAL;
	if (!*text)
		return false;
	if (!watch_format_fits(format, type))
		format = WATCH_AUTO;
	switch (format) {
	case WATCH_BIN: return parse_digits("2#", type, text, out, why);
	case WATCH_HEX: return parse_digits("16#", type, text, out, why);
	case WATCH_SIGNED:
	case WATCH_UNSIGNED: return parse_digits("", type, text, out, why);
	case WATCH_FLOAT: return parse_float(type, text, room, out, why);
	case WATCH_TIME: return parse_ms(type, text, room, out, why);
	case WATCH_AUTO:
	case WATCH_FORMATS: break;
	}
	if (iec_type_row(type)->class == CLASS_TIME)
		return parse_time(type, text, room, out, why);
	return value_parse(type, text, strlen(text), room, out, why);
}
