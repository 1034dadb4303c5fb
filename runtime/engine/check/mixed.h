/* SPDX-License-Identifier: MIT
 *
 * mixed - bit strings as numbers in Structured Text (docs/st.md).
 *
 * BYTE, WORD, DWORD and LWORD count as numbers without a sign there. The translation adds the
 * conversions; lists, rungs and the scan know nothing of it.
 */
#ifndef CHECK_MIXED_H
#define CHECK_MIXED_H

#include "engine/check/check_il.h"

/** mixed_is_bits - BYTE to LWORD, not BOOL. Scan-safe: yes. */
bool mixed_is_bits(enum iec_type type);
/**
 * mixed_join - the type of an operation on values of these types, one of which is a bit string
 *
 * IEC_NONE: a constant, which is as the other one. REAL or LREAL if one is; else the wider type, of
 * two the bit string.   Scan-safe: yes.   Fails: IEC_TYPE_COUNT: they are no bit string and a number.
 */
enum iec_type mixed_join(enum iec_type a, enum iec_type b);
/** mixed_converts - is a value of type @from also one of type @to, though only one of them is a
 * bit string? A BOOL is 0 or 1. Scan-safe: yes. */
bool mixed_converts(enum iec_type from, enum iec_type to);
/** mixed_narrows - are both numbers or bit strings, neither a BOOL, of different types? A value of
 * @from can become one of @to, perhaps another one. Scan-safe: yes. */
bool mixed_narrows(enum iec_type from, enum iec_type to);
/** mixed_pin - the type that a value of @type gets at a pin that takes @classes; @type itself, if
 * the pin takes it, or no conversion helps. Scan-safe: yes. */
enum iec_type mixed_pin(uint16_t classes, enum iec_type type);
#endif
