/* SPDX-License-Identifier: MIT
 *
 * grid_canvas - the normal form of rungs, and a rung spread out as it is shown: its cells,
 * bars, rows and wires. What edits share is here; each edit is in grid_edit.c, grid_wire.c,
 * grid_block.c or grid_kind.c.
 *
 * Normal form: all outputs stand in one column; columns of wire before it are taken out one
 * by one, as long as the circuit stays the same.
 */
#include "editor-gtk/edit/grid_canvas.h"

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

/* ---- the canvas ---- */

bool canvas_fail(struct canvas *c, enum grid_refusal refusal)
{
	if (c->refusal == GRID_DONE)
		c->refusal = refusal;
	return false;
}

bool canvas_open(struct canvas *c, const struct rung *rung, int columns, int rows)
{
	memset(c, 0, sizeof(*c));
	arena_init(&c->arena);
	columns = columns < LIMIT_COLS ? columns : LIMIT_COLS;
	c->rung = grid_spread(rung, grid_display_columns(rung, columns));
	if (!c->rung)
		return canvas_fail(c, GRID_NO_MEMORY);
	return canvas_rows(c, rows);
}

/* Removes the marks; the last one of the cursor is its place. */
static void find_mark(struct rung *rung, struct grid_at *at)
{
	int row = -1, col = -1;

	for (int i = 0; i < rung->rows * rung->cols; i++) {
		if (rung->cell[i].spare & CANVAS_CURSOR) {
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

struct rung *canvas_close(struct canvas *c, struct grid_at *at)
{
	struct rung *made = NULL;

	if (c->refusal == GRID_DONE) {
		made = grid_normalise(c->rung);
		if (made)
			find_mark(made, at);
		else
			canvas_fail(c, GRID_NO_MEMORY);
	}
	at->refusal = c->refusal;
	rung_free(c->rung);
	c->rung = NULL;
	arena_free(&c->arena);
	return made;
}

void canvas_mark(struct canvas *c, int row, int col)
{
	for (int i = 0; i < c->rung->rows * c->rung->cols; i++)
		c->rung->cell[i].spare &= (uint8_t)~CANVAS_CURSOR;
	canvas_cell(c, row, col)->spare |= CANVAS_CURSOR;
}

bool canvas_network(struct canvas *c)
{
	arena_reset(&c->arena);
	return network_make(c->rung, &c->arena, &c->network) ||
	       canvas_fail(c, GRID_NO_MEMORY);
}

/* ---- cells ---- */

static bool is_inside(const struct canvas *c, int row, int col)
{
	return row >= 0 && row < c->rung->rows && col >= 0 && col < c->rung->cols;
}

struct cell *canvas_cell(struct canvas *c, int row, int col)
{
	return rung_cell(c->rung, row, col);
}

int canvas_last(const struct canvas *c)
{
	return c->rung->cols - 1;
}

enum word canvas_word(const struct canvas *c, int row, int col)
{
	if (!is_inside(c, row, col))
		return ELEM_EMPTY;
	return (enum word)rung_at(c->rung, row, col)->word;
}

void canvas_put(struct canvas *c, int row, int col, struct cell content)
{
	struct cell *cell = canvas_cell(c, row, col);

	content.link = cell->link;
	*cell = content;
}

void canvas_clear(struct canvas *c, int row, int col)
{
	canvas_put(c, row, col, (struct cell){ .word = ELEM_EMPTY });
}

bool canvas_is_empty(const struct canvas *c, int row, int col)
{
	return canvas_word(c, row, col) == ELEM_EMPTY;
}

bool canvas_is_element(const struct canvas *c, int row, int col)
{
	const enum word word = canvas_word(c, row, col);

	return word != ELEM_EMPTY && word != ELEM_WIRE && word != ELEM_PIN;
}

bool canvas_is_output(const struct canvas *c, int row, int col)
{
	return word_row(canvas_word(c, row, col))->place == PLACE_LAST;
}

/* ---- bars ---- */

bool canvas_left(const struct canvas *c, int row, int bar)
{
	return bar > 0 && !canvas_is_empty(c, row, bar - 1);
}

/* A row of pins is used only where it has a pin. */
bool canvas_right(const struct canvas *c, int row, int bar)
{
	return !canvas_is_empty(c, row, bar) &&
	       (canvas_word(c, row, bar) != ELEM_PIN ||
		rung_at(c->rung, row, bar)->operand);
}

bool canvas_up(const struct canvas *c, int row, int bar)
{
	return row > 0 && is_inside(c, row, bar - 1) &&
	       rung_at(c->rung, row, bar - 1)->link;
}

bool canvas_down(const struct canvas *c, int row, int bar)
{
	return canvas_up(c, row + 1, bar);
}

bool canvas_linked(const struct canvas *c, int row, int bar)
{
	return canvas_up(c, row, bar) || canvas_down(c, row, bar);
}

bool canvas_bar_used(const struct canvas *c, int row, int bar)
{
	return bar == 0 || canvas_left(c, row, bar) || canvas_right(c, row, bar) ||
	       canvas_linked(c, row, bar);
}

/* ---- rows and columns ---- */

static bool replace(struct canvas *c, struct rung *made, enum grid_refusal why)
{
	if (!made)
		return canvas_fail(c, why);
	rung_free(c->rung);
	c->rung = made;
	return true;
}

bool canvas_replace(struct canvas *c, struct rung *made)
{
	return replace(c, made, GRID_NO_MEMORY);
}

static bool has_room(struct canvas *c, int rows)
{
	return rows <= LIMIT_ROWS || canvas_fail(c, GRID_FULL_ROWS);
}

bool canvas_rows(struct canvas *c, int rows)
{
	if (rows <= c->rung->rows)
		return true;
	return has_room(c, rows) &&
	       replace(c, rung_resize(c->rung, rows, c->rung->cols), GRID_NO_MEMORY);
}

bool canvas_insert_row(struct canvas *c, int at)
{
	return has_room(c, c->rung->rows + 1) &&
	       replace(c, rung_insert_row(c->rung, at), GRID_NO_MEMORY);
}

/* A full rung needs a column of wire before the outputs that can be removed. */
bool canvas_insert_column(struct canvas *c, int at)
{
	if (c->rung->cols == LIMIT_COLS &&
	    (at >= canvas_last(c) ||
	     !replace(c, without_spare(c->rung), GRID_FULL_COLS)))
		return canvas_fail(c, GRID_FULL_COLS);
	return replace(c, rung_insert_column(c->rung, at), GRID_NO_MEMORY);
}

bool canvas_is_bare(const struct canvas *c, int row)
{
	for (int col = 0; col < c->rung->cols; col++) {
		const struct cell *cell = rung_at(c->rung, row, col);

		if (cell->word != ELEM_EMPTY || cell->comment)
			return false;
	}
	return true;
}

void canvas_drop_row(struct canvas *c, int row)
{
	if (c->rung->rows > 1 && row >= 0 && row < c->rung->rows &&
	    canvas_is_bare(c, row))
		replace(c, rung_delete_row(c->rung, row), GRID_NO_MEMORY);
}

/* ---- wires that close by themselves ---- */

bool canvas_close_left(struct canvas *c, int row, int col)
{
	int from = col;

	while (from > 0 && !canvas_left(c, row, from) && !canvas_linked(c, row, from))
		from--;
	if (!canvas_linked(c, row, from) && canvas_word(c, row, from - 1) == ELEM_PIN)
		return false;
	while (from < col)
		canvas_cell(c, row, from++)->word = ELEM_WIRE;
	return true;
}

/* The bar that a wire must reach: at an element without power, or at a link with nothing
 * else; -1: none. */
static int waiting_bar(const struct canvas *c, int row, int bar)
{
	for (; bar < c->rung->cols; bar++) {
		if (canvas_right(c, row, bar))
			return bar;
		if (canvas_linked(c, row, bar))
			return bar;
		if (!canvas_is_empty(c, row, bar))
			return -1;
	}
	return -1;
}

void canvas_close_right(struct canvas *c, int row, int col)
{
	const int bar = waiting_bar(c, row, col + 1);

	if (bar < 0 || (canvas_right(c, row, bar) && canvas_linked(c, row, bar)))
		return;
	for (int at = col + 1; at < bar; at++)
		canvas_cell(c, row, at)->word = ELEM_WIRE;
}

void canvas_join_up(struct canvas *c, int top, int row, int bar)
{
	if (bar == 0)
		return;
	for (int i = top + 1; i <= row; i++)
		canvas_cell(c, i, bar - 1)->link = 1;
}

static bool ends_there(const struct canvas *c, int row, int bar)
{
	return !canvas_left(c, row, bar) && !canvas_right(c, row, bar);
}

int canvas_prune(struct canvas *c, int row, int bar)
{
	while (ends_there(c, row, bar) && canvas_up(c, row, bar) &&
	       !canvas_down(c, row, bar))
		canvas_cell(c, row--, bar - 1)->link = 0;
	while (ends_there(c, row, bar) && canvas_down(c, row, bar) &&
	       !canvas_up(c, row, bar))
		canvas_cell(c, ++row, bar - 1)->link = 0;
	return row;
}
