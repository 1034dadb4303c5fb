/* SPDX-License-Identifier: MIT
 *
 * entry_expression - a comparison or an assignment, typed with or without brackets.
 *
 * The engine parses it; here its names are looked up, and new names get a type.
 */
#include "editor-gtk/edit/entry_expression.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/lex.h"
#include "engine/base/literal.h"
#include "engine/base/name.h"
#include "engine/model/expr.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One entry for each node of an expression. */
struct types {
	uint8_t given[LIMIT_EXPR_NODES];  /* from declarations and typed constants */
	uint8_t guessed[LIMIT_EXPR_NODES]; /* otherwise from constants and operators */
	uint8_t wanted[LIMIT_EXPR_NODES]; /* the type of a new name there      */
	uint8_t target;                   /* of the target of an assignment    */
};

/* A name with its declaration, `Level AT %IW0 : INT`. */
struct said {
	const char *text;
	size_t len, name;    /* bytes, and those of the name in it             */
	enum iec_type type;  /* IEC_NONE: not given                            */
};

/* Too large for a small stack. */
struct work {
	struct expr expr;
	struct diag_list diags;
	struct entry_target target;
	struct types types;
	struct said said[ENTRY_NEW_MOST];
	int said_count;
};

/* IEC_NONE for a wrong type, whose error is found when the name is declared. */
static enum iec_type type_said(const struct said *said)
{
	const char *end = said->text + said->len, *at = end;

	while (at > said->text && at[-1] != ':') /* the last colon: I:0/3 has one, too */
		at--;
	while (at < end && (*at == ' ' || *at == '\t'))
		at++;
	return iec_type_find(at, (size_t)(end - at));
}

static bool keep_said(struct lex *lex, struct work *w, struct entry *entry)
{
	const char *text = lex->token.text;
	const size_t len = entry_said_len(text, (size_t)(lex->end - text));
	struct said *said = &w->said[w->said_count];

	if (len == 0)
		return true;
	if (w->said_count == ENTRY_NEW_MOST)
		return entry_wrong(entry, N_("“%s” is not declared: one line declares "
				   "at most 4 names"), text,
				   lex->token.len);
	*said = (struct said){ text, len, lex->token.len, IEC_NONE };
	said->type = type_said(said);
	w->said_count++;
	lex->at = text + len;
	return true;
}

/* An address is kept as the name of its variable or in its canonical spelling, and so is a pin in
 * the spelling of another dialect, as everywhere else. What stands behind a dot or before := in a
 * call is the name of a member or a pin. */
static bool is_respelled(const struct entry_place *place, const struct lex *lex, bool member,
			 struct entry_target *target)
{
	const struct token *token = &lex->token;
	struct lex ahead = *lex;

	if (member || (token->kind != TOKEN_ADDRESS && token->kind != TOKEN_NAME))
		return false;
	entry_target_find(place, token->text, token->len, target);
	if (target->means != MEANS_NEW_PIN &&
	    (target->means != MEANS_VALUE ||
	     (token->text[0] != '%' && target->addr.area == AREA_NONE)))
		return false;
	lex_next(&ahead);
	return target->means == MEANS_NEW_PIN || !lex_is(&ahead, "(");
}

static bool add_token(const struct entry_place *place, const struct lex *lex, bool member,
		      struct entry_target *target, char *out, size_t size)
{
	const struct token *token = &lex->token;
	bool fits;

	if (is_respelled(place, lex, member, target))
		return entry_append(out, size, target->text, strlen(target->text));
	return token->kind == TOKEN_NUMBER &&
	       entry_literal(token->text, token->len, out, size, &fits) ? fits :
	       entry_append(out, size, token->text, token->len);
}

/* With one blank around := and comparisons, single blanks elsewhere, and without
 * declarations. */
static bool print(const struct entry_place *place, const char *text, size_t len, struct work *w,
		  struct entry *entry)
{
	static const char *const wide[] = { ":=", "<", ">", "<=", ">=", "=", "<>" };
	char *out = entry->operand;
	const size_t size = sizeof(entry->operand);
	struct lex lex;
	bool before = false, first = true, good = true, dot = false;
	int depth = 0;

	lex_init(&lex, text, len);
	while (lex_next(&lex) != TOKEN_END && good) {
		struct lex ahead = lex;
		bool sign = false;

		lex_next(&ahead);
		depth += lex_is(&lex, "(") - lex_is(&lex, ")");

		for (size_t i = 0; i < sizeof(wide) / sizeof(*wide); i++)
			sign |= lex.token.kind == TOKEN_SYMBOL && lex_is(&lex, wide[i]);
		if (!first && (before || sign || lex.token.space_before))
			good = entry_append(out, size, " ", 1);
		good = good && add_token(place, &lex, dot || (depth > 0 && lex_is(&ahead, ":=")),
					 &w->target, out, size);
		dot = lex_is(&lex, ".");
		before = sign;
		first = false;
		if (!keep_said(&lex, w, entry))
			return false;
	}
	return good || entry_wrong(entry, N_("the line is too long"), "", 0);
}

static const struct said *said_of(const struct work *w, const char *name, size_t len)
{
	for (int i = 0; i < w->said_count; i++)
		if (name_same(w->said[i].text, w->said[i].name, name, len))
			return &w->said[i];
	return NULL;
}

static enum iec_type type_of(const struct work *w, const char *name, size_t len)
{
	const struct said *said = said_of(w, name, len);

	return said ? said->type : IEC_NONE;
}

struct infer {
	const struct entry_place *place;
	const struct expr *expr;
	const struct work *work; /* for the declarations in the line            */
	struct types *types;
};

static bool is_comparison(enum word fn)
{
	return word_is_test(word_row(fn));
}

static enum iec_type or_else(uint8_t a, uint8_t b)
{
	return (enum iec_type)(a != IEC_NONE ? a : b);
}

/* ---- types: from the operands up ---- */

static enum iec_type type_of_name(const struct infer *in, const char *text, size_t len)
{
	struct entry_target target;

	entry_target_find(in->place, text, len, &target);
	if (target.means == MEANS_NEW)
		return type_of(in->work, text, len);
	if (target.means == MEANS_NEW_PIN)
		return entry_pin(&target)->type;
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

/* Number of an argument, from 0: the list begins with the last one. */
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

/* The type that the arguments share; @guessed: a possible one. */
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
	unsigned int bits, number;

	switch (node->op) {
	case EXPR_NAME:
	case EXPR_INDEX:
		given[i] = (uint8_t)type_of_name(in, node->text, node->len);
		return;
	case EXPR_BIT:
		if (!expr_part(node->tail, &bits, &number))
			return;
		given[i] = (uint8_t)(bits == 1 ? IEC_BOOL : bits == 8 ? IEC_BYTE :
				     bits == 16 ? IEC_WORD : bits == 32 ? IEC_DWORD : IEC_LWORD);
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

/* ---- types: down to new names ---- */

/* The type of two operands that need the same. */
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

/* TIME times a number is a TIME; so is TIME divided by a number. */
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
	case EXPR_BIT:
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

/* New names get the type of what they are compared or calculated with. If all names are
 * new: INT, or REAL beside a constant with a point. The engine checks types. Children have
 * lower indices than their parents, so a loop up and one down are enough. */
static void infer_types(const struct entry_place *place, struct work *w)
{
	const struct expr *expr = &w->expr;
	struct types *out = &w->types;
	const struct infer in = { place, expr, w, out };
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

/* ---- names ---- */

static bool look_up(const struct entry_place *place, const char *text, size_t len,
		    enum iec_type type, bool write, struct work *w, struct entry *entry)
{
	const struct said *said = said_of(w, text, len);
	struct entry_fit fit = entry_fit_type(type, write);

	if (said && said->type == type)
		fit.classes = iec_type_row(type)->class;
	if (!entry_operand(place, said ? said->text : text, said ? said->len : len, &fit,
			   &w->target, entry))
		return false;
	/* Which pin is meant, only a contact tells. */
	if (w->target.means == MEANS_VALUE && w->target.foreign.kind == DIALECT_BLOCK &&
	    w->target.foreign.name[0])
		return entry_wrong(entry, N_("“%s” is a timer or counter in other tools: write a pin "
				   "behind it, as in T37.Q"), text, len);
	return !write || w->target.means == MEANS_NEW || w->target.write ||
	       entry_wrong(entry, N_("“%s” cannot be written"), text, len);
}

static bool look_up_all(const struct entry_place *place, struct work *w,
			struct entry *entry)
{
	const struct expr *expr = &w->expr;

	infer_types(place, w);
	if (expr->target && expr->target_index < 0 &&
	    !look_up(place, expr->target, expr->target_len,
		     (enum iec_type)w->types.target, true, w, entry))
		return false;
	for (int i = 0; i < expr->count; i++)
		if (expr->node[i].op == EXPR_NAME &&
		    !look_up(place, expr->node[i].text, expr->node[i].len,
			     (enum iec_type)w->types.wanted[i], false, w, entry))
			return false;
	return true;
}

static bool parses(struct work *w, const char *text)
{
	diag_init(&w->diags);
	return expr_parse_text(text, strlen(text), &w->expr, &w->diags,
			       (struct diag){ .id = DIAG_BAD_EXPRESSION });
}

/* Only the rest is missing: with a name at its end and all brackets closed it would parse. */
static bool is_begun(struct work *w, const char *text)
{
	static const char *const names[] = { "", " x", "x" };
	char whole[ENTRY_TEXT + 64];
	int open = 0;

	for (const char *at = text; *at; at++)
		open += (*at == '(') - (*at == ')');
	for (size_t i = 0; open >= 0 && open < 32 && i < sizeof(names) / sizeof(*names); i++) {
		snprintf(whole, sizeof(whole), "%s%s%.*s", text, names[i], open,
			 "))))))))))))))))))))))))))))))))");
		if (parses(w, whole))
			return true;
	}
	return false;
}

/* Parsed from the text that is kept, so that it will read again. */
static bool read_expression(const struct entry_place *place, struct work *w,
			    struct entry *entry)
{
	if (!parses(w, entry->operand)) {
		if (!is_begun(w, entry->operand))
			return entry_wrong(entry, N_("“%s” is not a valid expression"),
					   entry->operand, strlen(entry->operand));
		entry->sense = ENTRY_PART;
		return false;
	}
	entry->word = w->expr.target ? ELEM_ASSIGN : ELEM_COMPARE;
	if (place->output && !w->expr.target)
		return entry_wrong(entry, N_("“%s” cannot stand in the last column: only an output can"),
				   entry->operand, strlen(entry->operand));
	if (!look_up_all(place, w, entry))
		return false;
	entry->sense = ENTRY_ELEMENT;
	return true;
}

bool entry_expression(const struct entry_place *place, const char *text, size_t len,
		      struct entry *entry)
{
	struct work *w;
	bool good;

	w = calloc(1, sizeof(*w));
	if (!w)
		return entry_wrong(entry, N_("out of memory"), "", 0);
	good = print(place, text, len, w, entry) && read_expression(place, w, entry);
	free(w);
	return good;
}
