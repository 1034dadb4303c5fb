/* SPDX-License-Identifier: MIT
 *
 * loop - parses variable, values and step of a FOR.
 */
#include "engine/model/loop.h"

#include "engine/base/lex.h"
#include "engine/base/literal.h"

/* A name or address with indices and members. */
static bool take_variable(struct lex *lex, struct loop_part *out)
{
	out->text = lex->token.text;
	if (lex->token.kind != TOKEN_NAME && lex->token.kind != TOKEN_ADDRESS)
		return false;
	for (;;) {
		out->len = (size_t)(lex->token.text + lex->token.len - out->text);
		lex_next(lex);
		if (!lex_is(lex, "[") || lex->token.space_before)
			return true;
		while (!lex_is(lex, "]")) {
			if (lex->token.kind == TOKEN_END)
				return false;
			lex_next(lex);
		}
		out->len = (size_t)(lex->token.text + 1 - out->text);
		lex_next(lex);
		if (!lex_is(lex, ".") || lex->token.space_before)
			return true;
		if (lex_next(lex) != TOKEN_NAME)
			return false;
	}
}

/* A variable or a constant, with its sign. */
static bool take_value(struct lex *lex, struct loop_part *out)
{
	const char *start = lex->token.text;

	const bool sign = lex_is(lex, "-") || lex_is(lex, "+");

	if (lex->token.kind != TOKEN_NUMBER && !sign)
		return take_variable(lex, out);
	if (sign)
		lex_next(lex);
	if (lex->token.kind != TOKEN_NUMBER)
		return false;
	out->text = start;
	out->len = (size_t)(lex->token.text + lex->token.len - start);
	lex_next(lex);
	return true;
}

static bool take_step(struct lex *lex, struct loop *out)
{
	struct literal literal;

	out->step = 1;
	if (!lex_accept(lex, "BY"))
		return true;
	if (!take_value(lex, &out->by) ||
	    literal_parse(out->by.text, out->by.len, &literal) != LITERAL_OK ||
	    literal.real || literal.high || literal.type == IEC_BOOL)
		return false;
	out->step = literal.value.i;
	return true;
}

bool loop_parse(const char *text, size_t len, struct loop *out)
{
	struct lex lex;

	*out = (struct loop){ .step = 1 };
	lex_init(&lex, text, len);
	lex_next(&lex);
	return take_variable(&lex, &out->variable) && lex_accept(&lex, ":=") &&
	       take_value(&lex, &out->from) && lex_accept(&lex, "TO") &&
	       take_value(&lex, &out->to) && take_step(&lex, out) &&
	       lex.token.kind == TOKEN_END;
}
