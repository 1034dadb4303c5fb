/* SPDX-License-Identifier: MIT
 *
 * explain - the texts of catalog.def for people.
 *
 * Separate from the rows, so that a runtime does not link them. All texts are static
 * and have no line break.
 */
#ifndef BASE_EXPLAIN_H
#define BASE_EXPLAIN_H

#include "engine/base/catalog.h"

/** explain_word - what a word does; "" of a word of a project. */
const char *explain_word(const struct word_row *row);
/** explain_pin - the purpose of pin @index of the row; "" for an inner pin and for a
 * word of a project. */
const char *explain_pin(const struct word_row *row, int index);
const char *explain_op(enum op op);
const char *explain_area(enum iec_area area);
const char *explain_sys(enum sys_id id);
#endif
