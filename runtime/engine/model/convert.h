/* SPDX-License-Identifier: MIT
 *
 * convert - words such as INT_TO_REAL, made by a rule instead of 400 rows.
 *
 * The forms of IEC 61131-3 table 22: A_TO_B and TO_B, A_TRUNC_B and TRUNC_B, A_BCD_TO_B
 * and BCD_TO_B, A_TO_BCD_B, TO_BCD_B and A_TO_BCD, where A and B are types. The row
 * names the function of the catalogue that runs.
 */
#ifndef MODEL_CONVERT_H
#define MODEL_CONVERT_H

#include "engine/base/catalog.h"

struct convert_word {
	struct word_row row; /* explanation (words_explain); points to pin and name */
	struct word_pin pin[4];
	const char *doc;     /* explanation; static; NULL: that of its word    */
	char name[48];
};

/**
 * convert_make - the row of a word of these forms
 * @out: caller's; must not move as long as the row is used
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false if the text is no such word.
 */
bool convert_make(const char *text, size_t len, struct convert_word *out);
#endif
