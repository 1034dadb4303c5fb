/* SPDX-License-Identifier: MIT
 *
 * grid_canvas - a rung spread out as it is shown: its cells, bars, rows and wires.
 *
 * What edits have in common. It knows where wires close, not which edit it serves.
 */
#include "editor-gtk/edit/grid_canvas.h"

#include <string.h>

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

/* Takes the marks off; the last one of the cursor tells its place. */
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

/* The same as check_rung() asks: does a net's reader stand left of where it is fed? */
bool canvas_is_backwards(struct canvas *c, int row, int col)
{
	const struct network *n = &c->network;
	int in, out;

	if (!canvas_network(c))
		return false;
	in = network_net(n, row, col);
	out = network_net(n, row, col + 1);
	for (int i = 0; i < n->element_count; i++)
		if ((n->element[i].out == in && n->element[i].col + 1 > col) ||
		    (n->element[i].in == out && n->element[i].col < col + 1))
			return true;
	for (int i = 0; i < n->pin_count; i++)
		if (n->pin[i].in == out && n->pin[i].col < col + 1)
			return true;
	return false;
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

/* A row of pins without a pin takes nothing. */
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

/* If there is no room for one more, a column of nothing but wire before the outputs
 * must go. */
bool canvas_insert_column(struct canvas *c, int at)
{
	if (c->rung->cols == LIMIT_COLS &&
	    (at >= canvas_last(c) ||
	     !replace(c, grid_without_spare(c->rung), GRID_FULL_COLS)))
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

/* The bar up to which wire would have to go: of what waits for power there, or of a
 * link that nothing else joins; -1: there is none. */
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
