/* SPDX-License-Identifier: MIT
 *
 * rung_clip - what is copied: a rung and the declarations of its names.
 *
 * The names are those that stand in its text, so that no uses of a large project are
 * looked for. A parameter that is called as a variable brings one declaration too many,
 * which nobody takes.
 */
#include "editor-gtk/document/rung_clip.h"

#include "editor-gtk/document/symbols_text.h"
#include "engine/base/lex.h"
#include "engine/xref/xref.h"

#include <stdlib.h>
#include <string.h>

/* The names of a text, as names_fold(). */
static GHashTable *names_in(const struct project *project, const char *text)
{
	GHashTable *found = g_hash_table_new(NULL, NULL);
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END) {
		const struct token *token = &lex.token;
		const char *dot = memchr(token->text, '.', token->len);
		const size_t len = dot ? (size_t)(dot - token->text) : token->len;

		if (token->kind == TOKEN_NAME)
			g_hash_table_add(found, GUINT_TO_POINTER(
				names_find_any(&project->names, token->text, len)));
	}
	return found;
}

static void add_line(GString *block, const struct project *project,
		     const struct var_table *vars, int table, int index)
{
	struct symbol_row *symbol = symbol_row_new(project, vars, table, index);
	char *line = symbol_text_line((const char *const *)symbol->text);

	g_string_append(block, line);
	g_free(line);
	symbol_row_free(symbol);
}

/* Those of @table among @names, in blocks of their kind, which begin with @head. What a
 * local has is no more among them. */
static void add_blocks(GString *out, const struct project *project, int table,
		       uint16_t head, GHashTable *names)
{
	const struct var_table *vars = xref_table((struct project *)project, table);
	GString *block[4];

	for (int i = 0; i < 4; i++)
		block[i] = g_string_new(NULL);
	for (int i = 0; i < vars_declared(vars); i++) {
		const uint16_t flags = vars_flags(vars, i);

		if (!(flags & VAR_RESULT) && g_hash_table_remove(names,
				GUINT_TO_POINTER(vars->var[i].fold)))
			add_line(block[flags & (VAR_RETAIN | VAR_CONSTANT)], project, vars,
				 table, i);
	}
	for (int i = 0; i < 4; i++) {
		char *first = symbol_text_block((uint16_t)(head | i));

		if (block[i]->len)
			g_string_append_printf(out, "%s%sEND_VAR\n", first, block[i]->str);
		g_free(first);
		g_string_free(block[i], TRUE);
	}
}

/* NULL: one of them cannot be written. */
static GString *written(LadderDocument *document, struct rung *const *rungs, int count)
{
	GString *out = g_string_new(NULL);

	for (int i = 0; i < count; i++) {
		char *text = ladder_write_rung(ladder_document_ladder(document), rungs[i]);

		if (!text) {
			g_string_free(out, TRUE);
			return NULL;
		}
		g_string_append(out, text);
		free(text);
	}
	return out;
}

void rung_clip_blocks(LadderDocument *document, int pou, const char *text, GString *globals,
		      GString *locals)
{
	const struct project *project = ladder_document_project(document);
	GHashTable *names = names_in(project, text);

	add_blocks(locals, project, pou + 1, 0, names);
	add_blocks(globals, project, 0, VAR_GLOBAL_WORD, names);
	g_hash_table_unref(names);
}

char *rung_clip_text(LadderDocument *document, int pou, struct rung *const *rungs,
		     int count)
{
	GString *text = written(document, rungs, count), *globals, *locals;

	if (!text)
		return NULL;
	globals = g_string_new(NULL);
	locals = g_string_new(NULL);
	rung_clip_blocks(document, pou, text->str, globals, locals);
	g_string_append_printf(globals, "%s%s", locals->str, text->str);
	g_string_free(locals, TRUE);
	g_string_free(text, TRUE);
	return g_string_free(globals, FALSE);
}

struct rung **rung_clip_take(struct rung_clip *clip)
{
	struct rung **rungs = clip->rung;

	clip->rung = NULL;
	clip->count = 0;
	return rungs;
}

void rung_clip_free(struct rung_clip *clip)
{
	if (!clip)
		return;
	for (int i = 0; i < clip->count; i++)
		rung_free(clip->rung[i]);
	g_free(clip->rung);
	g_clear_object(&clip->source);
	g_free(clip);
}
