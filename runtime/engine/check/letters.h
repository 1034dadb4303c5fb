/* SPDX-License-Identifier: MIT
 *
 * letters - `Name[3]` of a STRING: one of its letters.
 *
 * An expression of a statement is rewritten: to read is MID(Name, 1, 3), to store is
 * Name := REPLACE(Name, LEFT(value, 1), 1, 3). Check and translation see these functions.
 */
#ifndef CHECK_LETTERS_H
#define CHECK_LETTERS_H

#include "engine/check/scope.h"
#include "engine/model/expr.h"

/** letters_rewrite - all letters of @expr; what has no room stays, and the check refuses it as an index of
 * something that is no array. Scan-safe: no. */
void letters_rewrite(struct scope *scope, const struct pou *pou, struct expr *expr);
#endif
