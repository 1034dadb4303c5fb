/* SPDX-License-Identifier: MIT
 *
 * check_st - the names in statements of Structured Text. Types are left to the translation and to
 * check_il.
 */
#ifndef CHECK_CHECK_ST_H
#define CHECK_CHECK_ST_H

#include "engine/check/check_operand.h"

/** check_st_item - the same of one statement that is in no body; c->place is set. */
bool check_st_item(struct operand_check *c, const struct st_item *item);
/** check_st - @count statements of c->pou from @first on; c->rung is NULL. Notes the uses.
 * Scan-safe: no. Fails: false (and c->good too) when it added an error. */
bool check_st(struct operand_check *c, int first, int count);
#endif
