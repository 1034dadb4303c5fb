/* SPDX-License-Identifier: MIT
 *
 * grid_drag - where something that is dragged may be dropped, and what that does.
 *
 * One judgement for the marks while dragging and for the drop itself.
 */
#include "editor-gtk/edit/grid_canvas.h"

/* The element that a branch at the empty cell (@row, @col) would go round: right above,
 * or the box whose pins stand there; -1: none. */
static int element_above(const struct canvas *c, int row, int col)
{
	for (row--; row >= 0 && canvas_word(c, row, col) == ELEM_PIN; row--)
		;
	return row >= 0 && canvas_is_element(c, row, col) &&
	       !canvas_is_output(c, row, col) ? row : -1;
}

static enum grid_drop judge_series(const struct canvas *c, int row, int col)
{
	if (col >= canvas_last(c))
		return GRID_DROP_NOT;
	if (canvas_word(c, row, col) == ELEM_PIN)
		return GRID_DROP_NOT;
	if (canvas_word(c, row, col) == ELEM_WIRE)
		return GRID_DROP_WIRE;
	if (!canvas_is_empty(c, row, col))
		return GRID_DROP_BEFORE;
	return element_above(c, row, col) >= 0 ? GRID_DROP_BELOW : GRID_DROP_THERE;
}

static enum grid_drop judge(const struct canvas *c, int row, int col, enum word word)
{
	if (row < 0 || row > c->rung->rows || row >= LIMIT_ROWS || col < 0 ||
	    col >= c->rung->cols)
		return GRID_DROP_NOT;
	switch (word_row(word)->place) {
	case PLACE_LAST:
		return col == canvas_last(c) ? GRID_DROP_OUTPUT : GRID_DROP_NOT;
	case PLACE_SERIES:
	case PLACE_BOX:
		return judge_series(c, row, col);
	case PLACE_NONE:
	case PLACE_WIRE:
	case PLACE_PIN:
		break;
	}
	return GRID_DROP_NOT;
}

enum grid_drop grid_can_drop(const struct rung *rung, int columns, int row, int col,
			     enum word word)
{
	struct grid_at at = { columns, row, col, GRID_DONE };
	enum grid_drop drop = GRID_DROP_NOT;
	struct canvas c;

	if (canvas_open(&c, rung, columns, 1))
		drop = judge(&c, row, col, word);
	c.refusal = GRID_OUTSIDE; /* no rung is wanted */
	canvas_close(&c, &at);
	return drop;
}

bool grid_takes(const struct rung *rung, int columns, int rows, enum word word, bool *takes)
{
	struct grid_at at = { .columns = columns };
	const int cells = rows * columns;
	struct canvas c;
	const bool open = canvas_open(&c, rung, columns, 1);

	for (int i = 0; i < cells; i++)
		takes[i] = open && judge(&c, i / columns, i % columns, word) != GRID_DROP_NOT;
	c.refusal = GRID_OUTSIDE; /* no rung is wanted */
	canvas_close(&c, &at);
	return open;
}

static enum grid_refusal why_not(const struct canvas *c, int row, int col, enum word word)
{
	if (word_row(word)->place == PLACE_LAST)
		return GRID_OUTPUT_LAST;
	return canvas_word(c, row, col) == ELEM_PIN ? GRID_PIN_CELL : GRID_LAST_COLUMN;
}

static bool drop(struct canvas *c, int row, int col, struct cell cell)
{
	const enum grid_drop how = judge(c, row, col, (enum word)cell.word);

	if (how != GRID_DROP_NOT && !canvas_rows(c, row + 1))
		return false;
	switch (how) {
	case GRID_DROP_NOT:
		return canvas_fail(c, why_not(c, row, col, (enum word)cell.word));
	case GRID_DROP_BELOW:
		return canvas_parallel(c, element_above(c, row, col), col, col, cell);
	case GRID_DROP_THERE:
	case GRID_DROP_WIRE:
	case GRID_DROP_BEFORE:
	case GRID_DROP_OUTPUT:
		break;
	}
	return canvas_place(c, row, col, cell, GRID_INSERT);
}

struct rung *grid_drop(const struct rung *rung, struct grid_at *at, struct cell cell)
{
	struct canvas c;

	cell.spare = 0;
	if (canvas_open(&c, rung, at->columns, 1))
		drop(&c, at->row, at->col, cell);
	return canvas_close(&c, at);
}

/* ---- moving what is there ---- */

/* From the end, so that a branch goes before what it goes round. */
static bool delete_last_moved(struct canvas *c)
{
	for (int row = c->rung->rows - 1; row >= 0; row--)
		for (int col = canvas_last(c); col >= 0; col--) {
			struct cell *cell = canvas_cell(c, row, col);

			if (!(cell->spare & CANVAS_MOVED))
				continue;
			cell->spare &= (uint8_t)~CANVAS_MOVED;
			canvas_delete_whole(c, row, col);
			return true;
		}
	return false;
}

static void delete_moved(struct canvas *c)
{
	while (c->refusal == GRID_DONE && delete_last_moved(c))
		;
}

static struct rung *move_within(const struct rung *rung, struct grid_at *from,
				struct grid_at *to)
{
	struct canvas c;
	const struct grid_at start = *from;

	if (canvas_at_element(&c, rung, from)) {
		struct cell *cell = canvas_cell(&c, from->row, from->col);
		struct cell moved = *cell;

		moved.spare = 0;
		cell->spare |= CANVAS_MOVED;
		if (start.row == to->row && start.col == to->col)
			canvas_mark(&c, to->row, to->col);
		else if (drop(&c, to->row, to->col, moved))
			delete_moved(&c);
	}
	rung = canvas_close(&c, to);
	from->refusal = to->refusal;
	return (struct rung *)rung;
}

struct rung *grid_move(const struct rung *rung, struct grid_at *from,
		       const struct rung *target, struct grid_at *to,
		       struct rung **source)
{
	struct rung *made = NULL;
	struct grid_place place;
	struct cell moved;

	*source = NULL;
	if (rung == target)
		return move_within(rung, from, to);
	from->refusal = to->refusal = GRID_NO_ELEMENT;
	if (grid_display_find(rung, from->columns, from->row, from->col, &place) !=
	    GRID_SEEN_CELL)
		return NULL;
	moved = *rung_at(rung, place.row, place.col);
	if (moved.word == ELEM_WIRE || moved.word == ELEM_PIN)
		return NULL;
	made = grid_drop(target, to, moved);
	if (!made)
		return NULL;
	*source = grid_delete(rung, from);
	if (*source)
		return made;
	to->refusal = from->refusal;
	rung_free(made);
	return NULL;
}

/* ---- moving an area ---- */

static void mark_moved(struct canvas *c, const struct grid_area *area)
{
	for (int row = area->row; row <= area->last_row && row < c->rung->rows; row++)
		for (int col = area->col; col <= area->last_col; col++)
			if (col < c->rung->cols && canvas_is_element(c, row, col))
				canvas_cell(c, row, col)->spare |= CANVAS_MOVED;
}

static bool is_within(const struct grid_area *area, const struct grid_at *at)
{
	return at->row >= area->row && at->row <= area->last_row &&
	       at->col >= area->col && at->col <= area->last_col;
}

static struct rung *move_area_within(const struct rung *rung,
				     const struct grid_area *area,
				     const struct rung *piece, struct grid_at *to,
				     bool parallel)
{
	struct canvas c;

	if (canvas_open(&c, rung, to->columns, 1) && !is_within(area, to)) {
		mark_moved(&c, area);
		if (canvas_paste(&c, to->row, to->col, piece, parallel))
			delete_moved(&c);
	}
	return canvas_close(&c, to);
}

struct rung *grid_move_area(const struct rung *rung, struct grid_at *from,
			    const struct grid_area *area, const struct rung *target,
			    struct grid_at *to, bool parallel, struct rung **source)
{
	struct rung *piece = NULL, *made = NULL;

	*source = NULL;
	from->refusal = to->refusal = GRID_NO_ELEMENT;
	if (area->row >= 0 && area->col >= 0)
		piece = grid_copy(rung, from->columns, area);
	if (!piece)
		return NULL;
	if (rung == target)
		made = move_area_within(rung, area, piece, to, parallel);
	else
		made = grid_paste(target, to, piece, parallel);
	rung_free(piece);
	if (!made || rung == target)
		return made;
	*source = grid_delete_area(rung, from, area);
	if (*source)
		return made;
	to->refusal = from->refusal;
	rung_free(made);
	return NULL;
}
