/* SPDX-License-Identifier: MIT
 *
 * st_place - the statement before a cursor; see st_place.h.
 */
#include "engine/check/st_place.h"

#include "engine/base/ascii.h"

#include <string.h>

bool st_is(const struct token *token, const char *text)
{
	return token->len == strlen(text) && ascii_same(token->text, text, token->len);
}

static bool begins_vars(const struct token *token)
{
	return token->len >= 3 && ascii_same(token->text, "VAR", 3) &&
	       (token->len == 3 || token->text[3] == '_');
}

/* The kind of block that a first word opens; ST_KINDS: none. */
static enum st_kind opened(const struct token *token)
{
	static const enum st_kind kinds[] = { ST_IF, ST_CASE, ST_FOR, ST_WHILE, ST_REPEAT };

	for (size_t i = 0; i < sizeof(kinds) / sizeof(*kinds); i++)
		if (st_is(token, st_form(kinds[i])->word))
			return kinds[i];
	return ST_KINDS;
}

static bool is_one_of(const struct token *token, const char *const *words)
{
	for (; *words; words++)
		if (st_is(token, *words))
			return true;
	return false;
}

static bool closes(const struct token *token)
{
	static const char *const words[] = { "END_IF", "END_CASE", "END_FOR", "END_WHILE",
					     "END_REPEAT", NULL };

	return is_one_of(token, words);
}

/* A statement begins with it, also behind one that has no end. */
static bool begins_statement(const struct token *token)
{
	static const char *const words[] = { "ELSIF", "ELSE", "EXIT", "CONTINUE", "RETURN",
					     "UNTIL", NULL };

	return opened(token) != ST_KINDS || is_one_of(token, words);
}

/* Does the statement, or its head, end with this token? */
static bool ends(const struct st_place *p, const struct token *token)
{
	static const char *const heads[] = { ";", "THEN", "DO", NULL };
	static const char *const alone[] = { ";", "ELSE", "REPEAT", NULL };
	const struct st_block *block = st_place_block(p);

	if (closes(token) || is_one_of(token, p->count ? heads : alone))
		return true;
	if (p->count && st_is(token, "OF"))
		return st_is(p->token, "CASE");
	return p->count && block && block->kind == ST_CASE && p->parens <= 0 &&
	       st_is(token, ":");
}

/* Blocks that begin and end with the statement that ends at @token. */
static void count_block(struct st_place *p, const struct token *token)
{
	const struct token *first = p->count ? p->token : token;
	const enum st_kind kind = opened(first);
	struct st_block *block = p->depth ? &p->open[p->depth - 1] : NULL;

	if (closes(token) && block) {
		p->depth--;
	} else if (kind != ST_KINDS && p->depth < ST_PLACE_BLOCKS) {
		p->open[p->depth++] = (struct st_block){ .kind = kind };
		if (kind == ST_CASE && p->count > 1)
			p->open[p->depth - 1].selector = p->token[p->count - 1];
	} else if (block && st_is(first, "ELSE")) {
		block->other = true;
	}
}

static void take(struct st_place *p, const struct token *token)
{
	if (p->count && begins_statement(token))
		p->count = p->parens = 0;
	p->parens += st_is(token, "(") || st_is(token, "[");
	p->parens -= st_is(token, ")") || st_is(token, "]");
	if (ends(p, token)) {
		count_block(p, token);
		p->count = p->parens = 0;
		return;
	}
	if (p->count == ST_PLACE_TOKENS) {
		p->count /= 2;
		memmove(p->token, p->token + p->count,
			sizeof(*p->token) * (size_t)p->count);
	}
	p->token[p->count++] = *token;
}

void st_place_find(struct st_place *out, const char *body, size_t at)
{
	struct lex lex;

	out->count = out->depth = out->parens = 0;
	out->declares = false;
	lex_init(&lex, body, at);
	while (lex_next(&lex) != TOKEN_END) {
		if (out->declares) {
			out->declares = !st_is(&lex.token, "END_VAR");
			continue;
		}
		out->declares = out->count == 0 && begins_vars(&lex.token);
		if (!out->declares)
			take(out, &lex.token);
	}
}

struct st_open st_place_open(const struct st_place *place)
{
	struct st_open open = { -1, 0, 0 };
	int closed = 0, commas = 0, last = place->count;

	for (int i = place->count - 1; i >= 0; i--) {
		const struct token *token = &place->token[i];

		if (st_is(token, ")") || st_is(token, "]"))
			closed++;
		if (closed == 0 && st_is(token, ","))
			last = commas++ ? last : i + 1;
		if ((st_is(token, "(") || st_is(token, "[")) && closed-- == 0)
			return (struct st_open){ i, commas, commas ? last : i + 1 };
	}
	return open;
}

bool st_ends_value(const struct st_place *place)
{
	static const char *const words[] = { "AND", "OR", "XOR", "MOD", "NOT", "IF", "ELSIF",
		"WHILE", "UNTIL", "CASE", "TO", "BY", "FOR" };
	const struct token *last = &place->token[place->count - 1];

	if (place->count == 0)
		return false;
	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		if (st_is(last, words[i]))
			return false;
	return last->kind != TOKEN_SYMBOL || st_is(last, ")") || st_is(last, "]");
}
