/* SPDX-License-Identifier: MIT
 *
 * pou_edit - adds, duplicates, moves and deletes programs and blocks.
 */
#include "editor-gtk/document/pou_edit.h"

#include "editor-gtk/document/rename.h"
#include "editor-gtk/document/task_rows.h"
#include "editor-gtk/edit/grid_display.h"
#include "editor-gtk/edit/grid_edit.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/name.h"
#include "engine/xref/xref.h"

#include <stdlib.h>
#include <string.h>

/* ---- names ---- */

static bool is_global(const struct project *project, const char *name)
{
	for (int i = 0; i < project->globals.count; i++)
		if (name_equal(project_text(project, project->globals.var[i].name), name))
			return true;
	return false;
}

static bool is_structure(const struct project *project, const char *name)
{
	for (int i = 0; i < project->structure_count; i++)
		if (name_equal(project_text(project, project->structure[i].name), name))
			return true;
	return false;
}

static bool is_taken(const struct project *project, const char *name)
{
	return project_find_pou(project, name, strlen(name)) >= 0 ||
	       is_global(project, name) || is_structure(project, name) || words_is_taken(name);
}

char *pou_free_name(LadderDocument *document, enum pou_kind kind)
{
	static const char *const base[] = {
		[POU_PROGRAM] = "Program", [POU_FUNCTION] = "Function", [POU_BLOCK] = "Block",
		[POU_SUBROUTINE] = "Routine", [POU_ACTION] = "Action",
	};
	const struct project *project = ladder_document_project(document);
	char *name = NULL;

	for (int i = 1; !name || (project && is_taken(project, name)); i++) {
		g_free(name);
		name = g_strdup_printf("%s%d", base[kind], i);
	}
	return name;
}

/* "Motor_2" of "Motor" and of "Motor_1". */
char *pou_copy_name(LadderDocument *document, int pou)
{
	const struct project *project = ladder_document_project(document);
	char *base = g_strdup(project_text(project, project->pou[pou].name)), *name = NULL;
	char *digits = base + strlen(base);

	while (digits > base && g_ascii_isdigit(digits[-1]))
		digits--;
	if (*digits && digits > base + 1 && digits[-1] == '_')
		digits[-1] = '\0';
	for (int i = 2; !name || is_taken(project, name); i++) {
		g_free(name);
		name = g_strdup_printf("%s_%d", base, i);
	}
	g_free(base);
	return name;
}

char *pou_name_refusal(LadderDocument *document, enum pou_kind kind, const char *name)
{
	const struct project *project = ladder_document_project(document);
	const enum diag_id fault = ladder_name_fault(name);
	const bool called = kind == POU_FUNCTION || kind == POU_BLOCK;

	if (!project || !ladder_document_is_whole(document))
		return g_strdup(_("Nothing can be added while a text of the project cannot be "
				  "read"));
	if (!*name)
		return g_strdup(_("Enter a name"));
	if (fault == DIAG_RESERVED_NAME || (called && words_is_taken(name)))
		return g_strdup_printf(_("“%s” is a word of the language"), name);
	if (fault == DIAG_EXPECTED)
		return g_strdup_printf(_("“%s” is not a name"), name);
	if (project_find_pou(project, name, strlen(name)) >= 0)
		return g_strdup_printf(_("“%s” is a program or block of this project"), name);
	if (is_global(project, name))
		return g_strdup_printf(_("“%s” is a symbol of this project"), name);
	if (is_structure(project, name))
		return g_strdup_printf(_("“%s” is a data type of this project"), name);
	return NULL;
}

/* ---- adding ---- */

/* A new function or block has an input, and returns it until it is edited. */
static char *text_of(enum pou_kind kind, enum pou_language language, const char *name)
{
	const bool list = language == LANGUAGE_IL, chart = language == LANGUAGE_SFC;
	const bool statements = language == LANGUAGE_ST, networks = language == LANGUAGE_FBD;
	const bool function = kind == POU_FUNCTION, block = kind == POU_BLOCK;
	const char *result = function ? name : "Out";
	char *called = list ? g_strdup_printf("  LD In\n  ST %s\n", result) :
		       statements ? g_strdup_printf("  %s := In;\n", result) :
		       networks ? g_strdup_printf("NETWORK\n  %s := In\n", result) :
		       chart ? g_strdup_printf("  INITIAL_STEP Start:\n  END_STEP\n\n"
				"  TRANSITION FROM Start TO Work := In; END_TRANSITION\n\n"
				"  STEP Work:\n    %s(N);\n  END_STEP\n\n"
				"  TRANSITION FROM Work TO Start := NOT In; END_TRANSITION\n", result) :
		       g_strdup_printf("RUNG\n  | NO In | COIL %s |\n", result);
	char *text = g_strdup_printf("\n%s %s%s %s\n%s%s%sEND_%s\n", pou_word(kind), name,
		function ? " : BOOL" : "", pou_language_word(language),
		function || block ? "VAR_INPUT\n  In : BOOL;\nEND_VAR\n" : "",
		block ? "VAR_OUTPUT\n  Out : BOOL;\nEND_VAR\n" : "",
		function || block ? called : list ? "  LD FALSE\n" : statements ? "" :
			networks ? "NETWORK\n" : chart ? "  INITIAL_STEP Start:\n  END_STEP\n" : "RUNG\n",
		pou_word(kind));

	g_free(called);
	return text;
}

char *pou_add(LadderDocument *document, enum pou_kind kind, enum pou_language language,
	      const char *name)
{
	char *why = pou_name_refusal(document, kind, name), *text, *all;
	gsize len;

	if (why)
		return why;
	text = text_of(kind, language, name);
	all = ladder_document_outline(document, &len, NULL, NULL);
	why = ladder_document_replace_step(document, len, 0, text, _("New program or block"));
	g_free(all);
	g_free(text);
	return why;
}

/* ---- the text of a POU, with the comments above it ---- */

/* A POU as a part of the canonical text. */
struct part_of_pou {
	const struct project *project;
	int pou;
	struct text_span span;
	bool found;
};

static void take_part(void *context, const struct text_span *span)
{
	struct part_of_pou *part = context;
	const struct part *row = span->part == TEXT_PART ?
		&part->project->part[span->number] : NULL;

	if (row && row->kind == PART_POU && row->index == part->pou) {
		part->span = *span;
		part->found = true;
	}
}

char *pou_part(LadderDocument *document, int pou, struct text_span *span)
{
	struct part_of_pou part = { ladder_document_project(document), pou, { 0 }, false };
	gsize len;
	char *text = ladder_document_outline(document, &len, take_part, &part);

	*span = part.span;
	if (part.found)
		return text;
	g_free(text);
	return NULL;
}

/* ---- duplicating ---- */

/* The part with another name in its heading. Caller frees. */
static char *part_called(LadderDocument *document, int pou, const char *all,
			 const struct text_span *part, const char *name)
{
	const struct project *project = ladder_document_project(document);
	struct text_span span;
	gsize at, old = strlen(project_text(project, project->pou[pou].name));

	g_free(ladder_document_pou(document, pou, &span));
	at = span.at + strlen(pou_word(project->pou[pou].kind)) + 1;
	return g_strdup_printf("%.*s%s%.*s", (int)(at - part->at), all + part->at, name,
			       (int)(part->at + part->len - at - old), all + at + old);
}

/* The part of a POU after it was renamed, in a copy of the project. The engine renames the
 * result of a function, too. NULL, and @why: it is refused. Caller frees. */
static char *renamed_part(LadderDocument *document, int pou, const char *name, char **why)
{
	const struct xref_target target = { .what = XREF_POU, .index = pou };
	struct ladder *copy = ladder_document_reader(document);
	struct ladder_rename how;
	struct part_of_pou part = { NULL, pou, { 0 }, false };
	char *whole, *text = NULL;
	size_t len;

	whole = ladder_rename(ladder_document_ladder(document), &target, name, &len, &how);
	if (!whole) {
		*why = rename_reason(document, &how, name);
	} else if (ladder_load_text(copy, g_intern_string(
			   ladder_document_path(document) ? ladder_document_path(document) : ""),
					    whole, len)) {
		char *again;

		part.project = ladder_project(copy);
		again = ladder_outline(copy, &len, take_part, &part);
		text = part.found ? g_strndup(again + part.span.at, part.span.len) : NULL;
		free(again);
	}
	if (!text && !*why)
		*why = g_strdup(_("It cannot be read"));
	free(whole);
	ladder_free(copy);
	return text;
}

char *pou_duplicate(LadderDocument *document, int pou, const char *name)
{
	const struct project *project = ladder_document_project(document);
	char *why = pou_name_refusal(document, project ? project->pou[pou].kind : POU_PROGRAM,
				     name);
	struct text_span span;
	char *all, *part, *more;

	if (why)
		return why;
	all = pou_part(document, pou, &span);
	if (!all)
		return g_strdup(_("It is declared in another file"));
	/* Only a function uses its own name. */
	part = project->pou[pou].kind == POU_FUNCTION ?
		renamed_part(document, pou, name, &why) :
		part_called(document, pou, all, &span, name);
	if (part) {
		more = g_strconcat("\n", part, NULL);
		why = ladder_document_replace_step(document, span.at + span.len, 0, more,
						   _("Duplicate program or block"));
		g_free(more);
	}
	g_free(part);
	g_free(all);
	return why;
}

/* ---- order ---- */

static bool is_program(const struct project *project, int pou)
{
	return project->pou[pou].kind == POU_PROGRAM;
}

int pou_beside(LadderDocument *document, int pou, int by)
{
	const struct project *project = ladder_document_project(document);

	for (int i = pou + by; project && i >= 0 && i < project->pou_count; i += by)
		if (is_program(project, i) == is_program(project, pou) &&
		    !project->pou[i].included)
			return i;
	return -1;
}

bool pou_order_counts(LadderDocument *document)
{
	const struct project *project = ladder_document_project(document);

	for (int i = 0; project && project->config && i < project->config->count; i++)
		if (project->config->entry[i].kind == CONFIG_PROGRAM)
			return false;
	return true;
}

/* The text from the first to the last of both parts, with the part that moves at its new
 * place. A blank line stands before each part. */
static char *moved_text(const char *all, const struct text_span *moves,
			const struct text_span *stays, bool behind)
{
	const gsize to = behind ? stays->at + stays->len : stays->at - 1;
	const gsize from = moves->at - 1, len = moves->len + 1;

	return from < to ? g_strdup_printf("%.*s%.*s", (int)(to - from - len),
			all + from + len, (int)len, all + from) :
		g_strdup_printf("%.*s%.*s", (int)len, all + from, (int)(from - to), all + to);
}

const char *pou_move(LadderDocument *document, int pou, int beside, bool behind)
{
	const struct project *project = ladder_document_project(document);
	struct text_span moves, stays;
	char *all, *there, *text;
	bool good;
	gsize at;

	if (!project || !ladder_document_is_whole(document))
		return _("Nothing can be moved until the whole project can be read. Correct its errors first");
	if (pou == beside)
		return NULL;
	all = pou_part(document, pou, &moves);
	there = pou_part(document, beside, &stays);
	good = all && there;
	if (good) {
		at = MIN(moves.at - 1, behind ? stays.at + stays.len : stays.at - 1);
		text = moved_text(all, &moves, &stays, behind);
		ladder_document_begin(document, _("Move program or block"), NULL);
		good = ladder_document_replace(document, at, strlen(text), text, NULL);
		ladder_document_end(document);
		g_free(text);
	}
	g_free(there);
	g_free(all);
	return good ? NULL : _("It is declared in another file");
}

/* ---- deleting ---- */

int pou_uses(LadderDocument *document, int pou)
{
	struct project *project = ladder_document_project(document);
	struct xref xref = { 0 };
	int count = 0;

	if (!xref_make(&xref, project))
		g_error("out of memory");
	for (int i = 0; i < xref.count; i++)
		count += xref.use[i].target.what == XREF_POU && xref.use[i].target.index == pou &&
			 xref.use[i].kind != XREF_DECLARED && xref.use[i].pou != pou;
	xref_free(&xref);
	return count;
}

/* The rung without boxes of a word; NULL: it has none, or memory is out. */
static struct rung *without(const struct rung *rung, enum word word)
{
	struct rung *now = NULL;

	for (int i = rung->rows * rung->cols - 1; i >= 0; i--) {
		const struct rung *from = now ? now : rung;
		struct grid_at at = { .columns = grid_display_columns(from, 0) };
		struct rung *less;

		if (i >= from->rows * from->cols || from->cell[i].word != word)
			continue;
		at.row = i / from->cols;
		at.col = grid_display_column(from, at.columns, at.row, i % from->cols);
		less = grid_delete(from, &at);
		if (!less)
			break;
		rung_free(now);
		now = less;
		i = now->rows * now->cols;
	}
	return now;
}

static void delete_boxes(LadderDocument *document, int pou)
{
	struct project *project = ladder_document_project(document);
	const enum word word = project->pou[pou].word;

	for (int n = 0; n < project->pou_count && word != WORD_COUNT; n++)
		for (int i = 0; n != pou && i < project->pou[n].rung_count; i++) {
			struct rung *rung = without(project->pou[n].rung[i], word);

			if (rung)
				ladder_document_put_rung(document, n, i, rung, NULL);
		}
}

/* Deletes line @number, from 1. */
static void delete_line(GString *text, int number)
{
	const char *at = text->str, *end;

	while (--number > 0 && strchr(at, '\n'))
		at = strchr(at, '\n') + 1;
	end = strchr(at, '\n');
	g_string_erase(text, at - text->str, end ? end + 1 - at : -1);
}

/* Deletes lines that cannot be read because of the name. False: there is none. */
static bool delete_lines(GString *text, const char *name)
{
	struct ladder *ladder = ladder_new();
	const struct diag_list *diags;
	bool any = false;

	if (!ladder || ladder_load_text(ladder, "", text->str, text->len)) {
		ladder_free(ladder);
		return false;
	}
	diags = ladder_diags(ladder);
	for (int i = diags->count - 1; i >= 0; i--) {
		const struct diag *diag = &diags->diag[i];

		if (diag->rung || diag->line < 1 ||
		    !name_is(name, diag->arg, (size_t)diag_name_length(diag)))
			continue;
		delete_line(text, diag->line);
		any = true;
	}
	ladder_free(ladder);
	return any;
}

bool pou_delete_text(LadderDocument *document, const struct text_span *span, const char *name)
{
	gsize len;
	char *whole = ladder_document_outline(document, &len, NULL, NULL);
	GString *text = g_string_new(whole);
	bool good;

	g_string_erase(text, (gssize)span->at, (gssize)span->len);
	while (delete_lines(text, name))
		;
	good = ladder_document_replace(document, 0, len, text->str, NULL);
	g_string_free(text, TRUE);
	g_free(whole);
	return good;
}

/* Deletes its PROGRAM line in the CONFIGURATION. The only one stays: without it all run. */
static void delete_program_line(LadderDocument *document, int pou)
{
	struct task_rows *tasks = task_rows_new(document);
	int row = -1;

	for (int i = 0; i < tasks->count; i++)
		if (tasks->row[i].pou == pou && tasks->row[i].line)
			row = i;
	task_rows_free(tasks);
	if (row >= 0)
		task_rows_delete(document, row, NULL);
}

const char *pou_delete(LadderDocument *document, int pou)
{
	struct part_of_pou part = { ladder_document_project(document), pou,
				    { 0 }, false };
	gsize len;
	char *name;
	bool good;

	if (!part.project || part.project->pou_count < 2)
		return _("It cannot be deleted: a project has at least one program");
	g_free(ladder_document_outline(document, &len, take_part, &part));
	if (!part.found)
		return _("It is declared in another file");
	name = g_strdup(project_text(part.project, part.project->pou[pou].name));
	ladder_document_begin(document, _("Delete program or block"), NULL);
	delete_boxes(document, pou);
	delete_program_line(document, pou);
	part.project = ladder_document_project(document);
	g_free(ladder_document_outline(document, &len, take_part, &part));
	good = pou_delete_text(document, &part.span, name);
	if (good)
		ladder_document_end(document);
	else
		ladder_document_cancel(document);
	g_free(name);
	return good ? NULL : _("It cannot be deleted while a text of the project cannot be read");
}
