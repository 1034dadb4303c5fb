/* SPDX-License-Identifier: MIT
 *
 * math_number - division and power series of struct number (base/number.h), and the
 * kinds of a double, for math.
 */
#ifndef SCAN_MATH_NUMBER_H
#define SCAN_MATH_NUMBER_H

#include "engine/base/number.h"
#include "engine/scan/wide.h"

#include <stdbool.h>
#include <string.h>

/* 1 / k! and 1 / k, of 2^64, for k >= 2. */
#define NUMBER_FACTORIALS 20
#define NUMBER_INVERSES 17
extern const uint64_t number_factorial[NUMBER_FACTORIALS + 1];
extern const uint64_t number_inverse[NUMBER_INVERSES + 1];

/** number_wide - @n / 2^128 * 2^@power, cut; for @n = 0 something tiny.
 * Scan-safe: yes. */
struct number number_wide(struct wide n, int32_t power, bool negative);

/** number_divided - @a / @b, cut to 64 bits. Scan-safe: yes. */
struct number number_divided(struct number a, struct number b);

/** number_fixed - |@n| * 2^@bits, cut; it must fit. Scan-safe: yes. */
uint64_t number_fixed(struct number n, int32_t bits);

/**
 * number_series - c[first] ± x c[first + step] + x² c[first + 2 step] ± ... c[last]
 * @alternate: the signs change
 * @x:         of 2^64
 *
 * Scan-safe: yes. The coefficients fall, so that no sum leaves 0 .. 1.
 */
uint64_t number_series(const uint64_t *c, int first, int last, int step,
		       bool alternate, uint64_t x);

/* The kind of a double by its bits: isnan() and the like may call a C library. The sign
 * of a NaN that arithmetic produces depends on the machine; bits_nan() has one. */
#define BITS_INFINITY ((uint64_t)0x7ff << 52)

static inline uint64_t bits_of(double x)
{
	uint64_t bits;

	memcpy(&bits, &x, sizeof(bits));
	return bits;
}

static inline double bits_double(uint64_t bits)
{
	double x;

	memcpy(&x, &bits, sizeof(x));
	return x;
}

static inline bool bits_is_negative(double x)
{
	return bits_of(x) >> 63;
}

static inline bool bits_is_zero(double x)
{
	return bits_of(x) << 1 == 0;
}

static inline bool bits_is_infinite(double x)
{
	return bits_of(x) << 1 == BITS_INFINITY << 1;
}

static inline bool bits_is_nan(double x)
{
	return bits_of(x) << 1 > BITS_INFINITY << 1;
}

/** bits_is_special - 0, infinite or NaN: struct number cannot hold it. Scan-safe: yes. */
static inline bool bits_is_special(double x)
{
	return bits_is_zero(x) || bits_of(x) << 1 >= BITS_INFINITY << 1;
}

static inline double bits_nan(void)
{
	return bits_double((uint64_t)0xfff << 51);
}

static inline double bits_infinity(bool negative)
{
	return bits_double(BITS_INFINITY | (uint64_t)negative << 63);
}
#endif
