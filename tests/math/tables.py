#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""tables - writes runtime/engine/scan/math_table.h and .c: python3 tests/math/tables.py

Needs mpmath. Every constant is a fraction of 2^64 or 2^128, to the nearest.
"""
import os
from mpmath import mp, mpf, log, pi, e, atan, factorial, floor

mp.prec = 3000
SCAN = os.path.join(os.path.dirname(__file__), '../../runtime/engine/scan/')


def fixed(x, bits=64):
    return int(floor(mpf(x) * mpf(2)**bits + mpf(1) / 2))


def hexa(n):
    return '0x%016x' % n


def array(name, values, per_line=3, text=lambda v: hexa(v)):
    rows = [text(v) for v in values]
    lines = [', '.join(rows[i:i + per_line]) for i in range(0, len(rows), per_line)]
    return 'const %s = {\n\t%s,\n};\n' % (name, ',\n\t'.join(lines))


def wide(n):
    return '{ %s, %s }' % (hexa(n >> 64), hexa(n & (2**64 - 1)))


factors = [256] + [(2 * 16384 + 65 + 2 * i) // (2 * (65 + 2 * i)) for i in range(1, 31)] + [128]
logs = [0 if c in (128, 256) else fixed(log(mpf(256) / c, 2), 128) for c in factors]
two_pi = fixed(2 / pi, 64 * 30) >> (64 * 12)
words = [0, 0] + [two_pi >> (64 * (17 - i)) & (2**64 - 1) for i in range(18)]
log2e = fixed(1 / log(mpf(2)) / 2, 128)

HEAD = '''/* SPDX-License-Identifier: MIT
 *
 * math_table - %s
 *
 * Written by tests/math/tables.py; do not change by hand.
 */
'''
with open(SCAN + 'math_table.h', 'w') as f:
    f.write(HEAD % 'constants of math, fractions of 2^64 or 2^128.' + '''#ifndef SCAN_MATH_TABLE_H
#define SCAN_MATH_TABLE_H

#include "engine/scan/wide.h"

/* log2(e) / 2, ln 2, 2 log10(2), pi / 4. */
''')
    for name, value in [('LOG2_E_HIGH', log2e >> 64), ('LOG2_E_LOW', log2e & (2**64 - 1)),
                        ('LN_2', fixed(log(mpf(2)))), ('LOG10_2', fixed(2 * log(mpf(2), 10))),
                        ('PI_4', fixed(pi / 4))]:
        f.write('#define MATH_%s UINT64_C(%s)\n' % (name, hexa(value)))
    f.write('''
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
''')
with open(SCAN + 'math_table.c', 'w') as f:
    f.write(HEAD % 'tables of math and the coefficients of math_number.'
            + '#include "engine/scan/math_table.h"\n#include "engine/scan/math_number.h"\n\n')
    f.write(array('uint8_t math_log_factor[32]', [c - 1 for c in factors], 8, str) + '\n')
    f.write(array('struct wide math_log_table[32]', logs, 2, wide) + '\n')
    f.write(array('uint64_t math_exp_table[16]', [fixed(mpf(2)**(mpf(i) / 16 - 1)) for i in range(16)]) + '\n')
    f.write(array('uint64_t math_atan_table[9]', [fixed(atan(mpf(i) / 8)) for i in range(9)]) + '\n')
    f.write(array('uint64_t math_2_pi[20]', words) + '\n')
    f.write(array('uint64_t number_factorial[NUMBER_FACTORIALS + 1]',
                  [0, 0] + [fixed(1 / factorial(k)) for k in range(2, 21)]) + '\n')
    f.write(array('uint64_t number_inverse[NUMBER_INVERSES + 1]',
                  [0, 0] + [fixed(mpf(1) / k) for k in range(2, 18)]))
