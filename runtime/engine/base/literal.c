/* SPDX-License-Identifier: MIT
 *
 * literal - constants as IEC 61131-3 writes them (tables 5 to 7).
 *
 * Strict on purpose: an underscore stands between two digits, the units of a time fall,
 * and a value that does not fit is refused.
 */
#include "engine/base/literal.h"
#include "engine/base/ascii.h"
#include "engine/base/decimal.h"
#include "engine/base/literal_part.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define SECOND_NS INT64_C(1000000000)
#define DAY_NS    (86400 * SECOND_NS)

/* A number of at least two digits (a year: four) and at most @most. */
static enum literal_result take_part(struct rest *rest, size_t digits,
				     uint64_t most, uint64_t *out)
{
	const char *start = rest->at;
	enum literal_result result;

	*out = 0;
	result = literal_digits(rest, 10, out);
	if (result == LITERAL_BAD || (size_t)(rest->at - start) > digits ||
	    memchr(start, '_', (size_t)(rest->at - start)))
		return LITERAL_BAD;
	return *out > most ? LITERAL_RANGE : LITERAL_OK;
}

/* Other tools leave the seconds out: 08:30. Images have no such text. */
#ifdef RUNGBOARD_SMALL
#define HAS_SHORT_CLOCK false
#else
#define HAS_SHORT_CLOCK true
#endif

/* 08:30:00.5, 08:30 */
static enum literal_result take_clock(struct rest *rest, int64_t *ns)
{
	static const uint64_t most[] = { 23, 59, 59 };
	uint64_t part[3], fraction = 0, below = 0;
	int places = 0;

	for (int i = 0; i < 3; i++) {
		enum literal_result result;

		if (HAS_SHORT_CLOCK && i == 2 && literal_end(rest)) {
			part[i] = 0;
			break;
		}
		if (i > 0 && !literal_byte(rest, ':'))
			return LITERAL_BAD;
		result = take_part(rest, 2, most[i], &part[i]);
		if (result != LITERAL_OK)
			return result;
	}
	if (literal_byte(rest, '.')) {
		enum literal_result result = literal_places(rest, &fraction, &places);

		if (result != LITERAL_OK)
			return result;
		if (!literal_fraction(fraction, places, (uint64_t)SECOND_NS, &below))
			return LITERAL_RANGE;
	}
	*ns = (int64_t)((part[0] * 60 + part[1]) * 60 + part[2]) * SECOND_NS +
	      (int64_t)below;
	return LITERAL_OK;
}

static int days_of_month(int year, int month)
{
	return (int)(iec_days(month == 12 ? year + 1 : year,
			      month == 12 ? 1 : month + 1, 1) -
		     iec_days(year, month, 1));
}

/* 2026-11-21, as days since 1970-01-01. */
static enum literal_result take_date(struct rest *rest, int64_t *day)
{
	static const uint64_t most[] = { 9999, 12, 31 };
	uint64_t part[3];

	for (int i = 0; i < 3; i++) {
		enum literal_result result;

		if (i > 0 && !literal_byte(rest, '-'))
			return LITERAL_BAD;
		result = take_part(rest, i ? 2 : 4, most[i], &part[i]);
		if (result != LITERAL_OK)
			return result;
	}
	if (part[1] == 0 || part[2] == 0 ||
	    part[2] > (uint64_t)days_of_month((int)part[0], (int)part[1]))
		return LITERAL_RANGE;
	*day = iec_days((int)part[0], (int)part[1], (int)part[2]);
	return LITERAL_OK;
}

/* What stands behind TOD#, D# and DT#. */
static enum literal_result literal_date(enum iec_type type, struct rest rest,
				      int64_t *out)
{
	enum literal_result result = LITERAL_OK;
	int64_t day = 0, clock = 0, ns;

	if (type != IEC_TIME_OF_DAY)
		result = take_date(&rest, &day);
	if (result == LITERAL_OK && type == IEC_DATE_AND_TIME &&
	    !literal_byte(&rest, '-'))
		return LITERAL_BAD;
	if (result == LITERAL_OK && type != IEC_DATE)
		result = take_clock(&rest, &clock);
	if (result != LITERAL_OK)
		return result;
	if (!literal_end(&rest))
		return LITERAL_BAD;
	if (__builtin_mul_overflow(day, DAY_NS, &ns) ||
	    __builtin_add_overflow(ns, clock, &ns))
		return LITERAL_RANGE;
	*out = ns;
	return LITERAL_OK;
}

/* The number that @count hexadecimal digits are; -1: they are none. */
static int hexadecimal(const char *at, size_t left, size_t count)
{
	int number = 0;

	for (size_t i = 0; i < count; i++) {
		if (i >= left || literal_digit(at[i]) > 15)
			return -1;
		number = number * 16 + (int)literal_digit(at[i]);
	}
	return number;
}

/* The byte that an escape behind $ stands for, or in a wide text the character; -1: it is none. */
static int escape(const char *at, size_t left, bool wide, size_t *used)
{
	static const char letter[] = "LNPRT";
	static const char byte[] = "\n\n\f\r\t";

	*used = 1;
	if (left == 0)
		return -1;
	if (*at == '$' || *at == '\'' || (wide && *at == '"'))
		return *at;
	for (size_t i = 0; i < sizeof(letter) - 1; i++)
		if (ascii_upper(*at) == letter[i])
			return byte[i];
	*used = wide ? 4 : 2;
	return hexadecimal(at, left, *used);
}

/* A character as UTF-8; its number of bytes. */
static size_t put_code(int code, char out[4])
{
	const size_t len = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;

	for (size_t i = len; i-- > 1; code >>= 6)
		out[i] = (char)(0x80 | (code & 0x3f));
	out[0] = (char)(len == 1 ? code : (0xf00 >> len & 0xff) | code);
	return len;
}

/* The bytes of the escape behind the $ at @at; 0: it is none. A wide one of two halves is one
 * character. */
static size_t escaped(const char *at, size_t left, bool wide, size_t *used, char out[4])
{
	int code = escape(at, left, wide, used), low;

	if (code < 0)
		return 0;
	if (code >= 0xd800 && code < 0xe000) {
		low = left > 9 && at[4] == '$' ? hexadecimal(at + 5, left - 5, 4) : -1;
		if (code >= 0xdc00 || low < 0xdc00 || low >= 0xe000)
			return 0;
		*used = 9;
		code = 0x10000 + ((code - 0xd800) << 10) + low - 0xdc00;
	}
	if (wide)
		return put_code(code, out);
	*out = (char)code;
	return 1;
}

/* Counts the bytes of the text between two quotes; @out may be NULL. */
static enum literal_result unescape(const struct literal *literal, char *out, size_t *count)
{
	const char *text = literal->text, quote = literal->wide ? '"' : '\'';

	*count = 0;
	for (size_t i = 0; i < literal->len; i++) {
		char byte[4] = { text[i] };
		size_t used, bytes = 1;

		if (text[i] == quote && (++i == literal->len || text[i] != quote))
			return LITERAL_BAD;
		if (text[i] == '$') {
			bytes = escaped(text + i + 1, literal->len - i - 1, literal->wide, &used, byte);
			if (!bytes)
				return LITERAL_BAD;
			i += used;
		}
		if (*count + bytes > IEC_STRING_MOST)
			return LITERAL_RANGE;
		if (out)
			memcpy(out + *count, byte, bytes);
		*count += bytes;
	}
	return LITERAL_OK;
}

size_t literal_string(const struct literal *literal, char *out)
{
	size_t count;

	unescape(literal, out, &count);
	return count;
}

static enum literal_result literal_quoted(struct rest rest, struct literal *out)
{
	size_t len = (size_t)(rest.end - rest.at), count;

	if (len < 2 || rest.at[0] != rest.end[-1] || (rest.at[0] != '\'' && rest.at[0] != '"'))
		return LITERAL_BAD;
	out->type = IEC_STRING;
	out->wide = *rest.at == '"';
	out->text = rest.at + 1;
	out->len = len - 2;
	return unescape(out, NULL, &count);
}

/* ---- numbers ---- */

static bool take_minus(struct rest *rest)
{
	if (literal_byte(rest, '-'))
		return true;
	literal_byte(rest, '+');
	return false;
}

static enum literal_result parse_real(struct rest rest, bool minus, double *out)
{
	struct decimal_text text;
	uint64_t exponent = 0;
	bool down = false;

	rest.at = decimal_take(rest.at, rest.end, &text);
	if (!rest.at)
		return LITERAL_BAD;
	if (!literal_end(&rest) && ascii_upper(*rest.at) == 'E') {
		rest.at++;
		down = take_minus(&rest);
		if (literal_digits(&rest, 10, &exponent) == LITERAL_BAD)
			return LITERAL_BAD;
	}
	if (!literal_end(&rest))
		return LITERAL_BAD;
	if (text.more || exponent > 100000)
		return LITERAL_RANGE;
	text.exponent += down ? -(int64_t)exponent : (int64_t)exponent;
	*out = 0;
	if (text.count)
		*out = decimal_value(text.digit, text.count, text.exponent, false);
	if (!isfinite(*out))
		return LITERAL_RANGE;
	if (minus)
		*out = -*out;
	return LITERAL_OK;
}

static bool is_real(struct rest rest)
{
	for (; !literal_end(&rest); rest.at++)
		if (*rest.at == '.' || ascii_upper(*rest.at) == 'E')
			return true;
	return false;
}

/* 12, -7, 16#FF; 1.5E-3 sets out->real. */
static enum literal_result parse_number(struct rest rest, struct literal *out)
{
	const char *hash = memchr(rest.at, '#', (size_t)(rest.end - rest.at));
	const char *start = rest.at;
	bool minus = take_minus(&rest);
	enum literal_result result;
	uint64_t size;

	if (!hash && is_real(rest)) {
		out->real = true;
		return parse_real(rest, minus, &out->value.r);
	}
	result = literal_digits(&rest, 10, &size);
	if (hash && result == LITERAL_OK && rest.at == hash) {
		if (rest.at - start > 2 || !ascii_digit(*start) ||
		    (size != 2 && size != 8 && size != 10 && size != 16))
			return LITERAL_BAD;
		rest.at++;
		result = literal_digits(&rest, (unsigned int)size, &size);
	}
	if (result == LITERAL_BAD || !literal_end(&rest))
		return LITERAL_BAD;
	if (result == LITERAL_RANGE)
		return result;
	out->high = !minus && size > (uint64_t)INT64_MAX;
	if (out->high) {
		out->value.i = (int64_t)size;
		return LITERAL_OK;
	}
	return literal_signed(size, minus, &out->value.i);
}

static enum literal_result parse_time(struct rest rest, int64_t *out)
{
	bool minus = take_minus(&rest);
	uint64_t size;
	enum literal_result result = literal_units(rest, &size);

	return result == LITERAL_OK ? literal_signed(size, minus, out) : result;
}

static bool parse_bool(struct rest rest, int64_t *out)
{
	size_t len = (size_t)(rest.end - rest.at);

	*out = ascii_is("TRUE", rest.at, len);
	return *out || ascii_is("FALSE", rest.at, len);
}

/* INT#16#7F: the number must fit the type before it. */
static enum literal_result parse_typed(enum iec_type type, struct rest rest,
				       struct literal *out)
{
	struct literal untyped = { .type = IEC_NONE };
	enum literal_result result;
	bool real = iec_type_row(type)->class == CLASS_REAL;

	out->type = type;
	if (literal_end(&rest))
		return LITERAL_BAD;
	if (type == IEC_TIME)
		return parse_time(rest, &out->value.i);
	if (iec_type_row(type)->class & ANY_DATE)
		return literal_date(type, rest, &out->value.i);
	if (type == IEC_STRING)
		return literal_quoted(rest, out);
	if (type == IEC_BOOL && parse_bool(rest, &out->value.i))
		return LITERAL_OK;
	result = parse_number(rest, &untyped);
	if (result != LITERAL_OK)
		return result;
	out->high = untyped.high;
	if (real ? memchr(rest.at, '#', (size_t)(rest.end -
							     rest.at)) != NULL :
			       untyped.real)
		return LITERAL_BAD;
	return literal_fit(&untyped, type, &out->value) ? LITERAL_OK :
							  LITERAL_RANGE;
}

static bool is_letter_type(const char *text, size_t len)
{
	return ascii_is("CHAR", text, len) || ascii_is("WCHAR", text, len);
}

/* Is the text one letter? */
static bool is_one_letter(const struct literal *literal)
{
	char letter[4];
	size_t count;

	if (unescape(literal, NULL, &count) != LITERAL_OK || count == 0 || count > sizeof(letter))
		return false;
	unescape(literal, letter, &count);
	while (count > 1 && (letter[count - 1] & 0xc0) == 0x80)
		count--;
	return count == 1;
}

/* The type before a #; T is short for TIME, D for DATE. */
static enum iec_type type_before(const char *text, size_t len)
{
	if (ascii_is("T", text, len) || ascii_is("LT", text, len))
		return IEC_TIME;
	if (ascii_is("D", text, len) || ascii_is("LD", text, len))
		return IEC_DATE;
	if (ascii_is("WSTRING", text, len) || is_letter_type(text, len))
		return IEC_STRING;
	return iec_type_find(text, len);
}

enum literal_result literal_parse(const char *text, size_t len,
				  struct literal *out)
{
	struct rest rest = { text, text + len };
	const char *hash;
	enum literal_result result;
	int64_t ns;

	*out = (struct literal){ .type = IEC_NONE };
	if (len == 0)
		return LITERAL_NONE;
	if (*text == '\'' || *text == '"')
		return literal_quoted(rest, out);
	if (parse_bool(rest, &out->value.i)) {
		out->type = IEC_BOOL;
		return LITERAL_OK;
	}
	if (ascii_digit(*text) || (len > 1 && ascii_digit(text[1]) &&
				   (*text == '-' || *text == '+'))) {
		result = parse_number(rest, out);
		if (result == LITERAL_BAD &&
		    literal_parse_duration(text, len, &ns))
			return LITERAL_NONE;
		return result;
	}
	hash = memchr(text, '#', len);
	if (!hash)
		return LITERAL_NONE;
	rest.at = hash + 1;
	out->type = type_before(text, (size_t)(hash - text));
	if (out->type == IEC_NONE)
		return LITERAL_BAD;
	result = parse_typed(out->type, rest, out);
	return result == LITERAL_OK && is_letter_type(text, (size_t)(hash - text)) && !is_one_letter(out) ?
	       LITERAL_BAD : result;
}

/* REAL and LREAL take an integer only when it is exact. */
static bool fit_real(double value, bool exact, bool wide, union iec_value *out)
{
	float single;

	if (wide) {
		out->r = value;
		return isfinite(value);
	}
	if (fabs(value) > (double)3.4028235677973366e38)
		return false;
	single = (float)value;
	if (!isfinite(single) || (exact && (double)single != value) ||
	    (single == 0 && value != 0))
		return false;
	out->r = (double)single;
	return true;
}

static bool fit_integer(const struct literal *literal, enum iec_type type,
			union iec_value *out)
{
	const struct iec_type_row *row = iec_type_row(type);
	int64_t value = literal->value.i;

	if (literal->type == IEC_NONE &&
	    row->class & (CLASS_TIME | ANY_DATE | CLASS_STRING))
		return false;
	if (literal->high ? !iec_is_wide(type) :
	    row->class == 0 || value < row->low || value > row->high)
		return false;
	*out = literal->value;
	return true;
}

bool literal_fit(const struct literal *literal, enum iec_type type,
		 union iec_value *out)
{
	bool real = iec_type_row(type)->class == CLASS_REAL;
	bool wide = type == IEC_LREAL;
	int64_t value = literal->value.i;

	if (literal->type != IEC_NONE && !iec_can_widen(literal->type, type))
		return false;
	if (literal->type == IEC_STRING)
		return true;
	if (literal->real || iec_type_row(literal->type)->class == CLASS_REAL)
		return real && fit_real(literal->value.r, false, wide, out);
	if (!real)
		return fit_integer(literal, type, out);
	return !literal->high && value >= -(INT64_C(1) << 53) &&
	       value <= INT64_C(1) << 53 &&
	       fit_real((double)value, true, wide, out);
}

int literal_print_time(int64_t ns, char *out, size_t size)
{
	uint64_t left = ns < 0 ? 0 - (uint64_t)ns : (uint64_t)ns;
	char text[96];
	int len = snprintf(text, sizeof(text), "T#%s", ns < 0 ? "-" : "");

	for (int i = 0; i < LITERAL_UNITS; i++) {
		uint64_t count = left / literal_unit[i].ns;

		left %= literal_unit[i].ns;
		if (count)
			len += snprintf(text + len, sizeof(text) - (size_t)len,
					"%" PRIu64 "%s", count, literal_unit[i].word);
	}
	return snprintf(out, size, "%s%s", text, ns ? "" : "0s");
}

/* 5 is no REAL in source: 5.0; and 1e+06 is written 1.0e+06. */
static int print_real(enum iec_type type, union iec_value value, char *out,
		      size_t size)
{
	char text[40];
	const char *exponent;
	int len;

	iec_value_print(type, value, text, sizeof(text));
	if (strpbrk(text, ".n"))
		return snprintf(out, size, "%s", text);
	exponent = strchr(text, 'e');
	len = (int)(exponent ? (size_t)(exponent - text) : strlen(text));
	return snprintf(out, size, "%.*s.0%s", len, text, text + len);
}

static int print_dated(enum iec_type type, union iec_value value, char *out,
		       size_t size)
{
	const char *prefix = type == IEC_DATE ? "D" :
			     type == IEC_TIME_OF_DAY ? "TOD" : "DT";
	char text[48];

	iec_value_print(type, value, text, sizeof(text));
	return snprintf(out, size, "%s#%s", prefix, text);
}

int literal_print(enum iec_type type, union iec_value value, char *out,
		  size_t size)
{
	if (type == IEC_BOOL)
		return snprintf(out, size, "%s", value.i ? "TRUE" : "FALSE");
	if (type == IEC_TIME)
		return literal_print_time(value.i, out, size);
	if (iec_type_row(type)->class == CLASS_REAL)
		return print_real(type, value, out, size);
	if (iec_type_row(type)->class & ANY_DATE)
		return print_dated(type, value, out, size);
	return iec_value_print(type, value, out, size);
}

bool literal_is_named(const char *text, size_t len)
{
	const char *sign = len ? memchr(text, '#', len) : NULL;

	if (!sign || sign == text || ascii_digit(*text) || *text == '\'' || sign + 1 == text + len ||
	    ascii_digit(sign[1]) || strchr("-+'", sign[1]))
		return false;
	return type_before(text, (size_t)(sign - text)) == IEC_NONE;
}
