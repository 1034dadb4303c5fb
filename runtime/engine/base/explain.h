/* SPDX-License-Identifier: MIT
 *
 * explain - what the rows of catalog.def say to people.
 *
 * Apart from the rows, so that a runtime, which explains nothing, does not carry the
 * texts. All of them live for ever and hold no line break.
 */
#ifndef BASE_EXPLAIN_H
#define BASE_EXPLAIN_H

#include "engine/base/catalog.h"

/** explain_word - what a word does; "" of a word of a project. */
const char *explain_word(const struct word_row *row);
/** explain_pin - what pin @index of the row is for; "": inside, or of a project. */
const char *explain_pin(const struct word_row *row, int index);
const char *explain_op(enum op op);
const char *explain_area(enum iec_area area);
const char *explain_sys(enum sys_id id);
#endif
