/* SPDX-License-Identifier: MIT
 *
 * whole_number - whole numbers that an expression of constants gives; see whole_number.h.
 */
#include "engine/translate/whole_number.h"

static bool of_text(const struct expr_node *node, struct literal *out)
{
	return literal_parse(node->text, node->len, out) == LITERAL_OK && out->type == IEC_NONE &&
	       !out->real;
}

static bool operate(enum word fn, int64_t a, int64_t b, int64_t *out)
{
	if (fn == FN_ADD)
		return !__builtin_add_overflow(a, b, out);
	if (fn == FN_SUB)
		return !__builtin_sub_overflow(a, b, out);
	if (fn == FN_MUL)
		return !__builtin_mul_overflow(a, b, out);
	if ((fn != FN_DIV && fn != FN_MOD) || b == 0 || (b == -1 && a == INT64_MIN))
		return false;
	*out = fn == FN_DIV ? a / b : a % b;
	return true;
}

/* The parser keeps LIMIT_EXPR_DEPTH, which bounds the recursion. */
bool whole_compute(const struct expr *expr, int index, struct literal *out)
{
	const struct expr_node *node = &expr->node[index];
	struct literal left, right;
	int64_t number = 0;

	if (node->op == EXPR_LITERAL)
		return of_text(node, out);
	if (node->op != EXPR_NEG && node->op != EXPR_FN)
		return false;
	if (!whole_compute(expr, node->left, &left) || left.high)
		return false;
	if (node->op == EXPR_NEG) {
		if (!operate(FN_SUB, 0, left.value.i, &number))
			return false;
	} else if (!whole_compute(expr, node->right, &right) || right.high ||
		   !operate(node->fn, left.value.i, right.value.i, &number)) {
		return false;
	}
	*out = (struct literal){ .type = IEC_NONE, .value.i = number };
	return true;
}

union iec_value whole_cut(const struct literal *literal, enum iec_type type)
{
	const struct iec_type_row *row = iec_type_row(type);
	const unsigned int spare = 64 - 8u * row->size;
	const uint64_t bits = (uint64_t)literal->value.i << spare;
	union iec_value out;

	out.i = row->class == CLASS_SIGNED ? (int64_t)bits >> spare : (int64_t)(bits >> spare);
	return out;
}
