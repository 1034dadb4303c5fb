/* SPDX-License-Identifier: MIT
 *
 * fn_text_to - the value that a text spells: literals of one type, read in a scan.
 *
 * Of a number, the text may go on behind it, as in other tools: '12 kg' is 12, '3.14' as INT is 3.
 *
 * base/literal.h reads sources and may use libc; this file reads texts while a program
 * runs. It allocates nothing and rounds only REAL and LREAL.
 */
#include "engine/scan/fn_text.h"
#include "engine/base/decimal.h"
#include "engine/base/ascii.h"

#include <string.h>

#define SECOND_NS INT64_C(1000000000)
#define DAY_NS    (86400 * SECOND_NS)

/* The rest of a text. */
struct rest {
	const char *at, *end;
};

static bool at_end(const struct rest *rest)
{
	return rest->at == rest->end;
}

static char peek(const struct rest *rest)
{
	return at_end(rest) ? '\0' : *rest->at;
}

static bool accept(struct rest *rest, char c)
{
	if (at_end(rest) || ascii_upper(*rest->at) != c)
		return false;
	rest->at++;
	return true;
}

static unsigned digit_at(const struct rest *rest)
{
	char c = ascii_upper(peek(rest));

	if (c >= '0' && c <= '9')
		return (unsigned)(c - '0');
	return c >= 'A' && c <= 'F' ? (unsigned)(c - 'A') + 10 : 99;
}

/* Digits with single underscores between them, as one number. */
static bool take_digits(struct rest *rest, unsigned base, uint64_t *out)
{
	bool any = false;

	for (*out = 0;;) {
		unsigned digit = digit_at(rest);

		if (digit >= base)
			return any;
		any = true;
		if (__builtin_mul_overflow(*out, (uint64_t)base, out) ||
		    __builtin_add_overflow(*out, (uint64_t)digit, out))
			return false;
		rest->at++;
		if (peek(rest) == '_') {
			const struct rest next = { rest->at + 1, rest->end };

			if (digit_at(&next) >= base)
				return true;
			rest->at++;
		}
	}
}

/* The type in front, which may be missing: TYPE#, or T# and D#. */
static void skip_type(struct rest *rest, enum iec_type type)
{
	const char *hash = memchr(rest->at, '#', (size_t)(rest->end - rest->at));
	size_t len = hash ? (size_t)(hash - rest->at) : 0;
	char first = ascii_upper(peek(rest));

	if (len > 0 && (iec_type_find(rest->at, len) == type ||
			(len == 1 && ((first == 'T' && type == IEC_TIME) ||
				      (first == 'D' && type == IEC_DATE)))))
		rest->at = hash + 1;
}

static bool to_bool(struct rest rest, int64_t *out)
{
	size_t len = (size_t)(rest.end - rest.at);

	*out = ascii_is("TRUE", rest.at, len) || ascii_is("1", rest.at, len);
	return *out || ascii_is("FALSE", rest.at, len) ||
	       ascii_is("0", rest.at, len);
}

/* ---- whole numbers ---- */

/* 2#, 8# or 16#; 10 if there is none. */
static unsigned take_base(struct rest *rest)
{
	static const struct { const char *text; unsigned len, base; } bases[] = {
		{ "2#", 2, 2 }, { "8#", 2, 8 }, { "16#", 3, 16 },
	};

	for (size_t i = 0; i < sizeof(bases) / sizeof(*bases); i++)
		if ((size_t)(rest->end - rest->at) > bases[i].len &&
		    memcmp(rest->at, bases[i].text, bases[i].len) == 0) {
			rest->at += bases[i].len;
			return bases[i].base;
		}
	return 10;
}

static bool to_whole(enum iec_type type, struct rest rest, int64_t *out)
{
	const struct iec_type_row *row = iec_type_row(type);
	bool minus = accept(&rest, '-'), wide = iec_is_wide(type);
	uint64_t value;

	if (!minus)
		accept(&rest, '+');
	if (!take_digits(&rest, take_base(&rest), &value))
		return false;
	if (minus ? value > 0 - (uint64_t)row->low :
		    !wide && value > (uint64_t)row->high)
		return false;
	*out = (int64_t)(minus ? 0 - value : value);
	return true;
}

/* ---- REAL ---- */

/* E-3; the value is limited, so that a huge exponent stays out of range. */
static void take_exponent(struct rest rest, int64_t *exponent)
{
	int64_t power = 0;
	bool minus;

	if (!accept(&rest, 'E'))
		return;
	minus = accept(&rest, '-');
	if (!minus)
		accept(&rest, '+');
	for (; ascii_digit(peek(&rest)); rest.at++)
		if (power < 100000)
			power = power * 10 + (*rest.at - '0');
	*exponent += minus ? -power : power;
}

/* The end of digits with single underscores between them and at most one point before a digit. */
static const char *digits_end(struct rest rest)
{
	bool point = false;

	for (; !at_end(&rest); rest.at++) {
		const struct rest next = { rest.at + 1, rest.end };

		if (ascii_digit(peek(&rest)))
			continue;
		if (!ascii_digit(peek(&next)) || (peek(&rest) != '_' && (point || peek(&rest) != '.')))
			break;
		point |= peek(&rest) == '.';
	}
	return rest.at;
}

static bool to_real(enum iec_type type, struct rest rest, double *out)
{
	struct decimal_text text;
	bool minus = accept(&rest, '-');
	double value = 0;

	if (!minus)
		accept(&rest, '+');
	rest.at = decimal_take(rest.at, digits_end(rest), &text);
	if (!rest.at)
		return false;
	take_exponent(rest, &text.exponent);
	if (text.count > 0)
		value = decimal_value(text.digit, text.count, text.exponent,
				      type == IEC_REAL);
	*out = minus ? -value : value;
	return value <= 1.7976931348623157e308;
}

/* ---- times and dates ---- */

/* Digits behind a point: a part of @unit, which must give whole nanoseconds. */
static bool take_fraction(struct rest *rest, int64_t unit, int64_t *ns)
{
	bool any = false;

	for (*ns = 0; ascii_digit(peek(rest)); rest->at++) {
		int digit = *rest->at - '0';

		any = true;
		if (unit % 10 != 0 && digit)
			return false;
		unit /= 10;
		*ns += digit * unit;
	}
	return any;
}

/* The unit behind a number; 0: there is none. */
static int64_t take_unit(struct rest *rest)
{
	static const struct { const char *word; int64_t ns; } units[] = {
		{ "MS", 1000000 }, { "US", 1000 }, { "NS", 1 }, { "D", DAY_NS },
		{ "H", 3600 * SECOND_NS }, { "M", 60 * SECOND_NS },
		{ "S", SECOND_NS },
	};

	for (size_t i = 0; i < sizeof(units) / sizeof(*units); i++) {
		size_t len = ascii_prefix(units[i].word, rest->at,
					  (size_t)(rest->end - rest->at));

		rest->at += len;
		if (len > 0)
			return units[i].ns;
	}
	return 0;
}

/* One number and its unit, smaller than the one before; the last may have a point. */
static bool add_part(struct rest *rest, int64_t *before, uint64_t *sum, bool *last)
{
	const char *point;
	uint64_t count, whole;
	int64_t unit, part = 0;

	if (!take_digits(rest, 10, &count))
		return false;
	*last = accept(rest, '.');
	point = rest->at;
	while (*last && ascii_digit(peek(rest)))
		rest->at++;
	struct rest fraction = { point, rest->at };

	unit = take_unit(rest);
	if (unit == 0 || unit >= *before ||
	    (*last && !take_fraction(&fraction, unit, &part)))
		return false;
	*before = unit;
	return !__builtin_mul_overflow(count, (uint64_t)unit, &whole) &&
	       !__builtin_add_overflow(whole, (uint64_t)part, &whole) &&
	       !__builtin_add_overflow(*sum, whole, sum);
}

static bool to_time(struct rest rest, int64_t *out)
{
	bool minus = accept(&rest, '-'), last = false;
	int64_t before = INT64_MAX;
	uint64_t sum = 0;

	do {
		if (last || !add_part(&rest, &before, &sum, &last))
			return false;
		if (!at_end(&rest))
			accept(&rest, '_');
	} while (!at_end(&rest));
	*out = (int64_t)(minus ? 0 - sum : sum);
	return sum <= (uint64_t)INT64_MAX + minus;
}

/* A number of one or two digits, of a year up to four. */
static bool take_part(struct rest *rest, int digits, int64_t most, int64_t *out)
{
	int count = 0;

	for (*out = 0; count < digits && ascii_digit(peek(rest)); count++)
		*out = *out * 10 + (*rest->at++ - '0');
	return count > 0 && *out <= most;
}

static bool take_clock(struct rest *rest, int64_t *ns)
{
	int64_t hour, minute, second, below = 0;

	if (!take_part(rest, 2, 23, &hour) || !accept(rest, ':') ||
	    !take_part(rest, 2, 59, &minute) || !accept(rest, ':') ||
	    !take_part(rest, 2, 59, &second) ||
	    (accept(rest, '.') && !take_fraction(rest, SECOND_NS, &below)))
		return false;
	*ns = ((hour * 60 + minute) * 60 + second) * SECOND_NS + below;
	return true;
}

static bool take_date(struct rest *rest, int64_t *ns)
{
	int64_t year, month, day;

	return take_part(rest, 4, 9999, &year) && accept(rest, '-') &&
	       take_part(rest, 2, 12, &month) && accept(rest, '-') &&
	       take_part(rest, 2, 31, &day) && iec_date(year, month, day, ns);
}

static bool to_dated(uint16_t class, struct rest rest, int64_t *out)
{
	int64_t day = 0, clock = 0;

	if (class != CLASS_TOD && !take_date(&rest, &day))
		return false;
	if (class == CLASS_DT && !accept(&rest, '-'))
		return false;
	if (class != CLASS_DATE && !take_clock(&rest, &clock))
		return false;
	return at_end(&rest) && !__builtin_add_overflow(day, clock, out);
}

bool fn_text_to(enum iec_type type, const char *text, uint32_t len,
		union iec_value *out)
{
	uint16_t class = iec_type_row(type)->class;
	struct rest rest = { text, text + len };

	while (!at_end(&rest) && *rest.at == ' ')
		rest.at++;
	while (!at_end(&rest) && rest.end[-1] == ' ')
		rest.end--;
	if (at_end(&rest))
		return false;
	skip_type(&rest, type);
	if (class == CLASS_BOOL)
		return to_bool(rest, &out->i);
	if (class == CLASS_REAL)
		return to_real(type, rest, &out->r);
	if (class == CLASS_TIME)
		return to_time(rest, &out->i);
	if (class & ANY_DATE)
		return to_dated(class, rest, &out->i);
	return class != CLASS_STRING && to_whole(type, rest, &out->i);
}
