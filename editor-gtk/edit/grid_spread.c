/* SPDX-License-Identifier: MIT
 *
 * grid_spread - the normal form of rungs, and a rung spread out as it is shown: its cells,
 * bars, rows and wires. What edits share is here; each edit is in grid_edit.c, grid_wire.c,
 * grid_block.c or grid_kind.c.
 *
 * Normal form: all outputs stand in one column; columns of wire before it are taken out one
 * by one, as long as the circuit stays the same.
 */
#include "editor-gtk/edit/grid_spread.h"

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

/* Pairs of nets of two graphs; -1: not known yet. */
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

/* May cell (@row, @col), right before the outputs, be removed? Wires and links that lead to
 * an output may; a loose link stays. */
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

static struct rung *without_spare(const struct rung *rung)
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
		made = without_spare(rung);
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

/* ---- opening and closing ---- */

bool spread_fail(struct spread *c, enum grid_refusal refusal)
{
	if (c->refusal == GRID_DONE)
		c->refusal = refusal;
	return false;
}

bool spread_open(struct spread *c, const struct rung *rung, int columns, int rows)
{
	memset(c, 0, sizeof(*c));
	arena_init(&c->arena);
	columns = columns < LIMIT_COLS ? columns : LIMIT_COLS;
	c->rung = grid_spread(rung, grid_display_columns(rung, columns));
	if (!c->rung)
		return spread_fail(c, GRID_NO_MEMORY);
	return spread_rows(c, rows);
}

/* Removes the marks; the last one of the cursor is its place. */
static void find_mark(struct rung *rung, struct grid_at *at)
{
	int row = -1, col = -1;

	for (int i = 0; i < rung->rows * rung->cols; i++) {
		if (rung->cell[i].spare & SPREAD_CURSOR) {
			row = i / rung->cols;
			col = i % rung->cols;
		}
		rung->cell[i].spare = 0;
	}
	if (row < 0)
		return;
	at->row = row;
	at->col = grid_display_column(rung, grid_display_columns(rung, at->columns),
				      row, col);
}

struct rung *spread_close(struct spread *c, struct grid_at *at)
{
	struct rung *made = NULL;

	if (c->refusal == GRID_DONE) {
		made = grid_normalise(c->rung);
		if (made)
			find_mark(made, at);
		else
			spread_fail(c, GRID_NO_MEMORY);
	}
	at->refusal = c->refusal;
	rung_free(c->rung);
	c->rung = NULL;
	arena_free(&c->arena);
	return made;
}

void spread_mark(struct spread *c, int row, int col)
{
	for (int i = 0; i < c->rung->rows * c->rung->cols; i++)
		c->rung->cell[i].spare &= (uint8_t)~SPREAD_CURSOR;
	spread_cell(c, row, col)->spare |= SPREAD_CURSOR;
}

bool spread_network(struct spread *c)
{
	arena_reset(&c->arena);
	return network_make(c->rung, &c->arena, &c->network) ||
	       spread_fail(c, GRID_NO_MEMORY);
}

/* ---- cells ---- */

static bool is_inside(const struct spread *c, int row, int col)
{
	return row >= 0 && row < c->rung->rows && col >= 0 && col < c->rung->cols;
}

struct cell *spread_cell(struct spread *c, int row, int col)
{
	return rung_cell(c->rung, row, col);
}

int spread_last(const struct spread *c)
{
	return c->rung->cols - 1;
}

enum word spread_word(const struct spread *c, int row, int col)
{
	if (!is_inside(c, row, col))
		return ELEM_EMPTY;
	return (enum word)rung_at(c->rung, row, col)->word;
}

void spread_put(struct spread *c, int row, int col, struct cell content)
{
	struct cell *cell = spread_cell(c, row, col);

	content.link = cell->link;
	*cell = content;
}

void spread_clear(struct spread *c, int row, int col)
{
	spread_put(c, row, col, (struct cell){ .word = ELEM_EMPTY });
}

bool spread_is_empty(const struct spread *c, int row, int col)
{
	return spread_word(c, row, col) == ELEM_EMPTY;
}

bool spread_is_element(const struct spread *c, int row, int col)
{
	const enum word word = spread_word(c, row, col);

	return word != ELEM_EMPTY && word != ELEM_WIRE && word != ELEM_PIN;
}

bool spread_is_output(const struct spread *c, int row, int col)
{
	return word_row(spread_word(c, row, col))->place == PLACE_LAST;
}

/* ---- bars ---- */

bool spread_left(const struct spread *c, int row, int bar)
{
	return bar > 0 && !spread_is_empty(c, row, bar - 1);
}

/* A row of pins is used only where it has a pin. */
bool spread_right(const struct spread *c, int row, int bar)
{
	return !spread_is_empty(c, row, bar) &&
	       (spread_word(c, row, bar) != ELEM_PIN ||
		rung_at(c->rung, row, bar)->operand);
}

bool spread_up(const struct spread *c, int row, int bar)
{
	return row > 0 && is_inside(c, row, bar - 1) &&
	       rung_at(c->rung, row, bar - 1)->link;
}

bool spread_down(const struct spread *c, int row, int bar)
{
	return spread_up(c, row + 1, bar);
}

bool spread_linked(const struct spread *c, int row, int bar)
{
	return spread_up(c, row, bar) || spread_down(c, row, bar);
}

bool spread_bar_used(const struct spread *c, int row, int bar)
{
	return bar == 0 || spread_left(c, row, bar) || spread_right(c, row, bar) ||
	       spread_linked(c, row, bar);
}

/* ---- rows and columns ---- */

static bool replace(struct spread *c, struct rung *made, enum grid_refusal why)
{
	if (!made)
		return spread_fail(c, why);
	rung_free(c->rung);
	c->rung = made;
	return true;
}

bool spread_replace(struct spread *c, struct rung *made)
{
	return replace(c, made, GRID_NO_MEMORY);
}

static bool has_room(struct spread *c, int rows)
{
	return rows <= LIMIT_ROWS || spread_fail(c, GRID_FULL_ROWS);
}

bool spread_rows(struct spread *c, int rows)
{
	if (rows <= c->rung->rows)
		return true;
	return has_room(c, rows) &&
	       replace(c, rung_resize(c->rung, rows, c->rung->cols), GRID_NO_MEMORY);
}

bool spread_insert_row(struct spread *c, int at)
{
	return has_room(c, c->rung->rows + 1) &&
	       replace(c, rung_insert_row(c->rung, at), GRID_NO_MEMORY);
}

/* A full rung needs a column of wire before the outputs that can be removed. */
bool spread_insert_column(struct spread *c, int at)
{
	if (c->rung->cols == LIMIT_COLS &&
	    (at >= spread_last(c) ||
	     !replace(c, without_spare(c->rung), GRID_FULL_COLS)))
		return spread_fail(c, GRID_FULL_COLS);
	return replace(c, rung_insert_column(c->rung, at), GRID_NO_MEMORY);
}

bool spread_is_bare(const struct spread *c, int row)
{
	for (int col = 0; col < c->rung->cols; col++) {
		const struct cell *cell = rung_at(c->rung, row, col);

		if (cell->word != ELEM_EMPTY || cell->comment)
			return false;
	}
	return true;
}

void spread_drop_row(struct spread *c, int row)
{
	if (c->rung->rows > 1 && row >= 0 && row < c->rung->rows &&
	    spread_is_bare(c, row))
		replace(c, rung_delete_row(c->rung, row), GRID_NO_MEMORY);
}

/* ---- wires that close by themselves ---- */

bool spread_close_left(struct spread *c, int row, int col)
{
	int from = col;

	while (from > 0 && !spread_left(c, row, from) && !spread_linked(c, row, from))
		from--;
	if (!spread_linked(c, row, from) && spread_word(c, row, from - 1) == ELEM_PIN)
		return false;
	while (from < col)
		spread_cell(c, row, from++)->word = ELEM_WIRE;
	return true;
}

/* The bar that a wire must reach: at an element without power, or at a link with nothing
 * else; -1: none. */
static int waiting_bar(const struct spread *c, int row, int bar)
{
	for (; bar < c->rung->cols; bar++) {
		if (spread_right(c, row, bar))
			return bar;
		if (spread_linked(c, row, bar))
			return bar;
		if (!spread_is_empty(c, row, bar))
			return -1;
	}
	return -1;
}

void spread_close_right(struct spread *c, int row, int col)
{
	const int bar = waiting_bar(c, row, col + 1);

	if (bar < 0 || (spread_right(c, row, bar) && spread_linked(c, row, bar)))
		return;
	for (int at = col + 1; at < bar; at++)
		spread_cell(c, row, at)->word = ELEM_WIRE;
}

void spread_join_up(struct spread *c, int top, int row, int bar)
{
	if (bar == 0)
		return;
	for (int i = top + 1; i <= row; i++)
		spread_cell(c, i, bar - 1)->link = 1;
}

static bool ends_there(const struct spread *c, int row, int bar)
{
	return !spread_left(c, row, bar) && !spread_right(c, row, bar);
}

int spread_prune(struct spread *c, int row, int bar)
{
	while (ends_there(c, row, bar) && spread_up(c, row, bar) &&
	       !spread_down(c, row, bar))
		spread_cell(c, row--, bar - 1)->link = 0;
	while (ends_there(c, row, bar) && spread_down(c, row, bar) &&
	       !spread_up(c, row, bar))
		spread_cell(c, ++row, bar - 1)->link = 0;
	return row;
}
