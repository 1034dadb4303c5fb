/* SPDX-License-Identifier: MIT
 *
 * st_formula - an expression of a body over the whole program: see st_formula.h.
 */
#include "editor-gtk/sim/st_formula.h"

#include "engine/base/name.h"
#include "engine/model/named.h"

#include <string.h>

char *st_formula_number(struct project *project, const struct token *token)
{
	struct names *names = &project->names;
	const char *sign = memchr(token->text, '#', token->len);
	const gsize before = sign ? (gsize)(sign - token->text) + 1 : 0;
	const uint32_t fold = names_fold(names, names_intern(names, token->text + before,
							     token->len - before));
	const int type = !sign ? -1 : named_find(project, names_fold(names,
		names_intern(names, token->text, before - 1)));

	for (int i = 0; i < project->enum_value_count; i++) {
		const struct enum_value *value = &project->enum_value[i];
		const struct var *like = type < 0 ? NULL : project->named[type].like.var;

		if (value->fold == fold && (!like || like->enumeration == value->enumeration + 1) &&
		    (!sign || like))
			return g_strdup_printf("%" G_GINT64_FORMAT, value->number);
	}
	return NULL;
}

/* Is @name a variable of @scope, or the beginning of its parts? */
static bool has_name(const struct program *program, const char *scope, const struct token *name)
{
	struct declared_cursor cursor = { 0 };
	struct declared_name part;
	char *whole = g_strdup_printf("%s.%.*s", scope, (int)name->len, name->text);
	bool found = false;

	while (!found && image_next_declared(program, &cursor, &part)) {
		char *own = *part.pou ? g_strdup_printf("%s.%s", part.pou, part.name) : NULL;

		found = name_head(whole, strlen(whole), part.name, strlen(part.name)) ||
			(own && name_head(whole, strlen(whole), own, strlen(own)));
		g_free(own);
	}
	g_free(whole);
	return found;
}

static bool is_word(const struct token *token)
{
	return token->kind == TOKEN_NAME || (token->len && memchr(token->text, '#', token->len));
}

/* Names behind a point are parts of what stands before it. */
/* The first of @scope and @pou that has the name; NULL: neither. */
static const char *owner_of(const struct program *program, const char *scope, const char *pou,
			    const struct token *name)
{
	return has_name(program, scope, name) ? scope : has_name(program, pou, name) ? pou : NULL;
}

char *st_formula_text(struct project *project, const struct program *program, const char *scope,
		      const char *pou, const char *text)
{
	GString *out = g_string_new(NULL);
	const char *copied = text;
	bool part = false;
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END) {
		const struct token *token = &lex.token;
		char *number = is_word(token) && !part ? st_formula_number(project, token) : NULL;
		const char *owner = token->kind == TOKEN_NAME && !part && !number ?
			owner_of(program, scope, pou, token) : NULL;

		g_string_append_len(out, copied, token->text - copied);
		copied = token->text + token->len;
		if (number)
			g_string_append(out, number);
		else if (owner)
			g_string_append_printf(out, "%s.%.*s", owner, (int)token->len, token->text);
		else
			g_string_append_len(out, token->text, (gssize)token->len);
		part = token->len == 1 && *token->text == '.';
		g_free(number);
	}
	g_string_append(out, copied);
	return g_string_free(out, FALSE);
}
