/* SPDX-License-Identifier: MIT
 *
 * expr - infix expressions of IEC 61131-3 table 55, as a tree.
 *
 * Two explicit stacks instead of recursion, so that no text can overflow the machine's
 * stack. Names and types are not checked.
 */
#include "engine/model/expr.h"

#include "engine/base/ascii.h"
#include "engine/base/literal.h"
#include "engine/base/lex.h"

#include <stdio.h>
#include <string.h>

#define PENDING (LIMIT_EXPR_DEPTH * 3) /* operators that still need a right operand */

struct operator {
	const char *word;
	uint8_t strength; /* a higher number binds more strongly             */
	uint8_t op;       /* enum expr_op                                    */
	uint16_t fn;      /* enum word of EXPR_FN                            */
	bool lazy;
};

enum { OPERATOR_PAREN, OPERATOR_INDEX, OPERATOR_CALL, OPERATOR_NEG, OPERATOR_NOT,
       OPERATOR_BINARY };
static const struct operator operators[] = {
	[OPERATOR_PAREN] = { "(", 0, 0, 0, false },
	[OPERATOR_INDEX] = { "[", 0, 0, 0, false },
	[OPERATOR_CALL] = { "(", 0, 0, 0, false },
	[OPERATOR_NEG] = { "-", 9, EXPR_NEG, 0, false },
	[OPERATOR_NOT] = { "NOT", 9, EXPR_NOT, 0, false },
	[OPERATOR_BINARY] = { "**", 8, EXPR_FN, FN_EXPT, false },
	{ "*", 7, EXPR_FN, FN_MUL, false },
	{ "/", 7, EXPR_FN, FN_DIV, false },   { "MOD", 7, EXPR_FN, FN_MOD, false },
	{ "+", 6, EXPR_FN, FN_ADD, false },   { "-", 6, EXPR_FN, FN_SUB, false },
	{ "<", 5, EXPR_FN, FN_LT, false },    { ">", 5, EXPR_FN, FN_GT, false },
	{ "<=", 5, EXPR_FN, FN_LE, false },   { ">=", 5, EXPR_FN, FN_GE, false },
	{ "=", 4, EXPR_FN, FN_EQ, false },    { "<>", 4, EXPR_FN, FN_NE, false },
	{ "AND", 3, EXPR_AND, 0, false },     { "&", 3, EXPR_AND, 0, false },
	{ "XOR", 2, EXPR_XOR, 0, false },     { "OR", 1, EXPR_OR, 0, false },
	{ "AND_THEN", 3, EXPR_AND, 0, true }, { "OR_ELSE", 1, EXPR_OR, 0, true },
};
#define OPERATORS (int)(sizeof(operators) / sizeof(*operators))

struct parser {
	struct lex *lex;
	struct expr *out;
	struct diag_list *diags;
	const struct diag *place; /* of the text                            */
	int shift;         /* column of the first byte of the text, minus 1; -1: none */
	int opened;        /* ( and [ not closed yet                         */
	int nested;        /* entries of the operator stack                  */
	int indexed;       /* [ not closed yet                               */
	int called;        /* ( of functions not closed yet                  */
	int pending_count;
	int value_count;
	bool alone;        /* one operand: what is behind it stays            */
	struct expr_tail bit;     /* behind the path that was read last; len 0: none */
	uint8_t pending[PENDING];
	int16_t value[PENDING + 1];
};

/* Adds diagnostic @id at the token; returns false. At the end of the text, the argument
 * is empty. */
static bool refuse(struct parser *parser, enum diag_id id)
{
	const struct token *token = &parser->lex->token;
	size_t len = token->kind == TOKEN_NEWLINE ? 0 : token->len;

	struct diag place = *parser->place;

	place.id = id;
	if (parser->shift >= 0)
		place.column = token->column + parser->shift;
	return diag_add(parser->diags, place, "%.*s",
			(int)(len < LIMIT_ARG ? len : LIMIT_ARG), token->text);
}

/* What the last bracket that is open stands for. */
static int innermost(const struct parser *parser)
{
	for (int i = parser->pending_count - 1; i >= 0; i--)
		if (parser->pending[i] <= OPERATOR_CALL)
			return parser->pending[i];
	return -1;
}

/* ( is not closed before the present token. */
static bool refuse_open(struct parser *parser)
{
	const struct token *token = &parser->lex->token;
	const size_t len = token->kind == TOKEN_NEWLINE ? 0 : token->len;
	struct diag place = *parser->place;

	place.id = DIAG_BAD_EXPRESSION;
	if (parser->shift >= 0)
		place.column = token->column + parser->shift;
	return diag_add(parser->diags, place, "%.*s" DIAG_AND ")", (int)(len < LIMIT_ARG / 2 ? len : LIMIT_ARG / 2),
			token->text);
}

static bool add_node(struct parser *parser, struct expr_node node)
{
	struct expr *out = parser->out;

	if (out->count == LIMIT_EXPR_NODES || parser->value_count > PENDING)
		return refuse(parser, DIAG_EXPR_TOO_DEEP);
	out->node[out->count] = node;
	parser->value[parser->value_count++] = (int16_t)out->count++;
	return true;
}

/* Pops the operator on top and gives it its operands. */
static bool reduce(struct parser *parser)
{
	int which = parser->pending[--parser->pending_count];
	const struct operator *operator = &operators[which];
	struct expr_node node = { .op = (enum expr_op)operator->op,
				  .fn = (enum word)operator->fn, .lazy = operator->lazy,
				  .left = -1, .right = -1 };

	if (which >= OPERATOR_BINARY)
		node.right = parser->value[--parser->value_count];
	else
		parser->nested--;
	node.left = parser->value[--parser->value_count];
	return add_node(parser, node);
}

/* Pops all operators that bind at least as strongly as @strength, up to a ( or [. */
static bool reduce_to(struct parser *parser, int strength)
{
	while (parser->pending_count) {
		int top = parser->pending[parser->pending_count - 1];

		if (top <= OPERATOR_CALL || operators[top].strength < strength)
			break;
		if (!reduce(parser))
			return false;
	}
	return true;
}

static bool push(struct parser *parser, int which)
{
	if (which < OPERATOR_BINARY && ++parser->nested > LIMIT_EXPR_DEPTH)
		return refuse(parser, DIAG_EXPR_TOO_DEEP);
	if (parser->pending_count == PENDING)
		return refuse(parser, DIAG_EXPR_TOO_DEEP);
	parser->pending[parser->pending_count++] = (uint8_t)which;
	lex_next(parser->lex);
	return true;
}

static bool is_operand(const struct lex *lex)
{
	switch (lex->token.kind) {
	case TOKEN_NUMBER:
	case TOKEN_ADDRESS:
		return true;
	case TOKEN_NAME:
		return !lex_is(lex, "AND") && !lex_is(lex, "OR") &&
		       !lex_is(lex, "XOR") && !lex_is(lex, "MOD") &&
		       !lex_is(lex, "AND_THEN") && !lex_is(lex, "OR_ELSE");
	case TOKEN_END:
	case TOKEN_NEWLINE:
	case TOKEN_STRING:
	case TOKEN_COMMENT:
	case TOKEN_SYMBOL:
	case TOKEN_BAD:
		break;
	}
	return false;
}

/* From the [ or , at the token, steps over a name or number behind it. */
static bool skip_one_index(struct lex *at)
{
	lex_next(at);
	if (lex_is(at, "-") || lex_is(at, "+")) {
		lex_next(at);
		if (at->token.kind != TOKEN_NUMBER)
			return false;
	}
	if (at->token.kind != TOKEN_NUMBER && at->token.kind != TOKEN_NAME &&
	    at->token.kind != TOKEN_ADDRESS)
		return false;
	lex_next(at);
	return true;
}

/* From the [ at the token to the ] of `[3]`, `[i, -2]`; false: an index is an expression. */
static bool skip_simple_index(struct lex *lex)
{
	struct lex at = *lex;

	do {
		if (!skip_one_index(&at))
			return false;
	} while (lex_is(&at, ","));
	if (!lex_is(&at, "]"))
		return false;
	*lex = at;
	return true;
}

/* From the last token of a name or index, steps over a path with simple indices,
 * `[2].Times`, to its last token. Stops before an index that is an expression. */
static void expr_skip_path(struct lex *lex)
{
	struct lex at = *lex;
	bool dots = lex_is(lex, "]");

	for (;;) {
		lex_next(&at);
		if (lex_is(&at, "^")) {
			dots = true;
		} else if (lex_is(&at, "[")) {
			if (!skip_simple_index(&at))
				return;
			dots = true;
		} else if (!dots || !lex_is(&at, ".") || lex_next(&at) != TOKEN_NAME) {
			return;
		} else {
			dots = false;
		}
		*lex = at;
	}
}

size_t expr_array(const char *text, size_t len)
{
	int open = 0;

	while (len > 0) {
		len--;
		open += text[len] == ']';
		open -= text[len] == '[';
		if (open == 0)
			break;
	}
	return len;
}

/* ---- parts of bit strings ---- */

static const struct { char letter; uint8_t bits; } sizes[] = {
	{ 'X', 1 }, { 'B', 8 }, { 'W', 16 }, { 'D', 32 }, { 'L', 64 },
};

unsigned int expr_part_print(unsigned int of, bool percent, int index, char *out, size_t size)
{
	for (size_t i = 0; i < sizeof(sizes) / sizeof(*sizes) && sizes[i].bits < of; i++) {
		const int count = (int)(of / sizes[i].bits);

		if (index < count && i == 0 && !percent)
			snprintf(out, size, "%d", index);
		else if (index < count)
			snprintf(out, size, "%%%c%d", sizes[i].letter, index);
		if (index < count)
			return sizes[i].bits;
		index -= count;
	}
	return 0;
}

/* `3`, `%X3`, `%B1`. */
static bool one_part(const char *at, size_t len, unsigned int *bits, unsigned int *number)
{
	const char *end = at + len;

	*bits = len && *at != '%' ? 1 : 0;
	*number = 0;
	for (size_t i = 0; len > 2 && *at == '%' && i < sizeof(sizes) / sizeof(*sizes); i++)
		if (ascii_upper(at[1]) == sizes[i].letter)
			*bits = sizes[i].bits;
	at += *at == '%' ? 2 : 0;
	if (!*bits || at == end || end - at > 2)
		return false;
	for (; at < end; at++) {
		if (!ascii_digit(*at))
			return false;
		*number = *number * 10 + (unsigned int)(*at - '0');
	}
	return true;
}

bool expr_part(struct expr_tail tail, unsigned int *bits, unsigned int *number)
{
	const char *at = tail.text, *end = at + tail.len;
	unsigned int below = 0, before = 0;

	do {
		const char *dot, *stop;

		at += at != tail.text; /* the dot */
		dot = memchr(at, '.', (size_t)(end - at));
		stop = dot ? dot : end;
		while (at < stop && *at == ' ')
			at++;
		if (!one_part(at, (size_t)(stop - at), bits, number) ||
		    (before && (*bits >= before || *bits * (*number + 1) > before)))
			return false;
		below += *bits * *number;
		before = *bits;
		at = stop;
	} while (at < end);
	*number = below / *bits;
	return true;
}

/* Bytes of the number behind the last dot of the name `Word.3` at the token; 0: there is none. */
static size_t bit_len(const struct token *token)
{
	struct iec_addr addr;
	size_t len = 0;

	while (token->kind == TOKEN_NAME && len < token->len && ascii_digit(token->text[token->len - 1 - len]))
		len++;
	if (!len || len + 1 >= token->len || token->text[token->len - 1 - len] != '.')
		return 0;
	return iec_addr_parse(token->text, token->len, &addr) == ADDR_NONE ? len : 0; /* I0.3 */
}

static bool is_number(const struct token *token)
{
	size_t digits = 0;

	while (digits < token->len && ascii_digit(token->text[digits]))
		digits++;
	return digits == token->len;
}

/* @bit, a part so far, goes on with the token. */
static void take_part(struct expr_tail *bit, const struct token *token)
{
	const char *begin = bit->len ? bit->text : token->text;
	const size_t len = (size_t)(token->text + token->len - begin);

	*bit = (struct expr_tail){ begin, (uint16_t)(len < LIMIT_NAME ? len : LIMIT_NAME) };
}

/* On the last token of a path: where the path ends, without the bit behind it. parser->bit gets
 * that bit, or what follows in tokens of their own: `.%W1.%X3`. */
static const char *take_bit(struct parser *parser)
{
	struct lex *lex = parser->lex;
	const struct token *token = &lex->token;
	const char *end = token->text + token->len;
	const size_t len = bit_len(token);
	struct lex ahead = *lex;

	parser->bit = (struct expr_tail){ end - len, (uint16_t)len };
	if (len)
		return end - len - 1;
	while (lex_next(&ahead) == TOKEN_SYMBOL && lex_is(&ahead, ".")) {
		lex_next(&ahead);
		if (ahead.token.kind != TOKEN_ADDRESS &&
		    (ahead.token.kind != TOKEN_NUMBER || !is_number(&ahead.token)))
			break;
		take_part(&parser->bit, &ahead.token);
		*lex = ahead;
	}
	return end;
}

/* The place that was read last, or the part of it that was named. */
static bool add_bit(struct parser *parser, const char *text)
{
	struct expr_node node = { .op = EXPR_BIT, .text = text, .tail = parser->bit, .right = -1 };

	if (!parser->bit.len)
		return true;
	node.len = (uint16_t)(parser->bit.text + parser->bit.len - text);
	node.left = parser->value[--parser->value_count];
	parser->bit.len = 0;
	return add_node(parser, node);
}

/* ---- indices ---- */

/* From the ] of an index that is an expression: takes the path behind it and stops on
 * its last token. */
static bool take_tail(struct parser *parser, struct expr_tail *out)
{
	const char *text = parser->lex->token.text + 1;
	size_t len;

	expr_skip_path(parser->lex);
	len = (size_t)(take_bit(parser) - text);
	if (len > LIMIT_NAME)
		return refuse(parser, DIAG_NAME_TOO_LONG);
	*out = (struct expr_tail){ text, (uint16_t)len };
	return true;
}

/* The next token is [ with an index that is an expression: opens it, to be closed at
 * its ]. */
static bool open_index(struct parser *parser, struct expr_open open)
{
	if (parser->indexed == LIMIT_EXPR_DEPTH)
		return refuse(parser, DIAG_EXPR_TOO_DEEP);
	if (!push(parser, OPERATOR_INDEX))
		return false;
	if (open.base >= 0)
		parser->out->node[open.base].inner = true;
	parser->out->open[parser->indexed++] = open;
	parser->opened++;
	return true;
}

/* ---- functions ---- */

/* Whether the token is the name of a function with a ( behind it. */
static bool is_call(const struct lex *lex)
{
	struct lex ahead = *lex;

	if (lex->token.kind != TOKEN_NAME)
		return false;
	lex_next(&ahead);
	return lex_is(&ahead, "(");
}

static struct expr_tail token_text(const struct lex *lex)
{
	return (struct expr_tail){ lex->token.text, (uint16_t)lex->token.len };
}

bool expr_inverts(const struct lex *lex)
{
	struct lex ahead = *lex;

	return lex_is(&ahead, "NOT") && lex_next(&ahead) == TOKEN_NAME && lex_next(&ahead) == TOKEN_SYMBOL &&
	       lex_is(&ahead, "=>");
}

/* `MN :=` or `OUT =>` before an argument, if it is there. */
static bool take_pin(struct parser *parser)
{
	struct expr_call *call = &parser->out->call[parser->called - 1];
	struct lex ahead;

	call->pin = (struct expr_tail){ "", 0 };
	call->output = false;
	call->inverted = expr_inverts(parser->lex);
	if (call->inverted)
		lex_next(parser->lex);
	ahead = *parser->lex;
	if (ahead.token.kind != TOKEN_NAME)
		return true;
	lex_next(&ahead);
	call->output = lex_is(&ahead, "=>");
	if (!lex_is(&ahead, ":=") && !call->output)
		return true;
	if (parser->lex->token.len > LIMIT_NAME)
		return refuse(parser, DIAG_NAME_TOO_LONG);
	call->pin = token_text(parser->lex);
	*parser->lex = ahead;
	lex_next(parser->lex);
	return true;
}

/* The argument at the lexer. Those with nothing behind := or => are passed over, as if they were not there.
 * @more: an operand follows; false on failure, too. */
static bool open_argument(struct parser *parser, bool *more)
{
	const struct expr_call *call = &parser->out->call[parser->called - 1];

	*more = false;
	do {
		if (!take_pin(parser))
			return false;
		*more = !call->pin.len || (!lex_is(parser->lex, ",") && !lex_is(parser->lex, ")"));
	} while (!*more && lex_accept(parser->lex, ","));
	return true;
}

static bool add_call(struct parser *parser, const struct expr_call *call)
{
	return add_node(parser, (struct expr_node){
		.op = EXPR_CALL, .text = call->name.text, .len = call->name.len,
		.left = call->last, .right = -1 });
}

/* At the name of a function. @more: its first argument follows. */
static bool open_call(struct parser *parser, bool *more)
{
	struct expr_call call = { token_text(parser->lex), { "", 0 }, -1, false, false };

	if (parser->called == LIMIT_EXPR_DEPTH)
		return refuse(parser, DIAG_EXPR_TOO_DEEP);
	if (parser->lex->token.len > LIMIT_NAME)
		return refuse(parser, DIAG_NAME_TOO_LONG);
	lex_next(parser->lex);
	if (!push(parser, OPERATOR_CALL))
		return false;
	parser->out->call[parser->called++] = call;
	parser->opened++;
	*more = !lex_is(parser->lex, ")");
	if (*more && (!open_argument(parser, more) || *more))
		return *more;
	parser->pending_count--; /* F() */
	parser->opened--;
	parser->nested--;
	parser->called--;
	lex_next(parser->lex);
	return add_call(parser, &call);
}

/* The operand before the , or ) is an argument. */
static bool close_argument(struct parser *parser)
{
	struct expr_call *call = &parser->out->call[parser->called - 1];
	struct expr_node node = {
		.op = EXPR_ARG, .text = call->pin.text, .len = call->pin.len,
		.left = parser->value[--parser->value_count], .right = call->last,
		.output = call->output, .inverted = call->inverted,
	};

	if (!add_node(parser, node))
		return false;
	call->last = parser->value[--parser->value_count];
	return true;
}

/* ---- operands ---- */

/* @more: an operand follows, behind a [ or the ( of a function. */
static bool take_operand(struct parser *parser, bool *more)
{
	struct lex *lex = parser->lex;
	const struct token start = lex->token, *token = &start;
	bool literal = token->kind == TOKEN_NUMBER || lex_is(lex, "TRUE") ||
		       lex_is(lex, "FALSE");
	struct expr_node node = {
		.op = literal ? EXPR_LITERAL : EXPR_NAME,
		.text = token->text, .left = -1, .right = -1,
	};
	size_t len;

	*more = false;
	if (!is_operand(lex) && !is_call(lex))
		return refuse(parser, DIAG_BAD_EXPRESSION);
	if (!literal && is_call(lex))
		return open_call(parser, more);
	if (token->len > LIMIT_NAME)
		return refuse(parser, literal ? DIAG_LITERAL_RANGE : DIAG_NAME_TOO_LONG);
	parser->bit.len = 0;
	len = token->len;
	if (token->kind != TOKEN_NUMBER) {
		expr_skip_path(lex);
		len = (size_t)((literal ? token->text + token->len : take_bit(parser)) - token->text);
	}
	if (len > 2 * LIMIT_NAME)
		return refuse(parser, DIAG_NAME_TOO_LONG);
	node.len = (uint16_t)len;
	lex_next(lex);
	*more = token->kind != TOKEN_NUMBER && !parser->bit.len && lex_is(lex, "[");
	return *more ? open_index(parser, (struct expr_open){ node.text, node.len, -1 }) :
		       add_node(parser, node) && add_bit(parser, node.text);
}

/* Any number of signs, ( and `Table[`, then a name or a constant. */
static bool take_prefix_and_operand(struct parser *parser)
{
	for (;;) {
		bool more = true;
		int which;

		while (lex_is(parser->lex, "+")) /* a sign */
			lex_next(parser->lex);
		if (lex_is(parser->lex, "("))
			which = OPERATOR_PAREN;
		else if (lex_is(parser->lex, "-"))
			which = OPERATOR_NEG;
		else if (lex_is(parser->lex, "NOT"))
			which = OPERATOR_NOT;
		else if (!take_operand(parser, &more))
			return false;
		else if (more)
			continue;
		else
			return true;
		if (!push(parser, which))
			return false;
		parser->opened += which == OPERATOR_PAREN;
	}
}

/* The expression in brackets is the index of the array before them. */
static bool close_index(struct parser *parser)
{
	int top = --parser->indexed;
	const struct expr_open *open = &parser->out->open[top];
	struct expr_node node = {
		.op = EXPR_INDEX, .text = open->text, .len = open->len,
		.right = open->base,
	};

	node.left = parser->value[--parser->value_count];
	return take_tail(parser, &node.tail) && add_node(parser, node) &&
	       add_bit(parser, parser->bit.text);
}

/* Behind an element: opens the next index of its path, if that is an expression. */
static bool go_on(struct parser *parser, bool *more)
{
	struct expr_open open = { "", 0, -1 };

	*more = lex_is(parser->lex, "[") &&
		parser->out->node[parser->out->count - 1].op == EXPR_INDEX;
	if (!*more)
		return true;
	open.base = parser->value[--parser->value_count];
	return open_index(parser, open);
}

/* The , of `A[i + 1, j]`: what precedes it is an index of its own, as in A[i + 1][j]. */
static bool next_index(struct parser *parser, bool *more)
{
	int top = --parser->indexed;
	const struct expr_open *open = &parser->out->open[top];
	struct expr_node node = {
		.op = EXPR_INDEX, .text = open->text, .len = open->len, .right = open->base,
		.tail = { parser->lex->token.text, 0 },
	};
	struct expr_open again = { "", 0, -1 };

	node.left = parser->value[--parser->value_count];
	if (!add_node(parser, node))
		return false;
	parser->pending_count--;
	parser->opened--;
	parser->nested--;
	again.base = parser->value[--parser->value_count];
	*more = true;
	return open_index(parser, again);
}

/* Closes the innermost bracket at the current token. @more: an operand follows: another
 * index of the path, or another argument. */
static bool close_one(struct parser *parser, bool *more)
{
	const int top = parser->pending[parser->pending_count - 1];
	const bool index = lex_is(parser->lex, "]"), comma = lex_is(parser->lex, ",");

	if (comma && top == OPERATOR_INDEX)
		return next_index(parser, more);
	if (index && top == OPERATOR_PAREN)
		return refuse_open(parser);
	if (index != (top == OPERATOR_INDEX) || (comma && top != OPERATOR_CALL))
		return refuse(parser, DIAG_BAD_EXPRESSION);
	if (top == OPERATOR_CALL && !close_argument(parser))
		return false;
	if (comma) {
		lex_next(parser->lex);
		if (!open_argument(parser, more) || *more)
			return *more;
	}
	parser->pending_count--;
	parser->opened--;
	parser->nested--;
	if (index && !close_index(parser))
		return false;
	if (top == OPERATOR_CALL &&
	    !add_call(parser, &parser->out->call[--parser->called]))
		return false;
	lex_next(parser->lex);
	return !index || go_on(parser, more);
}

static bool close_parens(struct parser *parser, bool *more)
{
	*more = false;
	while (parser->opened && !*more &&
	       (lex_is(parser->lex, ")") || lex_is(parser->lex, "]") ||
		lex_is(parser->lex, ",")))
		if (!reduce_to(parser, 1) || !close_one(parser, more))
			return false;
	return true;
}

/* The binary operator at the token; -1: none, the expression ends. */
static int binary_at(const struct lex *lex)
{
	char first;

	if (lex->token.kind != TOKEN_SYMBOL && lex->token.kind != TOKEN_NAME)
		return -1;
	first = ascii_upper(lex->token.text[0]);
	for (int i = OPERATOR_BINARY; i < OPERATORS; i++)
		if (operators[i].word[0] == first && lex_is(lex, operators[i].word))
			return i;
	return -1;
}

static bool parse(struct parser *parser)
{
	for (;;) {
		bool more;
		int which;

		if (!take_prefix_and_operand(parser) ||
		    !close_parens(parser, &more))
			return false;
		if (more)
			continue;
		which = parser->alone && !parser->opened ? -1 : binary_at(parser->lex);
		if (which < 0)
			break;
		if (!reduce_to(parser, operators[which].strength) ||
		    !push(parser, which))
			return false;
	}
	if (parser->opened && innermost(parser) == OPERATOR_PAREN)
		return refuse_open(parser);
	if (parser->opened || (!parser->alone && lex_is(parser->lex, "(")))
		return refuse(parser, DIAG_BAD_EXPRESSION);
	if (!reduce_to(parser, 1))
		return false;
	parser->out->root = parser->value[0];
	return true;
}

/* The stacks are not cleared: they are written before they are read. */
static void parser_init(struct parser *parser, struct lex *lex,
			struct expr *out, struct diag_list *diags,
			const struct diag *place)
{
	parser->lex = lex;
	parser->out = out;
	parser->diags = diags;
	parser->place = place;
	parser->shift = 0;
	parser->opened = parser->nested = parser->indexed = parser->called = 0;
	parser->pending_count = parser->value_count = 0;
	parser->alone = false;
	out->count = 0;
	out->root = -1;
	out->target = NULL;
	out->target_len = 0;
	out->target_index = -1;
	out->target_tail = out->target_bit = (struct expr_tail){ NULL, 0 };
	out->target_base = -1;
	out->target_points = out->target_tried = false;
	parser->bit = out->target_bit;
}

bool expr_parse(struct lex *lex, struct expr *out, struct diag_list *diags,
		struct diag place)
{
	struct parser parser;

	parser_init(&parser, lex, out, diags, &place);
	return parse(&parser);
}

bool expr_parse_place(struct lex *lex, struct expr *out, struct diag_list *diags,
		      struct diag place)
{
	struct parser parser;

	parser_init(&parser, lex, out, diags, &place);
	parser.alone = true;
	return parse(&parser);
}

/* Makes the part of the target so far an array that an index follows. */
static bool keep_target(struct parser *parser)
{
	struct expr *out = parser->out;
	struct expr_node node = {
		.op = EXPR_INDEX, .text = out->target, .len = (uint16_t)out->target_len,
		.tail = out->target_tail, .left = (int16_t)out->target_index,
		.right = (int16_t)out->target_base, .inner = true,
	};

	if (out->target_index < 0)
		return true;
	if (!add_node(parser, node))
		return false;
	out->target_base = parser->value[--parser->value_count];
	return true;
}

/* From the [ of an index that is an expression to the path behind its ]. */
static bool take_target_index(struct parser *parser)
{
	struct lex *lex = parser->lex;
	struct expr *out = parser->out;

	do {
		if (!keep_target(parser))
			return false;
		lex_next(lex);
		if (!parse(parser))
			return false;
		out->target_index = out->root;
		out->target_tail = (struct expr_tail){ lex->token.text, 0 };
		parser->value_count = 0;
	} while (lex_is(lex, ","));
	if (!lex_is(lex, "]"))
		return refuse(parser, DIAG_BAD_EXPRESSION);
	if (!take_tail(parser, &out->target_tail))
		return false;
	out->target_bit = parser->bit;
	lex_next(lex);
	return true;
}

/* Steps behind the ] that closes the [ at the token; false: there is none. */
static bool skip_brackets(struct lex *lex)
{
	int depth = 0, parens = 0;

	for (;;) {
		if (lex_is(lex, "["))
			depth++;
		else if (lex_is(lex, "]") && --depth == 0)
			return lex_next(lex), true;
		else if (lex->token.kind == TOKEN_END ||
			 lex->token.kind == TOKEN_NEWLINE || (lex_is(lex, ":=") && parens <= 0))
			return false;
		parens += lex_is(lex, "("); /* T[F(A := 1)] */
		parens -= lex_is(lex, ")");
		lex_next(lex);
	}
}

/* REF= at the token? */
static bool is_points(struct lex lex)
{
	return lex_is(&lex, "REF") && lex_next(&lex) == TOKEN_SYMBOL && lex_is(&lex, "=");
}

/* Whether the expression at the token is followed by := or REF=. */
static bool expr_has_target(struct lex lex)
{
	if (lex.token.kind != TOKEN_NAME && lex.token.kind != TOKEN_ADDRESS)
		return false;
	lex_next(&lex);
	for (;;) {
		struct lex ahead = lex;

		if (lex_accept(&lex, "^"))
			continue;
		if (lex_is(&lex, "[") && !skip_brackets(&lex))
			return false;
		if (lex.at != ahead.at)
			continue;
		if (!lex_is(&lex, ".") || lex_next(&ahead) == TOKEN_SYMBOL)
			break;
		lex = ahead; /* a member, or .3, .%B1 */
		lex_next(&lex);
	}
	return lex_is(&lex, ":=") || lex_is(&lex, "?=") || is_points(lex);
}

/* `target :=`, if the text begins so; otherwise the lexer does not move. */
static bool take_target(struct parser *parser)
{
	struct lex *lex = parser->lex;
	struct expr *out = parser->out;

	if (!expr_has_target(*lex))
		return true;
	out->target = lex->token.text;
	expr_skip_path(lex);
	out->target_len = (size_t)(take_bit(parser) - out->target);
	out->target_bit = parser->bit;
	if (out->target_len > 2 * LIMIT_NAME)
		return refuse(parser, DIAG_NAME_TOO_LONG);
	lex_next(lex);
	while (!out->target_bit.len && lex_is(lex, "["))
		if (!take_target_index(parser))
			return false;
	out->target_points = is_points(*lex);
	out->target_tried = lex_accept(lex, "?=");
	if (out->target_tried)
		return true;
	if (out->target_points)
		lex_next(lex);
	return lex_accept(lex, out->target_points ? "=" : ":=") || refuse(parser, DIAG_BAD_EXPRESSION);
}

static bool parse_cell(struct parser *parser)
{
	return take_target(parser) && parse(parser);
}

bool expr_parse_cell(struct lex *lex, struct expr *out, struct diag_list *diags,
		     struct diag place)
{
	struct parser parser;

	parser_init(&parser, lex, out, diags, &place);
	return parse_cell(&parser);
}

/* Does an operator between two operands stand here? */
static bool is_binary(const struct lex *lex)
{
	for (int i = OPERATOR_BINARY; i < OPERATORS; i++)
		if (lex_is(lex, operators[i].word))
			return true;
	return false;
}

bool expr_begins(struct lex lex)
{
	int signs = 0;

	if (lex.token.kind == TOKEN_NUMBER && literal_is_named(lex.token.text, lex.token.len))
		return true;
	for (; lex_is(&lex, "-") || lex_is(&lex, "+"); signs++)
		lex_next(&lex);
	if (lex_is(&lex, "(") || lex_is(&lex, "NOT"))
		return true;
	if (lex.token.kind == TOKEN_NAME && !lex_is(&lex, "TRUE") && !lex_is(&lex, "FALSE"))
		return true;
	if (lex.token.kind != TOKEN_NUMBER && lex.token.kind != TOKEN_NAME &&
	    lex.token.kind != TOKEN_ADDRESS)
		return false;
	lex_next(&lex);
	return signs > 1 || is_binary(&lex);
}

void expr_skip(struct lex *lex, const char **end)
{
	static const char *const stops[] = { ",", ":", ":=", ".", "]", ")" };
	int open = 0;

	for (; lex->token.kind != TOKEN_END && !lex_is(lex, ";"); lex_next(lex)) {
		for (size_t i = 0; open == 0 && i < sizeof(stops) / sizeof(*stops); i++)
			if (lex_is(lex, stops[i]))
				return;
		open += lex_is(lex, "(") || lex_is(lex, "[");
		open -= lex_is(lex, ")") || lex_is(lex, "]");
		*end = lex->token.text + lex->token.len;
	}
}

bool expr_parse_text(const char *text, size_t len, struct expr *out,
		     struct diag_list *diags, struct diag place)
{
	struct parser parser;
	struct lex lex;

	lex_init(&lex, text, len);
	lex_next(&lex);
	parser_init(&parser, &lex, out, diags, &place);
	parser.shift = place.column - 1;
	if (!parse_cell(&parser))
		return false;
	if (lex.token.kind != TOKEN_END)
		return refuse(&parser, DIAG_BAD_EXPRESSION);
	return true;
}

/* ---- marks ---- */

/* NOT or the sign in front of @operand. */
static const char *sign_before(const char *operand, const char *text, bool is_not)
{
	while (operand > text && strchr(" \t\r\n(", operand[-1]))
		operand--;
	return operand - text >= (is_not ? 3 : 1) ? operand - (is_not ? 3 : 1) : text;
}

const char *expr_first(const struct expr *expr, int index, const char *text)
{
	const struct expr_node *node = &expr->node[index];

	while (node->op == EXPR_INDEX && node->right >= 0)
		node = &expr->node[node->right];
	if (node->op == EXPR_NOT || node->op == EXPR_NEG)
		return sign_before(expr_first(expr, node->left, text), text, node->op == EXPR_NOT);
	if (node->op == EXPR_NAME || node->op == EXPR_INDEX || node->op == EXPR_LITERAL || node->op == EXPR_CALL ||
	    node->left < 0)
		return node->text;
	return expr_first(expr, node->left, text);
}

uint16_t expr_mark(const struct expr *expr, int index, const char *text)
{
	const struct expr_node *node = &expr->node[index];
	const char *place = expr_first(expr, index, text), *other;
	bool sides = false;
	size_t mark;

	if (node->op == EXPR_FN || node->op == EXPR_AND || node->op == EXPR_XOR || node->op == EXPR_OR) {
		other = node->right >= 0 ? expr_first(expr, node->right, text) : place;
		place = other > place ? other : place; /* a check may turn the sides */
		sides = true;
	} else if (node->op != EXPR_CALL && node->op != EXPR_NOT && node->op != EXPR_NEG) {
		return 0;
	}
	mark = place && place >= text ? 2 * (size_t)(place - text) + 1 + sides : 0;
	return mark <= UINT16_MAX ? (uint16_t)mark : 0;
}
