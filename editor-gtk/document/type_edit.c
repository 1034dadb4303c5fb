/* SPDX-License-Identifier: MIT
 *
 * type_edit - edits of structures as changes of the canonical text.
 */
#include "editor-gtk/document/type_edit.h"

#include "editor-gtk/document/pou_edit.h"
#include "editor-gtk/document/symbols.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/name.h"
#include "engine/xref/xref.h"

#include <string.h>

static bool refuse(char **why, char *text)
{
	*why = text;
	return false;
}

/* ---- what there is ---- */

int type_find(LadderDocument *document, const char *name)
{
	const struct project *project = ladder_document_project(document);

	for (int i = 0; project && i < project->structure_count; i++)
		if (name_equal(project_text(project, project->structure[i].name), name))
			return i;
	return -1;
}

int type_table(LadderDocument *document, int structure)
{
	return ladder_document_project(document)->pou_count + 1 + structure;
}

/* The part TYPE … END_TYPE that declares it. */
static const struct part *part_with(const struct project *project, int structure)
{
	for (int i = 0; i < project->part_count; i++) {
		const struct part *part = &project->part[i];

		if (part->kind == PART_TYPES && structure >= part->index &&
		    structure < part->index + part->count)
			return part;
	}
	return NULL;
}

bool type_is_included(LadderDocument *document, int structure)
{
	const struct part *part = part_with(ladder_document_project(document), structure);

	return !part || part->included;
}

/* ---- the text ---- */

struct outline {
	const struct project *project;
	char *text;
	gsize len;
	GArray *span;        /* of struct text_span                           */
};

static void take_span(void *context, const struct text_span *span)
{
	g_array_append_val((GArray *)context, *span);
}

static void outline_make(struct outline *outline, LadderDocument *document)
{
	outline->project = ladder_document_project(document);
	outline->span = g_array_new(FALSE, FALSE, sizeof(struct text_span));
	outline->text = ladder_document_outline(document, &outline->len, take_span,
						outline->span);
}

static void outline_clear(struct outline *outline)
{
	g_array_unref(outline->span);
	g_free(outline->text);
}

/* NULL: it is not in this file. */
static const struct text_span *find_span(const struct outline *outline, enum text_part part,
					 int structure, int number)
{
	for (guint i = 0; i < outline->span->len; i++) {
		const struct text_span *span = &g_array_index(outline->span,
							      struct text_span, i);

		if (span->part == part && span->number == number &&
		    span->structure == structure)
			return span;
	}
	return NULL;
}

static const struct text_span *structure_span(const struct outline *outline, int structure)
{
	return find_span(outline, TEXT_STRUCT, structure, structure);
}

/* Replaces a piece of the text as one step. */
static bool put(LadderDocument *document, gsize at, gsize removed, const char *with,
		const char *step, char **why)
{
	*why = ladder_document_replace_step(document, at, removed, with, step);
	return !*why;
}

static bool is_readable(LadderDocument *document, char **why)
{
	return (ladder_document_project(document) && ladder_document_is_whole(document)) ||
	       refuse(why, g_strdup(_("Nothing can be changed while a text of the project "
				      "cannot be read")));
}

/* ---- names ---- */

char *type_name_refusal(LadderDocument *document, const char *name)
{
	struct project *project = ladder_document_project(document);
	const enum diag_id fault = ladder_name_fault(name);

	if (!*name)
		return g_strdup(_("Enter a name"));
	if (fault == DIAG_EXPECTED)
		return g_strdup_printf(_("“%s” is not a name"), name);
	if (fault != DIAG_COUNT && fault != DIAG_SHADOWS_ADDRESS)
		return diag_said_of(fault, name);
	if (type_find(document, name) >= 0 || project_find_pou(project, name, strlen(name)) >= 0)
		return g_strdup_printf(_("“%s” is declared already"), name);
	if (words_is_taken(name))
		return g_strdup_printf(_("“%s” is a word of the language"), name);
	for (int i = 0; i < project->globals.count; i++)
		if (name_equal(name, project_text(project,
				project->globals.var[i].name)))
			return g_strdup_printf(_("“%s” is declared already"), name);
	return NULL;
}

char *type_free_name(LadderDocument *document, const char *like)
{
	char *stem = g_strdup(like), *name = g_strdup(like), *why;
	gsize len = strlen(stem);

	while (len > 1 && g_ascii_isdigit(stem[len - 1]))
		stem[--len] = '\0';
	for (int i = 2; (why = type_name_refusal(document, name)) && i < LIMIT_OWN_WORDS; i++) {
		g_free(why);
		g_free(name);
		name = g_strdup_printf("%s%d", stem, i);
	}
	g_free(why);
	g_free(stem);
	return name;
}

/* ---- adding ---- */

/* A new part TYPE goes before the first declaration, program or configuration. */
static gsize place_of_types(const struct outline *outline)
{
	for (guint i = 0; i < outline->span->len; i++) {
		const struct text_span *span = &g_array_index(outline->span,
							      struct text_span, i);
		enum part_kind kind = span->part == TEXT_PART ?
			outline->project->part[span->number].kind : PART_INCLUDE;

		if (kind != PART_INCLUDE && kind != PART_USES)
			return span->at;
	}
	return outline->len;
}

/* The last structure of this file; NULL: none. */
static const struct text_span *last_structure(const struct outline *outline)
{
	for (int i = outline->project->structure_count - 1; i >= 0; i--) {
		const struct text_span *span = structure_span(outline, i);

		if (span)
			return span;
	}
	return NULL;
}

bool type_add(LadderDocument *document, const char *name, char **why)
{
	struct outline outline;
	const struct text_span *last;
	char *text;
	bool good;

	*why = NULL;
	if (!is_readable(document, why))
		return false;
	*why = type_name_refusal(document, name);
	if (*why)
		return false;
	outline_make(&outline, document);
	last = last_structure(&outline);
	text = g_strdup_printf(last ? "  %s : STRUCT\n    %s : INT;\n  END_STRUCT;\n" :
		"TYPE\n  %s : STRUCT\n    %s : INT;\n  END_STRUCT;\nEND_TYPE\n\n", name,
		"Member1");
	good = put(document, last ? last->at + last->len : place_of_types(&outline), 0, text,
		   _("New structure"), why);
	g_free(text);
	outline_clear(&outline);
	return good;
}

bool type_duplicate(LadderDocument *document, int structure, const char *name, char **why)
{
	struct outline outline;
	const struct text_span *span;
	gsize head;
	char *text;
	bool good = false;

	*why = NULL;
	if (!is_readable(document, why))
		return false;
	*why = type_name_refusal(document, name);
	if (*why)
		return false;
	outline_make(&outline, document);
	span = structure_span(&outline, structure);
	if (span) {
		head = strlen("  ") + strlen(project_text(outline.project,
			outline.project->structure[structure].name));
		text = g_strdup_printf("  %s%.*s", name, (int)(span->len - head),
				       outline.text + span->at + head);
		good = put(document, span->at + span->len, 0, text, _("Duplicate structure"),
			   why);
		g_free(text);
	} else {
		refuse(why, g_strdup(_("It is declared in another file")));
	}
	outline_clear(&outline);
	return good;
}

/* ---- deleting ---- */

int type_uses(LadderDocument *document, int structure)
{
	const struct xref_target target = { .what = XREF_STRUCTURE, .index = structure };
	struct xref xref = { 0 };
	int count = 0;

	if (!xref_make(&xref, ladder_document_project(document)))
		g_error("out of memory");
	for (int i = 0; i < xref.count; i++)
		count += xref_same(&xref.use[i].target, &target) &&
			 xref.use[i].kind != XREF_DECLARED;
	xref_free(&xref);
	return count;
}

static bool is_of(const struct var *var, enum word word)
{
	return var->type == IEC_NONE && var->fb == word;
}

/* Names what stays but cannot be read without the type: a structure that has no other
 * members, or a function that returns it. NULL: none. Caller frees. */
static char *holder(const struct project *project, int structure)
{
	const enum word word = project->structure[structure].word;

	for (int i = 0; i < project->structure_count; i++) {
		const struct var_table *vars = &project->structure[i].vars;
		int others = 0;

		for (int k = 0; k < vars->count; k++)
			others += !is_of(&vars->var[k], word);
		if (i != structure && vars->count && !others)
			return g_strdup_printf(_("“%s” would have no member without it"),
				project_text(project, project->structure[i].name));
	}
	for (int i = 0; i < project->pou_count; i++)
		if (project->pou[i].kind == POU_FUNCTION && project->pou[i].vars.count &&
		    is_of(&project->pou[i].vars.var[0], word))
			return g_strdup_printf(_("“%s” returns it"),
				project_text(project, project->pou[i].name));
	return NULL;
}

/* The part TYPE if nothing else is in it, else the structure. */
static struct text_span deleted_span(const struct outline *outline, int structure)
{
	const struct part *part = part_with(outline->project, structure);

	if (part->count == 1)
		return *find_span(outline, TEXT_PART, -1,
				  (int)(part - outline->project->part));
	return *structure_span(outline, structure);
}

bool type_delete(LadderDocument *document, int structure, char **why)
{
	struct outline outline;
	struct text_span span;
	char *name;
	bool good;

	*why = NULL;
	if (!is_readable(document, why))
		return false;
	if (type_is_included(document, structure))
		return refuse(why, g_strdup(_("It is declared in another file")));
	*why = holder(ladder_document_project(document), structure);
	if (*why)
		return false;
	outline_make(&outline, document);
	span = deleted_span(&outline, structure);
	name = g_strdup(project_text(outline.project,
				     outline.project->structure[structure].name));
	outline_clear(&outline);
	ladder_document_begin(document, _("Delete structure"), NULL);
	good = pou_delete_text(document, &span, name);
	if (good)
		ladder_document_end(document);
	else
		ladder_document_cancel(document);
	g_free(name);
	return good || refuse(why, g_strdup(_("Another file cannot be read without it")));
}

/* ---- members ---- */

bool type_move_member(LadderDocument *document, int structure, int from, int to, char **why)
{
	struct outline outline;
	const struct text_span *moved, *other;
	char *text;
	gsize at, len;
	bool good = true;

	*why = NULL;
	if (!is_readable(document, why))
		return false;
	if (from == to)
		return true;
	outline_make(&outline, document);
	moved = find_span(&outline, TEXT_VAR, structure, from);
	other = find_span(&outline, TEXT_VAR, structure, to);
	if (!moved || !other) {
		good = refuse(why, g_strdup(_("It is declared in another file")));
	} else {
		at = MIN(moved->at, other->at);
		len = MAX(moved->at + moved->len, other->at + other->len) - at;
		text = to < from ?
			g_strdup_printf("%.*s%.*s", (int)moved->len, outline.text + moved->at,
				(int)(moved->at - at), outline.text + at) :
			g_strdup_printf("%.*s%.*s", (int)(at + len - moved->at - moved->len),
				outline.text + moved->at + moved->len, (int)moved->len,
				outline.text + moved->at);
		good = put(document, at, len, text, _("Move member"), why);
		g_free(text);
	}
	outline_clear(&outline);
	return good;
}

bool type_add_member(LadderDocument *document, int structure, int behind, char **name,
		     char **why)
{
	const struct project *project = ladder_document_project(document);
	const char *text[SYMBOL_FIELDS] = { "", "", "", "", "", "", "" };
	const struct var_table *vars;
	struct symbol_row *row;
	int table, count;
	bool good;

	*why = NULL;
	*name = NULL;
	if (!is_readable(document, why))
		return false;
	table = type_table(document, structure);
	vars = &project->structure[structure].vars;
	count = vars->count;
	row = symbol_row_new(project, vars, table, CLAMP(behind, 0, count - 1));
	*name = symbol_free_name(document, table, row->text[FIELD_NAME]);
	text[FIELD_NAME] = *name;
	text[FIELD_TYPE] = row->text[FIELD_TYPE];
	ladder_document_begin(document, _("Add member"), NULL);
	good = symbol_add(document, table, 0, text, why) &&
	       type_move_member(document, structure, count, behind + 1, why);
	if (good)
		ladder_document_end(document);
	else
		ladder_document_cancel(document);
	symbol_row_free(row);
	return good;
}
