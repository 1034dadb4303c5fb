/* SPDX-License-Identifier: MIT
 *
 * decimal - REAL and LREAL as decimal digits, and back: exact, so that the same bytes come
 * out on every machine.
 *
 * Not printf and strtod: a scan has no libc, and those follow the user's language.
 */
#ifndef SCAN_DECIMAL_H
#define SCAN_DECIMAL_H

#include <stdbool.h>
#include <stdint.h>

#define DECIMAL_DIGITS 17 /* tell every LREAL from its neighbours */

struct decimal {
	char digit[DECIMAL_DIGITS]; /* '0' to '9'; the first and last are not 0 */
	int count;
	int exponent;               /* value: d.ddd * 10^exponent             */
};

/**
 * decimal_of - the fewest digits that read back as @value
 * @single: as a REAL
 *
 * Of those with as few digits the one nearest to the value. @value is finite and above
 * 0.   Scan-safe: yes; at most a few thousand steps, 1 KB of stack.
 */
void decimal_of(double value, bool single, struct decimal *out);

/**
 * decimal_value - 0.@digit * 10^@exponent, rounded once to a REAL or LREAL
 * @digit: '0' to '9', the first is not '0'
 * @count: 1 to 255 of them
 *
 * To the nearest, ties to even; infinite if it is too large.
 * Scan-safe: yes; 1 KB of stack.
 */
double decimal_value(const char *digit, int count, int64_t exponent, bool single);
#endif
