/* SPDX-License-Identifier: MIT
 *
 * whole_number - whole numbers that an expression of constants without a type gives, such as 60 * 1000.
 */
#ifndef TRANSLATE_WHOLE_NUMBER_H
#define TRANSLATE_WHOLE_NUMBER_H

#include "engine/base/literal.h"
#include "engine/model/expr.h"

/**
 * whole_compute - the exact number of + - * / MOD on whole constants without a type
 * @out: gets a constant without a type
 *
 * Scan-safe: yes.   Fails: false: it has other parts, divides by 0, or needs more than 64 bits.
 */
bool whole_compute(const struct expr *expr, int index, struct literal *out);
/** whole_cut - @literal as a value of @type, an integer or a bit string: its lowest bits. Scan-safe: yes. */
union iec_value whole_cut(const struct literal *literal, enum iec_type type);
#endif
