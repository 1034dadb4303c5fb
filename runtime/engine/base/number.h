/* SPDX-License-Identifier: MIT
 *
 * number - a double taken apart, with 64 bits' precision, and put together again.
 *
 * Eleven bits more than a double has leave room for the errors of a few steps, and
 * integers are the same on every machine, with or without a unit for floating point.
 * Callers exclude infinities and NaN.
 */
#ifndef BASE_NUMBER_H
#define BASE_NUMBER_H

#include <stdbool.h>
#include <stdint.h>

struct number {
	uint64_t part;   /* of 2^64; the top bit is set                       */
	int32_t power;   /* value: part / 2^64 * 2^power                      */
	bool negative;
};

/** number_of - @x, which is finite and not 0. Exact. Scan-safe: yes. */
struct number number_of(double x);

/** number_double - the nearest double, ties to even; ±inf if too large, subnormals
 * rounded once. Scan-safe: yes. */
double number_double(struct number n);
#endif
