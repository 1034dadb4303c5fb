/* SPDX-License-Identifier: MIT
 *
 * find - hits of a text in rungs, lists and declarations, in the order of the file.
 * Replacing is find_replace.c's.
 */
#include "editor-gtk/document/find_inside.h"

#include "editor-gtk/draw/grid_names.h"
#include "engine/xref/xref.h"

#include <string.h>

struct search {
	struct find *find;
	struct project *project;
	char *folded;          /* what is wanted, in one case                  */
	struct find_hit place; /* where we are                                 */
	struct iec_addr address; /* that is wanted; AREA_NONE: another text    */
	struct grid_names *names; /* of the POU, if an address is wanted       */
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

/* Behind what is wanted if it stands at @at, letter by letter; NULL: it does not. */
static const char *match(const struct search *search, const char *at)
{
	const char *want = search->folded;

	for (; *want && *at; want = g_utf8_next_char(want), at = g_utf8_next_char(at)) {
		gunichar c = g_utf8_get_char(at);

		if (!search->find->options.match_case)
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

static void search_text(struct search *search, const char *text)
{
	for (const char *at = text; *at && search->find->hit->len < FIND_HITS_MOST;) {
		const char *end = match(search, at);

		if (!end || (search->find->options.whole_word &&
			     !stands_alone(text, at, end))) {
			at = g_utf8_next_char(at);
			continue;
		}
		add_hit(search, text, at, end);
		at = end;
	}
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

/* A short form, as Q5, may as well be a part of a name. */
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

/* An element that shows the address above its symbol. */
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

/* An expression is a line, and no rung. */
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

/* Declarations as they stand in the canonical text. */
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

	/* Those of a list are a part of its text. */
	if (span->pou >= 0 && search->project->pou[span->pou].language == LANGUAGE_IL)
		return;
	line = g_strndup(whole + span->at, span->len);
	g_strchomp(line);
	search->place = (struct find_hit){ .where = FIND_DECLARATIONS, .pou = span->pou,
		.rung = -1, .row = -1, .col = -1, .index = span->number,
		.table = table_of(search->project, span) };
	search_text(search, line);
	g_free(line);
}

/* Of the globals and structures (@pou -1), or of one POU. */
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

struct find *find_new(LadderDocument *document, const char *wanted,
		      struct find_options options)
{
	struct find *find = g_new0(struct find, 1);
	struct search search = { .find = find };

	find->hit = g_ptr_array_new_with_free_func(clear_hit);
	find->wanted = g_utf8_make_valid(wanted, -1);
	find->options = options;
	search.project = ladder_document_project(document);
	search.folded = fold(find->wanted, options.match_case);
	search.address = address_of(find->wanted);
	if (search.project && *search.folded)
		search_project(&search, document);
	g_free(search.folded);
	return find;
}

void find_free(struct find *find)
{
	if (!find)
		return;
	g_ptr_array_unref(find->hit);
	g_free(find->wanted);
	g_free(find);
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
