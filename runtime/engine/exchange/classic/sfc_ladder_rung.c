/* SPDX-License-Identifier: MIT
 *
 * sfc_ladder_rung - collects the cells of one rung and writes it as text.
 */
#include "engine/exchange/classic/sfc_ladder_parts.h"

#include "engine/base/ascii.h"
#include "engine/base/literal.h"
#include "engine/check/mixed.h"
#include "engine/check/scope.h"
#include "engine/model/expr_args.h"

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

/* ---- what only Structured Text knows ---- */

static const struct meaning *meaning_of(struct lad *e, const struct expr_node *node)
{
	enum diag_id why;

	return scope_find(e->scope, e->pou, names_intern(&e->project->names, node->text, node->len), &why);
}

static bool is_whole_number(enum iec_type type)
{
	return iec_type_row(type)->class & ANY_INT;
}

static bool is_wide_constant(const struct expr_node *node)
{
	struct literal literal;
	union iec_value value;

	return literal_parse(node->text, node->len, &literal) == LITERAL_OK && literal.type == IEC_NONE &&
	       !literal.real && !literal_fit(&literal, IEC_INT, &value);
}

static bool is_comparison(enum word fn)
{
	return fn == FN_GT || fn == FN_GE || fn == FN_EQ || fn == FN_LE || fn == FN_LT || fn == FN_NE;
}

/* What is computed from @node is perhaps no BOOL and no operand. */
static bool is_computed(struct lad *e, const struct expr_node *node)
{
	const struct meaning *m = node->op == EXPR_NAME ? meaning_of(e, node) : NULL;

	return node->op == EXPR_NEG || node->op == EXPR_CALL || (node->op == EXPR_NAME && m && is_whole_number(m->type)) ||
	       (node->op == EXPR_FN && !is_comparison(node->fn));
}

static bool node_needs_st(struct lad *e, const struct expr_node *node)
{
	const struct expr_node *left = node->left >= 0 ? &e->expr->node[node->left] : NULL;
	const struct meaning *m;

	switch (node->op) {
	case EXPR_NAME:
		m = meaning_of(e, node);
		return m && mixed_is_bits(m->type);
	case EXPR_INDEX:
	case EXPR_BIT:
		return true;
	case EXPR_LITERAL:
		return is_wide_constant(node);
	case EXPR_CALL:
		return !word_is_own(expr_function(&e->project->words, node));
	case EXPR_NOT:
	case EXPR_AND:
	case EXPR_XOR:
	case EXPR_OR:
		return left && (is_computed(e, left) ||
				(node->right >= 0 && is_computed(e, &e->expr->node[node->right])));
	case EXPR_NEG:
	case EXPR_FN:
	case EXPR_ARG:
		return false;
	}
	return false;
}

bool lad_needs_st(struct lad *e, const char *text)
{
	struct diag_list *ignored = arena_alloc(e->arena, sizeof(*ignored));

	if (!e->expr)
		e->expr = arena_alloc(e->arena, sizeof(*e->expr));
	if (!e->scope)
		e->scope = scope_new(e->project, e->arena);
	e->good &= ignored && e->expr && e->scope;
	if (!e->good || !expr_parse_text(text, strlen(text), e->expr, ignored, (struct diag){ .id = DIAG_COUNT }))
		return false;
	for (int i = 0; i < e->expr->count; i++)
		if (node_needs_st(e, &e->expr->node[i]))
			return true;
	return false;
}
