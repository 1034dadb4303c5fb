/* SPDX-License-Identifier: MIT
 *
 * rung_clip_read - a text that holds rungs, whoever wrote it: a copy of ours, lines of a
 * text editor, a whole file.
 *
 * It is cut where the lines begin that begin a part, and each part is read by the engine.
 * Of an error its line in the text as it came is told. Rungs are read in the document, so
 * that its own words are known; declarations in a project made for them.
 */
#include "editor-gtk/document/rung_clip.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/document/rung_clip_line.h"
#include "engine/base/lex.h"

#include <stdlib.h>
#include <string.h>

#define TYPES_ROUNDS 4 /* in each, as many types as a list of diagnostics holds */

/* A part of the text: from its comments on to the end of its last line. */
struct span {
	gsize at, len;
	int line;           /* of its first byte                               */
	gsize head;         /* bytes before its first word                     */
	gsize head_len;     /* of that                                         */
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
	gsize end;          /* behind the last line that had something         */
	int end_line;
	struct span *open;  /* what the line belongs to; NULL: nothing          */
	bool block;         /* and that is a block                             */
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

/* False: it is a file, or there are enough. */
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
		/* What follows on lines of their own belongs to what comes next. */
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

/* ---- what is wrong ---- */

static bool refuse(struct reading *r, char *why)
{
	g_free(r->why);
	r->why = why;
	return false;
}

static const struct diag *first_error(const struct diag_list *diags)
{
	for (int i = 0; i < diags->count; i++)
		if (diag_severity(diags->diag[i].id) == SEVERITY_ERROR)
			return &diags->diag[i];
	return NULL;
}

static bool refuse_at(struct reading *r, const struct diag_list *diags, int line)
{
	const struct diag *diag = first_error(diags);
	char *said = diag ? diag_said_whole(diag) : g_strdup(_("It cannot be read"));

	refuse(r, g_strdup_printf(_("The clipboard, line %d: %s"), line, said));
	g_free(said);
	return false;
}

static int line_of(const struct diag_list *diags)
{
	const struct diag *diag = first_error(diags);

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

/* RUNG stands where its first row did, so that comments stay above it. */
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

/* Types that nobody knows: each as a structure, so that what is of it can be read. */
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

/* The line of the clipboard that line @line of the blocks came from, which stand behind
 * two lines, the local ones behind one more. */
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

/* A file, behind its first two lines. */
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

/* False: again, with more types. */
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

/* What another project's rungs say, said here: its words may be unknown. */
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

/* No row and no word of a rung file. */
static bool take_lines(struct reading *r)
{
	char *why = NULL;
	int line = 1;
	char **text = rung_clip_lines(r->document, r->pou, r->text, &why, &line);
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
