/* SPDX-License-Identifier: MIT
 *
 * read_operand - names, strings, values and parameters in cells, declarations and lists.
 *
 * It judges form only; check/ finds the meaning of a name.
 */
#include "engine/base/name.h"
#include "engine/text/reader.h"

#include "engine/base/ascii.h"
#include "engine/base/literal.h"

#include <stdio.h>
#include <string.h>

/* A name may carry a pin behind a dot; each part has its own limit. */
static bool check_length(struct reader *r)
{
	const char *text = r->lex.token.text;
	size_t len = r->lex.token.len;
	const char *dot = memchr(text, '.', len);
	size_t head = dot ? (size_t)(dot - text) : len;

	if (head > LIMIT_NAME || len - head > LIMIT_NAME + 1)
		return reader_fail_token(r, DIAG_NAME_TOO_LONG);
	return true;
}

bool reader_name(struct reader *r, const char *wanted, uint32_t *id)
{
	const struct token *token = &r->lex.token;

	if (token->kind != TOKEN_NAME || memchr(token->text, '.', token->len))
		return reader_fail_word(r, DIAG_EXPECTED, wanted);
	if (!check_length(r))
		return false;
	*id = reader_intern(r, token->text, token->len);
	return true;
}

/* The byte that $ and this letter stand for; 0: no such escape. */
static char escape(char c)
{
	switch (ascii_upper(c)) {
	case '$':
	case '"':
		return c;
	case 'N':
	case 'L':
		return '\n';
	case 'R':
		return '\r';
	case 'T':
		return '\t';
	default:
		return 0;
	}
}

bool reader_string(struct reader *r, uint32_t *id)
{
	const char *at = r->lex.token.text + 1;
	const char *end = at + r->lex.token.len - 2;

	buffer_clear(&r->text);
	while (at < end) {
		const char *dollar = memchr(at, '$', (size_t)(end - at));
		const char *stop = dollar ? dollar : end;

		buffer_add(r, &r->text, at, (size_t)(stop - at));
		at = stop;
		if (at == end)
			break;
		char c = at + 1 < end ? escape(at[1]) : 0;
		if (c == 0)
			return reader_fail(r, DIAG_SYNTAX, at,
					   at + 1 < end ? 2 : 1);
		buffer_add(r, &r->text, &c, 1);
		at += 2;
	}
	*id = buffer_take(r, &r->text);
	return true;
}

bool reader_unescape(struct reader *r, const struct token *token,
		     struct diag_list *diags, uint32_t *id)
{
	struct token at = r->lex.token;
	struct diag_list *own = r->diags;
	bool good;

	r->lex.token = *token;
	r->diags = diags;
	good = reader_string(r, id);
	r->lex.token = at;
	r->diags = own;
	return good;
}

static bool check_constant(struct reader *r, const char *text, size_t len)
{
	struct literal literal;

	if (literal_is_named(text, len))
		return true;
	switch (literal_parse(text, len, &literal)) {
	case LITERAL_OK:
		return true;
	case LITERAL_RANGE:
		return reader_fail_range(r, text, len);
	case LITERAL_NONE:
	case LITERAL_BAD:
		break;
	}
	return reader_fail(r, DIAG_BAD_LITERAL, text, len);
}

bool reader_sign(struct reader *r)
{
	if (!reader_is(r, '-') && !reader_is(r, '+'))
		return false;
	buffer_add(r, &r->text, r->lex.token.text, 1);
	reader_step(r);
	return true;
}

/* Reads one index at the cursor, and steps behind it. */
static bool add_one_index(struct reader *r)
{
	const struct token *token = &r->lex.token;

	if (reader_sign(r) && token->kind != TOKEN_NUMBER)
		return reader_fail_token(r, DIAG_BAD_LITERAL);
	if (token->kind != TOKEN_NUMBER && token->kind != TOKEN_NAME &&
	    token->kind != TOKEN_ADDRESS)
		return reader_fail_word(r, DIAG_EXPECTED, "index");
	if (token->kind == TOKEN_NAME && !check_length(r))
		return false;
	buffer_add(r, &r->text, token->text, token->len);
	reader_step(r);
	return true;
}

/* Reads `[3]`, `[-3]`, `[i]` or `[i, 3]` after the cursor; leaves it on the ]. */
static bool add_index(struct reader *r)
{
	reader_step(r);
	buffer_add(r, &r->text, "[", 1);
	reader_step(r);
	if (!add_one_index(r))
		return false;
	while (reader_is(r, ',')) {
		buffer_add(r, &r->text, ", ", 2);
		reader_step(r);
		if (!add_one_index(r))
			return false;
	}
	if (!reader_is(r, ']'))
		return reader_fail_word(r, DIAG_EXPECTED, "]");
	buffer_add(r, &r->text, "]", 1);
	return true;
}

/* Does `.%X3` or `.3` follow, the part of a number? */
static bool part_follows(const struct reader *r)
{
	struct lex ahead = r->lex;

	lex_next(&ahead);
	if (!lex_is(&ahead, "."))
		return false;
	lex_next(&ahead);
	return ahead.token.kind == TOKEN_ADDRESS || ahead.token.kind == TOKEN_NUMBER;
}

/* Reads it; leaves the cursor on its last token. */
static void add_part(struct reader *r)
{
	reader_step(r);
	buffer_add(r, &r->text, ".", 1);
	reader_step(r);
	buffer_add(r, &r->text, r->lex.token.text, r->lex.token.len);
}

/* Does `[`, or in a list `^` behind a pointer, follow? */
static bool goes_on(const struct reader *r)
{
	return reader_peek(r, "[") || (r->il && reader_peek(r, "^"));
}

/* Reads `^`; leaves the cursor on it. */
static bool add_arrow(struct reader *r)
{
	reader_step(r);
	buffer_add(r, &r->text, "^", 1);
	return true;
}

/* Reads an index, members and a part after a name or address, as in `Line[2].Times[i].3` or `Line^.Next`; leaves
 * the cursor on the last token. */
static bool add_path(struct reader *r)
{
	const struct token *token = &r->lex.token;

	while (goes_on(r)) {
		if (!(reader_peek(r, "^") ? add_arrow(r) : add_index(r)))
			return false;
		if (goes_on(r))
			continue;
		if (!reader_peek(r, "."))
			return true;
		if (part_follows(r))
			break;
		reader_step(r);
		buffer_add(r, &r->text, ".", 1);
		reader_step(r);
		if (token->kind != TOKEN_NAME)
			return reader_fail_word(r, DIAG_EXPECTED, "name of a member");
		if (!check_length(r))
			return false;
		buffer_add(r, &r->text, token->text, token->len);
	}
	if (part_follows(r))
		add_part(r);
	return true;
}

bool reader_instance(struct reader *r, uint32_t *id)
{
	const struct token *token = &r->lex.token;

	if (r->plain && token->kind == TOKEN_NAME && memchr(token->text, '.', token->len) &&
	    !reader_peek(r, "[")) { /* an action: Pump.Reset */
		*id = reader_intern(r, token->text, token->len);
		return check_length(r);
	}
	if (!reader_name(r, "name", id))
		return false;
	if (!reader_peek(r, "["))
		return true;
	buffer_clear(&r->text);
	buffer_add(r, &r->text, token->text, token->len);
	if (!add_path(r))
		return false;
	*id = buffer_take(r, &r->text);
	return true;
}

/* `REF(Name)` of a list, which is `&Name` in it; leaves the cursor on the ). */
static bool add_reference(struct reader *r)
{
	reader_step(r);
	reader_step(r);
	if (r->lex.token.kind != TOKEN_NAME)
		return reader_fail_word(r, DIAG_EXPECTED, "name");
	buffer_add(r, &r->text, "&", 1);
	buffer_add(r, &r->text, r->lex.token.text, r->lex.token.len);
	if (!check_length(r) || !add_path(r))
		return false;
	reader_step(r);
	return reader_is(r, ')') || reader_fail_word(r, DIAG_EXPECTED, ")");
}

static bool is_reference(const struct reader *r)
{
	const struct token *token = &r->lex.token;

	return r->il && token->kind == TOKEN_NAME && reader_peek(r, "(") &&
	       (ascii_is("REF", token->text, token->len) || ascii_is("ADR", token->text, token->len));
}

bool reader_fail_operand(struct reader *r, const struct token *word)
{
	const enum token_kind kind = r->lex.token.kind;

	if (!r->place.row || reader_is(r, '|') || kind == TOKEN_NEWLINE || kind == TOKEN_END ||
	    kind == TOKEN_COMMENT || kind == TOKEN_BAD)
		return reader_fail(r, DIAG_MISSING_OPERAND, word->text, word->len);
	return reader_fail_token(r, DIAG_EXTRA_TEXT);
}

/* NOT Q => Lamp, Q => NOT Lamp, Q => /Lamp in a cell. */
static bool is_negated(struct reader *r, struct lex ahead)
{
	const bool first = lex_accept(&ahead, "NOT");
	const struct token pin = ahead.token;
	char text[LIMIT_PARTS];

	lex_next(&ahead);
	if (!r->place.row || pin.kind != TOKEN_NAME || !lex_accept(&ahead, "=>") ||
	    !(first || lex_accept(&ahead, "NOT") || lex_accept(&ahead, "/")) || ahead.token.kind != TOKEN_NAME)
		return false;
	snprintf(text, sizeof(text), "NOT %.*s=>%.*s", pin.len < 40 ? (int)pin.len : 40, pin.text,
		 ahead.token.len < 60 ? (int)ahead.token.len : 60, ahead.token.text);
	reader_fail_word(r, DIAG_NEGATED, text);
	return true;
}

bool reader_value(struct reader *r, bool constant, const struct token *word)
{
	const struct token *token = &r->lex.token;
	size_t from = r->text.len;
	struct iec_addr addr;

	if (is_reference(r))
		return add_reference(r);

	if (constant && reader_sign(r) && token->kind != TOKEN_NUMBER)
		return reader_fail_token(r, DIAG_BAD_LITERAL);
	buffer_add(r, &r->text, token->text, token->len);
	if (token->kind == TOKEN_NAME)
		return check_length(r) && add_path(r);
	if (token->kind == TOKEN_ADDRESS) {
		const enum diag_id why = iec_addr_fault(token->text, token->len, &addr);

		if (why != DIAG_COUNT)
			return reader_fail_token(r, why);
		return add_path(r);
	}
	if (token->kind == TOKEN_NUMBER && constant)
		return r->no_memory ||
		       check_constant(r, r->text.text + from,
				      r->text.len - from);
	return reader_fail_operand(r, word);
}

/* Pins of the catalogue become upper case, pins of the project keep their spelling. */
static bool add_pin(struct reader *r)
{
	const struct token *token = &r->lex.token;

	if (token->len > LIMIT_NAME)
		return reader_fail_token(r, DIAG_NAME_TOO_LONG);
	for (size_t i = 0; i < token->len; i++) {
		char c = r->keep_pins ? token->text[i] :
					ascii_upper(token->text[i]);

		buffer_add(r, &r->text, &c, 1);
	}
	return !r->no_memory;
}

bool reader_pin(struct reader *r, uint32_t *id)
{
	buffer_clear(&r->text);
	if (!add_pin(r))
		return false;
	*id = buffer_take(r, &r->text);
	return true;
}

static bool is_twice(const struct reader *r, const struct read_arg *arg)
{
	const char *pin = r->text.text + arg->pin_at;

	for (int i = 0; i < r->arg_count; i++)
		if (name_same(r->text.text + r->arg[i].pin_at, r->arg[i].pin_len, pin,
			      arg->pin_len))
			return true;
	return false;
}

bool reader_arg(struct reader *r)
{
	struct token pin = r->lex.token;
	struct read_arg arg = { 0 };
	bool inverse = false;

	if (is_negated(r, r->lex))
		return false;
	if (pin.kind != TOKEN_NAME || memchr(pin.text, '.', pin.len))
		return reader_fail_token(r, DIAG_EXTRA_TEXT);
	if (r->arg_count == LIMIT_ARGS)
		return reader_fail_many(r, DIAG_TOO_MANY, "parameters", LIMIT_ARGS);
	if (r->text.len > 0)
		buffer_add(r, &r->text, " ", 1);
	arg.pin_at = r->text.len;
	arg.pin_len = pin.len;
	if (!add_pin(r))
		return false;
	if (is_twice(r, &arg))
		return reader_fail_token(r, DIAG_DUPLICATE_ARG);
	reader_step(r);
	arg.output = lex_is(&r->lex, "=>");
	if (!arg.output && !lex_is(&r->lex, ":="))
		return reader_fail(r, DIAG_EXTRA_TEXT, pin.text, pin.len);
	buffer_add(r, &r->text, arg.output ? "=>" : ":=", 2);
	reader_step(r);
	arg.value_at = r->text.len;
	arg.line = r->lex.token.line;
	arg.column = r->lex.token.column;
	if (!arg.output && !r->across_lines && reader_is(r, '/')) { /* in a cell */
		buffer_add(r, &r->text, "/", 1);
		reader_step(r);
		inverse = true;
	}
	if (!reader_value(r, !arg.output && !inverse, &pin))
		return false;
	arg.value_len = r->text.len - arg.value_at;
	r->arg[r->arg_count++] = arg;
	return true;
}
