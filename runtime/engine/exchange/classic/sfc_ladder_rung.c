/* SPDX-License-Identifier: MIT
 *
 * sfc_ladder_rung - collects the cells of one rung and writes it as text.
 */
#include "engine/exchange/classic/sfc_ladder_parts.h"

#include "engine/base/ascii.h"

#include <string.h>

struct lad_rung *lad_begin(struct lad *e)
{
	struct lad_rung *r = arena_alloc(e->arena, sizeof(*r));

	e->good &= r != NULL;
	if (r)
		r->arena = e->arena;
	return r;
}

void lad_head(struct lad_rung *r, char *cell)
{
	if (!r)
		return;
	r->full |= r->heads == LAD_COLS;
	if (!r->full)
		r->head[r->heads++] = cell;
}

void lad_way(struct lad_rung *r)
{
	if (!r)
		return;
	r->full |= r->ways == LAD_ROWS;
	if (r->full)
		return;
	r->way[r->ways] = arena_alloc(r->arena, sizeof(*r->way[0]));
	r->full |= !r->way[r->ways];
	r->ways += !r->full;
}

void lad_cell(struct lad_rung *r, char *cell)
{
	struct lad_way *way;

	if (!r)
		return;
	if (!r->ways)
		lad_way(r);
	if (r->full)
		return;
	way = r->way[r->ways - 1];
	r->full |= way->length == LAD_COLS;
	if (!r->full)
		way->cell[way->length++] = cell;
}

void lad_out(struct lad_rung *r, char *cell)
{
	if (!r)
		return;
	r->full |= r->outs == LAD_ROWS;
	if (!r->full)
		r->out[r->outs++] = cell;
}

/* ---- writing ---- */

static int width_of(const struct lad_rung *r)
{
	int width = 0;

	for (int i = 0; i < r->ways; i++)
		width = r->way[i]->length > width ? r->way[i]->length : width;
	return width;
}

/* Text of the cell in column @col of row @row. */
static const char *cell_at(const struct lad_rung *r, int row, int col)
{
	if (col < r->heads)
		return row ? "" : r->head[col];
	col -= r->heads;
	if (row >= r->ways)
		return "";
	return col < r->way[row]->length ? r->way[row]->cell[col] : "---";
}

static void write_row(struct lad *e, const struct lad_rung *r, int row, int width)
{
	sink_text(&e->out, "  |");
	for (int col = 0; col < r->heads + width; col++) {
		const bool parts = col == r->heads - 1 && row < r->ways;
		const bool meets = col == r->heads + width - 1;

		sink_text(&e->out, " ");
		sink_text(&e->out, cell_at(r, row, col));
		sink_text(&e->out, row && (parts || meets) ? " ^|" : " |");
	}
	if (row < r->outs) {
		sink_text(&e->out, " ");
		sink_text(&e->out, r->out[row]);
		sink_text(&e->out, " |");
	}
	sink_text(&e->out, "\n");
}

void lad_write(struct lad *e, const struct lad_rung *r, const char *label,
	       const char *title)
{
	int rows, width;

	if (!r || (!r->outs && !r->full))
		return;
	width = width_of(r);
	if (r->full || r->heads + width > LAD_COLS) {
		lad_refuse(e, e->pou->line, 0, "too many steps at one place");
		return;
	}
	sink_text(&e->out, "RUNG ");
	sink_text(&e->out, label);
	sink_text(&e->out, *label ? " \"" : "\"");
	sink_text(&e->out, title);
	sink_text(&e->out, "\"\n");
	rows = r->ways > r->outs ? r->ways : r->outs;
	for (int row = 0; row < (rows ? rows : 1); row++)
		write_row(e, r, row, width);
}

/* ---- expressions ---- */

static bool is_plain(const char *text)
{
	static const char *const others[] = { " XOR ", " MOD ", "TRUE", "FALSE" };

	if (strpbrk(text, "()[]'&/*+") || strstr(text, " - "))
		return false;
	for (size_t i = 0; i < sizeof(others) / sizeof(*others); i++) {
		const size_t len = strlen(others[i]);

		for (const char *at = text; *at; at++)
			if (strlen(at) >= len && ascii_same(at, others[i], len))
				return false;
	}
	return true;
}

/* The next word of a plain expression; 0: none. */
static size_t next_word(const char **at, const char **word)
{
	*at += strspn(*at, " \t\n");
	*word = *at;
	*at += strcspn(*at, " \t\n");
	return (size_t)(*at - *word);
}

/* A contact for an operand or NOT of it, a cell for a comparison. false: something else. */
static bool put_term(struct lad *e, struct lad_rung *r, const char *text, size_t len,
		     int words)
{
	const bool inverse = words == 2 && len > 4 && ascii_same(text, "NOT ", 4);
	const bool compares = memchr(text, '=', len) || memchr(text, '<', len) ||
			      memchr(text, '>', len);

	if (words == 3 && !(len > 4 && ascii_same(text, "NOT ", 4)))
		lad_cell(r, lad_text(e, "[ %.*s ]", (int)len, text));
	else if (words == 1 && !compares)
		lad_cell(r, lad_text(e, "NO %.*s", (int)len, text));
	else if (inverse && !compares)
		lad_cell(r, lad_text(e, "NC %.*s", (int)len - 4, text + 4));
	else
		return false;
	return true;
}

/* Terms with AND as series, with OR as ways. false: something else. */
static bool put_terms(struct lad *e, struct lad_rung *r, const char *text)
{
	const char *at = text, *word, *term = NULL, *end = text;
	int words = 0;
	size_t len;

	lad_way(r);
	while ((len = next_word(&at, &word)) > 0) {
		const bool either = ascii_is("OR", word, len);

		if (!either && !ascii_is("AND", word, len)) {
			term = term ? term : word;
			end = word + len;
			words++;
			continue;
		}
		if (!term || !put_term(e, r, term, (size_t)(end - term), words))
			return false;
		if (either)
			lad_way(r);
		term = NULL;
		words = 0;
	}
	return term && put_term(e, r, term, (size_t)(end - term), words);
}

void lad_expression(struct lad *e, struct lad_rung *r, const char *text)
{
	if (!r || ascii_is("TRUE", text, strlen(text)))
		return;
	if (is_plain(text)) {
		const int ways = r->ways;

		if (put_terms(e, r, text))
			return;
		r->ways = ways;
	}
	lad_way(r);
	lad_cell(r, lad_text(e, "[ %s ]", text));
}
