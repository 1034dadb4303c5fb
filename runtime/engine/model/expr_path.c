/* SPDX-License-Identifier: MIT
 *
 * expr_path - operands with dots and indices, and whether a := stands behind one.
 *
 * It moves a scanner over them and knows neither names nor trees.
 */
#include "engine/model/expr_path.h"

/* From the [ to the ] of `[ i ]` or `[-3]`: an index that needs no operation. */
static bool skip_simple_index(struct lex *lex)
{
	struct lex at = *lex;

	lex_next(&at);
	if (lex_is(&at, "-")) {
		lex_next(&at);
		if (at.token.kind != TOKEN_NUMBER)
			return false;
	}
	if (at.token.kind != TOKEN_NUMBER && at.token.kind != TOKEN_NAME &&
	    at.token.kind != TOKEN_ADDRESS)
		return false;
	lex_next(&at);
	if (!lex_is(&at, "]"))
		return false;
	*lex = at;
	return true;
}

/* On the last token of a name or of an index behind it: to that of what follows with
 * simple indices alone, `[2].Times`. An index that is an expression is not gone to. */
void expr_skip_path(struct lex *lex)
{
	struct lex at = *lex;
	bool dots = lex_is(lex, "]");

	for (;;) {
		lex_next(&at);
		if (dots ? !lex_is(&at, ".") || lex_next(&at) != TOKEN_NAME
			 : !lex_is(&at, "[") || !skip_simple_index(&at))
			return;
		*lex = at;
		dots = !dots;
	}
}

/* What ends at the cursor, on its last token: its text from @text on. */
size_t expr_text_len(const char *text, const struct lex *lex)
{
	return (size_t)(lex->token.text + lex->token.len - text);
}

/* Behind the ] that closes the [ under the cursor; false: there is none. */
static bool skip_brackets(struct lex *lex)
{
	int depth = 0;

	for (;;) {
		if (lex_is(lex, "["))
			depth++;
		else if (lex_is(lex, "]") && --depth == 0)
			return lex_next(lex), true;
		else if (lex->token.kind == TOKEN_END ||
			 lex->token.kind == TOKEN_NEWLINE || lex_is(lex, ":="))
			return false;
		lex_next(lex);
	}
}

/* Is there a := that belongs to what the cursor is on? */
bool expr_has_target(struct lex lex)
{
	if (lex.token.kind != TOKEN_NAME && lex.token.kind != TOKEN_ADDRESS)
		return false;
	lex_next(&lex);
	while (lex_is(&lex, "[")) {
		if (!skip_brackets(&lex))
			return false;
		if (lex_is(&lex, ".") && lex_next(&lex) == TOKEN_NAME)
			lex_next(&lex);
	}
	return lex_is(&lex, ":=");
}
