/* SPDX-License-Identifier: MIT
 *
 * operand_check - what the halves of the check of cells share.
 *
 * Private to check/. check_operand looks at elements and boxes, check_expression at what
 * stands in brackets.
 */
#ifndef CHECK_OPERAND_CHECK_H
#define CHECK_OPERAND_CHECK_H

#include "engine/check/check_operand.h"

/* A cell of the rung, 0-based. */
struct operand_spot {
	int row, col;
};

/* ---- check_operand.c: each adds diagnostics of the cell, and notes uses ---- */
bool operand_report(struct operand_check *c, enum diag_id id, struct operand_spot at,
		    const char *arg);
/** operand_find - the meaning of @id, or NULL after a diagnostic. */
const struct meaning *operand_find(struct operand_check *c, struct operand_spot at,
				   uint32_t id);
uint32_t operand_intern(struct operand_check *c, const char *text, size_t len);
/** operand_refuse - what is named wrongly is at least not unused: NULL. */
const struct meaning *operand_refuse(struct operand_check *c, enum diag_id id,
				     struct operand_spot at, uint32_t name,
				     const struct meaning *m);
bool operand_is_array(struct operand_check *c, uint32_t id);
/** operand_read, operand_write, operand_change - a name whose value is asked for, that is
 * written (@always: at every evaluation), or both. */
const struct meaning *operand_read(struct operand_check *c, struct operand_spot at,
				   uint32_t id);
const struct meaning *operand_write(struct operand_check *c, struct operand_spot at,
				    uint32_t id, bool always);
void operand_change(struct operand_check *c, struct operand_spot at, uint32_t id);
/** operand_write_array - the same of a whole array. */
void operand_write_array(struct operand_check *c, struct operand_spot at, uint32_t id);

/* ---- check_expression.c ---- */
void operand_expression(struct operand_check *c, struct operand_spot at, uint32_t id);
#endif
