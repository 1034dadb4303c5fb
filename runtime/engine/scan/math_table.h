/* SPDX-License-Identifier: MIT
 *
 * math_table - constants of math, fractions of 2^64 or 2^128.
 *
 * Written by tests/math/tables.py; do not change by hand.
 */
#ifndef SCAN_MATH_TABLE_H
#define SCAN_MATH_TABLE_H

#include "engine/scan/wide.h"

/* log2(e) / 2, ln 2, 2 log10(2), pi / 4. */
#define MATH_LOG2_E_HIGH UINT64_C(0xb8aa3b295c17f0bb)
#define MATH_LOG2_E_LOW UINT64_C(0xbe87fed0691d3e89)
#define MATH_LN_2 UINT64_C(0xb17217f7d1cf79ac)
#define MATH_LOG10_2 UINT64_C(0x9a209a84fbcff799)
#define MATH_PI_4 UINT64_C(0xc90fdaa22168c235)

/* 256 / (1 + (i + 1/2) / 32) - 1 to the nearest, but exact at both ends. */
extern const uint8_t math_log_factor[32];
/* log2 of 256 / (that + 1); 0 for 256 / 128 too, the 1 is added elsewhere. */
extern const struct wide math_log_table[32];
/* 2^(i/16) / 2. */
extern const uint64_t math_exp_table[16];
/* atan(i/8). */
extern const uint64_t math_atan_table[9];
/* 128 zeros, then the bits of 2/pi. */
extern const uint64_t math_2_pi[20];
#endif
