/* SPDX-License-Identifier: MIT
 *
 * grid_block - pieces of rungs: copied, pasted, dragged and dropped.
 *
 * A piece is a rung whose rail is the piece's left edge. Marks while dragging and the drop
 * itself ask the same function, judge().
 */
#include "editor-gtk/edit/grid_spread.h"

/* ---- copy ---- */

static bool has_box_above(const struct spread *c, int row, int col, int top)
{
	while (row >= top && spread_word(c, row, col) == ELEM_PIN)
		row--;
	return row >= top;
}

static void copy_cells(const struct spread *c, const struct grid_area *area,
		       struct rung *made)
{
	for (int row = 0; row < made->rows; row++)
		for (int col = 0; col < made->cols; col++) {
			const int from = area->row + row, at = area->col + col;
			struct cell *cell = rung_cell(made, row, col);

			*cell = *rung_at(c->rung, from, at);
			cell->spare = 0;
			if (row == 0)
				cell->link = 0;
			if (cell->word == ELEM_PIN &&
			    !has_box_above(c, from, at, area->row))
				*cell = (struct cell){ .link = cell->link };
		}
}

static bool is_bare(const struct rung *rung)
{
	for (int i = 0; i < rung->rows * rung->cols; i++)
		if (rung->cell[i].word != ELEM_EMPTY || rung->cell[i].comment)
			return false;
	return true;
}

struct rung *grid_copy(const struct rung *rung, int columns,
		       const struct grid_area *area)
{
	struct grid_at at = { columns, area->row, area->col, GRID_DONE };
	struct rung *piece = NULL, *made = NULL;
	struct grid_area a = *area;
	struct spread c;

	if (spread_open(&c, rung, columns, 1)) {
		a.last_row = a.last_row < c.rung->rows ? a.last_row : c.rung->rows - 1;
		a.last_col = a.last_col < c.rung->cols ? a.last_col : c.rung->cols - 1;
		if (a.row >= 0 && a.col >= 0)
			piece = rung_new(a.last_row - a.row + 1, a.last_col - a.col + 1);
		if (piece) {
			copy_cells(&c, &a, piece);
			made = is_bare(piece) ? NULL : grid_normalise(piece);
		}
	}
	rung_free(piece);
	rung_free(spread_close(&c, &at));
	return made;
}

/* ---- paste ---- */

static bool is_last(enum word word)
{
	return word_row(word)->place == PLACE_LAST;
}

static bool is_plain(const struct cell *cell)
{
	return cell->word == ELEM_EMPTY || cell->word == ELEM_WIRE;
}

/* Counts of the elements of a piece; they decide how it is pasted. */
struct piece {
	const struct rung *rung;
	int elements, outputs, pins;
	struct cell only;  /* the last element found                          */
};

static struct piece look_at(const struct rung *rung)
{
	struct piece piece = { .rung = rung };

	for (int i = 0; i < rung->rows * rung->cols; i++) {
		const struct cell *cell = &rung->cell[i];

		piece.pins += cell->word == ELEM_PIN;
		if (is_plain(cell) || cell->word == ELEM_PIN)
			continue;
		piece.elements++;
		piece.outputs += is_last((enum word)cell->word);
		piece.only = *cell;
		piece.only.spare = 0;
	}
	return piece;
}

/* Puts the cells of the piece at (@row, @col). Its rows that begin at its rail are joined
 * with the bar there. */
static void put_piece(struct spread *c, int row, int col, const struct rung *part)
{
	for (int i = 0; i < part->rows; i++) {
		for (int k = 0; k < part->cols; k++) {
			struct cell cell = *rung_at(part, i, k);

			cell.spare = 0;
			spread_put(c, row + i, col + k, cell);
			if (i > 0 && cell.link)
				spread_cell(c, row + i, col + k)->link = 1;
		}
		if (i > 0 && spread_right(c, row + i, col))
			spread_join_up(c, row, row + i, col);
	}
}

static bool insert_columns(struct spread *c, int at, int count)
{
	while (count-- > 0)
		if (!spread_insert_column(c, at))
			return false;
	return true;
}

static bool insert_rows(struct spread *c, int at, int count)
{
	while (count-- > 0)
		if (!spread_insert_row(c, at))
			return false;
	return true;
}

/* Counts cells from @col on that are free or wire, with no link between them. */
static int free_run(const struct spread *c, int row, int col, int most)
{
	int count = 0;

	while (count < most && col + count < spread_last(c) &&
	       is_plain(rung_at(c->rung, row, col + count)) &&
	       (count == 0 || !spread_linked(c, row, col + count)))
		count++;
	return count;
}

static bool paste_series(struct spread *c, int row, int col, const struct rung *part)
{
	const int width = part->cols;
	int run;

	if (col >= spread_last(c))
		return spread_fail(c, GRID_LAST_COLUMN);
	if (spread_word(c, row, col) == ELEM_PIN)
		return spread_fail(c, GRID_PIN_CELL);
	run = free_run(c, row, col, width);
	if (!insert_columns(c, col, width - run) ||
	    !insert_rows(c, row + 1, part->rows - 1))
		return false;
	put_piece(c, row, col, part);
	spread_close_left(c, row, col);
	if (!spread_is_empty(c, row, col + width - 1))
		spread_close_right(c, row, col + width - 1);
	spread_mark(c, row, col);
	return true;
}

static bool paste_parallel(struct spread *c, int row, int col, const struct rung *part)
{
	const int width = part->cols;
	int below;

	if (!spread_is_element(c, row, col))
		return spread_fail(c, GRID_NOTHING_BELOW);
	if (spread_is_output(c, row, col))
		return spread_fail(c, GRID_ONLY_OUTPUT);
	if (!insert_columns(c, col + 1, width - 1))
		return false;
	below = spread_branch_row(c, &row, col, col + width - 1);
	if (below < 0)
		return false;
	if (below < row && part->rows > 1)
		return spread_fail(c, GRID_CROSSING);
	if (!insert_rows(c, below + 1, part->rows - 1))
		return false;
	put_piece(c, below, col, part);
	spread_join_branch(c, row, below, col);
	spread_join_branch(c, row, below, col + width);
	for (int i = col + width - 1; i > col && spread_is_empty(c, below, i) &&
				      !spread_linked(c, below, i); i--)
		spread_cell(c, below, i)->word = ELEM_WIRE;
	if (spread_is_empty(c, below, col + width - 1))
		spread_cell(c, below, col + width - 1)->word = ELEM_WIRE;
	spread_mark(c, below, col);
	return true;
}

/* The first row, from @row on, that is not joined with the row above: new rows go there. */
static int row_apart(const struct spread *c, int row)
{
	bool joined = true;

	for (; row < c->rung->rows && joined; row++) {
		joined = false;
		for (int col = 0; col < c->rung->cols; col++)
			joined |= rung_at(c->rung, row, col)->link ||
				  spread_word(c, row, col) == ELEM_PIN;
		if (!joined)
			break;
	}
	return row;
}

static bool is_bare_row(const struct spread *c, int row)
{
	for (int col = 0; col < c->rung->cols; col++)
		if (!spread_is_empty(c, row, col) || spread_linked(c, row, col + 1))
			return false;
	return true;
}

static bool paste_rows(struct spread *c, int row, const struct rung *part)
{
	const int rows = part->rows, columns = grid_display_columns(part, 1);
	struct rung *spread;

	if (!insert_columns(c, spread_last(c), columns - c->rung->cols))
		return false;
	if (is_bare_row(c, row)) {
		if (!insert_rows(c, row + 1, rows - 1))
			return false;
	} else {
		row = row_apart(c, row + 1);
		if (!insert_rows(c, row, rows))
			return false;
	}
	spread = grid_spread(part, c->rung->cols);
	if (!spread)
		return spread_fail(c, GRID_NO_MEMORY);
	put_piece(c, row, 0, spread);
	rung_free(spread);
	spread_mark(c, row, 0);
	return true;
}

/* For outputs alone: puts all of them in the row of the cursor. */
static void paste_outputs(struct spread *c, int row, const struct rung *part)
{
	for (int i = 0; i < part->rows * part->cols; i++)
		if (!is_plain(&part->cell[i]) &&
		    !spread_place(c, row, spread_last(c), part->cell[i], GRID_INSERT))
			return;
}

static bool paste(struct spread *c, int row, int col, const struct piece *piece,
		  bool parallel)
{
	if (row < 0 || col < 0 || col >= c->rung->cols)
		return spread_fail(c, GRID_OUTSIDE);
	if (piece->elements == 0)
		return spread_fail(c, GRID_NO_ELEMENT);
	if (!spread_rows(c, row + 1))
		return false;
	if (piece->elements == 1 && piece->pins == 0)
		return parallel ? spread_parallel(c, row, col, col, piece->only) :
				  spread_place(c, row, col, piece->only, GRID_INSERT);
	if (piece->outputs == piece->elements)
		paste_outputs(c, row, piece->rung);
	else if (piece->outputs > 0)
		return paste_rows(c, row, piece->rung);
	else
		return parallel ? paste_parallel(c, row, col, piece->rung) :
				  paste_series(c, row, col, piece->rung);
	return c->refusal == GRID_DONE;
}

static bool paste_piece(struct spread *c, int row, int col, const struct rung *part,
		  bool parallel)
{
	struct rung *normal = grid_normalise(part);
	struct piece piece;
	bool good;

	if (!normal)
		return spread_fail(c, GRID_NO_MEMORY);
	piece = look_at(normal);
	good = paste(c, row, col, &piece, parallel);
	rung_free(normal);
	return good;
}

struct rung *grid_paste(const struct rung *rung, struct grid_at *at,
			const struct rung *part, bool parallel)
{
	struct spread c;

	if (spread_open(&c, rung, at->columns, 1))
		paste_piece(&c, at->row, at->col, part, parallel);
	return spread_close(&c, at);
}

bool grid_is_outputs(const struct rung *rung)
{
	const struct piece piece = look_at(rung);

	return piece.outputs > 0 && piece.outputs == piece.elements && piece.pins == 0;
}

/* ---- dropping ---- */

/* The element that a branch at the empty cell (@row, @col) would go around: right above, or
 * the box whose pins are there; -1: none. */
static int element_above(const struct spread *c, int row, int col)
{
	for (row--; row >= 0 && spread_word(c, row, col) == ELEM_PIN; row--)
		;
	return row >= 0 && spread_is_element(c, row, col) &&
	       !spread_is_output(c, row, col) ? row : -1;
}

static enum grid_drop judge_series(const struct spread *c, int row, int col)
{
	if (col >= spread_last(c))
		return GRID_DROP_NOT;
	if (spread_word(c, row, col) == ELEM_PIN)
		return GRID_DROP_NOT;
	if (spread_word(c, row, col) == ELEM_WIRE)
		return GRID_DROP_WIRE;
	if (!spread_is_empty(c, row, col))
		return GRID_DROP_BEFORE;
	return element_above(c, row, col) >= 0 ? GRID_DROP_BELOW : GRID_DROP_THERE;
}

static enum grid_drop judge(const struct spread *c, int row, int col, enum word word)
{
	if (row < 0 || row > c->rung->rows || row >= LIMIT_ROWS || col < 0 ||
	    col >= c->rung->cols)
		return GRID_DROP_NOT;
	switch (word_row(word)->place) {
	case PLACE_LAST:
		return col == spread_last(c) ? GRID_DROP_OUTPUT : GRID_DROP_NOT;
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
	struct spread c;

	if (spread_open(&c, rung, columns, 1))
		drop = judge(&c, row, col, word);
	c.refusal = GRID_OUTSIDE; /* no rung is wanted */
	spread_close(&c, &at);
	return drop;
}

bool grid_takes(const struct rung *rung, int columns, int rows, enum word word, bool *takes)
{
	struct grid_at at = { .columns = columns };
	const int cells = rows * columns;
	struct spread c;
	const bool open = spread_open(&c, rung, columns, 1);

	for (int i = 0; i < cells; i++)
		takes[i] = open && judge(&c, i / columns, i % columns, word) != GRID_DROP_NOT;
	c.refusal = GRID_OUTSIDE; /* no rung is wanted */
	spread_close(&c, &at);
	return open;
}

static enum grid_refusal why_not(const struct spread *c, int row, int col, enum word word)
{
	if (word_row(word)->place == PLACE_LAST)
		return GRID_OUTPUT_LAST;
	return spread_word(c, row, col) == ELEM_PIN ? GRID_PIN_CELL : GRID_LAST_COLUMN;
}

static bool drop(struct spread *c, int row, int col, struct cell cell)
{
	const enum grid_drop how = judge(c, row, col, (enum word)cell.word);

	if (how != GRID_DROP_NOT && !spread_rows(c, row + 1))
		return false;
	switch (how) {
	case GRID_DROP_NOT:
		return spread_fail(c, why_not(c, row, col, (enum word)cell.word));
	case GRID_DROP_BELOW:
		return spread_parallel(c, element_above(c, row, col), col, col, cell);
	case GRID_DROP_THERE:
	case GRID_DROP_WIRE:
	case GRID_DROP_BEFORE:
	case GRID_DROP_OUTPUT:
		break;
	}
	return spread_place(c, row, col, cell, GRID_INSERT);
}

struct rung *grid_drop(const struct rung *rung, struct grid_at *at, struct cell cell)
{
	struct spread c;

	cell.spare = 0;
	if (spread_open(&c, rung, at->columns, 1))
		drop(&c, at->row, at->col, cell);
	return spread_close(&c, at);
}

/* ---- moving an element ---- */

/* Backwards, so that a branch is deleted before the element it is parallel to. */
static bool delete_last_moved(struct spread *c)
{
	for (int row = c->rung->rows - 1; row >= 0; row--)
		for (int col = spread_last(c); col >= 0; col--) {
			struct cell *cell = spread_cell(c, row, col);

			if (!(cell->spare & SPREAD_MOVED))
				continue;
			cell->spare &= (uint8_t)~SPREAD_MOVED;
			spread_delete_whole(c, row, col);
			return true;
		}
	return false;
}

static void delete_moved(struct spread *c)
{
	while (c->refusal == GRID_DONE && delete_last_moved(c))
		;
}

static struct rung *move_within(const struct rung *rung, struct grid_at *from,
				struct grid_at *to)
{
	struct spread c;
	const struct grid_at start = *from;

	if (spread_at_element(&c, rung, from)) {
		struct cell *cell = spread_cell(&c, from->row, from->col);
		struct cell moved = *cell;

		moved.spare = 0;
		cell->spare |= SPREAD_MOVED;
		if (start.row == to->row && start.col == to->col)
			spread_mark(&c, to->row, to->col);
		else if (drop(&c, to->row, to->col, moved))
			delete_moved(&c);
	}
	rung = spread_close(&c, to);
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

static void mark_moved(struct spread *c, const struct grid_area *area)
{
	for (int row = area->row; row <= area->last_row && row < c->rung->rows; row++)
		for (int col = area->col; col <= area->last_col; col++)
			if (col < c->rung->cols && spread_is_element(c, row, col))
				spread_cell(c, row, col)->spare |= SPREAD_MOVED;
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
	struct spread c;

	if (spread_open(&c, rung, to->columns, 1) && !is_within(area, to)) {
		mark_moved(&c, area);
		if (paste_piece(&c, to->row, to->col, piece, parallel))
			delete_moved(&c);
	}
	return spread_close(&c, to);
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
