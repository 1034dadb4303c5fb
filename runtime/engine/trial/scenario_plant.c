/* SPDX-License-Identifier: MIT
 *
 * scenario_plant - which plant a scenario file names: asked before it can be read, since
 * names in it are names of the plant.
 */
#include "engine/trial/scenario.h"

bool scenario_is_plant(const struct lex *lex)
{
	struct lex ahead = *lex;

	if (!lex_is(&ahead, "plant"))
		return false;
	lex_next(&ahead);
	return ahead.token.kind == TOKEN_STRING;
}

bool scenario_plant_token(const char *text, size_t len, struct token *out)
{
	bool first = true; /* of its line */
	struct lex lex;

	lex_init(&lex, text, len);
	lex.newlines = true;
	for (lex_next(&lex); lex.token.kind != TOKEN_END; lex_next(&lex)) {
		if (first && scenario_is_plant(&lex)) {
			lex_next(&lex);
			*out = lex.token;
			return true;
		}
		if (lex.token.kind == TOKEN_SYMBOL && lex_is(&lex, "#"))
			while (lex.at < lex.end && *lex.at != '\n')
				lex.at++; /* a comment */
		first = lex.token.kind == TOKEN_NEWLINE;
	}
	return false;
}

const char *scenario_find_plant(const char *file, const char *text, size_t len,
				struct arena *arena, struct diag *place)
{
	struct token token;
	size_t bad;

	if (!utf8_valid(text, len, &bad) || !scenario_plant_token(text, len, &token))
		return NULL;
	*place = (struct diag){ .file = file, .line = token.line,
				.column = token.column };
	return arena_copy(arena, token.text + 1, token.len - 2);
}
