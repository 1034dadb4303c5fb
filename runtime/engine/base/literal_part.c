/* SPDX-License-Identifier: MIT
 *
 * literal_part - reads pieces of constants: dates, times of day and quoted texts.
 * literal.c combines them.
 */
#include "engine/base/literal_part.h"
#include "engine/base/ascii.h"

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

/* 08:30:00.5 */
static enum literal_result take_clock(struct rest *rest, int64_t *ns)
{
	static const uint64_t most[] = { 23, 59, 59 };
	uint64_t part[3], fraction = 0, below = 0;
	int places = 0;

	for (int i = 0; i < 3; i++) {
		enum literal_result result;

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
enum literal_result literal_date(enum iec_type type, struct rest rest,
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

/* The byte that an escape behind $ stands for; -1: it is none. */
static int escape(const char *at, size_t left, size_t *used)
{
	static const char letter[] = "LNPRT";
	static const char byte[] = "\n\n\f\r\t";

	*used = 1;
	if (left == 0)
		return -1;
	if (*at == '$' || *at == '\'')
		return *at;
	for (size_t i = 0; i < sizeof(letter) - 1; i++)
		if (ascii_upper(*at) == letter[i])
			return byte[i];
	if (left < 2 || literal_digit(at[0]) > 15 || literal_digit(at[1]) > 15)
		return -1;
	*used = 2;
	return (int)(literal_digit(at[0]) * 16 + literal_digit(at[1]));
}

/* Counts the bytes of the text between two quotes; @out may be NULL. */
static enum literal_result unescape(const char *text, size_t len, char *out,
				    size_t *count)
{
	*count = 0;
	for (size_t i = 0; i < len; i++) {
		int byte = (unsigned char)text[i];
		size_t used;

		if (byte == '\'')
			return LITERAL_BAD;
		if (byte == '$') {
			byte = escape(text + i + 1, len - i - 1, &used);
			if (byte < 0)
				return LITERAL_BAD;
			i += used;
		}
		if (*count == IEC_STRING_MOST)
			return LITERAL_RANGE;
		if (out)
			out[*count] = (char)byte;
		++*count;
	}
	return LITERAL_OK;
}

size_t literal_string(const struct literal *literal, char *out)
{
	size_t count;

	unescape(literal->text, literal->len, out, &count);
	return count;
}

enum literal_result literal_quoted(struct rest rest, struct literal *out)
{
	size_t len = (size_t)(rest.end - rest.at), count;

	if (len < 2 || rest.at[0] != '\'' || rest.end[-1] != '\'')
		return LITERAL_BAD;
	out->type = IEC_STRING;
	out->text = rest.at + 1;
	out->len = len - 2;
	return unescape(out->text, out->len, NULL, &count);
}
