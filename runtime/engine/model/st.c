/* SPDX-License-Identifier: MIT
 *
 * st - the parts of statements of Structured Text; see st.h.
 */
#include "engine/model/st.h"

#include "engine/base/ascii.h"

#include <limits.h>
#include <string.h>

static const struct st_form forms[ST_KINDS] = {
	[ST_ASSIGN] = { "", ";", false, false, false },
	[ST_CALL] = { "", ";", false, false, false },
	[ST_IF] = { "IF", "THEN", true, false, true },
	[ST_ELSIF] = { "ELSIF", "THEN", true, true, true },
	[ST_ELSE] = { "ELSE", "", true, true, false },
	[ST_END_IF] = { "END_IF", ";", false, true, false },
	[ST_CASE] = { "CASE", "OF", true, false, true },
	[ST_CHOICE] = { "", ":", true, true, false },
	[ST_END_CASE] = { "END_CASE", ";", false, true, false },
	[ST_FOR] = { "FOR", "DO", true, false, false },
	[ST_END_FOR] = { "END_FOR", ";", false, true, false },
	[ST_WHILE] = { "WHILE", "DO", true, false, true },
	[ST_END_WHILE] = { "END_WHILE", ";", false, true, false },
	[ST_REPEAT] = { "REPEAT", "", true, false, false },
	[ST_UNTIL] = { "UNTIL", "END_REPEAT", false, true, true },
	[ST_EXIT] = { "EXIT", ";", false, false, false },
	[ST_CONTINUE] = { "CONTINUE", ";", false, false, false },
	[ST_RETURN] = { "RETURN", ";", false, false, false },
	[ST_JUMP] = { "JMP", ";", false, false, false },
	[ST_LABEL] = { "", ":", false, false, false },
	[ST_EMPTY] = { "", ";", false, false, false },
	[ST_COMMENT] = { "", "", false, false, false },
	[ST_SET] = { "", "", false, false, false },
	[ST_RESET] = { "", "", false, false, false },
	[ST_JUMP_IF] = { "JMP", "", false, false, false },
	[ST_RETURN_IF] = { "RETURN", "", false, false, false },
	[ST_STOP_IF] = { "STOP", "", false, false, false },
};

const struct st_form *st_form(enum st_kind kind)
{
	return &forms[kind];
}

void st_begin(struct st_walk *walk, const struct names *names, const struct st_item *item)
{
	*walk = (struct st_walk){ .kind = (enum st_kind)item->kind };
	lex_init(&walk->lex, names_text(names, item->text), names_len(names, item->text));
	walk->lex.wide = true; /* the reader refused it in a rung file */
	walk->lex.line = item->line;
	walk->lex.line_start = walk->lex.at - (item->column - 1);
	lex_next(&walk->lex);
}

void st_where(const struct names *names, const struct st_item *item, const char *at, int *line,
	      int *column)
{
	const char *begin = names_text(names, item->text), *next;
	const char *end = begin + names_len(names, item->text);

	*line = item->line;
	*column = item->column;
	if (at < begin || at > end)
		return;
	for (; (next = memchr(begin, '\n', (size_t)(at - begin))); begin = next + 1) {
		++*line;
		*column = 1;
	}
	*column += (int)(at - begin);
}

bool st_is_choice(struct lex lex)
{
	int open = 0;

	for (; lex.token.kind != TOKEN_END; lex_next(&lex)) {
		if (lex_is(&lex, ";") || lex_is(&lex, ":="))
			return false;
		if (lex_is(&lex, ":") && open <= 0)
			return true;
		open += lex_is(&lex, "(") || lex_is(&lex, "[");
		open -= lex_is(&lex, ")") || lex_is(&lex, "]");
	}
	return false;
}

bool st_begins(struct lex lex)
{
	int open = 0, labels = 0;
	struct lex ahead = lex;

	lex_next(&ahead);
	for (; lex.token.kind == TOKEN_NAME && lex_is(&ahead, ":"); labels++) { /* both languages have them */
		lex_next(&ahead);
		lex = ahead;
		lex_next(&ahead);
	}
	if (labels && lex.token.len > 4 && ascii_same(lex.token.text, "END_", 4))
		return true; /* nothing but labels */
	for (int i = 0; i < ST_COMMENT; i++)
		if (*forms[i].word && lex_is(&lex, forms[i].word) && i != ST_JUMP)
			return true;
	if (op_find(lex.token.text, lex.token.len) == OP_LD)
		return false;
	for (; lex.token.kind != TOKEN_END; lex_next(&lex)) {
		if (open <= 0 && (lex_is(&lex, ";") || lex_is(&lex, ":=")))
			return true;
		if (open <= 0 && lex_is(&lex, ":"))
			return false;
		open += lex_is(&lex, "(") || lex_is(&lex, "[");
		open -= lex_is(&lex, ")") || lex_is(&lex, "]");
	}
	return false;
}

/* ---- labels ---- */

struct token st_label_name(const struct names *names, const struct st_item *item)
{
	struct st_walk walk;

	st_begin(&walk, names, item);
	if (item->kind == ST_JUMP || item->kind == ST_JUMP_IF)
		lex_next(&walk.lex);
	return walk.lex.token;
}

static uint32_t label_fold(struct names *names, const struct st_item *item)
{
	const struct token name = st_label_name(names, item);

	return names_fold(names, names_intern(names, name.text, name.len));
}

void st_lists_step(struct st_lists *lists, const struct st_item *item, int at)
{
	if (st_form((enum st_kind)item->kind)->opens && item->depth <= 2 * LIMIT_ST_DEPTH) /* in CASE, a choice stands between */
		lists->of[item->depth + 1] = lists->of[item->depth + 2] = at;
}

void st_labels(struct names *names, const struct st *st, int first, int count, struct st_labels *out)
{
	struct st_lists lists = { { -1 } };

	*out = (struct st_labels){ .count = 0, .over = -1 };
	for (int i = first; i < first + count; i++) {
		const struct st_item *item = &st->item[i];

		st_lists_step(&lists, item, i);
		if (item->kind != ST_LABEL)
			continue;
		if (out->count == LIMIT_ST_LABELS) {
			out->over = i;
			return;
		}
		out->label[out->count++] = (struct st_label){
			.fold = label_fold(names, item), .item = i, .list = lists.of[item->depth],
		};
	}
}

int st_label_find(struct names *names, const struct st_labels *labels, const struct st_item *item)
{
	const uint32_t fold = label_fold(names, item);

	for (int i = 0; i < labels->count; i++)
		if (labels->label[i].fold == fold)
			return i;
	return -1;
}

/* ---- parts ---- */

static bool st_fail(struct st_walk *walk, struct diag_list *diags, struct diag place, enum diag_id id,
		    const char *wanted)
{
	const struct token *token = &walk->lex.token;
	const int len = token->len < LIMIT_ARG / 2 ? (int)token->len : LIMIT_ARG / 2;

	place.id = id;
	place.line = token->line;
	place.column = token->column;
	walk->missing = true;
	return diag_add(diags, place, "%s%s%.*s", wanted, *wanted ? DIAG_AND : "", len, token->text);
}

/* The expression at the lexer. */
static bool st_value(struct st_walk *walk, struct expr *expr, struct diag_list *diags,
		     struct diag place)
{
	place.line = walk->lex.token.line;
	walk->missing = !expr_parse(&walk->lex, expr, diags, place);
	return !walk->missing;
}

/* The next part is @role, behind @word. */
static bool behind(struct st_walk *walk, struct st_part *part, enum st_role role, const char *word,
		   struct expr *expr, struct diag_list *diags, struct diag place)
{
	if (*word && !lex_accept(&walk->lex, word))
		return st_fail(walk, diags, place, DIAG_EXPECTED, word);
	part->role = walk->last = role;
	part->text = walk->lex.token.text;
	return st_value(walk, expr, diags, place);
}

/* FOR i := from TO to BY by */
static bool next_of_for(struct st_walk *walk, struct st_part *part, struct expr *expr,
			struct diag_list *diags, struct diag place)
{
	static const struct { enum st_role before, role; const char *word; } order[] = {
		{ ST_NO_PART, ST_VARIABLE, "FOR" }, { ST_VARIABLE, ST_FROM, ":=" },
		{ ST_FROM, ST_TO, "TO" }, { ST_TO, ST_BY, "BY" },
	};

	for (size_t i = 0; i < sizeof(order) / sizeof(*order); i++)
		if (order[i].before == walk->last &&
		    (order[i].role != ST_BY || lex_is(&walk->lex, "BY")))
			return behind(walk, part, order[i].role, order[i].word, expr, diags, place);
	return true;
}

/* 1, 3..5 */
static bool next_of_choice(struct st_walk *walk, struct st_part *part, struct expr *expr,
			   struct diag_list *diags, struct diag place)
{
	struct lex ahead = walk->lex;

	if (walk->last == ST_LOW && lex_is(&ahead, ".")) {
		lex_next(&ahead);
		if (lex_is(&ahead, ".")) {
			lex_next(&walk->lex);
			return behind(walk, part, ST_HIGH, ".", expr, diags, place);
		}
	}
	if (walk->last != ST_NO_PART && !lex_is(&walk->lex, ","))
		return true;
	return behind(walk, part, ST_LOW, walk->last == ST_NO_PART ? "" : ",", expr, diags, place);
}

/* `PIN :=` or `PIN =>`, if it stands here. */
static void take_pin(struct st_walk *walk, struct st_part *part)
{
	struct lex ahead = walk->lex;

	part->role = ST_INPUT;
	part->inverted = expr_inverts(&walk->lex);
	if (part->inverted)
		lex_next(&walk->lex);
	ahead = walk->lex;
	if (ahead.token.kind != TOKEN_NAME)
		return;
	lex_next(&ahead);
	if (!lex_is(&ahead, ":=") && !lex_is(&ahead, "=>"))
		return;
	part->pin = (struct expr_tail){ walk->lex.token.text, (uint16_t)walk->lex.token.len };
	if (walk->lex.token.len > LIMIT_NAME)
		part->pin.len = LIMIT_NAME;
	part->role = lex_is(&ahead, "=>") ? ST_OUTPUT : ST_INPUT;
	lex_next(&ahead);
	walk->lex = ahead;
}

/* `Delay`, `Motor[i + 1].Delay` */
static bool take_callee(struct st_walk *walk, struct st_part *part, struct expr *expr,
			struct diag_list *diags, struct diag place)
{
	struct lex *lex = &walk->lex, ahead = *lex;
	const struct token name = lex->token;

	part->text = name.text;
	if (name.kind != TOKEN_NAME)
		return st_fail(walk, diags, place, DIAG_EXPECTED, "statement");
	lex_next(&ahead);
	if (lex_is(&ahead, "[") || lex_is(&ahead, "^")) {
		walk->missing = !expr_parse_place(lex, expr, diags, place);
		return !walk->missing;
	}
	*lex = ahead;
	if (name.len > 2 * LIMIT_NAME)
		return st_fail(walk, diags, place, DIAG_NAME_TOO_LONG, "");
	expr->node[0] = (struct expr_node){ .op = EXPR_NAME, .text = name.text,
					    .len = (uint16_t)name.len, .left = -1, .right = -1 };
	expr->count = 1;
	expr->root = 0;
	expr->target = NULL;
	return true;
}

/* Delay(IN := Start, Q => Motor) */
static bool next_of_call(struct st_walk *walk, struct st_part *part, struct expr *expr,
			 struct diag_list *diags, struct diag place)
{
	struct lex *lex = &walk->lex;

	if (walk->last == ST_NO_PART) {
		part->role = walk->last = ST_CALLED;
		return take_callee(walk, part, expr, diags, place);
	}
	if (walk->last == ST_CALLED && (!lex_accept(lex, "(") || lex_accept(lex, ")")))
		return true;
	if (walk->last != ST_CALLED && lex_accept(lex, ")"))
		return true;
	if (walk->last != ST_CALLED && !lex_accept(lex, ","))
		return st_fail(walk, diags, place, DIAG_EXPECTED, ", or )");
	take_pin(walk, part);
	part->text = lex->token.text;
	if (part->pin.len && (lex_is(lex, ",") || lex_is(lex, ")"))) {
		part->role = walk->last = ST_OPEN;
		return true;
	}
	walk->last = part->role;
	return st_value(walk, expr, diags, place);
}

/* How many := stand outside of parentheses and brackets up to the ; */
static int count_stores(struct lex lex)
{
	int open = 0, stores = 0;

	for (; lex.token.kind != TOKEN_END && !lex_is(&lex, ";"); lex_next(&lex)) {
		open += lex_is(&lex, "(") || lex_is(&lex, "[");
		open -= lex_is(&lex, ")") || lex_is(&lex, "]");
		stores += lex_is(&lex, ":=") && open == 0;
	}
	return stores;
}

/* Behind the next @count :=, or to the end of the statement. */
static void pass_stores(struct lex *lex, int count)
{
	for (int open = 0; count > 0 && lex->token.kind != TOKEN_END && !lex_is(lex, ";"); lex_next(lex)) {
		open += lex_is(lex, "(") || lex_is(lex, "[");
		open -= lex_is(lex, ")") || lex_is(lex, "]");
		count -= lex_is(lex, ":=") && open == 0;
	}
}

/* To the first token of the statement. */
static void chain_back(struct st_walk *walk)
{
	walk->lex.at = walk->first.at;
	walk->lex.line = walk->first.line;
	walk->lex.line_start = walk->first.line_start;
	lex_next(&walk->lex);
}

static bool assigned(struct st_walk *walk, struct st_part *part, struct expr *expr,
		     struct diag_list *diags, struct diag place);

/* a := b := 1: from the right to the left */
static bool next_of_chain(struct st_walk *walk, struct st_part *part, struct expr *expr,
			  struct diag_list *diags, struct diag place)
{
	if (walk->last == ST_NO_PART) {
		walk->first.at = walk->lex.token.text;
		walk->first.line = walk->lex.token.line;
		walk->first.line_start = walk->lex.token.text - (walk->lex.token.column - 1);
		if (!assigned(walk, part, expr, diags, place) || !lex_is(&walk->lex, ":=") || expr->target_points)
			return !walk->missing;
		chain_back(walk);
		walk->stores = count_stores(walk->lex);
	}
	if (walk->stores == 0)
		return true;
	chain_back(walk);
	pass_stores(&walk->lex, --walk->stores);
	if (!assigned(walk, part, expr, diags, place))
		return false;
	if (walk->stores == 0)
		pass_stores(&walk->lex, INT_MAX);
	return true;
}

/* Does it begin with x = …, whatever comes behind? In x = A AND B the AND is the outermost node. */
static bool begins_with_equals(const struct expr *expr, const char *first)
{
	for (int i = 0; i < expr->count; i++) {
		const struct expr_node *node = &expr->node[i];

		if (node->op == EXPR_FN && node->fn == FN_EQ && node->left >= 0 && expr->node[node->left].text == first)
			return true;
	}
	return false;
}

/* Level := Level + 1 */
static bool assigned(struct st_walk *walk, struct st_part *part, struct expr *expr,
		     struct diag_list *diags, struct diag place)
{
	const struct token first = walk->lex.token;

	part->role = walk->last = ST_ASSIGNED;
	part->text = first.text;
	place.line = first.line;
	walk->missing = true;
	if (!expr_parse_cell(&walk->lex, expr, diags, place))
		return false;
	walk->missing = !expr->target;
	if (expr->target)
		return true;
	place.id = begins_with_equals(expr, first.text) ? DIAG_ST_COMPARES : DIAG_ST_NOTHING;
	place.column = first.column;
	return diag_add(diags, place, "%.*s", first.len < LIMIT_ARG ? (int)first.len : LIMIT_ARG,
			first.text);
}

/* Horn S= value: the place, then the value */
static bool next_of_latch(struct st_walk *walk, struct st_part *part, struct expr *expr,
			  struct diag_list *diags, struct diag place)
{
	if (walk->last == ST_NO_PART)
		return behind(walk, part, ST_VARIABLE, "", expr, diags, place);
	if (walk->last != ST_VARIABLE)
		return true;
	if (!lex_accept(&walk->lex, walk->kind == ST_SET ? "S" : "R"))
		return st_fail(walk, diags, place, DIAG_EXPECTED, walk->kind == ST_SET ? "S=" : "R=");
	return behind(walk, part, ST_VALUE, "=", expr, diags, place);
}

/* JMP Fill IF value, RETURN IF value, STOP IF value */
static bool next_of_leave(struct st_walk *walk, struct st_part *part, struct expr *expr,
			  struct diag_list *diags, struct diag place)
{
	if (walk->last != ST_NO_PART)
		return true;
	lex_accept(&walk->lex, forms[walk->kind].word);
	if (walk->kind == ST_JUMP_IF) {
		if (walk->lex.token.kind != TOKEN_NAME)
			return st_fail(walk, diags, place, DIAG_EXPECTED, "label of a network");
		if (walk->lex.token.len > LIMIT_NAME)
			return st_fail(walk, diags, place, DIAG_NAME_TOO_LONG, "");
		lex_next(&walk->lex);
	}
	if (!lex_is(&walk->lex, "IF"))
		return true;
	return behind(walk, part, ST_VALUE, "IF", expr, diags, place);
}

bool st_next(struct st_walk *walk, struct st_part *part, struct expr *expr,
	     struct diag_list *diags, struct diag place)
{
	*part = (struct st_part){ .role = ST_NO_PART };
	if (walk->kind == ST_CALL)
		return next_of_call(walk, part, expr, diags, place);
	if (walk->kind == ST_FOR)
		return next_of_for(walk, part, expr, diags, place);
	if (walk->kind == ST_CHOICE)
		return next_of_choice(walk, part, expr, diags, place);
	if (walk->kind == ST_ASSIGN)
		return next_of_chain(walk, part, expr, diags, place);
	if (walk->kind == ST_SET || walk->kind == ST_RESET)
		return next_of_latch(walk, part, expr, diags, place);
	if (walk->kind == ST_JUMP_IF || walk->kind == ST_RETURN_IF || walk->kind == ST_STOP_IF)
		return next_of_leave(walk, part, expr, diags, place);
	if (walk->last != ST_NO_PART)
		return true;
	if (forms[walk->kind].tests)
		return behind(walk, part, ST_VALUE, forms[walk->kind].word, expr, diags, place);
	if (*forms[walk->kind].word)
		lex_accept(&walk->lex, forms[walk->kind].word);
	if (walk->kind != ST_JUMP && walk->kind != ST_LABEL)
		return true;
	if (walk->lex.token.kind != TOKEN_NAME)
		return st_fail(walk, diags, place, DIAG_EXPECTED, "name of a label");
	if (walk->lex.token.len > LIMIT_NAME)
		return st_fail(walk, diags, place, DIAG_NAME_TOO_LONG, "");
	lex_next(&walk->lex);
	return true;
}
