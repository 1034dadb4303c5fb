/* SPDX-License-Identifier: MIT
 *
 * read_array - ARRAY[low..high] OF, and initial values: [1, 2, 3(7)], (Speed := 5).
 *
 * Bounds are integer constants of one dimension, or constant expressions. check/ finds whether
 * a variable with an address leaves its area.
 */
#include "engine/text/reader.h"

#include "engine/base/literal.h"

#include <stdio.h>
#include <string.h>

/* Reads a bound and steps past it; r->text gets it as written. */
static bool read_bound(struct reader *r, struct var *var, enum written_place where, int64_t *out)
{
	const struct token *token = &r->lex.token;
	bool negative = reader_is(r, '-');
	struct literal literal;

	buffer_clear(&r->text);
	if (reader_begins_expression(r, IEC_DINT))
		return reader_expression(r, var, where);
	if (negative || reader_is(r, '+'))
		reader_step(r);
	if (negative)
		buffer_add(r, &r->text, "-", 1);
	if (token->kind != TOKEN_NUMBER ||
	    literal_parse(token->text, token->len, &literal) != LITERAL_OK ||
	    literal.real || literal.high || literal.type != IEC_NONE ||
	    literal.value.i > INT32_MAX)
		return reader_fail_token(r, DIAG_BAD_BOUNDS);
	*out = negative ? -literal.value.i : literal.value.i;
	buffer_add(r, &r->text, token->text, token->len);
	reader_step(r);
	return true;
}

/* `..` is two symbols for the scanner. */
static bool read_dots(struct reader *r)
{
	for (int i = 0; i < 2; i++) {
		if (!reader_is(r, '.'))
			return reader_fail_word(r, DIAG_EXPECTED, "..");
		reader_step(r);
	}
	return true;
}

bool read_array(struct reader *r, struct var *var)
{
	int64_t low = 0, high = 0;
	uint32_t lowest;

	if (!lex_is(&r->lex, "ARRAY"))
		return true;
	reader_step(r);
	if (!reader_is(r, '['))
		return reader_fail_word(r, DIAG_EXPECTED, "[");
	reader_step(r);
	if (!read_bound(r, var, WRITTEN_LOW, &low))
		return false;
	lowest = buffer_take(r, &r->text);
	if (!read_dots(r) || !read_bound(r, var, WRITTEN_HIGH, &high))
		return false;
	if (!reader_is(r, ']'))
		return reader_fail_word(r, DIAG_EXPECTED, "]");
	if (var->written) {
		var->written->bound[0] = lowest;
		var->written->bound[1] = buffer_take(r, &r->text);
		low = high = 0; /* until check/settle.c computes them */
	}
	if (high < low || high - low >= LIMIT_ELEMENTS) {
		char text[48];

		snprintf(text, sizeof(text), "%lld..%lld", (long long)low,
			 (long long)high);
		return reader_fail_word(r, DIAG_BAD_BOUNDS, text);
	}
	reader_step(r);
	if (!lex_is(&r->lex, "OF"))
		return reader_fail_word(r, DIAG_EXPECTED, "OF");
	reader_step(r);
	var->array = (struct var_array){ (int32_t)low, (uint32_t)(high - low + 1) };
	return true;
}

/* ---- initial values ---- */

/* Reads the `3(` before a value: the count; 1 without. The text of the count is kept too. */
static bool read_times(struct reader *r, uint32_t *times)
{
	const struct token *token = &r->lex.token;
	struct literal literal;

	*times = 1;
	if (token->kind != TOKEN_NUMBER || !reader_peek(r, "("))
		return true;
	if (literal_parse(token->text, token->len, &literal) != LITERAL_OK ||
	    literal.real || literal.high || literal.type != IEC_NONE || literal.value.i < 1 ||
	    literal.value.i > LIMIT_ELEMENTS)
		return reader_fail_token(r, DIAG_LITERAL_RANGE);
	*times = (uint32_t)literal.value.i;
	buffer_add(r, &r->text, token->text, token->len);
	buffer_add(r, &r->text, "(", 1);
	reader_step(r);
	reader_step(r);
	return true;
}

static bool add_values(struct reader *r, struct var *var, uint32_t *room,
		       struct var_init init)
{
	struct var_init *slot;

	if (init.count > *room)
		return reader_fail_word(r, DIAG_TOO_MANY_VALUES, "");
	*room -= init.count;
	slot = arena_push(&r->project->arena, &var->init_list,
			  &var->init_count, sizeof(*slot));
	if (slot)
		*slot = init;
	else
		r->no_memory = true;
	return slot != NULL;
}

/* One value, or several alike. */
static bool read_values(struct reader *r, struct var *var, uint32_t *room)
{
	const size_t from = r->text.len;
	struct var_init init = { 1, { .i = 0 }, 0 };
	size_t value;

	if (!read_times(r, &init.count))
		return false;
	bool several = r->text.len != from;

	value = r->text.len;
	if (several && reader_is(r, ')'))
		init.text = 0; /* n(): n elements keep their 0 */
	else if (!read_constant(r, var->type, &init.value))
		return false;
	else if (var->type == IEC_STRING)
		init.text = reader_intern(r, r->text.text + value,
					  r->text.len - value);
	if (several) {
		if (!reader_is(r, ')'))
			return reader_fail_word(r, DIAG_EXPECTED, ")");
		buffer_add(r, &r->text, ")", 1);
		reader_step(r);
	}
	return add_values(r, var, room, init);
}

static bool read_init_text(struct reader *r, struct var *var);
static bool has_expressions(const struct reader *r);

bool read_init_list(struct reader *r, struct var *var)
{
	uint32_t room = var->array.count;

	if (reader_is(r, '[') && (var->written || has_expressions(r)))
		return read_init_text(r, var);

	if (!reader_is(r, '['))
		return reader_fail_word(r, DIAG_EXPECTED, "[");
	buffer_clear(&r->text);
	buffer_add(r, &r->text, "[", 1);
	reader_step(r);
	while (read_values(r, var, &room)) {
		if (reader_is(r, ']')) {
			buffer_add(r, &r->text, "]", 1);
			var->has_init = true;
			var->init_text = buffer_take(r, &r->text);
			reader_step(r);
			return true;
		}
		if (!reader_is(r, ','))
			return reader_fail_word(r, DIAG_EXPECTED, ", or ]");
		buffer_add(r, &r->text, ", ", 2);
		reader_step(r);
	}
	return false;
}

/* ---- of what has parts, or expressions ---- */

static bool opens(const struct token *token)
{
	return token->len == 1 && (*token->text == '(' || *token->text == '[');
}

static bool closes(const struct token *token)
{
	return token->len == 1 && (*token->text == ')' || *token->text == ']');
}

static bool is_symbol(const struct token *token, const char *symbol)
{
	return token->kind == TOKEN_SYMBOL && token->len == strlen(symbol) &&
	       memcmp(token->text, symbol, token->len) == 0;
}

/* A token behind which a value begins, so that a - there is a sign; @token NULL: the start. */
static bool is_before_value(const struct token *token)
{
	return !token || opens(token) || is_symbol(token, ",") || is_symbol(token, ":=");
}

/* Is the token, behind @before, more than the form of constants needs? @next follows it. */
static bool is_of_expression(const struct lex *lex, const struct token *before,
			     const struct token *next)
{
	static const char *const operators[] = { "*", "/", "&", "<", ">", "=", "<=", ">=", "<>", "." };
	const struct token *token = &lex->token;

	for (size_t i = 0; i < sizeof(operators) / sizeof(*operators); i++)
		if (is_symbol(token, operators[i]))
			return true;
	if (is_symbol(token, "-") || is_symbol(token, "+"))
		return !is_before_value(before);
	if (is_symbol(token, "(")) /* not of a structure, and not n( */
		return next->kind == TOKEN_NUMBER && before && before->kind != TOKEN_NUMBER;
	return token->kind == TOKEN_NAME && !is_symbol(next, ":=") && !lex_is(lex, "TRUE") &&
	       !lex_is(lex, "FALSE");
}

/* Have the values in the brackets at the cursor an expression? */
static bool has_expressions(const struct reader *r)
{
	struct token before = { .kind = TOKEN_END };
	struct lex lex = r->lex;
	int open = 0;

	lex.newlines = lex.comments = false;
	do {
		struct lex ahead = lex;

		lex_next(&ahead);
		if (is_of_expression(&lex, before.text ? &before : NULL, &ahead.token))
			return true;
		open += opens(&lex.token);
		open -= closes(&lex.token);
		before = lex.token;
		lex = ahead;
	} while (open > 0 && lex.token.kind != TOKEN_END && !lex_is(&lex, ";"));
	return false;
}

/* Appends the token under the cursor in its canonical form; @before NULL: it is the first.
 * @sign: a sign stands before it. */
static void add_part(struct reader *r, const struct token *before, bool sign)
{
	const struct token *token = &r->lex.token;
	const bool apart = before && (token->space_before || token->line != before->line);

	if (lex_is(&r->lex, ":=")) {
		buffer_add(r, &r->text, " := ", 4);
		return;
	}
	if (reader_is(r, ',')) {
		buffer_add(r, &r->text, ", ", 2);
		return;
	}
	if (apart && !sign && !closes(token) && !is_before_value(before) &&
	    !(opens(token) && before->kind == TOKEN_NUMBER) && !is_symbol(token, ".") &&
	    !is_symbol(before, "."))
		buffer_add(r, &r->text, " ", 1);
	buffer_add(r, &r->text, token->text, token->len);
}

static bool is_part(const struct reader *r)
{
	static const char *const symbols[] = { "(", ")", "[", "]", ",", "-", "+", ":=", "*", "/",
					       "&", "<", ">", "=", "<=", ">=", "<>", "." };

	if (r->lex.token.kind == TOKEN_NAME || r->lex.token.kind == TOKEN_NUMBER)
		return true;
	for (size_t i = 0; i < sizeof(symbols) / sizeof(*symbols); i++)
		if (lex_is(&r->lex, symbols[i]))
			return true;
	return false;
}

/* Reads the values in the brackets at the cursor as text. */
static bool read_init_text(struct reader *r, struct var *var)
{
	const struct token *token = &r->lex.token;
	struct token before = { .kind = TOKEN_END };
	bool sign = false;
	int open = 0;

	if (has_expressions(r) || var->written) {
		struct var_written *written = reader_written(r, var, WRITTEN_INITIAL);

		if (!written)
			return false;
		written->initial = true;
	}
	buffer_clear(&r->text);
	do {
		const struct token *last = before.text ? &before : NULL;

		if (!is_part(r))
			return reader_fail_word(r, DIAG_EXPECTED,
						reader_is(r, ';') ? ") or ]" :
						"initial value");
		open += opens(token);
		open -= closes(token);
		add_part(r, last, sign);
		sign = (is_symbol(token, "-") || is_symbol(token, "+")) && is_before_value(last);
		before = *token;
		reader_step(r);
	} while (open > 0);
	var->has_init = true;
	var->init_text = buffer_take(r, &r->text);
	return true;
}

bool read_init_parts(struct reader *r, struct var *var)
{
	const char first = var->array.count ? '[' : '(';

	if (!reader_is(r, first))
		return reader_fail(r, DIAG_EXPECTED, &first, 1);
	return read_init_text(r, var);
}
