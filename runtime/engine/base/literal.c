/* SPDX-License-Identifier: MIT
 *
 * literal - constants as IEC 61131-3 writes them (tables 5 to 7).
 *
 * Strict on purpose: an underscore stands between two digits, a time has falling
 * units, and what does not fit is refused, never cut. Knows no names but types.
 */
#include "engine/base/literal.h"
#include "engine/base/ascii.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What is left of the text. */
struct rest {
	const char *at, *end;
};

static bool at_end(const struct rest *rest)
{
	return rest->at == rest->end;
}

static bool take_byte(struct rest *rest, char c)
{
	if (at_end(rest) || *rest->at != c)
		return false;
	rest->at++;
	return true;
}

static bool take_minus(struct rest *rest)
{
	if (take_byte(rest, '-'))
		return true;
	take_byte(rest, '+');
	return false;
}

static unsigned int digit_value(char c)
{
	if (ascii_digit(c))
		return (unsigned int)(c - '0');
	c = ascii_upper(c);
	return c >= 'A' && c <= 'F' ? (unsigned int)(c - 'A') + 10 : 99;
}

/* Digits of @base with single underscores between them. */
static enum literal_result take_digits(struct rest *rest, unsigned int base,
				       uint64_t *out)
{
	bool over = false, digit = false;
	uint64_t value = 0;

	for (; !at_end(rest); rest->at++) {
		unsigned int d = digit_value(*rest->at);

		if (*rest->at == '_' && digit && rest->end - rest->at > 1 &&
		    digit_value(rest->at[1]) < base)
			continue;
		if (d >= base)
			break;
		digit = true;
		over |= __builtin_mul_overflow(value, (uint64_t)base, &value);
		over |= __builtin_add_overflow(value, (uint64_t)d, &value);
	}
	*out = value;
	return !digit ? LITERAL_BAD : over ? LITERAL_RANGE : LITERAL_OK;
}

static enum literal_result set_integer(uint64_t size, bool minus, int64_t *out)
{
	if (size > (uint64_t)INT64_MAX + minus)
		return LITERAL_RANGE;
	*out = minus ? (int64_t)(0 - size) : (int64_t)size;
	return LITERAL_OK;
}

#define REAL_TEXT 400 /* digits of a real literal that are looked at         */

/* Copies digits without underscores; false: none, or a stray underscore. */
static bool copy_digits(struct rest *rest, char *out, size_t *len)
{
	size_t before = *len;
	bool digit = false;

	for (; !at_end(rest); rest->at++) {
		if (*rest->at == '_' && digit && rest->end - rest->at > 1 &&
		    ascii_digit(rest->at[1]))
			continue;
		if (!ascii_digit(*rest->at))
			break;
		digit = true;
		if (*len < REAL_TEXT)
			out[*len] = *rest->at;
		++*len;
	}
	return *len != before;
}

/* 1.5E-3 goes to strtod as 15e-4: the locale's decimal point cannot matter. */
static enum literal_result parse_real(struct rest rest, bool minus, double *out)
{
	char text[REAL_TEXT + 32];
	size_t len = 0, whole;
	uint64_t exponent = 0;
	bool down = false;

	if (!copy_digits(&rest, text, &len))
		return LITERAL_BAD;
	whole = len;
	if (take_byte(&rest, '.') && !copy_digits(&rest, text, &len))
		return LITERAL_BAD;
	if (!at_end(&rest) && ascii_upper(*rest.at) == 'E') {
		rest.at++;
		down = take_minus(&rest);
		if (take_digits(&rest, 10, &exponent) == LITERAL_BAD)
			return LITERAL_BAD;
	}
	if (!at_end(&rest))
		return LITERAL_BAD;
	if (len > REAL_TEXT || exponent > 100000)
		return LITERAL_RANGE;
	snprintf(text + len, sizeof(text) - len, "e%ld",
		 (down ? -(long)exponent : (long)exponent) -
		 (long)(len - whole));
	*out = strtod(text, NULL);
	if (!isfinite(*out))
		return LITERAL_RANGE;
	if (minus)
		*out = -*out;
	return LITERAL_OK;
}

static bool is_real(struct rest rest)
{
	for (; !at_end(&rest); rest.at++)
		if (*rest.at == '.' || ascii_upper(*rest.at) == 'E')
			return true;
	return false;
}

/* 12, -7, 16#FF, and 1.5E-3 for which out->real is set. */
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
	result = take_digits(&rest, 10, &size);
	if (hash && result == LITERAL_OK && rest.at == hash) {
		if (rest.at - start > 2 || !ascii_digit(*start) ||
		    (size != 2 && size != 8 && size != 16))
			return LITERAL_BAD;
		rest.at++;
		result = take_digits(&rest, (unsigned int)size, &size);
	}
	if (result == LITERAL_BAD || !at_end(&rest))
		return LITERAL_BAD;
	if (result == LITERAL_RANGE)
		return result;
	return set_integer(size, minus, &out->value.i);
}

struct unit {
	const char *word;
	uint64_t ns;
	uint64_t most; /* behind a larger unit                               */
};

static const struct unit units[] = {
	{ "d",  86400000000000u, 0 }, { "h", 3600000000000u, 23 },
	{ "m",  60000000000u, 59 },   { "s", 1000000000u, 59 },
	{ "ms", 1000000u, 999 },      { "us", 1000u, 999 },
	{ "ns", 1u, 999 },
};
#define UNITS (int)(sizeof(units) / sizeof(*units))

/* The unit word at the cursor; UNITS: none. */
static int take_unit(struct rest *rest)
{
	size_t len = 0;

	while (rest->at + len != rest->end &&
	       ascii_upper(rest->at[len]) >= 'A' &&
	       ascii_upper(rest->at[len]) <= 'Z')
		len++;
	for (int i = 0; i < UNITS; i++)
		if (ascii_is(units[i].word, rest->at, len)) {
			rest->at += len;
			return i;
		}
	return UNITS;
}

/* @part / 10^@places of @ns, if that is a whole number; false: it is finer. */
static bool take_fraction(uint64_t part, int places, uint64_t ns, uint64_t *out)
{
	while (places > 0) {
		if (part % 10 == 0)
			part /= 10;
		else if (ns % 10 == 0)
			ns /= 10;
		else if (part % 2 == 0 && ns % 5 == 0) {
			part /= 2;
			ns /= 5;
		} else if (part % 5 == 0 && ns % 2 == 0) {
			part /= 5;
			ns /= 2;
		} else {
			return false;
		}
		places--;
	}
	return !__builtin_mul_overflow(part, ns, out);
}

/* Digits behind the point; zeros at their end do not count. */
static enum literal_result take_places(struct rest *rest, uint64_t *part,
				       int *places)
{
	struct rest digits = *rest;

	if (take_digits(rest, 10, part) == LITERAL_BAD)
		return LITERAL_BAD;
	digits.end = rest->at;
	while (digits.end - digits.at > 1 &&
	       (digits.end[-1] == '0' || digits.end[-1] == '_'))
		digits.end--;
	*places = 0;
	for (const char *at = digits.at; at != digits.end; at++)
		*places += *at != '_';
	return take_digits(&digits, 10, part);
}

/* 1h2m3.5s */
static enum literal_result parse_units(struct rest rest, uint64_t *out)
{
	uint64_t total = 0, count, part = 0, ns;
	int before = -1, places = 0;

	while (!at_end(&rest)) {
		enum literal_result result = take_digits(&rest, 10, &count);
		bool point = result != LITERAL_BAD && take_byte(&rest, '.');
		int unit;

		if (point && result == LITERAL_OK)
			result = take_places(&rest, &part, &places);
		if (result != LITERAL_OK)
			return result;
		unit = take_unit(&rest);
		if (unit == UNITS || unit <= before ||
		    (point && !at_end(&rest)))
			return LITERAL_BAD;
		if ((before >= 0 && count > units[unit].most) ||
		    __builtin_mul_overflow(count, units[unit].ns, &ns) ||
		    __builtin_add_overflow(total, ns, &total))
			return LITERAL_RANGE;
		if (point && (!take_fraction(part, places, units[unit].ns,
					     &ns) ||
			      __builtin_add_overflow(total, ns, &total)))
			return LITERAL_RANGE;
		before = unit;
		if (take_byte(&rest, '_') && at_end(&rest))
			return LITERAL_BAD;
	}
	*out = total;
	return before < 0 ? LITERAL_BAD : LITERAL_OK;
}

bool literal_parse_duration(const char *text, size_t len, int64_t *ns)
{
	struct rest rest = { text, text + len };
	uint64_t size;

	return parse_units(rest, &size) == LITERAL_OK &&
	       set_integer(size, false, ns) == LITERAL_OK;
}

static enum literal_result parse_time(struct rest rest, int64_t *out)
{
	bool minus = take_minus(&rest);
	uint64_t size;
	enum literal_result result = parse_units(rest, &size);

	return result == LITERAL_OK ? set_integer(size, minus, out) : result;
}

static bool parse_bool(struct rest rest, int64_t *out)
{
	size_t len = (size_t)(rest.end - rest.at);

	*out = ascii_is("TRUE", rest.at, len);
	return *out || ascii_is("FALSE", rest.at, len);
}

/* INT#16#7F: what stands behind a type must fit it. */
static enum literal_result parse_typed(enum iec_type type, struct rest rest,
				       struct literal *out)
{
	struct literal untyped = { IEC_NONE, false, { 0 } };
	enum literal_result result;

	out->type = type;
	if (at_end(&rest))
		return LITERAL_BAD;
	if (type == IEC_TIME)
		return parse_time(rest, &out->value.i);
	if (type == IEC_BOOL && parse_bool(rest, &out->value.i))
		return LITERAL_OK;
	result = parse_number(rest, &untyped);
	if (result != LITERAL_OK)
		return result;
	if (type == IEC_REAL ? memchr(rest.at, '#', (size_t)(rest.end -
							     rest.at)) != NULL :
			       untyped.real)
		return LITERAL_BAD;
	return literal_fit(&untyped, type, &out->value) ? LITERAL_OK :
							  LITERAL_RANGE;
}

/* The type before a #; T is short for TIME. */
static enum iec_type type_before(const char *text, size_t len)
{
	if (len == 1 && ascii_upper(*text) == 'T')
		return IEC_TIME;
	return iec_type_find(text, len);
}

enum literal_result literal_parse(const char *text, size_t len,
				  struct literal *out)
{
	struct rest rest = { text, text + len };
	const char *hash;
	enum literal_result result;
	int64_t ns;

	*out = (struct literal){ IEC_NONE, false, { 0 } };
	if (len == 0)
		return LITERAL_NONE;
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
	return parse_typed(out->type, rest, out);
}

/* REAL takes an integer only when it is exact. */
static bool fit_real(double value, bool exact, union iec_value *out)
{
	float single;

	if (fabs(value) > (double)3.4028235677973366e38)
		return false;
	single = (float)value;
	if (!isfinite(single) || (exact && (double)single != value) ||
	    (single == 0 && value != 0))
		return false;
	out->r = (double)single;
	return true;
}

bool literal_fit(const struct literal *literal, enum iec_type type,
		 union iec_value *out)
{
	const struct iec_type_row *row = iec_type_row(type);
	int64_t value = literal->value.i;

	if (literal->type != IEC_NONE && !iec_can_widen(literal->type, type))
		return false;
	if (literal->real || literal->type == IEC_REAL)
		return type == IEC_REAL &&
		       fit_real(literal->value.r, false, out);
	if (type == IEC_REAL)
		return value >= -(INT64_C(1) << 53) &&
		       value <= INT64_C(1) << 53 &&
		       fit_real((double)value, true, out);
	if (literal->type == IEC_NONE && type == IEC_TIME)
		return false;
	if (row->class == 0 || value < row->low || value > row->high)
		return false;
	out->i = value;
	return true;
}

int literal_print_time(int64_t ns, char *out, size_t size)
{
	uint64_t left = ns < 0 ? 0 - (uint64_t)ns : (uint64_t)ns;
	char text[96];
	int len = snprintf(text, sizeof(text), "T#%s", ns < 0 ? "-" : "");

	for (int i = 0; i < UNITS; i++) {
		uint64_t count = left / units[i].ns;

		left %= units[i].ns;
		if (count)
			len += snprintf(text + len, sizeof(text) - (size_t)len,
					"%" PRIu64 "%s", count, units[i].word);
	}
	return snprintf(out, size, "%s%s", text, ns ? "" : "0s");
}

/* 5 is no REAL in source: 5.0; and 1e+06 is written 1.0e+06. */
static int print_real(union iec_value value, char *out, size_t size)
{
	char text[40];
	const char *exponent;
	int len;

	iec_value_print(IEC_REAL, value, text, sizeof(text));
	if (strpbrk(text, ".n"))
		return snprintf(out, size, "%s", text);
	exponent = strchr(text, 'e');
	len = (int)(exponent ? (size_t)(exponent - text) : strlen(text));
	return snprintf(out, size, "%.*s.0%s", len, text, text + len);
}

int literal_print(enum iec_type type, union iec_value value, char *out,
		  size_t size)
{
	if (type == IEC_BOOL)
		return snprintf(out, size, "%s", value.i ? "TRUE" : "FALSE");
	if (type == IEC_TIME)
		return literal_print_time(value.i, out, size);
	if (type == IEC_REAL)
		return print_real(value, out, size);
	return iec_value_print(type, value, out, size);
}
