/* SPDX-License-Identifier: MIT
 *
 * grid_edit - putting elements into a rung, and changing the one that stands there.
 *
 * Branches are in grid_branch.c, taking away in grid_delete.c. It knows of a word only
 * what its row says.
 */
#include "editor-gtk/edit/grid_canvas.h"
#include "editor-gtk/kit/i18n.h"

static const char *const refusal_text[] = {
#define REFUSAL(id, text) text,
#include "editor-gtk/edit/grid_refusal.def"
};

const char *grid_refusal_text(enum grid_refusal refusal)
{
	return refusal < GRID_REFUSAL_COUNT ? refusal_text[refusal] : "";
}

/* ---- room in a row ---- */

/* May the cells @col … @end - 1 move right by one, onto the wire or the end at @end,
 * with no link between them? */
static bool can_shift(const struct canvas *c, int row, int col, int end)
{
	for (int i = col; i < end; i++)
		if (canvas_linked(c, row, i + 1) ||
		    canvas_word(c, row, i) == ELEM_PIN ||
		    rung_height(c->rung, row, i) > 1)
			return false;
	if (canvas_word(c, row, end) == ELEM_WIRE)
		return true;
	/* At the open end of a row. */
	return canvas_is_empty(c, row, end) && !canvas_linked(c, row, end + 1) &&
	       canvas_is_empty(c, row, end + 1);
}

/* Where to the cells from @col on may be shifted; -1: they may not. */
static int shift_end(const struct canvas *c, int row, int col)
{
	int end = col;

	while (end < canvas_last(c) && canvas_is_element(c, row, end))
		end++;
	return end < canvas_last(c) && can_shift(c, row, col, end) ? end : -1;
}

/* The last of those that moved would be fed from its right, or feed to its left. */
static bool shift_fails(struct canvas *c, int row, int end)
{
	return canvas_is_element(c, row, end) && canvas_is_backwards(c, row, end);
}

bool canvas_room_before(struct canvas *c, int row, int col)
{
	const int end = shift_end(c, row, col);
	const enum word freed = canvas_word(c, row, end);

	if (end < 0)
		return canvas_insert_column(c, col);
	for (int i = end; i > col; i--)
		canvas_put(c, row, i, *canvas_cell(c, row, i - 1));
	canvas_clear(c, row, col);
	canvas_cell(c, row, col)->word = ELEM_WIRE;
	if (!shift_fails(c, row, end))
		return true;
	for (int i = col; i < end; i++)
		canvas_put(c, row, i, *canvas_cell(c, row, i + 1));
	canvas_clear(c, row, end);
	canvas_cell(c, row, end)->word = (uint16_t)freed;
	return canvas_insert_column(c, col);
}

/* ---- put, replace ---- */

/* Another element in the place of one; another box has no use for its rows of pins. */
static void replace(struct canvas *c, int row, int col, struct cell cell)
{
	const int height = cell.word == canvas_word(c, row, col) ?
		1 : rung_height(c->rung, row, col);

	for (int i = 1; i < height; i++)
		canvas_remove_pin(c, row + i, col);
	canvas_put(c, row, col, cell);
}

/* What is put in the place of an element keeps its comment, unless it has one. */
static struct cell commented(struct canvas *c, int row, int col, struct cell cell)
{
	if (!cell.comment)
		cell.comment = canvas_cell(c, row, col)->comment;
	return cell;
}

static int behind_last(const struct canvas *c, int row)
{
	int col = canvas_last(c);

	while (col > 0 && !canvas_is_element(c, row, col - 1))
		col--;
	return col;
}

/* In the last column it goes behind the row's last element; an output there stays. */
static bool place_last(struct canvas *c, int row, struct cell cell)
{
	int col = behind_last(c, row);

	if (col == canvas_last(c) && !canvas_insert_column(c, col))
		return false;
	if (canvas_is_output(c, row, canvas_last(c)))
		return canvas_place(c, row, col, cell, GRID_INSERT);
	for (int i = col + 1; i < c->rung->cols; i++)
		if (canvas_word(c, row, i) == ELEM_WIRE && !canvas_linked(c, row, i + 1))
			canvas_clear(c, row, i);
	canvas_put(c, row, col, cell);
	canvas_close_left(c, row, col);
	canvas_mark(c, row, col);
	return true;
}

static bool place_output(struct canvas *c, int row, int col, struct cell cell,
			 enum grid_how how)
{
	const int last = canvas_last(c);

	if (how == GRID_REPLACE && col == last && canvas_is_output(c, row, last)) {
		canvas_put(c, row, last, commented(c, row, last, cell));
	} else {
		row = canvas_output(c, row, cell);
		if (row < 0)
			return false;
	}
	canvas_mark(c, row, canvas_last(c));
	return true;
}

/* Could the element stand at @col of that wire, without power going leftwards? */
static bool fits_wire(struct canvas *c, int row, int col, struct cell cell)
{
	const struct cell wire = *canvas_cell(c, row, col);
	bool fits;

	canvas_put(c, row, col, cell);
	fits = !canvas_is_backwards(c, row, col);
	canvas_put(c, row, col, wire);
	return fits;
}

/* The column of the wire at (@row, @col) that an element is put into: that one, or the
 * nearest that will do, or right before what the wire leads to. -1: it failed. */
static int wire_column(struct canvas *c, int row, int col, struct cell cell)
{
	const struct stretch s = canvas_stretch(c, row, col);
	const int last = s.right < canvas_last(c) ? s.right : canvas_last(c);

	for (int step = 0; step < c->rung->cols; step++) {
		if (col + step < last && fits_wire(c, row, col + step, cell))
			return col + step;
		if (step > 0 && col - step >= s.left &&
		    fits_wire(c, row, col - step, cell))
			return col - step;
	}
	if (!canvas_is_element(c, row, s.right) || canvas_linked(c, row, s.right)) {
		canvas_fail(c, GRID_BACKWARDS);
		return -1;
	}
	return canvas_room_before(c, row, s.right) ? s.right : -1;
}

static bool place_series(struct canvas *c, int row, int col, struct cell cell,
			 enum grid_how how)
{
	if (canvas_word(c, row, col) == ELEM_PIN)
		return canvas_fail(c, GRID_PIN_CELL);
	if (canvas_is_element(c, row, col)) {
		if (how == GRID_REPLACE) {
			replace(c, row, col, commented(c, row, col, cell));
			canvas_mark(c, row, col);
			return true;
		}
		if (!canvas_room_before(c, row, col))
			return false;
	} else if (canvas_word(c, row, col) == ELEM_WIRE) {
		col = wire_column(c, row, col, cell);
		if (col < 0)
			return false;
	}
	canvas_put(c, row, col, cell);
	canvas_close_left(c, row, col);
	canvas_close_right(c, row, col);
	canvas_mark(c, row, col);
	return true;
}

bool canvas_place(struct canvas *c, int row, int col, struct cell cell,
		  enum grid_how how)
{
	switch (word_row((enum word)cell.word)->place) {
	case PLACE_LAST:
		return place_output(c, row, col, cell, how);
	case PLACE_BOX:
		if (col >= canvas_last(c))
			return place_last(c, row, cell);
		return place_series(c, row, col, cell, how);
	case PLACE_SERIES:
		if (col >= canvas_last(c) && how == GRID_INSERT &&
		    canvas_is_output(c, row, canvas_last(c)))
			return place_last(c, row, cell);
		if (col >= canvas_last(c))
			return canvas_fail(c, GRID_LAST_COLUMN);
		return place_series(c, row, col, cell, how);
	case PLACE_NONE:
	case PLACE_WIRE:
	case PLACE_PIN:
		break;
	}
	return canvas_fail(c, GRID_NO_WORD);
}

static bool is_cell(struct canvas *c, const struct grid_at *at)
{
	return (at->row >= 0 && at->row < LIMIT_ROWS && at->col >= 0 &&
		at->col < c->rung->cols) || canvas_fail(c, GRID_OUTSIDE);
}

struct rung *grid_place(const struct rung *rung, struct grid_at *at, struct cell cell,
			enum grid_how how)
{
	struct canvas c;

	cell.spare = 0;
	if (canvas_open(&c, rung, at->columns, at->row + 1) && is_cell(&c, at))
		canvas_place(&c, at->row, at->col, cell, how);
	return canvas_close(&c, at);
}

/* ---- the element that stands there ---- */

bool canvas_at_element(struct canvas *c, const struct rung *rung, struct grid_at *at)
{
	if (!canvas_open(c, rung, at->columns, 1))
		return false;
	if (at->row < 0 || at->row >= c->rung->rows || !is_cell(c, at))
		return canvas_fail(c, GRID_OUTSIDE);
	if (!canvas_is_element(c, at->row, at->col))
		return canvas_fail(c, GRID_NO_ELEMENT);
	canvas_mark(c, at->row, at->col);
	return true;
}

static bool same_place(enum word a, enum word b)
{
	return (word_row(a)->place == PLACE_LAST) == (word_row(b)->place == PLACE_LAST);
}

struct rung *grid_set(const struct rung *rung, struct grid_at *at, struct cell cell)
{
	struct canvas c;

	cell.spare = 0;
	if (canvas_at_element(&c, rung, at)) {
		struct cell *now = canvas_cell(&c, at->row, at->col);
		const enum place place = word_row((enum word)cell.word)->place;

		if (place == PLACE_NONE || place == PLACE_WIRE || place == PLACE_PIN)
			canvas_fail(&c, GRID_NO_WORD);
		else if (!same_place((enum word)cell.word, (enum word)now->word))
			canvas_fail(&c, GRID_OTHER_PLACE);
		else
			replace(&c, at->row, at->col, cell);
		canvas_mark(&c, at->row, at->col);
	}
	return canvas_close(&c, at);
}

/* ---- rows and columns ---- */

static bool at_cell(struct canvas *c, const struct rung *rung, struct grid_at *at)
{
	return canvas_open(c, rung, at->columns, 1) && is_cell(c, at) &&
	       (at->row < c->rung->rows || canvas_fail(c, GRID_OUTSIDE));
}

struct rung *grid_insert_row(const struct rung *rung, struct grid_at *at)
{
	struct canvas c;

	if (at_cell(&c, rung, at))
		canvas_insert_row(&c, at->row);
	return canvas_close(&c, at);
}

struct rung *grid_insert_column(const struct rung *rung, struct grid_at *at)
{
	struct canvas c;

	if (at_cell(&c, rung, at))
		canvas_insert_column(&c, at->col);
	return canvas_close(&c, at);
}

struct rung *grid_delete_row(const struct rung *rung, struct grid_at *at)
{
	struct canvas c;

	if (at_cell(&c, rung, at)) {
		if (c.rung->rows == 1)
			canvas_fail(&c, GRID_ONLY_ROW);
		else
			canvas_replace(&c, rung_delete_row(c.rung, at->row));
	}
	return canvas_close(&c, at);
}

struct rung *grid_delete_column(const struct rung *rung, struct grid_at *at)
{
	struct canvas c;

	if (at_cell(&c, rung, at)) {
		if (at->col == canvas_last(&c))
			canvas_fail(&c, GRID_LAST_COLUMN);
		else
			canvas_replace(&c, rung_delete_column(c.rung, at->col));
	}
	return canvas_close(&c, at);
}
