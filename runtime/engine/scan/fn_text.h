/* SPDX-License-Identifier: MIT
 *
 * fn_text - values as text and back, IEC 61131-3 table 22: INT_TO_STRING,
 * STRING_TO_TIME and so on.
 *
 * A text is the literal of the value (6.3): TRUE, -7, 1.5, T#1h30m, TOD#08:30:00,
 * D#2026-11-21, DT#2026-11-21-08:30:00. The same bytes on every machine.
 */
#ifndef SCAN_FN_TEXT_H
#define SCAN_FN_TEXT_H

#include "engine/base/iec.h"

#define FN_TEXT_MOST 64 /* bytes of the longest text of a value */

/**
 * fn_text_from - the text of a value
 * @type: any but STRING
 * @out:  FN_TEXT_MOST bytes; no NUL follows
 *
 * REAL and LREAL: the fewest digits that read back; inf, -inf and nan.
 * Returns their number.   Scan-safe: yes.
 */
uint32_t fn_text_from(enum iec_type type, union iec_value value, char *out);

/**
 * fn_text_to - the value that a text spells
 * @type: any but STRING
 * @text: @len bytes, no more than IEC_STRING_MOST; blanks around do not count
 *
 * Reads the texts of fn_text_from() and other literals: 16#FF, 1_000, 1.5E-3, INT#7,
 * T#2.5s. The type in front may be left out.
 * Scan-safe: yes. Fails: false if it is no literal of @type or out of its range.
 */
bool fn_text_to(enum iec_type type, const char *text, uint32_t len,
		union iec_value *out);
#endif
