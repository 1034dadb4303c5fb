/* SPDX-License-Identifier: MIT
 *
 * find - finds a text in rungs, lists and declarations, in the order of the file, and
 * replaces it. The document refuses a replacement that it could not read again.
 */
#include "editor-gtk/document/find.h"

#include "editor-gtk/document/spelled.h"
#include "editor-gtk/draw/grid_names.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/xref/xref.h"

#include <string.h>

/* The text of a rung or cell that a hit is in: find_hit.field. */
enum hit_field {
	HIT_OPERAND, HIT_ARGS, HIT_COMMENT, HIT_RUNG_COMMENT, HIT_TITLE, HIT_LABEL,
};

struct search {
	struct find *find;
	struct project *project;
	struct find_hit place; /* the current place                            */
	struct iec_addr address; /* the searched address; AREA_NONE: a text    */
	struct grid_names *names; /* of the POU, for an address                */
};

/* ---- one text ---- */

static bool is_word_char(gunichar c)
{
	return c == '_' || g_unichar_isalnum(c);
}

static bool stands_alone(const char *text, const char *at, const char *end)
{
	if (at > text && is_word_char(g_utf8_get_char(g_utf8_prev_char(at))))
		return false;
	return !*end || !is_word_char(g_utf8_get_char(end));
}

/* The end of a match at @at, compared letter by letter; NULL: no match. */
static const char *match(const struct find *find, const char *at)
{
	const char *want = find->folded;

	for (; *want && *at; want = g_utf8_next_char(want), at = g_utf8_next_char(at)) {
		gunichar c = g_utf8_get_char(at);

		if (!find->options.match_case)
			c = g_unichar_tolower(c);
		if (c != g_utf8_get_char(want))
			return NULL;
	}
	return *want ? NULL : at;
}

static void add_hit(struct search *search, const char *text, const char *at,
		    const char *end)
{
	struct find_hit *hit = g_memdup2(&search->place, sizeof(*hit));

	hit->at = (gsize)(at - text);
	hit->len = (gsize)(end - at);
	hit->text = g_strdup(text);
	g_ptr_array_add(search->find->hit, hit);
}

gssize find_match(const struct find *find, const char *text, gsize *from)
{
	for (const char *at = text + *from; *at && *find->folded; at = g_utf8_next_char(at)) {
		const char *end = match(find, at);

		if (end && (!find->options.whole_word || stands_alone(text, at, end))) {
			*from = (gsize)(end - text);
			return at - text;
		}
	}
	return -1;
}

static void search_text(struct search *search, const char *text)
{
	gsize end = 0;
	gssize at;

	while (search->find->hit->len < FIND_HITS_MOST &&
	       (at = find_match(search->find, text, &end)) >= 0)
		add_hit(search, text, text + at, text + end);
}

static void search_id(struct search *search, enum find_where where, int field, uint32_t id)
{
	if (!id || !(search->find->options.where & where))
		return;
	search->place.where = where;
	search->place.field = field;
	search_text(search, project_text(search->project, id));
}

/* ---- addresses ---- */

/* A short form such as Q5 may also be part of a name, so it is searched as text. */
static struct iec_addr address_of(const char *text)
{
	struct iec_addr address = { .area = AREA_NONE };

	if (*text != '%' || iec_addr_parse(text, strlen(text), &address) != ADDR_OK)
		address.area = AREA_NONE;
	return address;
}

static bool is_wanted(const struct search *search, const char *address)
{
	const struct iec_addr at = address_of(address), want = search->address;

	return at.area != AREA_NONE && at.area == want.area && at.bits == want.bits &&
	       at.byte == want.byte && at.bit == want.bit;
}

/* Finds an element whose symbol lies at the searched address. */
static void search_symbol(struct search *search, const struct cell *cell)
{
	const char *name = project_text(search->project, cell->operand);
	struct find_hit *hit;

	if (!search->names || *name == '%' || !(search->find->options.where & FIND_OPERANDS) ||
	    search->find->hit->len >= FIND_HITS_MOST ||
	    !is_wanted(search, grid_names_find(search->names, name).address))
		return;
	search->place.where = FIND_OPERANDS;
	search->place.field = HIT_OPERAND;
	add_hit(search, name, name, name + strlen(name));
	hit = search->find->hit->pdata[search->find->hit->len - 1];
	hit->by_symbol = true;
}

static void names_start(struct search *search, const struct pou *pou)
{
	g_clear_pointer(&search->names, grid_names_free);
	if (search->address.area != AREA_NONE)
		search->names = grid_names_new(search->project, pou);
}

/* ---- the parts ---- */

static void search_rung(struct search *search, const struct rung *rung)
{
	search->place.row = search->place.col = -1;
	search_id(search, FIND_COMMENTS, HIT_RUNG_COMMENT, rung->comment);
	search_id(search, FIND_LABELS, HIT_LABEL, rung->label);
	search_id(search, FIND_TITLES, HIT_TITLE, rung->title);
	for (int i = 0; i < rung->rows * rung->cols; i++) {
		const struct cell *cell = &rung->cell[i];
		const bool jump = word_row((enum word)cell->word)->operand == OPND_LABEL;

		search->place.row = i / rung->cols;
		search->place.col = i % rung->cols;
		search_id(search, jump ? FIND_LABELS : FIND_OPERANDS, HIT_OPERAND,
			  cell->operand);
		if (!jump)
			search_symbol(search, cell);
		search_id(search, FIND_OPERANDS, HIT_ARGS, cell->args);
		search_id(search, FIND_COMMENTS, HIT_COMMENT, cell->comment);
	}
}

static void search_line(struct search *search, const char *line, int row)
{
	const guint first = search->find->hit->len;

	search->place.where = FIND_LISTS;
	search->place.row = row;
	search_text(search, line);
	for (guint k = first; k < search->find->hit->len; k++) {
		struct find_hit *hit = search->find->hit->pdata[k];

		hit->col = (int)hit->at;
	}
}

static void search_list(struct search *search, LadderDocument *document, int pou)
{
	char *text = ladder_document_list(document, pou), **line;

	if (!(search->find->options.where & FIND_LISTS) || !text) {
		g_free(text);
		return;
	}
	line = g_strsplit(text, "\n", -1);
	for (int i = 0; line[i]; i++)
		search_line(search, line[i], i);
	g_strfreev(line);
	g_free(text);
}

/* ---- charts: their rungs as rungs, the rest line by line ---- */

struct chart_parts {
	int pou;
	struct text_span whole;  /* of the POU                                  */
	GArray *apart;           /* struct text_span: rungs and declarations     */
};

static void take_part(void *context, const struct text_span *span)
{
	struct chart_parts *parts = context;

	if (span->part == TEXT_POU && span->number == parts->pou)
		parts->whole = *span;
	else if (span->pou == parts->pou &&
		 (span->part == TEXT_RUNG || span->part == TEXT_VAR))
		g_array_append_val(parts->apart, *span);
}

static bool is_apart(const struct chart_parts *parts, gsize at)
{
	for (guint i = 0; i < parts->apart->len; i++) {
		const struct text_span *span = &g_array_index(parts->apart, struct text_span,
							      i);

		if (at >= span->at && at < span->at + span->len)
			return true;
	}
	return false;
}

static void search_lines(struct search *search, const char *whole,
			 const struct chart_parts *parts)
{
	const char *at = whole + parts->whole.at, *end = at + parts->whole.len;

	for (int row = 0; at < end; row++) {
		const char *next = memchr(at, '\n', (gsize)(end - at));
		char *line = g_strndup(at, (gsize)((next ? next : end) - at));

		if (!is_apart(parts, (gsize)(at - whole)))
			search_line(search, line, row);
		g_free(line);
		at = next ? next + 1 : end;
	}
}

/* Expressions are searched as lines, not as rungs. */
static void search_chart(struct search *search, LadderDocument *document, int number)
{
	struct chart_parts parts = { .pou = number,
		.apart = g_array_new(FALSE, FALSE, sizeof(struct text_span)) };
	const struct pou *pou = &search->project->pou[number];
	gsize len;
	char *whole = ladder_document_outline(document, &len, take_part, &parts);

	if (search->find->options.where & (FIND_LISTS | FIND_OPERANDS | FIND_COMMENTS))
		search_lines(search, whole, &parts);
	for (guint i = 0; i < parts.apart->len; i++) {
		const struct text_span *span = &g_array_index(parts.apart, struct text_span,
							      i);

		if (span->part != TEXT_RUNG || span->number >= pou->rung_count)
			continue;
		search->place.rung = span->number;
		search_rung(search, pou->rung[span->number]);
	}
	g_array_unref(parts.apart);
	g_free(whole);
}

/* Declarations in the canonical text. */
struct lines {
	struct search *search;
	GArray *span;
};

static void take_var(void *context, const struct text_span *span)
{
	if (span->part == TEXT_VAR)
		g_array_append_val((GArray *)context, *span);
}

static int table_of(const struct project *project, const struct text_span *span)
{
	if (span->structure >= 0)
		return project->pou_count + 1 + span->structure;
	return span->pou + 1;
}

static void search_declaration(struct search *search, const char *whole,
			       const struct text_span *span)
{
	char *line;

	/* The text of a list includes its declarations. */
	if (span->pou >= 0 && (search->project->pou[span->pou].language == LANGUAGE_IL ||
			       search->project->pou[span->pou].language == LANGUAGE_ST ||
			       search->project->pou[span->pou].fbd))
		return;
	line = g_strndup(whole + span->at, span->len);
	g_strchomp(line);
	search->place = (struct find_hit){ .where = FIND_DECLARATIONS, .pou = span->pou,
		.rung = -1, .row = -1, .col = -1, .index = span->number,
		.table = table_of(search->project, span) };
	search_text(search, line);
	g_free(line);
}

/* @pou: -1: globals and structures. */
static void search_declarations(struct search *search, const char *whole,
				const GArray *span, int pou)
{
	if (!(search->find->options.where & FIND_DECLARATIONS))
		return;
	for (guint i = 0; i < span->len; i++) {
		const struct text_span *one = &g_array_index(span, struct text_span, i);

		if (one->pou == pou)
			search_declaration(search, whole, one);
	}
}

/* ---- all ---- */

static char *fold(const char *text, bool match_case)
{
	GString *out;

	if (match_case)
		return g_strdup(text);
	out = g_string_new("");
	for (; *text; text = g_utf8_next_char(text))
		g_string_append_unichar(out, g_unichar_tolower(g_utf8_get_char(text)));
	return g_string_free(out, FALSE);
}

static void clear_hit(gpointer pointer)
{
	struct find_hit *hit = pointer;

	g_free(hit->text);
	g_free(hit);
}

static void search_project(struct search *search, LadderDocument *document)
{
	GArray *span = g_array_new(FALSE, FALSE, sizeof(struct text_span));
	gsize len;
	char *whole = ladder_document_outline(document, &len, take_var, span);

	search_declarations(search, whole, span, -1);
	for (int i = 0; i < search->project->pou_count; i++) {
		const struct pou *pou = &search->project->pou[i];

		if (pou->included)
			continue;
		search_declarations(search, whole, span, i);
		names_start(search, pou);
		search->place = (struct find_hit){ .pou = i, .rung = -1, .row = -1,
						   .col = -1, .table = -1, .index = -1 };
		if (pou->sfc) {
			search_chart(search, document, i);
			continue;
		}
		if (pou->language != LANGUAGE_LD) {
			search_list(search, document, i);
			continue;
		}
		for (int k = 0; k < pou->rung_count; k++) {
			search->place.rung = k;
			search_rung(search, pou->rung[k]);
		}
	}
	g_clear_pointer(&search->names, grid_names_free);
	g_free(whole);
	g_array_unref(span);
}

/* A text has addresses as files do, whatever the sheets show. Caller: g_free. */
static char *as_written(LadderDocument *document, const char *wanted)
{
	char *valid = g_utf8_make_valid(wanted, -1), *canonical;

	if (spelling_screen() == SPELLING_IEC)
		return valid;
	canonical = spelled_canonical(document, valid);
	g_free(valid);
	return canonical;
}

struct find *find_new(LadderDocument *document, const char *wanted,
		      struct find_options options)
{
	struct find *find = g_new0(struct find, 1);
	struct search search = { .find = find };

	find->hit = g_ptr_array_new_with_free_func(clear_hit);
	find->wanted = as_written(document, wanted);
	find->options = options;
	search.project = ladder_document_project(document);
	find->folded = fold(find->wanted, options.match_case);
	search.address = address_of(find->wanted);
	if (search.project && *find->folded)
		search_project(&search, document);
	return find;
}

void find_free(struct find *find)
{
	if (!find)
		return;
	g_ptr_array_unref(find->hit);
	g_free(find->folded);
	g_free(find->wanted);
	g_free(find);
}

const struct find_hit *find_seen_next(const struct find_seen *seen, int pou, int *at, bool *now)
{
	for (; seen->find && *at < (int)seen->find->hit->len; ++*at) {
		const struct find_hit *hit = seen->find->hit->pdata[*at];

		*now = *at == seen->current;
		if (hit->pou == pou && (*now || seen->all)) {
			++*at;
			return hit;
		}
	}
	return NULL;
}

static int compare(const struct find_hit *hit, int pou, int rung, int row, int col)
{
	const int a[] = { hit->pou, hit->rung, hit->row, hit->col };
	const int b[] = { pou, rung, row, col };

	for (int i = 0; i < 4; i++)
		if (a[i] != b[i])
			return a[i] < b[i] ? -1 : 1;
	return 0;
}

int find_next(const struct find *find, int pou, int rung, int row, int col, bool back)
{
	const int count = (int)find->hit->len;

	for (int i = 0; i < count; i++) {
		const int number = back ? count - 1 - i : i;
		const int side = compare(find->hit->pdata[number], pou, rung, row, col);

		if (back ? side < 0 : side > 0)
			return number;
	}
	return !count ? -1 : back ? count - 1 : 0;
}

/* Hits in one place. */
struct hits {
	LadderDocument *document;
	struct find_hit *const *hit;
	int count;
	const char *with;
};

/* Backwards, so that earlier offsets stay valid. */
static char *replaced(const struct hits *hits, const char *text)
{
	GString *out = g_string_new(text);

	for (int i = hits->count - 1; i >= 0; i--) {
		g_string_erase(out, (gssize)hits->hit[i]->at, (gssize)hits->hit[i]->len);
		g_string_insert(out, (gssize)hits->hit[i]->at, hits->with);
	}
	return g_string_free(out, FALSE);
}

/* The leading hits that are in the same text as the first one. */
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

/* "PLACE: first error". @place: taken over. */
static char *reason_at(char *place, const struct diag_list *diags)
{
	char *what = diags->count ? diag_said_whole(&diags->diag[0]) :
		     g_strdup(_("The program cannot be read after this change"));
	char *reason = g_strdup_printf(_("%s: %s"), place, what);

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

/* All lines of a list, with the hits replaced. Caller frees. */
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

/* Refused if it cannot be read: only lists may be unreadable. */
static char *replace_in_chart(const struct hits *hits, struct diag_list *why)
{
	struct text_span span;
	char *text = ladder_document_pou(hits->document, hits->hit[0]->pou, &span);
	char *old = g_strndup(text + span.at, span.len);
	char *whole = replaced_lines(hits, old);
	const bool good = ladder_document_replace(hits->document, span.at, span.len, whole,
						  why);

	g_free(whole);
	g_free(old);
	g_free(text);
	return good ? NULL : reason_at(pou_name(hits), why);
}

/* ---- declarations ---- */

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

/* Number of declarations in the project: a replacement must not change it. */
static int declared(LadderDocument *document)
{
	struct project *project = ladder_document_project(document);
	int count = project->pou_count * LIMIT_VARS;

	for (int i = 0; i <= project->pou_count + project->structure_count; i++)
		count += xref_table(project, i)->count;
	return count;
}

/* Index of the first hit in the same declaration as the last hit. */
static int first_of_last(const struct find_hit *const *hit, int count)
{
	int at = count - 1;

	while (at > 0 && hit[at - 1]->table == hit[count - 1]->table &&
	       hit[at - 1]->index == hit[count - 1]->index)
		at--;
	return at;
}

/* Replaces in each declaration, backwards. NULL: a declaration was not found. Caller frees. */
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

/* A name that a replacement has made a double; NULL: none. */
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

/* The reason, with the declaration that has the error. */
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

/* The leading hits that are replaced together. */
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

/* Returns the reason of a failure, which the caller frees, or NULL. */
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
