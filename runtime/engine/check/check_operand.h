/* SPDX-License-Identifier: MIT
 *
 * check_operand - what the cells of a rung name: is it there, may it be
 * used so?
 *
 * A part of check_names. Types of values are left to check_il, but for contacts
 * and coils, which are BOOL by their drawing.
 */
#ifndef CHECK_CHECK_OPERAND_H
#define CHECK_CHECK_OPERAND_H

#include "engine/check/scope.h"
#include "engine/check/uses.h"
#include "engine/model/expr.h"

struct operand_check {
	struct scope *scope;
	struct project *project;
	struct uses *uses;
	struct expr *expr;        /* room for the expression of a cell */
	struct diag_list *diags;
	const struct pou *pou;
	const struct rung *rung;
	int number;               /* of the rung, 1-based */
	bool condition;           /* of a transition: its coil is TRANSITION   */
	bool good;                /* false after an error in this rung */
};

/** check_operands - all cells of c->rung but labels; notes the uses.
 * Scan-safe: no.   Fails: false (and c->good too) when it added an error. */
bool check_operands(struct operand_check *c);
#endif
