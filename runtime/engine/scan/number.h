/* SPDX-License-Identifier: MIT
 *
 * number - floating point of 64 bits' precision made of integers: what math
 * reckons with between a double that comes in and the one that goes out.
 *
 * Eleven bits more than a double has leave room for the errors of a few steps,
 * and integers are the same on every machine, with or without a unit for floating
 * point. There are no infinities here and no NaN; callers keep them out.
 */
#ifndef SCAN_NUMBER_H
#define SCAN_NUMBER_H

#include "engine/scan/wide.h"

struct number {
	uint64_t part;   /* of 2^64; the top bit is set                       */
	int32_t power;   /* value: part / 2^64 * 2^power                      */
	bool negative;
};

/* 1 / k! and 1 / k, of 2^64, for k >= 2. */
#define NUMBER_FACTORIALS 20
#define NUMBER_INVERSES 17
extern const uint64_t number_factorial[NUMBER_FACTORIALS + 1];
extern const uint64_t number_inverse[NUMBER_INVERSES + 1];

/** number_of - @x, which is finite and not 0. Exact. Scan-safe: yes. */
struct number number_of(double x);

/** number_double - the nearest double, ties to even; ±inf if too large, subnormals
 * rounded once. Scan-safe: yes. */
double number_double(struct number n);

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
#endif
