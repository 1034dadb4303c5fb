/* SPDX-License-Identifier: MIT
 *
 * find_replace - hits become another text: rungs, lists, charts and declarations are given to
 * the document anew, which refuses what could not be read again.
 */
#include "editor-gtk/document/find_inside.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "engine/xref/xref.h"

#include <string.h>

/* Some hits of a find, all at one place. */
struct hits {
	LadderDocument *document;
	struct find_hit *const *hit;
	int count;
	const char *with;
};

/* From the last to the first, so that places before stay what they are. */
static char *replaced(const struct hits *hits, const char *text)
{
	GString *out = g_string_new(text);

	for (int i = hits->count - 1; i >= 0; i--) {
		g_string_erase(out, (gssize)hits->hit[i]->at, (gssize)hits->hit[i]->len);
		g_string_insert(out, (gssize)hits->hit[i]->at, hits->with);
	}
	return g_string_free(out, FALSE);
}

/* How many from the first on are at its place, in the same text. */
static struct hits same_text(struct hits hits)
{
	const struct find_hit *first = hits.hit[0];
	int count = 1;

	while (count < hits.count && hits.hit[count]->row == first->row &&
	       hits.hit[count]->where == first->where &&
	       hits.hit[count]->field == first->field &&
	       hits.hit[count]->index == first->index &&
	       hits.hit[count]->table == first->table &&
	       (first->where == FIND_LISTS || hits.hit[count]->col == first->col))
		count++;
	hits.count = count;
	return hits;
}

/* ---- why not ---- */

/* What the first error says of a place. @place: taken over. */
static char *reason_at(char *place, const struct diag_list *diags)
{
	char *what = diags->count ? diag_said_whole(&diags->diag[0]) :
		     g_strdup(_("It could not be read again"));
	char *reason = g_strdup_printf("%s: %s", place, what);

	g_free(what);
	g_free(place);
	return reason;
}

static char *pou_name(const struct hits *hits)
{
	const struct project *project = ladder_document_project(hits->document);

	return g_strdup(project_text(project, project->pou[hits->hit[0]->pou].name));
}

/* ---- rungs ---- */

static uint32_t *id_of(struct rung *rung, const struct find_hit *hit)
{
	struct cell *cell = hit->row < 0 ? NULL : rung_cell(rung, hit->row, hit->col);

	switch ((enum hit_field)hit->field) {
	case HIT_OPERAND:
		return &cell->operand;
	case HIT_ARGS:
		return &cell->args;
	case HIT_COMMENT:
		return &cell->comment;
	case HIT_RUNG_COMMENT:
		return &rung->comment;
	case HIT_TITLE:
		return &rung->title;
	case HIT_LABEL:
		return &rung->label;
	}
	return NULL;
}

static char *replace_in_rung(const struct hits *hits, struct diag_list *why)
{
	struct project *project = ladder_document_project(hits->document);
	const struct find_hit *first = hits->hit[0];
	struct rung *rung = rung_copy(project->pou[first->pou].rung[first->rung]);
	struct hits rest = *hits;

	while (rest.count > 0) {
		const struct hits same = same_text(rest);
		char *text = replaced(&same, same.hit[0]->text);

		*id_of(rung, same.hit[0]) = names_intern(&project->names, text,
							 strlen(text));
		g_free(text);
		rest.hit += same.count;
		rest.count -= same.count;
	}
	if (ladder_document_put_rung(hits->document, first->pou, first->rung, rung, why))
		return NULL;
	return reason_at(g_strdup_printf(_("%s, rung %d"), project_text(project,
		project->pou[first->pou].name), first->rung + 1), why);
}

/* ---- lists ---- */

/* All its lines, with the hits replaced. Caller frees. */
static char *replaced_lines(const struct hits *hits, const char *text)
{
	char **line = g_strsplit(text, "\n", -1), *whole;
	struct hits rest = *hits;

	while (rest.count > 0) {
		const struct hits same = same_text(rest);
		const int row = same.hit[0]->row;
		char *more = replaced(&same, line[row]);

		g_free(line[row]);
		line[row] = more;
		rest.hit += same.count;
		rest.count -= same.count;
	}
	whole = g_strjoinv("\n", line);
	g_strfreev(line);
	return whole;
}

static char *replace_in_list(const struct hits *hits, struct diag_list *why)
{
	const int pou = hits->hit[0]->pou;
	char *text = ladder_document_list(hits->document, pou);
	char *whole = replaced_lines(hits, text);
	const bool good = ladder_document_put_list(hits->document, pou, whole);

	g_free(whole);
	g_free(text);
	return good ? NULL : reason_at(pou_name(hits), why);
}

struct pou_place { int pou; struct text_span span; };

static void take_pou(void *context, const struct text_span *span)
{
	struct pou_place *place = context;

	if (span->part == TEXT_POU && span->number == place->pou)
		place->span = *span;
}

/* Unlike a list it is refused if it cannot be read. */
static char *replace_in_chart(const struct hits *hits, struct diag_list *why)
{
	struct pou_place place = { .pou = hits->hit[0]->pou };
	gsize len;
	char *text = ladder_document_outline(hits->document, &len, take_pou, &place);
	char *old = g_strndup(text + place.span.at, place.span.len);
	char *whole = replaced_lines(hits, old);
	const bool good = ladder_document_replace(hits->document, place.span.at,
						  place.span.len, whole, why);

	g_free(whole);
	g_free(old);
	g_free(text);
	return good ? NULL : reason_at(pou_name(hits), why);
}

/* ---- declarations ---- */

static void take_var(void *context, const struct text_span *span)
{
	if (span->part == TEXT_VAR)
		g_array_append_val((GArray *)context, *span);
}

static const struct text_span *span_of(const GArray *spans, const struct project *project,
				       const struct find_hit *hit)
{
	const int structure = MAX(hit->table - project->pou_count - 1, -1);

	for (guint i = 0; i < spans->len; i++) {
		const struct text_span *span = &g_array_index(spans, struct text_span, i);

		if (span->pou == hit->pou && span->number == hit->index &&
		    span->structure == structure)
			return span;
	}
	return NULL;
}

/* All declarations of the project: a replacement may make none and lose none. */
static int declared(LadderDocument *document)
{
	struct project *project = ladder_document_project(document);
	int count = project->pou_count * LIMIT_VARS;

	for (int i = 0; i <= project->pou_count + project->structure_count; i++)
		count += xref_table(project, i)->count;
	return count;
}

/* The first of those that are in the same declaration as the last one. */
static int first_of_last(const struct find_hit *const *hit, int count)
{
	int at = count - 1;

	while (at > 0 && hit[at - 1]->table == hit[count - 1]->table &&
	       hit[at - 1]->index == hit[count - 1]->index)
		at--;
	return at;
}

/* One declaration after the other in the one text, from the last one on; NULL: one is not
 * there. Caller frees. */
static GString *declarations_replaced(const struct hits *hits, char *whole, GArray *spans)
{
	const struct project *project = ladder_document_project(hits->document);
	GString *text = g_string_new(whole);

	for (int count = hits->count, at; count > 0; count = at) {
		at = first_of_last((const struct find_hit *const *)hits->hit, count);
		struct hits same = *hits;
		const struct text_span *span = span_of(spans, project, hits->hit[at]);
		char *line;

		if (!span) {
			g_string_free(text, TRUE);
			return NULL;
		}
		same.hit += at;
		same.count = count - at;
		line = replaced(&same, same.hit[0]->text);
		g_string_erase(text, (gssize)span->at, (gssize)span->len - 1);
		g_string_insert(text, (gssize)span->at, line);
		g_free(line);
	}
	return text;
}

/* A name that two declarations of a table have now, one of which was replaced; NULL: none. */
static const char *declared_twice(const struct hits *hits)
{
	struct project *project = ladder_document_project(hits->document);

	for (int i = 0; i < hits->count; i++) {
		const struct find_hit *hit = hits->hit[i];
		const struct var_table *vars = xref_table(project, hit->table);

		for (int k = 0; k < vars->count; k++)
			if (k != hit->index &&
			    vars->var[k].fold == vars->var[hit->index].fold)
				return project_text(project, vars->var[k].name);
	}
	return NULL;
}

/* The declaration that it says something of. */
static char *declaration_reason(const char *text, const struct diag_list *diags)
{
	char **line = g_strsplit(text, "\n", -1), *place;
	const int number = diags->count ? diags->diag[0].line : 0;

	if (number > 0 && number <= (int)g_strv_length(line))
		place = g_strdup_printf("“%s”", g_strstrip(line[number - 1]));
	else
		place = g_strdup(_("Declarations"));
	g_strfreev(line);
	return reason_at(place, diags);
}

static char *put_declarations(const struct hits *hits, const char *text, gsize len,
			      struct diag_list *why)
{
	const int before = declared(hits->document);
	const bool was = declared_twice(hits);
	const char *twice;

	if (!ladder_document_replace(hits->document, 0, len, text, why) ||
	    declared(hits->document) != before)
		return declaration_reason(text, why);
	twice = was ? NULL : declared_twice(hits);
	return twice ? g_strdup_printf(_("“%s” is declared already"), twice) : NULL;
}

static char *replace_declarations(const struct hits *hits, struct diag_list *why)
{
	GArray *spans = g_array_new(FALSE, FALSE, sizeof(struct text_span));
	gsize len;
	char *whole = ladder_document_outline(hits->document, &len, take_var, spans);
	GString *text = declarations_replaced(hits, whole, spans);
	char *reason = text ? put_declarations(hits, text->str, len, why) :
		       declaration_reason("", why);

	if (text)
		g_string_free(text, TRUE);
	g_free(whole);
	g_array_unref(spans);
	return reason;
}

/* ---- any ---- */

/* How many from the first on go in one go. */
static struct hits one_go(struct hits hits)
{
	const struct find_hit *first = hits.hit[0];
	const bool declaration = first->where == FIND_DECLARATIONS;
	int count = 1;

	while (count < hits.count && declaration ==
	       (hits.hit[count]->where == FIND_DECLARATIONS) &&
	       (declaration || (hits.hit[count]->pou == first->pou &&
				hits.hit[count]->rung == first->rung)))
		count++;
	hits.count = count;
	return hits;
}

static bool is_chart(const struct hits *hits)
{
	const struct project *project = ladder_document_project(hits->document);

	return project->pou[hits->hit[0]->pou].sfc != NULL;
}

/* Returns why not, which the caller frees. */
static char *replace_go(const struct hits *hits, struct diag_list *why)
{
	diag_init(why);
	if (hits->hit[0]->where == FIND_DECLARATIONS)
		return replace_declarations(hits, why);
	if (hits->hit[0]->where == FIND_LISTS)
		return is_chart(hits) ? replace_in_chart(hits, why) :
		       replace_in_list(hits, why);
	return replace_in_rung(hits, why);
}

static bool replace(struct hits hits, const char *step, char **why)
{
	struct diag_list *diags = g_new(struct diag_list, 1);
	char *reason = NULL;
	bool good;

	ladder_document_begin(hits.document, step, NULL);
	while (!reason && hits.count > 0) {
		const struct hits go = one_go(hits);

		reason = replace_go(&go, diags);
		hits.hit += go.count;
		hits.count -= go.count;
	}
	good = !reason;
	if (good)
		ladder_document_end(hits.document);
	else
		ladder_document_cancel(hits.document);
	g_free(diags);
	if (why)
		*why = reason;
	else
		g_free(reason);
	return good;
}

bool find_replace(LadderDocument *document, const struct find *find, int number,
		  const char *with, char **why)
{
	struct hits hits = { document, NULL, 1, with };

	if (why)
		*why = NULL;
	if (number < 0 || number >= (int)find->hit->len)
		return false;
	hits.hit = (struct find_hit *const *)find->hit->pdata + number;
	if (hits.hit[0]->by_symbol)
		return false;
	return replace(hits, _("Replace"), why);
}

int find_replace_all(LadderDocument *document, const struct find *find, const char *with,
		     char **why)
{
	GPtrArray *hit = g_ptr_array_new();
	struct hits hits = { document, NULL, 0, with };
	bool good;

	for (guint i = 0; i < find->hit->len; i++)
		if (!((const struct find_hit *)find->hit->pdata[i])->by_symbol)
			g_ptr_array_add(hit, find->hit->pdata[i]);
	hits.hit = (struct find_hit *const *)hit->pdata;
	hits.count = (int)hit->len;
	good = replace(hits, _("Replace all"), why);
	g_ptr_array_unref(hit);
	return good ? hits.count : -1;
}
