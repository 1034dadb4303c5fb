/* SPDX-License-Identifier: MIT
 *
 * rung_clip - rungs as text for the clipboard, and rungs from any text that holds some.
 *
 * A copy has the declarations of the names in its text, which is faster than a search for
 * uses. A text that is pasted is split where lines begin a part. The engine reads each
 * part: rungs in the document, so that its words are known, declarations in a project of
 * their own. An error names the line of the pasted text.
 */
#include "editor-gtk/document/rung_clip.h"

#include "editor-gtk/document/entry_outcome.h"
#include "editor-gtk/edit/entry.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/name_fold.h"

#include "engine/base/lex.h"
#include "engine/base/name.h"
#include "engine/xref/xref.h"

#include <stdlib.h>
#include <string.h>

/* The names in a text, as names_fold(). */
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

/* Calls @take for each name in the constant expressions of a declaration. */
static void each_needed(const struct project *project, const struct var *var,
			void (*take)(void *context, const char *name, gsize len), void *context)
{
	const struct var_written *written = var->written;
	const uint32_t text[] = {
		written ? written->bound[0] : 0, written ? written->bound[1] : 0,
		written ? written->capacity : 0, written && written->initial ? var->init_text : 0,
	};
	struct lex lex;

	for (gsize i = 0; i < G_N_ELEMENTS(text); i++) {
		lex_init(&lex, project_text(project, text[i]), names_len(&project->names, text[i]));
		while (lex_next(&lex) != TOKEN_END)
			if (lex.token.kind == TOKEN_NAME)
				take(context, lex.token.text, lex.token.len);
	}
}

struct needed { const struct project *project; GHashTable *names; };

static void add_name(void *context, const char *name, gsize len)
{
	const struct needed *needed = context;

	g_hash_table_add(needed->names, GUINT_TO_POINTER(
		names_find_any(&needed->project->names, name, len)));
}

/* Adds the constants that the declarations of @names need, and those that these need. */
static void add_needed(const struct project *project, int table, GHashTable *names)
{
	struct needed needed = { project, names };
	guint before;

	do {
		before = g_hash_table_size(names);
		for (int which = 0; which < 2; which++) {
			const struct var_table *vars = xref_table((struct project *)project,
								  which ? table : 0);

			for (int i = 0; i < vars_declared(vars); i++)
				if (g_hash_table_contains(names, GUINT_TO_POINTER(vars->var[i].fold)))
					each_needed(project, &vars->var[i], add_name, &needed);
		}
	} while (g_hash_table_size(names) > before);
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

/* Adds the declarations of @table that are among @names, in blocks whose heading begins
 * with @head. A local hides a global: it is removed from @names. */
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

/* NULL: a rung cannot be written. */
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

	add_needed(project, pou + 1, names);
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

#define TEXT_MOST 65536 /* bytes; longer texts are not read as mnemonics       */

struct typed {
	char *text;
	int line;       /* line of the clipboard                               */
};

struct line {
	LadderDocument *document;
	struct entry_place place;
	struct entry *entry;
	GStrvBuilder *rungs;
	GString *row;   /* the rung that is being read; NULL: none             */
	bool ended;     /* by its output                                       */
	char *why;
};

/* An element whose operand is missing. */
static bool is_begun(const struct line *line, const char *text)
{
	entry_read(&line->place, text, line->entry);
	return line->entry->sense == ENTRY_PART;
}

/* A word that takes an operand. */
static bool is_word(const struct line *line, const char *text)
{
	if (words_find(&line->place.project->words, text, strlen(text)) != WORD_COUNT)
		return true;
	return is_begun(line, text);
}

/* @why: a format for the word. */
static bool refuse_word(struct line *line, const char *text, const char *why)
{
	line->why = g_strdup_printf(why, text);
	return false;
}

static void end_rung(struct line *line)
{
	if (!line->row)
		return;
	g_strv_builder_add(line->rungs, line->row->str);
	g_string_free(line->row, TRUE);
	line->row = NULL;
}

static bool add(struct line *line, const char *text)
{
	const struct entry *entry = line->entry;
	const struct word_row *row;
	bool good, output;

	if (!entry_read(&line->place, text, line->entry)) {
		line->why = entry_outcome_tell(line->document, line->place.pou, entry, text,
					       &good);
		return false;
	}
	row = words_row(&line->place.project->words, entry->word);
	output = row->place == PLACE_LAST;
	if (entry->below || row->operand == OPND_EXPR || row->operand == OPND_ASSIGN ||
	    row->operand == OPND_LOOP || (output && line->ended))
		return refuse_word(line, text,
			      _("“%s” can only be pasted as a row of a rung file"));
	if (line->ended)
		end_rung(line);
	if (!line->row)
		line->row = g_string_new("RUNG\n|");
	line->ended = output;
	g_string_append_printf(line->row, " %s%s%s%s%s |", row->word,
			       entry->operand[0] ? " " : "", entry->operand,
			       entry->args[0] ? " " : "", entry->args);
	return true;
}

/* @count words as one line. Caller: g_free. */
static char *joined(const struct typed *from, int count)
{
	GString *one = g_string_new(from->text);

	for (int i = 1; i < count; i++)
		g_string_append_printf(one, " %s", from[i].text);
	return g_string_free(one, FALSE);
}

/* The number of words that belong to the word at @from: up to the next mnemonic. An operand
 * may have the name of one, such as Stop. */
static int count_of(const struct line *line, const struct typed *from)
{
	GString *one = g_string_new(from->text);
	int count = 1;

	while (from[count].text && one->len < ENTRY_TEXT &&
	       (is_begun(line, one->str) || (from[count].line == from->line &&
					     !is_word(line, from[count].text))))
		g_string_append_printf(one, " %s", from[count++].text);
	g_string_free(one, TRUE);
	return count;
}

/* If the line is valid without its last words, the first of those is an unknown mnemonic. */
static bool refuse_last(struct line *line, const struct typed *from, int count)
{
	while (--count > 0) {
		char *less = joined(from, count);
		const bool good = entry_read(&line->place, less, line->entry);

		g_free(less);
		if (good) {
			g_free(line->why);
			return refuse_word(line, from[count].text, _("“%s” is not a known word"));
		}
	}
	return false;
}

static bool add_all(struct line *line, const struct typed *part, int *at)
{
	bool good = true;

	while (good && part->text) {
		const int count = count_of(line, part);
		char *one = joined(part, count);

		*at = part->line;
		good = is_word(line, part->text) ? add(line, one) :
			refuse_word(line, part->text, _("“%s” is not a known word"));
		if (!good && count > 1 && line->entry->sense == ENTRY_WRONG)
			refuse_last(line, part, count);
		part += count;
		g_free(one);
	}
	return good;
}

/* Words, ended by one with text NULL. */
static GArray *words_of(const char *text)
{
	GArray *words = g_array_new(TRUE, TRUE, sizeof(struct typed));
	int line = 1;

	while (*text) {
		const size_t len = strcspn(text, " \t\r\n");
		const struct typed part = { g_strndup(text, len), line };

		if (len > 0)
			g_array_append_val(words, part);
		else
			g_free(part.text);
		text += len;
		line += *text == '\n';
		text += *text != '\0';
	}
	return words;
}

static void part_clear(gpointer part)
{
	g_free(((struct typed *)part)->text);
}

/* `XIC Start OTE Motor` as the text of rungs for POU @pou, not yet parsed; an output ends a
 * rung. @at: the line of an error. Caller: g_strfreev(). */
static char **rungs_of_lines(LadderDocument *document, int pou, const char *text, char **why,
			     int *at)
{
	struct line line = { .document = document,
			     .place = { .project = ladder_document_project(document),
					.pou = pou } };
	GArray *words = words_of(strlen(text) > TEXT_MOST ? "" : text);
	struct xref xref;
	char **rungs;
	bool good;

	g_array_set_clear_func(words, part_clear);
	if (!xref_make(&xref, line.place.project))
		g_error("out of memory");
	line.place.xref = &xref;
	line.entry = g_new0(struct entry, 1);
	line.rungs = g_strv_builder_new();
	good = add_all(&line, (const struct typed *)words->data, at);
	end_rung(&line);
	rungs = g_strv_builder_end(line.rungs);
	g_strv_builder_unref(line.rungs);
	g_free(line.entry);
	g_array_unref(words);
	xref_free(&xref);
	*why = line.why;
	if (good)
		return rungs;
	g_strfreev(rungs);
	return NULL;
}

#define TYPES_ROUNDS 4 /* each round adds as many types as a list of diagnostics holds */

/* A part of the text: from the comments above it to the end of its last line. */
struct span {
	gsize at, len;
	int line;           /* of its first byte                               */
	gsize head;         /* bytes before its first word                     */
	gsize head_len;     /* length of that word                             */
	bool global;        /* of a block: VAR_GLOBAL                          */
	bool bare;          /* of a rung: the word RUNG is missing             */
};

struct reading {
	LadderDocument *document;
	int pou;
	const char *text;
	GArray *block, *rung; /* of struct span                               */
	bool whole;           /* a file, or parts of one                      */
	bool headed;          /* its first line is RUNGBOARD                  */
	struct rung_clip *clip;
	char *why;
};

/* ---- where the parts are ---- */

static bool is_any(const struct lex *lex, const char *const *words)
{
	for (; *words; words++)
		if (lex_is(lex, *words))
			return true;
	return false;
}

static bool begins_block(const struct lex *lex)
{
	static const char *const words[] = { "VAR", "VAR_GLOBAL", "VAR_INPUT", "VAR_OUTPUT",
					     "VAR_IN_OUT", "VAR_TEMP", NULL };

	return lex->token.kind == TOKEN_NAME && is_any(lex, words);
}

static bool begins_file(const struct lex *lex)
{
	static const char *const words[] = {
		"RUNGBOARD", "PROJECT", "PROGRAM", "FUNCTION", "FUNCTION_BLOCK",
		"SUBROUTINE", "CONFIGURATION", "TYPE", "INCLUDE", "USES", NULL };

	return lex->token.kind == TOKEN_NAME && is_any(lex, words);
}

struct cut {
	struct lex lex;
	gsize end;          /* behind the last line with text                  */
	int end_line;
	struct span *open;  /* the part that the line belongs to; NULL: none    */
	bool block;         /* that part is a block                            */
};

static void begin(struct cut *cut, GArray *spans, const char *text)
{
	const struct token *token = &cut->lex.token;
	struct span span = {
		.at = cut->end, .line = cut->end_line,
		.head = (gsize)(token->text - text) - cut->end, .head_len = token->len,
		.global = lex_is(&cut->lex, "VAR_GLOBAL"), .bare = lex_is(&cut->lex, "|"),
	};

	g_array_append_val(spans, span);
	cut->open = &g_array_index(spans, struct span, spans->len - 1);
}

/* False: it is a whole file, or there are too many parts. */
static bool line_begins(struct reading *r, struct cut *cut)
{
	const struct lex *lex = &cut->lex;

	if (cut->block)
		return true;
	if (begins_file(lex) && r->rung->len == 0) {
		r->whole = true;
		r->headed = lex_is(lex, "RUNGBOARD");
		return false;
	}
	if (begins_block(lex)) {
		begin(cut, r->block, r->text);
		cut->block = true;
	} else if (lex_is(lex, "RUNG") ||
		   (lex_is(lex, "|") && r->rung->len == 0)) {
		if (r->rung->len == RUNG_CLIP_MOST)
			return false;
		begin(cut, r->rung, r->text);
	}
	return true;
}

static void cut_text(struct reading *r, gsize len)
{
	struct cut cut = { .end_line = 1 };
	bool fresh = true, any = false;

	lex_init(&cut.lex, r->text, len);
	cut.lex.newlines = true;
	for (;;) {
		const enum token_kind kind = lex_next(&cut.lex);
		const struct token *token = &cut.lex.token;

		if (kind != TOKEN_END && kind != TOKEN_NEWLINE) {
			if (fresh && !line_begins(r, &cut))
				return;
			any = true;
			fresh = false;
			if (cut.block && lex_is(&cut.lex, "END_VAR"))
				cut.block = false;
			continue;
		}
		/* Comments on lines of their own belong to the next part. */
		if (any && (cut.open || kind == TOKEN_END)) {
			cut.end = kind == TOKEN_END ? len :
				(gsize)(token->text + token->len - r->text);
			cut.end_line = token->line + 1;
			if (cut.open)
				cut.open->len = cut.end - cut.open->at;
		}
		if (kind == TOKEN_END)
			break;
		any = false;
		fresh = true;
	}
}

/* ---- errors ---- */

static bool refuse(struct reading *r, char *why)
{
	g_free(r->why);
	r->why = why;
	return false;
}

static bool refuse_at(struct reading *r, const struct diag_list *diags, int line)
{
	const struct diag *diag = diag_first_error(diags);
	char *said = diag ? diag_said_whole(diag) : g_strdup(_("It cannot be read"));

	refuse(r, g_strdup_printf(_("The clipboard, line %d: %s"), line, said));
	g_free(said);
	return false;
}

static int line_of(const struct diag_list *diags)
{
	const struct diag *diag = diag_first_error(diags);

	return diag && diag->line > 0 ? diag->line : 1;
}

/* ---- rungs ---- */

static bool take_rung(struct reading *r, const char *text, gsize len, int line)
{
	struct diag_list *diags = g_new0(struct diag_list, 1);
	struct rung *rung = ladder_read_rung(ladder_document_ladder(r->document), text, len,
					     diags);

	if (rung)
		r->clip->rung[r->clip->count++] = rung;
	else
		refuse_at(r, diags, line + line_of(diags) - 1);
	g_free(diags);
	return rung;
}

/* Inserts RUNG where the first row is, so that comments stay above it. */
static bool take_bare(struct reading *r, const struct span *span)
{
	const char *text = r->text + span->at;
	GString *whole = g_string_new_len(text, (gssize)span->head);
	int line = span->line;
	bool good;

	g_string_append(whole, "RUNG\n");
	g_string_append_len(whole, text + span->head, (gssize)(span->len - span->head));
	good = take_rung(r, whole->str, whole->len, line - 1);
	g_string_free(whole, TRUE);
	return good;
}

static bool take_rungs(struct reading *r)
{
	r->clip->rung = g_new0(struct rung *, r->rung->len + 1);
	for (guint i = 0; i < r->rung->len; i++) {
		const struct span *span = &g_array_index(r->rung, struct span, i);

		if (span->bare ? !take_bare(r, span) :
		    !take_rung(r, r->text + span->at, span->len, span->line))
			return false;
	}
	return true;
}

/* ---- declarations ---- */

/* Declares each unknown type as a structure, so that its variables can be read. */
static bool add_types(GString *types, const struct diag_list *diags)
{
	const gsize before = types->len;

	for (int i = 0; i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];
		char *type = g_strdup_printf("TYPE %s : STRUCT X : INT; END_STRUCT; END_TYPE ",
					     diag->arg);

		if (diag->id == DIAG_BAD_TYPE && strlen(diag->arg) < LIMIT_ARG - 1 &&
		    !strstr(types->str, type))
			g_string_append(types, type);
		g_free(type);
	}
	return types->len > before;
}

static void add_block(GString *out, const struct reading *r, const struct span *span)
{
	const gsize from = span->head + span->head_len;

	g_string_append_len(out, r->text + span->at, (gssize)span->head);
	g_string_append(out, span->global ? "VAR_GLOBAL" : "VAR");
	g_string_append_len(out, r->text + span->at + from, (gssize)(span->len - from));
	if (out->str[out->len - 1] != '\n')
		g_string_append_c(out, '\n');
}

/* The line of the clipboard for line @line of the blocks. Two lines stand before the
 * blocks, one more before the local ones. */
static int line_in(const struct reading *r, int line)
{
	int at = 3;

	for (int local = 0; local < 2; local++, at++)
		for (guint i = 0; i < r->block->len; i++) {
			const struct span *span = &g_array_index(r->block, struct span, i);
			int lines = 0;

			if (span->global == (bool)local)
				continue;
			for (gsize k = 0; k < span->len; k++)
				lines += r->text[span->at + k] == '\n';
			if (line < at + lines)
				return span->line + MAX(line - at, 0);
			at += lines;
		}
	return 1;
}

/* The blocks as a file, without its first two lines. */
static char *blocks_as_file(const struct reading *r)
{
	GString *text = g_string_new(NULL);

	for (int local = 0; local < 2; local++) {
		g_string_append(text, local ? "PROGRAM Clipboard LD\n" : "");
		for (guint i = 0; i < r->block->len; i++) {
			const struct span *span = &g_array_index(r->block, struct span, i);

			if (span->global != (bool)local)
				add_block(text, r, span);
		}
	}
	g_string_append(text, "RUNG\nEND_PROGRAM\n");
	return g_string_free(text, FALSE);
}

static LadderDocument *source_new(const char *text)
{
	LadderDocument *source = ladder_document_new();

	ladder_document_open_text(source, NULL, text, strlen(text), true);
	ladder_document_fix(source);
	return source;
}

/* False: try again with more types. */
static bool try_source(const char *body, GString *types, bool last, LadderDocument **source,
		       struct diag_list *diags)
{
	struct ladder *ladder = ladder_new();
	char *text = g_strdup_printf("RUNGBOARD 1\n%s\n%s", types->str, body);
	bool again = false;

	if (!ladder)
		g_error("out of memory");
	if (ladder_load_text(ladder, "", text, strlen(text)))
		*source = source_new(text);
	else if (last || !add_types(types, ladder_diags(ladder)))
		*diags = *ladder_diags(ladder);
	else
		again = true;
	g_free(text);
	ladder_free(ladder);
	return !again;
}

LadderDocument *rung_clip_source(const char *body, struct diag_list *diags)
{
	GString *types = g_string_new(NULL);
	LadderDocument *source = NULL;

	for (int round = 0; !try_source(body, types, round == TYPES_ROUNDS, &source, diags);
	     round++)
		;
	g_string_free(types, TRUE);
	return source;
}

static bool take_blocks(struct reading *r)
{
	struct diag_list *diags = g_new0(struct diag_list, 1);
	char *text = blocks_as_file(r);

	r->clip->source = rung_clip_source(text, diags);
	if (!r->clip->source)
		refuse_at(r, diags, line_in(r, line_of(diags)));
	g_free(text);
	g_free(diags);
	return r->clip->source;
}

/* ---- a whole file ---- */

static bool is_ladder(const struct pou *pou)
{
	return pou->kind == POU_PROGRAM && pou->language == LANGUAGE_LD && !pou->included;
}

/* Rungs of another project are written and read again: their words may be unknown here. */
static bool take_pou(struct reading *r, const struct pou *pou, int most, int before)
{
	struct ladder *from = ladder_document_ladder(r->clip->source);

	for (int i = 0; i < pou->rung_count && r->clip->count < most; i++) {
		char *text = ladder_write_rung(from, pou->rung[i]);
		const bool good = text && take_rung(r, text, strlen(text),
						    (int)pou->rung[i]->line - before);

		free(text);
		if (!good)
			return false;
	}
	return true;
}

static bool take_programs(struct reading *r)
{
	const struct project *project = ladder_document_project(r->clip->source);
	gsize most = 0;
	bool good = true;

	for (int i = 0; i < project->pou_count; i++)
		most += is_ladder(&project->pou[i]) ? (gsize)project->pou[i].rung_count : 0;
	most = MIN(most, RUNG_CLIP_MOST);
	r->clip->rung = g_new0(struct rung *, most + 1);
	for (int i = 0; good && i < project->pou_count; i++)
		if (is_ladder(&project->pou[i]))
			good = take_pou(r, &project->pou[i], (int)most, !r->headed);
	return good;
}

static bool take_whole(struct reading *r)
{
	struct ladder *ladder = ladder_new();
	char *text = g_strconcat(r->headed ? "" : "RUNGBOARD 1\n", r->text, NULL);
	bool good;

	if (!ladder)
		g_error("out of memory");
	good = ladder_load_text(ladder, "", text, strlen(text));
	if (good)
		r->clip->source = source_new(text);
	else
		refuse_at(r, ladder_diags(ladder),
			  MAX(line_of(ladder_diags(ladder)) - !r->headed, 1));
	g_free(text);
	ladder_free(ladder);
	return good && take_programs(r);
}

/* ---- any text ---- */

static bool is_text(struct reading *r, const char *text, gsize len)
{
	const struct diag large = { .id = DIAG_TOO_LARGE }, bytes = { .id = DIAG_BAD_UTF8 };

	if (len > LIMIT_TEXT)
		return refuse(r, diag_said_whole(&large));
	if (!utf8_valid(text, len, NULL))
		return refuse(r, diag_said_whole(&bytes));
	return true;
}

/* For a text without a row or a word of a rung file. */
static bool take_lines(struct reading *r)
{
	char *why = NULL;
	int line = 1;
	char **text = rungs_of_lines(r->document, r->pou, r->text, &why, &line);
	const guint count = text ? g_strv_length(text) : 0;
	bool good = text;

	if (why)
		refuse(r, g_strdup_printf(_("The clipboard, line %d: %s"), line, why));
	r->clip->rung = g_new0(struct rung *, count + 1);
	for (guint i = 0; good && i < count; i++)
		good = take_rung(r, text[i], strlen(text[i]), 0);
	g_strfreev(text);
	g_free(why);
	return good;
}

static bool take(struct reading *r)
{
	if (r->whole)
		return take_whole(r);
	if (r->rung->len == 0 && r->block->len == 0)
		return take_lines(r);
	return (r->block->len == 0 || take_blocks(r)) && take_rungs(r);
}

struct rung_clip *rung_clip_read(LadderDocument *document, int pou, const char *text,
				 gsize len, char **why)
{
	struct reading r = { .document = document, .pou = pou, .clip = g_new0(struct rung_clip, 1) };
	char *copy = NULL;
	bool good = is_text(&r, text, len);

	r.block = g_array_new(FALSE, FALSE, sizeof(struct span));
	r.rung = g_array_new(FALSE, FALSE, sizeof(struct span));
	if (good) {
		r.text = copy = g_strndup(text, len);
		cut_text(&r, len);
		good = take(&r);
	}
	if (good && r.clip->count == 0)
		good = refuse(&r, g_strdup(_("The clipboard holds no rungs.")));
	g_array_unref(r.block);
	g_array_unref(r.rung);
	g_free(copy);
	if (!good)
		g_clear_pointer(&r.clip, rung_clip_free);
	*why = r.why;
	return r.clip;
}

struct declare {
	LadderDocument *document;
	struct project *project;
	int pou;
	struct symbols *symbols;    /* of the source                          */
	struct project *source;
	struct symbol_batch *batch;
	int count;
	int clashes;
	char *clash;                /* message about the first clash           */
};

/* ---- names that the project lacks ---- */

/* Does the source have a name that is new here? Mostly not: most text is pasted into the
 * project it was copied from. */
static bool has_news(const struct declare *declare)
{
	for (int i = 0; i < declare->symbols->count; i++) {
		const char *name = declare->symbols->symbol[i].text[FIELD_NAME];
		const uint32_t fold = names_find_any(&declare->project->names, name,
						     strlen(name));

		if (vars_find(&declare->project->globals, fold) < 0 &&
		    vars_find(&declare->project->pou[declare->pou].vars, fold) < 0)
			return true;
	}
	return false;
}

/* Each unknown name once, as it is first written. */
static GPtrArray *unknown_names(const struct declare *declare, int at, int count)
{
	GHashTable *seen = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
	GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
	struct xref xref;

	if (!xref_make(&xref, declare->project))
		g_error("out of memory");
	for (int i = 0; i < xref.count; i++) {
		const struct xref_use *use = &xref.use[i];
		const char *text = xref_text(&xref, use) + use->at;

		if (use->target.what != XREF_UNKNOWN || use->pou != declare->pou ||
		    use->rung <= at || use->rung > at + count || !use->slot)
			continue;
		if (g_hash_table_add(seen, name_fold_len(text, use->len)))
			g_ptr_array_add(names, g_strndup(text, use->len));
	}
	xref_free(&xref);
	g_hash_table_unref(seen);
	return names;
}

/* A local hides a global, as in the source; members of structures do not count. */
static const struct symbol_row *find(const struct declare *declare, const char *name)
{
	const struct symbol_row *global = NULL;

	for (int i = 0; i < declare->symbols->count; i++) {
		const struct symbol_row *symbol = &declare->symbols->symbol[i];

		if (symbol->member ||
		    !name_equal(symbol->text[FIELD_NAME], name))
			continue;
		if (symbol->table > 0)
			return symbol;
		global = symbol;
	}
	return global;
}

/* ---- addresses ---- */

static uint64_t bits_of(const struct var *var)
{
	return (uint64_t)var->at.bits * (var->array.count ? var->array.count : 1);
}

static bool overlaps(const struct var *a, const struct var *b)
{
	const uint64_t first = (uint64_t)a->at.byte * 8 + a->at.bit;
	const uint64_t other = (uint64_t)b->at.byte * 8 + b->at.bit;

	return a->at.area != AREA_NONE && a->at.area == b->at.area &&
	       first < other + bits_of(b) && other < first + bits_of(a);
}

/* The variable here that lies at the address of a variable of the source; NULL: none. */
static const char *owner_of(const struct declare *declare, const struct var *var)
{
	for (int table = 0; table <= declare->project->pou_count; table++) {
		const struct var_table *vars = xref_table(declare->project, table);

		for (int i = 0; i < vars->count; i++)
			if (overlaps(var, &vars->var[i]))
				return project_text(declare->project, vars->var[i].name);
	}
	return NULL;
}

static bool put(struct declare *declare, const struct symbol_row *symbol,
		const char *address)
{
	const char *text[SYMBOL_FIELDS];

	for (int i = 0; i < SYMBOL_FIELDS; i++)
		text[i] = symbol->text[i];
	text[FIELD_ADDRESS] = address;
	if (!symbol_batch_put(declare->batch, symbol->table ? declare->pou + 1 : 0, -1, 0,
			      text, NULL))
		return false;
	declare->count++;
	return true;
}

static void declare_one(struct declare *declare, const struct symbol_row *symbol)
{
	const struct var_table *vars = xref_table(declare->source, symbol->table);
	const char *owner = owner_of(declare, &vars->var[symbol->index]);

	if (!put(declare, symbol, owner ? "" : symbol->text[FIELD_ADDRESS]) || !owner)
		return;
	if (declare->clashes++ == 0)
		declare->clash = g_strdup_printf(_("; %s has no address: %s is %s here"),
			symbol->text[FIELD_NAME], symbol->text[FIELD_ADDRESS], owner);
}

/* ---- all of them ---- */

static char *done(const struct declare *declare)
{
	GString *text = g_string_new(NULL);
	const int more = declare->clashes - 1;

	g_string_printf(text, ngettext("%d name was declared", "%d names were declared",
				       (gulong)declare->count), declare->count);
	if (declare->clash)
		g_string_append(text, declare->clash);
	if (more > 0)
		g_string_append_printf(text, ngettext(" and %d more", " and %d more",
						      (gulong)more), more);
	return g_string_free(text, FALSE);
}

struct wanting { const struct declare *declare; GPtrArray *names; };

static gboolean is_same_name(gconstpointer a, gconstpointer b)
{
	return name_equal(a, b);
}

static void want(void *context, const char *text, gsize len)
{
	const struct wanting *wanting = context;
	const struct project *project = wanting->declare->project;
	const uint32_t fold = names_find_any(&project->names, text, len);
	char *name = g_strndup(text, len);

	if ((fold && (vars_find(&project->globals, fold) >= 0 ||
		      vars_find(&project->pou[wanting->declare->pou].vars, fold) >= 0)) ||
	    g_ptr_array_find_with_equal_func(wanting->names, name, is_same_name, NULL))
		g_free(name);
	else
		g_ptr_array_add(wanting->names, name);
}

/* @names: gets the constants that a declaration needs. */
static char *declare_all(struct declare *declare, GPtrArray *names)
{
	struct wanting wanting = { declare, names };
	char *told = NULL;

	declare->batch = symbol_batch_new(declare->document);
	for (guint i = 0; i < names->len; i++) {
		const struct symbol_row *symbol = find(declare, names->pdata[i]);

		if (!symbol)
			continue;
		declare_one(declare, symbol);
		each_needed(declare->source, &xref_table(declare->source,
			symbol->table)->var[symbol->index], want, &wanting);
	}
	if (declare->count &&
	    symbol_batch_apply(declare->batch, _("Add symbol"), &told))
		told = done(declare);
	symbol_batch_free(declare->batch);
	g_free(declare->clash);
	return told;
}

char *rung_clip_declare(const struct rung_clip *clip, LadderDocument *document, int pou,
			int at, int count)
{
	struct declare declare = { .document = document, .pou = pou,
				   .project = ladder_document_project(document) };
	char *told = NULL;

	if (!clip->source)
		return NULL;
	declare.source = ladder_document_project(clip->source);
	declare.symbols = symbols_new(clip->source);
	if (has_news(&declare)) {
		GPtrArray *names = unknown_names(&declare, at, count);

		if (names->len)
			told = declare_all(&declare, names);
		g_ptr_array_unref(names);
	}
	symbols_free(declare.symbols);
	return told;
}
