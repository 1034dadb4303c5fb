/* SPDX-License-Identifier: MIT
 *
 * math - LN, EXP, SIN and the other functions of IEC 61131-3 tables 23 and 24, with the
 * same bits on every machine.
 *
 * C libraries round these functions differently. Here they are computed with integers
 * (number.h), so that neither processor nor C library matters; asin and acos begin with
 * sqrt(), of which IEEE 754 fixes every bit. A result is within 0.505 units of the last
 * place of the true value, a subnormal one too. Special values are those of C11 Annex
 * F; every NaN that comes out is the same one. They keep no state and do not set errno.
 *
 * Square root is not here: the machine's is exact.
 */
#ifndef SCAN_MATH_H
#define SCAN_MATH_H

#include <stdbool.h>
#include <stdint.h>

/** math_exp - e to the power of @x. Scan-safe: yes. */
double math_exp(double x);

/** math_log - natural logarithm; -inf of 0, NaN below. Scan-safe: yes. */
double math_log(double x);

/** math_log10 - logarithm to base 10, exact for powers of 10. Scan-safe: yes. */
double math_log10(double x);

/** math_pow - @x to the power of @y; NaN for x < 0 unless y is an integer.
 * Exact results and exact ties are rounded correctly. Scan-safe: yes. */
double math_pow(double x, double y);

/**
 * math_pow_integer - @x to the power of an integer that need not fit a double
 * @negative:  the exponent is below 0
 * @magnitude: its distance from 0
 *
 * Scan-safe: yes.
 */
double math_pow_integer(double x, bool negative, uint64_t magnitude);

/** math_sin, math_cos, math_tan - of @x radians, however large. Scan-safe: yes. */
double math_sin(double x);
double math_cos(double x);
double math_tan(double x);

/** math_asin, math_acos - NaN outside -1 .. 1. Scan-safe: yes. */
double math_asin(double x);
double math_acos(double x);

/** math_atan - -pi/2 .. pi/2. Scan-safe: yes. */
double math_atan(double x);

/** math_atan2 - direction of the point (@x, @y), -pi .. pi. Scan-safe: yes. */
double math_atan2(double y, double x);
#endif
