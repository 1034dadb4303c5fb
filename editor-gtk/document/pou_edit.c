/* SPDX-License-Identifier: MIT
 *
 * pou_edit - adds and deletes programs and blocks.
 */
#include "editor-gtk/document/pou_edit.h"

#include "editor-gtk/edit/grid_display.h"
#include "editor-gtk/edit/grid_edit.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/xref/xref.h"

#include <string.h>

/* ---- adding ---- */

static bool is_taken(const struct project *project, const char *name)
{
	if (project_find_pou(project, name, strlen(name)) >= 0)
		return true;
	for (int i = 0; i < project->globals.count; i++)
		if (g_ascii_strcasecmp(project_text(project, project->globals.var[i].name),
				       name) == 0)
			return true;
	return words_is_taken(name);
}

static char *free_name(const struct project *project, const char *what)
{
	const char *base = g_str_has_prefix(what, "PROGRAM") ? "Program" :
		g_str_has_prefix(what, "FUNCTION_BLOCK") ? "Block" :
		g_str_has_prefix(what, "FUNCTION") ? "Function" : "Routine";
	char *name = NULL;

	for (int i = 1; !name || is_taken(project, name); i++) {
		g_free(name);
		name = g_strdup_printf("%s%d", base, i);
	}
	return name;
}

/* A new function or block has an input, and returns it until it is edited. */
static char *text_of(const char *what, const char *name)
{
	char **words = g_strsplit(what, " ", 2);
	const bool list = strcmp(words[1], "IL") == 0;
	const bool function = strcmp(words[0], "FUNCTION") == 0;
	const bool block = strcmp(words[0], "FUNCTION_BLOCK") == 0;
	const bool chart = strcmp(words[1], "SFC") == 0;
	char *called = g_strdup_printf("RUNG\n  | NO In | COIL %s |\n", function ? name : "Out");
	char *text = g_strdup_printf("\n%s %s%s %s\n%s%s%sEND_%s\n", words[0], name,
		function ? " : BOOL" : "", words[1],
		function || block ? "VAR_INPUT\n  In : BOOL;\nEND_VAR\n" : "",
		block ? "VAR_OUTPUT\n  Out : BOOL;\nEND_VAR\n" : "",
		list ? "  LD FALSE\n" : chart ? "  INITIAL_STEP Start:\n  END_STEP\n" :
			function || block ? called : "RUNG\n", words[0]);

	g_free(called);
	g_strfreev(words);
	return text;
}

static const char *why_none(void)
{
	return _("Nothing can be added while a text of the project cannot be read");
}

const char *pou_add(GtkWidget *widget, LadderDocument *document, const char *what)
{
	const struct project *project = ladder_document_project(document);
	char *name, *text, *all;
	bool good;
	gsize len;

	if (!project)
		return why_none();
	name = free_name(project, what);
	text = text_of(what, name);
	all = ladder_document_outline(document, &len, NULL, NULL);
	ladder_document_begin(document, _("New program or block"), NULL);
	good = all && ladder_document_replace(document, len, 0, text, NULL);
	if (good) {
		project = ladder_document_project(document);
		gtk_widget_activate_action(widget, "win.go-to", "(iiii)",
					   project->pou_count - 1, 0, -1, -1);
	}
	ladder_document_end(document);
	g_free(all);
	g_free(text);
	g_free(name);
	return good ? NULL : why_none();
}

/* ---- deleting ---- */

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
		    (int)strlen(name) != diag_name_length(diag) ||
		    g_ascii_strncasecmp(diag->arg, name, strlen(name)) != 0)
			continue;
		delete_line(text, diag->line);
		any = true;
	}
	ladder_free(ladder);
	return any;
}

static bool delete_text(LadderDocument *document, const struct text_span *span, const char *name)
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
	g_free(ladder_document_outline(document, &len, take_part, &part));
	good = delete_text(document, &part.span, name);
	if (good)
		ladder_document_end(document);
	else
		ladder_document_cancel(document);
	g_free(name);
	return good ? NULL : _("It cannot be deleted while a text of the project cannot be read");
}
