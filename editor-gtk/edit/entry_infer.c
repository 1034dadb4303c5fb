/* SPDX-License-Identifier: MIT
 *
 * entry_infer - which types new names get in an expression: up the tree goes what is
 * known of its parts, down what a name there is calculated and compared with.
 *
 * Children stand before what they belong to, so that both ways are one loop.
 */
#include "editor-gtk/edit/entry_inside.h"

#include "engine/base/literal.h"
#include "engine/model/expr.h"

#include <stdlib.h>
#include <string.h>

struct infer {
	const struct entry_place *place;
	const struct expr *expr;
	enum iec_type (*said)(void *context, const char *name, size_t len);
	void *context;
	struct entry_types *types;
};

static bool is_comparison(enum word fn)
{
	return word_is_test(word_row(fn));
}

static enum iec_type or_else(uint8_t a, uint8_t b)
{
	return (enum iec_type)(a != IEC_NONE ? a : b);
}

/* ---- up ---- */

static enum iec_type type_of_name(const struct infer *in, const char *text, size_t len)
{
	struct entry_target target;

	entry_target_find(in->place, text, len, &target);
	if (target.means == MEANS_NEW)
		return in->said(in->context, text, len);
	return target.means == MEANS_VALUE ? target.type : IEC_NONE;
}

static void know_literal(const struct infer *in, int i)
{
	const struct expr_node *node = &in->expr->node[i];
	struct literal literal;

	if (literal_parse(node->text, node->len, &literal) != LITERAL_OK)
		return;
	in->types->given[i] = (uint8_t)literal.type;
	if (literal.real)
		in->types->guessed[i] = IEC_REAL;
}

static const struct word_row *row_of_call(const struct infer *in, int call)
{
	const struct expr_node *node = &in->expr->node[call];
	struct word_table *words = &in->place->project->words;
	const enum word word = words_find(words, node->text, node->len);
	const struct word_row *row = word != WORD_COUNT ? words_row(words, word) : NULL;

	return row && row->kind == WORD_FN && row->pin_count > 0 ? row : NULL;
}

/* Number of an argument, from 0: the last one is found first. */
static int argument_number(const struct expr *expr, int argument)
{
	int number = 0;

	for (int i = expr->node[argument].right; i >= 0; i = expr->node[i].right)
		number++;
	return number;
}

static const struct word_pin *pin_of(const struct infer *in, const struct word_row *row,
				     int argument)
{
	const struct expr_node *node = &in->expr->node[argument];
	const int index = node->len ? word_pin_find(row, node->text, node->len) :
				      argument_number(in->expr, argument);

	return index >= 0 ? word_input(row, (uint32_t)index) : NULL;
}

/* What those arguments have that share a type; @guessed: or may have. */
static enum iec_type shared_by(const struct infer *in, const struct word_row *row,
			       int call, bool guessed)
{
	const struct expr *expr = in->expr;
	enum iec_type type = IEC_NONE;

	for (int i = expr->node[call].left; i >= 0; i = expr->node[i].right) {
		const struct word_pin *pin = pin_of(in, row, i);
		const int value = expr->node[i].left;

		if (pin && pin->type == IEC_NONE && !pin->own && value >= 0)
			type = or_else(guessed ? in->types->guessed[value] :
				       in->types->given[value], (uint8_t)type);
	}
	return type;
}

static void know_call(const struct infer *in, int i)
{
	const struct word_row *row = row_of_call(in, i);

	if (!row)
		return;
	if (word_shares(row)) {
		in->types->given[i] = (uint8_t)shared_by(in, row, i, false);
		in->types->guessed[i] = (uint8_t)shared_by(in, row, i, true);
	} else if (row->result < IEC_TYPE_COUNT) {
		in->types->given[i] = (uint8_t)row->result;
	}
}

static void know(const struct infer *in, int i)
{
	const struct expr_node *node = &in->expr->node[i];
	uint8_t *given = in->types->given, *guessed = in->types->guessed;

	switch (node->op) {
	case EXPR_NAME:
	case EXPR_INDEX:
		given[i] = (uint8_t)type_of_name(in, node->text, node->len);
		return;
	case EXPR_LITERAL:
		know_literal(in, i);
		return;
	case EXPR_CALL:
		know_call(in, i);
		return;
	case EXPR_NEG:
	case EXPR_ARG:
		given[i] = given[node->left];
		guessed[i] = guessed[node->left];
		return;
	case EXPR_NOT:
		given[i] = given[node->left];
		guessed[i] = IEC_BOOL;
		return;
	case EXPR_AND:
	case EXPR_XOR:
	case EXPR_OR:
		given[i] = (uint8_t)or_else(given[node->left], given[node->right]);
		guessed[i] = IEC_BOOL;
		return;
	case EXPR_FN:
		break;
	}
	if (is_comparison(node->fn)) {
		given[i] = IEC_BOOL;
		return;
	}
	given[i] = (uint8_t)or_else(given[node->left], given[node->right]);
	guessed[i] = (uint8_t)or_else(guessed[node->left], guessed[node->right]);
}

/* ---- down ---- */

/* Of two that must go together. */
static enum iec_type common_type(const struct infer *in, const struct expr_node *node)
{
	const uint8_t *given = in->types->given, *guessed = in->types->guessed;
	const enum iec_type known = or_else(given[node->left], given[node->right]);

	return known != IEC_NONE ? known : or_else(guessed[node->left], guessed[node->right]);
}

static void want(const struct infer *in, int i, enum iec_type type)
{
	if (i >= 0)
		in->types->wanted[i] = (uint8_t)type;
}

static void want_of_call(const struct infer *in, int call)
{
	const struct word_row *row = row_of_call(in, call);
	enum iec_type shared = IEC_NONE;

	if (row)
		shared = or_else((uint8_t)shared_by(in, row, call, false),
				 (uint8_t)shared_by(in, row, call, true));
	if (row && word_shares(row) && shared == IEC_NONE)
		shared = (enum iec_type)in->types->wanted[call];
	for (int i = in->expr->node[call].left; i >= 0; i = in->expr->node[i].right) {
		const struct word_pin *pin = row ? pin_of(in, row, i) : NULL;

		want(in, i, pin ? entry_fit_pin(row, pin, shared, false).type : IEC_INT);
	}
}

/* TIME times a number is a TIME, and so it is divided. */
static void want_of_fn(const struct infer *in, int i)
{
	const struct expr_node *node = &in->expr->node[i];
	enum iec_type type = common_type(in, node), right;

	if (type == IEC_NONE)
		type = is_comparison(node->fn) || in->types->wanted[i] == IEC_BOOL ?
			IEC_INT : (enum iec_type)in->types->wanted[i];
	right = type;
	if (type == IEC_TIME && (node->fn == FN_MUL || node->fn == FN_DIV))
		right = IEC_INT;
	want(in, node->left, type);
	want(in, node->right, right);
}

static void want_below(const struct infer *in, int i)
{
	const struct expr_node *node = &in->expr->node[i];
	enum iec_type type;

	switch (node->op) {
	case EXPR_NAME:
	case EXPR_LITERAL:
		return;
	case EXPR_INDEX:
		want(in, node->left, IEC_INT);
		return;
	case EXPR_NEG:
	case EXPR_NOT:
	case EXPR_ARG:
		want(in, node->left, (enum iec_type)in->types->wanted[i]);
		return;
	case EXPR_AND:
	case EXPR_XOR:
	case EXPR_OR:
		type = or_else(in->types->given[node->left],
			       in->types->given[node->right]);
		if (type == IEC_NONE && iec_type_row((enum iec_type)
		    in->types->wanted[i])->class & ANY_BIT)
			type = (enum iec_type)in->types->wanted[i];
		if (type == IEC_NONE)
			type = IEC_BOOL;
		want(in, node->left, type);
		want(in, node->right, type);
		return;
	case EXPR_CALL:
		want_of_call(in, i);
		return;
	case EXPR_FN:
		want_of_fn(in, i);
		return;
	}
}

void entry_infer(const struct entry_place *place, const struct expr *expr,
		 enum iec_type (*said)(void *context, const char *name, size_t len),
		 void *context, struct entry_types *out)
{
	const struct infer in = { place, expr, said, context, out };
	const int root = expr->root;

	memset(out, 0, sizeof(*out));
	for (int i = 0; i < expr->count; i++)
		know(&in, i);
	out->target = IEC_BOOL;
	if (expr->target) {
		out->target = (uint8_t)type_of_name(&in, expr->target, expr->target_len);
		if (out->target == IEC_NONE)
			out->target = (uint8_t)or_else(out->given[root], out->guessed[root]);
		if (out->target == IEC_NONE)
			out->target = IEC_INT;
	}
	want(&in, root, (enum iec_type)out->target);
	want(&in, expr->target_index, IEC_INT);
	for (int i = expr->count - 1; i >= 0; i--)
		want_below(&in, i);
}
