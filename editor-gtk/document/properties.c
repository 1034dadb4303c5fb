/* SPDX-License-Identifier: MIT
 *
 * properties - title and properties of a project and its POUs; see properties.h.
 */
#include "editor-gtk/document/properties.h"

#include "editor-gtk/document/pou_edit.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/lex.h"
#include "engine/base/name.h"
#include "engine/model/st.h"
#include "engine/xref/xref.h"

#include <string.h>

/* ---- the project ---- */

const char *property_label(enum property property)
{
	static const char *const label[] = {
		[PROPERTY_AUTHOR] = N_("Author"), [PROPERTY_COMPANY] = N_("Company"),
		[PROPERTY_SITE] = N_("Site"), [PROPERTY_VERSION] = N_("Version"),
		[PROPERTY_REVISION] = N_("Revision"), [PROPERTY_DATE] = N_("Date"),
		[PROPERTY_LICENCE] = N_("Licence"),
		[PROPERTY_DESCRIPTION] = N_("Description"),
	};

	return _(label[property]);
}

/* Appends a line such as AUTHOR "…", or nothing for an empty text. */
static void put_line(GString *out, const char *word, const char *text)
{
	char *plain = g_strstrip(g_strdup(text));

	if (*plain)
		g_string_append_printf(out, "%s \"", word);
	for (const char *at = plain; *at; at++)
		if (*at == '"' || *at == '$')
			g_string_append_printf(out, "$%c", *at);
		else if (*at == '\n')
			g_string_append(out, "$N");
		else
			g_string_append_c(out, *at == '\t' || *at == '\r' ? ' ' : *at);
	if (*plain)
		g_string_append(out, "\"\n");
	g_free(plain);
}

static void take_title(void *context, const struct text_span *span)
{
	if (span->part == TEXT_TITLE)
		*(struct text_span *)context = *span;
}

char *properties_set(LadderDocument *document, const char *title,
		     const char *const property[PROPERTY_COUNT])
{
	const struct project *project = ladder_document_project(document);
	GString *text = g_string_new(NULL);
	struct text_span span = { 0 };
	gsize len;
	char *why;

	if (!project) {
		g_string_free(text, TRUE);
		return g_strdup(_("The file cannot be read as a program. Correct its errors first"));
	}
	put_line(text, "PROJECT", title);
	for (int i = 0; i < PROPERTY_COUNT; i++)
		put_line(text, property_row(i)->word, property[i]);
	if (project_has_head(project) && project->head) {
		/* without these lines the comment stands above the first part */
		char *head = g_strdup_printf(text->len ? "%s\n" : "\n%s\n",
					     project_text(project, project->head));

		g_string_prepend(text, head);
		g_free(head);
	}
	g_free(ladder_document_outline(document, &len, take_title, &span));
	why = ladder_document_replace_step(document, span.at, span.len, text->str,
					   _("Change project properties"));
	g_string_free(text, TRUE);
	return why;
}

/* ---- the comment of a POU ---- */

/* Appends the text of a comment, each line without the blanks around it. */
static void put_comment(GString *out, const char *text, gsize len)
{
	const gsize ends = text[0] == '(' ? 2 : 0;
	char *inner = g_strndup(text + 2, len - 2 - MIN(ends, len - 2));
	char **lines = g_strsplit(inner, "\n", -1);

	for (int i = 0; lines[i]; i++) {
		if (out->len || i)
			g_string_append_c(out, '\n');
		g_string_append(out, g_strstrip(lines[i]));
	}
	g_strfreev(lines);
	g_free(inner);
}

char *pou_comment(LadderDocument *document, int pou)
{
	const struct project *project = ladder_document_project(document);
	const char *text = project_text(project, project->pou[pou].comment);
	GString *out = g_string_new(NULL);
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	lex.comments = true;
	while (lex_next(&lex) == TOKEN_COMMENT)
		put_comment(out, lex.token.text, lex.token.len);
	return g_strstrip(g_string_free(out, FALSE));
}

/* Comments may be nested, so a delimiter in the text gets a blank. Lines are aligned. */
static char *comment_of(const char *text)
{
	GString *out = g_string_new("(* ");

	for (const char *at = text; *at; at++) {
		const bool opens = at[0] == '(' && at[1] == '*';
		const bool closes = at[0] == '*' && at[1] == ')';

		if (*at == '\n')
			g_string_append(out, "\n   ");
		else if (*at != '\r')
			g_string_append_c(out, *at);
		if (opens || closes)
			g_string_append_c(out, ' ');
	}
	g_string_append(out, " *)\n");
	return g_string_free(out, FALSE);
}

char *pou_set_comment(LadderDocument *document, int pou, const char *text)
{
	const struct project *project = ladder_document_project(document);
	char *before = project ? pou_comment(document, pou) : NULL, *why = NULL, *with;
	char *plain = g_strstrip(g_strdup(text));
	struct text_span span;
	gsize old;

	if (before && strcmp(before, plain) != 0) {
		old = strlen(project_text(project, project->pou[pou].comment));
		g_free(ladder_document_pou(document, pou, &span));
		span.len = old ? old + 1 : 0; /* its newline */
		span.at -= span.len;
		with = *plain ? comment_of(plain) : g_strdup("");
		why = ladder_document_replace_step(document, span.at, span.len, with,
						   _("Change comment"));
		g_free(with);
	}
	g_free(plain);
	g_free(before);
	return why;
}

/* ---- facts about a POU ---- */

const char *pou_fact_label(enum pou_fact fact)
{
	static const char *const label[] = {
		[POU_FACT_KIND] = N_("Kind"), [POU_FACT_LANGUAGE] = N_("Language"),
		[POU_FACT_LENGTH] = N_("Length"), [POU_FACT_CALLED] = N_("Used by"),
		[POU_FACT_RUNS] = N_("Runs"), [POU_FACT_SIZE] = N_("Size"),
	};

	return _(label[fact]);
}

static char *kind_of(const struct pou *pou)
{
	switch (pou->kind) {
	case POU_PROGRAM: return g_strdup(_("Program"));
	case POU_FUNCTION: return g_strdup(_("Function"));
	case POU_BLOCK: return g_strdup(_("Function block"));
	case POU_SUBROUTINE: return g_strdup(_("Subroutine"));
	case POU_ACTION: return g_strdup(_("Action"));
	}
	return NULL;
}

static char *language_of(const struct pou *pou)
{
	switch (pou->language) {
	case LANGUAGE_LD: return g_strdup(_("Ladder (LD)"));
	case LANGUAGE_IL: return g_strdup(_("Instruction list (IL)"));
	case LANGUAGE_SFC: return g_strdup(_("Chart (SFC)"));
	case LANGUAGE_ST: return g_strdup(_("Structured Text (ST)"));
	case LANGUAGE_FBD: return g_strdup(_("Function Block Diagram (FBD)"));
	}
	return NULL;
}

static char *length_of(const struct pou *pou)
{
	const int count = pou->sfc ? pou->sfc->step_count : pou->st ? pou->st->count :
		pou->language == LANGUAGE_LD ? pou->rung_count : pou->il.count;
	const unsigned long n = (unsigned long)count;

	if (pou->sfc)
		return g_strdup_printf(ngettext("%d step", "%d steps", n), count);
	return pou->language == LANGUAGE_LD ?
		g_strdup_printf(ngettext("%d rung", "%d rungs", n), count) :
		g_strdup_printf(ngettext("%d line", "%d lines", n), count);
}

/* "Main (2), Alarm (1)": POUs with the number of places. */
static char *called_by(struct project *project, int pou)
{
	int *count = g_new0(int, project->pou_count + 1);
	GString *out = g_string_new(NULL);
	struct xref xref = { 0 };

	if (!xref_make(&xref, project))
		g_error("out of memory");
	for (int i = 0; i < xref.count; i++) {
		const struct xref_use *use = &xref.use[i];

		if (use->target.what == XREF_POU && use->target.index == pou &&
		    use->kind != XREF_DECLARED && use->kind != XREF_RUN && use->pou != pou)
			count[use->pou + 1]++; /* first the globals */
	}
	for (int i = 0; i <= project->pou_count; i++)
		if (count[i])
			g_string_append_printf(out, "%s%s (%d)", out->len ? ", " : "",
				i ? project_text(project, project->pou[i - 1].name) :
				    _("the globals"), count[i]);
	xref_free(&xref);
	g_free(count);
	return g_string_free(out, FALSE);
}

static const struct config_entry *entry_named(const struct project *project,
					      enum config_kind kind, const char *name)
{
	for (int i = 0; project->config && i < project->config->count; i++) {
		const struct config_entry *entry = &project->config->entry[i];
		const uint32_t id = kind == CONFIG_PROGRAM ? entry->pou : entry->name;

		if (entry->kind == kind && name_equal(project_text(project, id), name))
			return entry;
	}
	return NULL;
}

static char *runs_in(const struct project *project, const struct config_entry *program)
{
	const char *task = project_text(project, program->task);
	const struct config_entry *entry = program->task ?
		entry_named(project, CONFIG_TASK, task) : NULL;

	if (!program->task)
		return g_strdup(_("in every scan, after all tasks"));
	if (entry && entry->interval)
		return g_strdup_printf(_("task %s, every %s"), task,
				       project_text(project, entry->interval));
	if (entry && entry->single)
		return g_strdup_printf(_("task %s, when %s becomes TRUE"), task,
				       project_text(project, entry->single));
	return g_strdup_printf(_("task %s"), task);
}

/* Programs only. */
static char *runs(LadderDocument *document, const struct project *project, int pou)
{
	const struct config_entry *program = entry_named(project, CONFIG_PROGRAM,
		project_text(project, project->pou[pou].name));
	int place = 0, count = 0;

	if (program)
		return runs_in(project, program);
	if (!pou_order_counts(document))
		return g_strdup(_("not: the CONFIGURATION does not list it"));
	for (int i = 0; i < project->pou_count; i++) {
		count += project->pou[i].kind == POU_PROGRAM;
		place += project->pou[i].kind == POU_PROGRAM && i <= pou;
	}
	return g_strdup_printf(_("in every scan, as number %d of %d"), place, count);
}

/* From the last check, if the program could be built. */
static char *size_of(LadderDocument *document, int pou)
{
	struct ladder *checked = ladder_document_checked(document);
	const struct il *il = checked && ladder_program(checked) ? ladder_il(checked, pou) : NULL;

	return il ? g_strdup_printf(ngettext("%d instruction", "%d instructions",
		(unsigned long)il->count), il->count) : NULL;
}

char *pou_fact(LadderDocument *document, int pou, enum pou_fact fact)
{
	struct project *project = ladder_document_project(document);
	const struct pou *of = &project->pou[pou];
	char *text = NULL;

	switch (fact) {
	case POU_FACT_KIND: return kind_of(of);
	case POU_FACT_LANGUAGE: return language_of(of);
	case POU_FACT_LENGTH: return length_of(of);
	case POU_FACT_CALLED:
		if (of->kind == POU_PROGRAM)
			return NULL;
		text = called_by(project, pou);
		if (*text)
			return text;
		g_free(text);
		return g_strdup(_("nothing"));
	case POU_FACT_RUNS:
		return of->kind == POU_PROGRAM ? runs(document, project, pou) : NULL;
	case POU_FACT_SIZE: return size_of(document, pou);
	case POU_FACTS: break;
	}
	return NULL;
}
