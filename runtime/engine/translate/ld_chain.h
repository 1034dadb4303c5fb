/* SPDX-License-Identifier: MIT
 *
 * ld_chain - what the two halves of the translation of expressions share.
 *
 * Private to translate/. ld_expr does operators, operands and assignments, ld_fn calls
 * of functions.
 */
#ifndef TRANSLATE_LD_CHAIN_H
#define TRANSLATE_LD_CHAIN_H

#include "engine/translate/ladder_unit.h"

/* A part of an expression that has been computed. */
struct value {
	uint32_t operand;
	enum iec_type type;     /* IEC_NONE: a constant without a type        */
};

struct chain {
	struct ld *ld;
	const struct expr *expr;
	int net;                /* power of the cell                          */
	uint32_t en;            /* of the next operation; 0: none so far      */
	bool can_fail;
	int calls;              /* of the project's own functions, to come    */
};

/* ---- ld_expr.c ---- */
uint32_t chain_intern(struct chain *c, const char *text, size_t len);
/** chain_infer - type of a part; IEC_NONE: constants take that of their neighbours. */
enum iec_type chain_infer(struct chain *c, int index);
/** chain_side - an input beside one of @type: a bare constant takes that type by itself,
 * an operation on constants must be told. */
struct value chain_side(struct chain *c, int index, enum iec_type type);
/** chain_place - the operand of a variable or element, as it is. */
struct value chain_place(struct chain *c, int index);
/** chain_power - the operand that enables the next operation. */
uint32_t chain_power(struct chain *c);

/* ---- ld_fn.c ---- */
/** chain_count_calls - calls of the project's own functions in the expression. */
int chain_count_calls(const struct ld *ld, const struct expr *expr);
enum iec_type chain_infer_call(struct chain *c, const struct expr_node *node);
struct value chain_call(struct chain *c, const struct expr_node *node,
			enum iec_type hint, uint32_t target);
#endif
