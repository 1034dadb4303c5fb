/* SPDX-License-Identifier: MIT
 *
 * expression - the walker's own evaluation of [ … ] cells.
 *
 * An expression is a chain of functions in the order of its tree, left before right:
 * the first gets EN from the power of the cell, each other from the ENO of the one
 * before. Only the parser is the engine's.
 */
#include "tests/walker/inside.h"

#include <string.h>

struct term {
	enum expr_op op;
	enum word fn;
	int left, right;
	enum iec_type type;     /* of its value; IEC_NONE: untyped literal    */
	enum iec_type inputs;   /* common type of an operation's inputs       */
	bool timely;            /* each input has its own: times and dates    */
	struct placed placed;   /* of a leaf                                  */
	struct value value;     /* of the last run                            */
};

struct expression {
	bool assigns;
	struct placed target;
	int target_index;       /* term; -1: none, or within the target       */
	int root, count;
	struct term *term;
};

static bool is_leaf(const struct term *term)
{
	return term->op == EXPR_NAME || term->op == EXPR_LITERAL;
}

/* A minus before a number is part of the number. */
static void fold_sign(struct term *term, struct term *left)
{
	if (term->op != EXPR_NEG || left->op != EXPR_LITERAL ||
	    left->type != IEC_NONE)
		return;
	term->op = EXPR_LITERAL;
	term->type = IEC_NONE;
	term->placed = left->placed;
	if (left->placed.literal.real)
		term->placed.literal.value.r = -left->placed.literal.value.r;
	else
		term->placed.literal.value.i = -left->placed.literal.value.i;
}

static bool type_term(struct walker *walker, struct expression *expression,
		      struct term *term)
{
	struct term *left = term->left < 0 ? NULL : &expression->term[term->left];
	struct term *right =
		term->right < 0 ? NULL : &expression->term[term->right];
	enum iec_type types[2] = { IEC_NONE, IEC_NONE };

	if (is_leaf(term))
		return term->placed.kind != PLACED_NOWHERE;
	if (term->op == EXPR_INDEX)
		return term->placed.count && left->type != IEC_NONE;
	if (left)
		types[0] = left->type;
	if (right)
		types[1] = right->type;
	if (left && !right) {
		fold_sign(term, left);
		if (is_leaf(term))
			return true;
	}
	if (term->op == EXPR_FN && right) {
		term->type = value_time_type(term->fn, types[0], types[1]);
		term->timely = term->type != IEC_NONE;
		if (term->timely)
			return true;
	}
	term->inputs = wide_type(types, 2);
	if (term->inputs == IEC_NONE) {
		walker->why = "an operation on constants alone, or mixed types";
		return false;
	}
	term->type = term->op == EXPR_FN &&
		     word_is_test(word_row(term->fn)) ?
		     IEC_BOOL : term->inputs;
	return true;
}

/* An array, or the elements behind an address. */
static struct placed array_at(struct walker *walker, const struct frame *frame,
			      const char *text, size_t len)
{
	struct placed array = walker_place(walker, frame, text, len);

	if (!array.count)
		array.count = array.rest;
	return array;
}

static bool make_terms(struct walker *walker, const struct frame *frame,
		       const struct expr *expr, struct expression *expression)
{
	expression->term = arena_alloc(&walker->arena, (size_t)expr->count *
				    sizeof(*expression->term));
	if (!expression->term)
		return false;
	expression->count = expr->count;
	expression->root = expr->root;
	for (int i = 0; i < expr->count; i++) {
		const struct expr_node *from = &expr->node[i];
		struct term *term = &expression->term[i];

		term->op = from->op;
		term->fn = from->fn;
		term->left = from->left;
		term->right = from->right;
		if (is_leaf(term)) {
			term->placed = walker_place(walker, frame, from->text,
						    from->len);
			term->type = term->placed.type;
			/* The parser may take TRUE and FALSE for names. */
			if (term->placed.kind == PLACED_LITERAL)
				term->op = EXPR_LITERAL;
		} else if (term->op == EXPR_INDEX) {
			term->placed = array_at(walker, frame, from->text,
						from->len);
			term->type = term->placed.type;
		}
		if (!type_term(walker, expression, term))
			return false;
	}
	return true;
}

struct expression *expression_new(struct walker *walker, const struct frame *frame,
			    const char *text)
{
	struct expression *expression =
		arena_alloc(&walker->arena, sizeof(*expression));
	static const struct diag nowhere;
	struct diag_list diags;
	struct expr expr;

	diag_init(&diags);
	walker->why = "an expression";
	if (!expression || !expr_parse_text(text, strlen(text), &expr, &diags,
					 nowhere))
		return NULL;
	expression->assigns = expr.target;
	expression->target_index = expr.target_index;
	if (expr.target) {
		expression->target = expr.target_index >= 0 ?
			array_at(walker, frame, expr.target, expr.target_len) :
			walker_place(walker, frame, expr.target, expr.target_len);
		if (expression->target.kind == PLACED_NOWHERE)
			return NULL;
	}
	return make_terms(walker, frame, &expr, expression) ? expression : NULL;
}

bool expression_assigns(const struct expression *expression)
{
	return expression->assigns;
}

struct run {
	struct walker *walker;
	struct expression *expression;
	bool enabled;           /* ENO of the operation before                */
	const struct term *wrapped; /* the operation that overflowed          */
};

/* One operation on known values; a failed or disabled one does not change its value,
 * which is not used then. */
static void operate(struct run *run, struct term *term, struct value a,
		    struct value b)
{
	struct value in[2] = { a, b };
	enum outcome outcome = OUTCOME_GOOD;

	if (!run->enabled)
		return;
	switch (term->op) {
	case EXPR_AND:
		outcome = value_compute(FN_AND, in, 2, &term->value);
		break;
	case EXPR_OR:
		outcome = value_compute(FN_OR, in, 2, &term->value);
		break;
	case EXPR_XOR:
		outcome = value_compute(FN_XOR, in, 2, &term->value);
		break;
	case EXPR_NOT:
		outcome = value_compute(FN_NOT, in, 1, &term->value);
		break;
	case EXPR_NEG:
		in[1] = a;
		in[0] = (struct value){ .type = a.type };
		outcome = value_compute(FN_SUB, in, 2, &term->value);
		break;
	case EXPR_FN:
		outcome = term->timely ?
			value_compute_time(term->fn, a, b, &term->value) :
			value_compute(term->fn, in, 2, &term->value);
		break;
	case EXPR_NAME:
	case EXPR_LITERAL:
	case EXPR_INDEX:
	case EXPR_BIT:
	case EXPR_CALL:
	case EXPR_ARG:
		break;
	}
	if (outcome != OUTCOME_GOOD) {
		run->walker->errors++;
		run->enabled = false;
		if (outcome == OUTCOME_WRAPPED)
			run->wrapped = term;
	}
}

/* An element, unless an operation failed; then it is not used. */
static struct value element(struct run *run, const struct placed *placed)
{
	struct value value = { .type = placed->type };
	struct placed here;

	if (!run->enabled)
		return value;
	if (placed_find(run->walker, placed, &here))
		return placed_read(&here, IEC_NONE);
	run->enabled = false;
	return value;
}

/* The same with a computed index. */
static bool find_computed(struct run *run, const struct placed *array,
			  struct value index, struct placed *out)
{
	if (run->enabled && placed_element(array, index.i, out))
		return true;
	run->walker->errors += run->enabled;
	run->enabled = false;
	return false;
}

/* A number beside a time is of its own type, without one a DINT or REAL. */
static enum iec_type type_beside(const struct run *run, const struct term *term)
{
	const struct term *right = &run->expression->term[term->right];

	if (!term->timely)
		return term->inputs;
	if (right->type != IEC_NONE)
		return right->type;
	return right->placed.literal.real ? IEC_REAL : IEC_DINT;
}

/* Depth is bounded by LIMIT_EXPR_DEPTH of the parser. */
static struct value compute(struct run *run, int at, enum iec_type type)
{
	struct term *term = &run->expression->term[at];
	struct value left = { 0 }, right = { 0 };

	if (is_leaf(term) && term->placed.index) {
		left = element(run, &term->placed);
		return type == IEC_NONE ? left : value_widen(left, type);
	}
	if (is_leaf(term))
		return placed_read(&term->placed, type);
	if (term->op == EXPR_INDEX) {
		struct placed here;

		right = compute(run, term->left, IEC_NONE);
		left.type = term->type;
		if (find_computed(run, &term->placed, right, &here))
			left = placed_read(&here, IEC_NONE);
		return type == IEC_NONE ? left : value_widen(left, type);
	}
	if (term->left >= 0)
		left = compute(run, term->left, term->inputs);
	if (term->right >= 0)
		right = compute(run, term->right, type_beside(run, term));
	operate(run, term, left, right);
	return type == IEC_NONE ? term->value : value_widen(term->value, type);
}

bool expression_run(struct walker *walker, struct expression *expression, bool power)
{
	struct run run = { walker, expression, power, NULL };
	struct placed target = expression->target;
	struct value value, index = { 0 };
	bool there = true, stored;

	if (!expression->assigns) {
		value = compute(&run, expression->root, IEC_BOOL);
		return power && run.enabled && value_is_true(value);
	}
	if (expression->target_index >= 0) {
		index = compute(&run, expression->target_index, IEC_NONE);
		there = placed_element(&expression->target, index.i, &target);
	} else if (expression->target.index) {
		index = placed_read(expression->target.index, IEC_NONE);
		there = placed_element(&expression->target, index.i, &target);
	}
	value = compute(&run, expression->root, expression->target.type);
	/* The last operation stores, even a wrapped result. If its element does not
	 * exist it does not run: one error, whatever the operation. */
	stored = run.enabled || run.wrapped == &expression->term[expression->root];
	if (stored && there)
		placed_write(&target, value);
	walker->errors += run.enabled && !there;
	return run.enabled && there;
}
