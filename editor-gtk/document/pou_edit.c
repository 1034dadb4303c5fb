/* SPDX-License-Identifier: MIT
 *
 * pou_edit - adds and deletes programs and blocks.
 */
#include "editor-gtk/document/pou_edit.h"

#include "editor-gtk/kit/i18n.h"

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

const char *pou_delete(LadderDocument *document, int pou)
{
	struct part_of_pou part = { ladder_document_project(document), pou,
				    { 0 }, false };
	gsize len;
	char *text;
	bool good;

	if (!part.project || part.project->pou_count < 2)
		return _("It cannot be deleted: a project has at least one program");
	text = ladder_document_outline(document, &len, take_part, &part);
	g_free(text);
	if (!part.found)
		return _("It is declared in another file");
	ladder_document_begin(document, _("Delete program or block"), NULL);
	good = ladder_document_replace(document, part.span.at, part.span.len, "", NULL);
	ladder_document_end(document);
	return good ? NULL : _("It cannot be deleted while a text of the project cannot be read");
}
