/* SPDX-License-Identifier: MIT
 *
 * math_bits - classifies a double by its bits; the special values.
 *
 * For math only. isnan() and the like may call a C library, and the sign of a NaN that
 * arithmetic produces depends on the machine.
 */
#ifndef SCAN_MATH_BITS_H
#define SCAN_MATH_BITS_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

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
