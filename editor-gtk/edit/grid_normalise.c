/* SPDX-License-Identifier: MIT
 *
 * grid_normalise - the normal form of rungs, and whether two are the same circuit.
 *
 * A rung is spread out so that all outputs stand in one column, then columns of wire
 * before it are taken out one by one, as long as the circuit stays what it was.
 */
#include "editor-gtk/edit/grid_canvas.h"

#include <stdlib.h>
#include <string.h>

/* ---- the same circuit ---- */

static bool same_cell(const struct rung *a, const struct network_element *x,
		      const struct rung *b, const struct network_element *y)
{
	const struct cell *p = rung_at(a, x->row, x->col);
	const struct cell *q = rung_at(b, y->row, y->col);

	return p->word == q->word && p->operand == q->operand &&
	       p->args == q->args && p->comment == q->comment && x->pins == y->pins;
}

/* Nets of two graphs that stand for each other; -1: not known yet. */
struct pairing { int *ab, *ba; };

static bool pair(struct pairing *p, int a, int b)
{
	if (p->ab[a] < 0 && p->ba[b] < 0) {
		p->ab[a] = b;
		p->ba[b] = a;
	}
	return p->ab[a] == b && p->ba[b] == a;
}

static bool same_pins(struct pairing *p, const struct network *a,
		      const struct network_element *x, const struct network *b,
		      const struct network_element *y)
{
	for (int i = 0; i < x->pins; i++) {
		const struct network_pin *u = &a->pin[x->first_pin + i];
		const struct network_pin *v = &b->pin[y->first_pin + i];

		if (u->operand != v->operand || !pair(p, u->in, v->in))
			return false;
	}
	return true;
}

static bool same_graphs(struct pairing *p, const struct rung *a,
			const struct network *na, const struct rung *b,
			const struct network *nb)
{
	if (na->element_count != nb->element_count || na->pin_count != nb->pin_count)
		return false;
	for (int i = 0; i < na->element_count; i++) {
		const struct network_element *x = &na->element[i];
		const struct network_element *y = &nb->element[i];

		if (!same_cell(a, x, b, y) || !pair(p, x->in, y->in) ||
		    !pair(p, x->out, y->out) || !same_pins(p, na, x, nb, y))
			return false;
	}
	return true;
}

static int *unpaired(struct arena *arena, int count)
{
	int *made = arena_alloc(arena, (size_t)count * sizeof(*made));

	for (int i = 0; made && i < count; i++)
		made[i] = -1;
	return made;
}

bool grid_same(const struct rung *a, const struct rung *b)
{
	struct network na, nb;
	struct pairing p;
	struct arena arena;
	bool same = false;

	arena_init(&arena);
	if (network_make(a, &arena, &na) && network_make(b, &arena, &nb)) {
		p.ab = unpaired(&arena, na.net_count);
		p.ba = unpaired(&arena, nb.net_count);
		same = p.ab && p.ba && pair(&p, NET_RAIL, NET_RAIL) &&
		       same_graphs(&p, a, &na, b, &nb);
	}
	arena_free(&arena);
	return same;
}

/* ---- columns of wire ---- */

static bool is_output(const struct rung *rung, int row, int col)
{
	return word_row((enum word)rung_at(rung, row, col)->word)->place == PLACE_LAST;
}

/* May cell (@row, @col), which stands right before the outputs, go? Wire and links on
 * the way to an output may; a link of somebody who still draws stays where it is. */
static bool is_spare(const struct rung *rung, int row, int col)
{
	const struct cell *cell = rung_at(rung, row, col);
	bool output = is_output(rung, row, col + 1);

	if (cell->comment)
		return false;
	if (cell->word == ELEM_WIRE)
		return output && (!cell->link || col > 0);
	return cell->word == ELEM_EMPTY &&
	       (!cell->link || (col > 0 && (output || (row + 1 < rung->rows &&
			rung_at(rung, row + 1, col)->link))));
}

struct rung *grid_without_spare(const struct rung *rung)
{
	const int col = rung->cols - 2;
	struct rung *made;

	for (int row = 0; row < rung->rows; row++)
		if (!is_spare(rung, row, col))
			return NULL;
	made = rung_delete_column(rung, col);
	if (made && grid_same(rung, made))
		return made;
	rung_free(made);
	return NULL;
}

static bool has_output(const struct rung *rung)
{
	for (int row = 0; row < rung->rows; row++)
		if (grid_display_output(rung, row) == rung->cols - 1)
			return true;
	return false;
}

static struct rung *squeeze(struct rung *rung)
{
	struct rung *made;

	while (rung && rung->cols > 1 && has_output(rung)) {
		made = grid_without_spare(rung);
		if (!made)
			break;
		rung_free(rung);
		rung = made;
	}
	return rung;
}

/* ---- outputs in one column ---- */

struct rung *grid_spread(const struct rung *rung, int columns)
{
	struct rung *made = rung_resize(rung, rung->rows, columns);

	for (int row = 0; made && row < rung->rows; row++) {
		const int from = grid_display_output(rung, row), to = columns - 1;

		if (from < 0 || from == to)
			continue;
		*rung_cell(made, row, to) = *rung_at(rung, row, from);
		for (int col = from; col < to; col++)
			*rung_cell(made, row, col) =
				(struct cell){ .word = ELEM_WIRE };
	}
	return made;
}

struct rung *grid_normalise(const struct rung *rung)
{
	struct rung *made = grid_spread(rung, grid_display_columns(rung, 1));
	struct rung *trimmed;

	if (made && !grid_same(rung, made)) {
		rung_free(made);
		made = rung_copy(rung);
	}
	made = squeeze(made);
	trimmed = made ? rung_trim(made) : NULL;
	rung_free(made);
	return trimmed;
}
