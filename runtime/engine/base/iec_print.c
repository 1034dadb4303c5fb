/* SPDX-License-Identifier: MIT
 *
 * iec_print - values as text (see iec.h).
 *
 * The same bytes on every machine: printf's decimal point depends on the user's
 * language and is not used. Not for the scan.
 */
#include "engine/base/iec.h"
#include "engine/base/decimal.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* As "%.Ng" does it: fixed for exponents from -4 up to the digits, at least six, else
 * with e. */
static int print_decimal(const struct decimal *decimal, const char *sign, char *out,
			 size_t size)
{
	const char *digit = decimal->digit;
	int count = decimal->count, exponent = decimal->exponent;
	int whole = exponent + 1;

	if (exponent < -4 || whole > (count > 6 ? count : 6))
		return snprintf(out, size, "%s%c%s%.*se%c%02d", sign, digit[0],
				count > 1 ? "." : "", count - 1, digit + 1,
				exponent < 0 ? '-' : '+', abs(exponent));
	if (whole <= 0)
		return snprintf(out, size, "%s0.%.*s%.*s", sign, -whole,
				"0000", count, digit);
	if (whole >= count)
		return snprintf(out, size, "%s%.*s%.*s", sign, count, digit,
				whole - count, "00000");
	return snprintf(out, size, "%s%.*s.%.*s", sign, whole, digit,
			count - whole, digit + whole);
}

/* The fewest digits that read back. */
static int print_real(double value, bool wide, char *out, size_t size)
{
	const char *sign = signbit(value) ? "-" : "";
	struct decimal decimal;

	if (isnan(value))
		return snprintf(out, size, "nan");
	if (isinf(value))
		return snprintf(out, size, "%sinf", sign);
	if (value == 0)
		return snprintf(out, size, "%s0", sign);
	decimal_of(fabs(value), !wide, &decimal);
	return print_decimal(&decimal, sign, out, size);
}

static int print_time(int64_t ns, char *out, size_t size)
{
	uint64_t size_ns = ns < 0 ? 0 - (uint64_t)ns : (uint64_t)ns;
	const char *sign = ns < 0 ? "-" : "";
	uint64_t ms = size_ns / 1000000, below = size_ns % 1000000;
	int decimals = 6;

	if (below == 0)
		return snprintf(out, size, "%s%" PRIu64, sign, ms);
	for (; below % 10 == 0; below /= 10)
		decimals--;
	return snprintf(out, size, "%s%" PRIu64 ".%0*" PRIu64, sign, ms,
			decimals, below);
}

#define DAY_NS INT64_C(86400000000000)

static int print_date(int64_t day, char *out, size_t size)
{
	int year, month, of_month;

	iec_civil(day, &year, &month, &of_month);
	return snprintf(out, size, "%04d-%02d-%02d", year, month, of_month);
}

/* 08:30:00, with as many decimals as it takes. A value of more than a day, read through
 * an address, shows its time of day, as the functions do. */
static int print_clock(int64_t beyond, char *out, size_t size)
{
	int64_t ns = (beyond % DAY_NS + DAY_NS) % DAY_NS;
	int64_t second = ns / 1000000000, below = ns % 1000000000;
	int decimals = 9;
	char fraction[16] = "";

	for (; below && below % 10 == 0; below /= 10)
		decimals--;
	if (below)
		snprintf(fraction, sizeof(fraction), ".%0*" PRId64, decimals,
			 below);
	return snprintf(out, size, "%02d:%02d:%02d%s", (int)(second / 3600),
			(int)(second / 60 % 60), (int)(second % 60), fraction);
}

static int print_date_and_time(int64_t ns, char *out, size_t size)
{
	int64_t day = ns / DAY_NS - (ns % DAY_NS < 0);
	char date[32], clock[32];

	print_date(day, date, sizeof(date));
	/* Unsigned: the first day may begin before the first value. */
	print_clock((int64_t)((uint64_t)ns - (uint64_t)day * (uint64_t)DAY_NS),
		    clock, sizeof(clock));
	return snprintf(out, size, "%s-%s", date, clock);
}

/* 'it$'s' as a literal; bytes that are no text as $xx. */
static int print_string(const struct iec_string *s, char *out, size_t size)
{
	char text[3 * IEC_STRING_MOST + 3];
	size_t at = 0;

	text[at++] = '\'';
	for (int i = 0; s && i < s->length && i < (int)IEC_STRING_MOST; i++) {
		uint8_t c = (uint8_t)s->text[i];

		if (c == '$' || c == '\'')
			text[at++] = '$';
		if (c >= ' ' && c != 0x7f)
			text[at++] = (char)c;
		else
			at += (size_t)snprintf(text + at, 4, "$%02X", c);
	}
	text[at++] = '\'';
	return snprintf(out, size, "%.*s", (int)at, text);
}

int iec_value_print(enum iec_type type, union iec_value value, char *out,
		    size_t size)
{
	switch ((enum iec_class)iec_type_row(type)->class) {
	case CLASS_REAL:
		return type == IEC_LREAL ?
		       print_real(value.r, true, out, size) :
		       print_real((double)(float)value.r, false, out, size);
	case CLASS_TIME:
		return print_time(value.i, out, size);
	case CLASS_TOD:
		return print_clock(value.i, out, size);
	case CLASS_DATE:
		return print_date(value.i / DAY_NS - (value.i % DAY_NS < 0), out,
				  size);
	case CLASS_DT:
		return print_date_and_time(value.i, out, size);
	case CLASS_STRING:
		return print_string(value.s, out, size);
	case CLASS_BOOL:
	case CLASS_BITS:
	case CLASS_SIGNED:
	case CLASS_UNSIGNED:
		if (iec_is_wide(type))
			return snprintf(out, size, "%" PRIu64, (uint64_t)value.i);
		return snprintf(out, size, "%" PRId64, value.i);
	}
	return snprintf(out, size, "%s", "");
}
