/* SPDX-License-Identifier: MIT
 *
 * attempt - see attempt.h.
 */
#include "engine/check/attempt.h"

#include "engine/base/ascii.h"
#include "engine/model/expr_args.h"

/* The variable or member at @node, of any element the first one; NULL: it is none. */
static const struct meaning *place_at(struct scope *scope, const struct pou *pou, struct expr *expr,
				      const struct expr_node *node)
{
	enum diag_id why;
	uint32_t id = 0;

	if (node->op == EXPR_NAME || node->op == EXPR_INDEX)
		id = scope_first_of(scope, pou, expr, node);
	return id ? scope_find(scope, pou, id, &why) : NULL;
}

/* What the place leads to, if it is declared as a reference. */
static const struct var_target *target_of(const struct meaning *m)
{
	const struct var_target *target = m && m->kind != MEANING_LITERAL && m->like ? m->like->target : NULL;

	return target && target->word != REFERENCE_TO ? target : NULL;
}

static bool is_same(const struct var_target *target, enum iec_type type, bool list, const struct var *like)
{
	const struct var *other = target->like;

	return target->type == type && target->list == list &&
	       (!like || !other || (like->fb == other->fb && like->enumeration == other->enumeration));
}

enum attempt attempt_of(struct scope *scope, const struct pou *pou, struct expr *expr)
{
	struct expr_node *to = &expr->node[expr->count];

	if (expr->count == LIMIT_EXPR_NODES)
		return ATTEMPT_WRONG;
	*to = (struct expr_node){
		.op = expr->target_index < 0 ? EXPR_NAME : EXPR_INDEX, .text = expr->target,
		.len = (uint16_t)expr->target_len, .left = (int16_t)expr->target_index,
		.right = (int16_t)expr->target_base, .tail = expr->target_tail,
	};
	const struct expr_node *root = &expr->node[expr->root];
	const struct var_target *target = target_of(place_at(scope, pou, expr, to)), *from;
	enum expr_measure what;
	const struct expr_node *of = expr_measured(expr, root, &what);
	const struct meaning *m = place_at(scope, pou, expr, of ? of : root);

	if (!target || (of && what != MEASURE_PLACE))
		return ATTEMPT_WRONG;
	if (root->op == EXPR_NAME && ascii_is("NULL", root->text, root->len))
		return ATTEMPT_STORES;
	if (!m)
		return ATTEMPT_WRONG;
	if (of)
		return is_same(target, m->type, m->kind == MEANING_ARRAY, m->like) ? ATTEMPT_STORES : ATTEMPT_NULL;
	from = target_of(m);
	if (!from)
		return ATTEMPT_WRONG;
	return is_same(target, from->type, from->list, from->like) ? ATTEMPT_STORES : ATTEMPT_NULL;
}
