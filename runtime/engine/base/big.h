/* SPDX-License-Identifier: MIT
 *
 * big - unsigned integers of up to 1984 bits: enough for a REAL or LREAL and its
 * decimal text to be compared exactly, see decimal.c.
 *
 * There is no overflow check: callers stay within 1984 bits. There is no division:
 * decimal.c finds a digit by subtraction.
 */
#ifndef BASE_BIG_H
#define BASE_BIG_H

#include <stdbool.h>
#include <stdint.h>

#define BIG_WORDS 62

struct big {
	int32_t count;            /* words in use; the top one is not 0       */
	uint32_t word[BIG_WORDS]; /* lowest first; above count not set        */
};

/* All of them: Scan-safe: yes. */
/** big_set - @value. */
void big_set(struct big *big, uint64_t value);
/** big_scale - *@big = *@big * @by + @add. */
void big_scale(struct big *big, uint32_t by, uint32_t add);
/** big_power - *@big * 10^@tens. */
void big_power(struct big *big, int tens);
/** big_shift - *@big * 2^@bits. */
void big_shift(struct big *big, int bits);
/** big_bits - place of the highest bit that is set, from 1; 0: the number is 0.
 * Scan-safe: yes. */
int big_bits(const struct big *big);
/** big_order - <0, 0, >0 as @a + @times * @b is less than, equal to or greater than @c;
 * @times: 0, 1 or 2.   Scan-safe: yes. */
int big_order(const struct big *a, int times, const struct big *b, const struct big *c);
/** big_subtract - *@a - *@b; @b is not greater. */
void big_subtract(struct big *a, const struct big *b);
#endif
