/* SPDX-License-Identifier: MIT
 *
 * decimal - REAL and LREAL as decimal digits, and back: exact, so that the same bytes
 * come out on every machine.
 *
 * Replaces printf and strtod, which follow the user's language and are not allowed in a
 * scan. Literals and the conversions of STRING use it.
 */
#ifndef BASE_DECIMAL_H
#define BASE_DECIMAL_H

#include <stdbool.h>
#include <stdint.h>

#define DECIMAL_DIGITS 17 /* distinguishes every LREAL */
#define DECIMAL_MOST 255  /* most digits of a text that can be read */

struct decimal {
	char digit[DECIMAL_DIGITS]; /* '0' to '9'; the first and last are not 0 */
	int count;
	int exponent;               /* value: d.ddd * 10^exponent             */
};

/**
 * decimal_of - the fewest digits that read back as @value
 * @single: as a REAL
 *
 * Among texts of that length, the one nearest to the value. @value is finite and above
 * 0. Scan-safe: yes; at most a few thousand steps, 1 KB of stack.
 */
void decimal_of(double value, bool single, struct decimal *out);

/**
 * decimal_value - 0.@digit * 10^@exponent, rounded once to a REAL or LREAL
 * @digit: '0' to '9', the first is not '0'
 * @count: 1 to DECIMAL_MOST of them
 *
 * To the nearest, ties to even; infinite if it is too large.
 * Scan-safe: yes; 1 KB of stack.
 */
double decimal_value(const char *digit, int count, int64_t exponent, bool single);

/* 0.digits * 10^exponent; no digits: 0. */
struct decimal_text {
	char digit[DECIMAL_MOST]; /* '0' to '9', the first is not '0'         */
	int count;
	bool more;                /* a digit other than 0 was cut off         */
	int64_t exponent;
};

/**
 * decimal_take - reads digits with single underscores between them and at most one
 * point
 *
 * Returns the end of the digits. NULL: there are none, or no digit follows a point or
 * an underscore. Scan-safe: yes.
 */
const char *decimal_take(const char *at, const char *end, struct decimal_text *out);
#endif
