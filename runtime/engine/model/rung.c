/* SPDX-License-Identifier: MIT
 *
 * rung - one grid of ladder: its memory and the edits that change its size.
 *
 * An edit makes a new rung, so that undo keeps the old one, and keeps connections where
 * possible. Edits in place keep links where they are, and a box with its pin rows together.
 */
#include "engine/model/rung.h"

#include <stdlib.h>
#include <string.h>

static size_t block_size(int rows, int cols)
{
	return sizeof(struct rung) +
	       (size_t)rows * (size_t)cols * sizeof(struct cell);
}

struct rung *rung_new(int rows, int cols)
{
	struct rung *rung;

	if (rows < 1 || rows > LIMIT_ROWS || cols < 1 || cols > LIMIT_COLS)
		return NULL;
	rung = calloc(1, block_size(rows, cols));
	if (!rung)
		return NULL;
	rung->rows = (uint16_t)rows;
	rung->cols = (uint16_t)cols;
	return rung;
}

void rung_free(struct rung *rung)
{
	free(rung);
}

size_t rung_size(const struct rung *rung)
{
	return block_size(rung->rows, rung->cols);
}

struct rung *rung_copy(const struct rung *rung)
{
	struct rung *copy = malloc(rung_size(rung));

	if (copy)
		memcpy(copy, rung, rung_size(rung));
	return copy;
}

bool rung_equal(const struct rung *a, const struct rung *b)
{
	return a->label == b->label && a->title == b->title &&
	       a->comment == b->comment && a->off == b->off &&
	       a->rows == b->rows && a->cols == b->cols &&
	       memcmp(a->cell, b->cell,
		      rung_size(a) - sizeof(struct rung)) == 0;
}

int rung_line(const struct rung *rung, int row)
{
	if (!rung->line || rung->gaps)
		return (int)rung->line;
	return (int)rung->line + row;
}

struct cell *rung_cell(struct rung *rung, int row, int col)
{
	return &rung->cell[(size_t)row * rung->cols + (size_t)col];
}

const struct cell *rung_at(const struct rung *rung, int row, int col)
{
	return &rung->cell[(size_t)row * rung->cols + (size_t)col];
}

/* An empty grid of another size with the same label, title and comments. */
static struct rung *new_like(const struct rung *rung, int rows, int cols)
{
	struct rung *made = rung_new(rows, cols);

	if (!made)
		return NULL;
	made->label = rung->label;
	made->title = rung->title;
	made->comment = rung->comment;
	made->line = rung->line;
	made->gaps = rung->gaps;
	made->off = rung->off;
	return made;
}

static void copy_row(struct rung *to, int to_row, const struct rung *from,
		     int from_row)
{
	memcpy(rung_cell(to, to_row, 0), rung_at(from, from_row, 0),
	       from->cols * sizeof(struct cell));
}

/* The new row has links where the rows above and below were joined. A box that it cuts
 * gets taller. */
struct rung *rung_insert_row(const struct rung *rung, int at)
{
	struct rung *made;

	if (at < 0 || at > rung->rows)
		return NULL;
	made = new_like(rung, rung->rows + 1, rung->cols);
	if (!made)
		return NULL;
	for (int row = 0; row < rung->rows; row++)
		copy_row(made, row < at ? row : row + 1, rung, row);
	for (int col = 0; col < rung->cols && at > 0 && at < rung->rows; col++) {
		const struct cell *below = rung_at(rung, at, col);
		struct cell *cell = rung_cell(made, at, col);

		cell->link = below->link;
		if (below->word == ELEM_PIN)
			cell->word = ELEM_PIN;
	}
	return made;
}

/* Removes the pin rows of the box at (@row, @col). */
static void drop_pins(struct rung *rung, int row, int col)
{
	for (; row < rung->rows; row++) {
		struct cell *cell = rung_cell(rung, row, col);
		uint8_t link = cell->link;

		if (cell->word != ELEM_PIN)
			break;
		*cell = (struct cell){ .link = link };
	}
}

/* Rows above and below stay joined where both were joined to the deleted row. A box in
 * it is deleted with its pin rows. */
struct rung *rung_delete_row(const struct rung *rung, int at)
{
	struct rung *made;

	if (at < 0 || at >= rung->rows)
		return NULL;
	made = new_like(rung, rung->rows - 1, rung->cols);
	if (!made)
		return NULL;
	for (int row = 0; row < made->rows; row++)
		copy_row(made, row, rung, row < at ? row : row + 1);
	for (int col = 0; col < rung->cols && at < made->rows; col++) {
		struct cell *below = rung_cell(made, at, col);

		below->link = at > 0 && below->link &&
			      rung_at(rung, at, col)->link;
		if (rung_height(rung, at, col) > 1)
			drop_pins(made, at, col);
	}
	return made;
}

static bool is_empty(const struct cell *cell)
{
	return cell->word == ELEM_EMPTY && !cell->link && !cell->comment;
}

/* Whether bar @bar of @row is joined to its left, above or below. */
static bool bar_is_used(const struct rung *rung, int row, int bar)
{
	const struct cell *left;

	if (bar == 0)
		return true;
	left = rung_at(rung, row, bar - 1);
	return left->word != ELEM_EMPTY || left->link ||
	       (row + 1 < rung->rows && rung_at(rung, row + 1, bar - 1)->link);
}

/* Whether the new column must carry power to the old cell (@row, @at). */
static bool needs_wire(const struct rung *rung, int row, int at)
{
	const struct cell *right;

	if (at == rung->cols)
		return false;
	right = rung_at(rung, row, at);
	if (right->word == ELEM_EMPTY ||
	    (right->word == ELEM_PIN && !right->operand))
		return false;
	return bar_is_used(rung, row, at);
}

struct rung *rung_insert_column(const struct rung *rung, int at)
{
	struct rung *made;

	if (at < 0 || at > rung->cols)
		return NULL;
	made = new_like(rung, rung->rows, rung->cols + 1);
	if (!made)
		return NULL;
	for (int row = 0; row < rung->rows; row++) {
		struct cell *to = rung_cell(made, row, 0);
		const struct cell *from = rung_at(rung, row, 0);

		memcpy(to, from, (size_t)at * sizeof(*to));
		memcpy(to + at + 1, from + at,
		       (size_t)(rung->cols - at) * sizeof(*to));
		if (needs_wire(rung, row, at))
			to[at].word = ELEM_WIRE;
	}
	return made;
}

/* The bars on both sides become one and keep the links of both. */
struct rung *rung_delete_column(const struct rung *rung, int at)
{
	struct rung *made;

	if (at < 0 || at >= rung->cols)
		return NULL;
	made = new_like(rung, rung->rows, rung->cols - 1);
	if (!made)
		return NULL;
	for (int row = 0; row < rung->rows; row++) {
		struct cell *to = rung_cell(made, row, 0);
		const struct cell *from = rung_at(rung, row, 0);

		memcpy(to, from, (size_t)at * sizeof(*to));
		memcpy(to + at, from + at + 1,
		       (size_t)(made->cols - at) * sizeof(*to));
		if (at > 0 && from[at].link)
			to[at - 1].link = 1;
	}
	return made;
}

struct rung *rung_resize(const struct rung *rung, int rows, int cols)
{
	struct rung *made = new_like(rung, rows, cols);
	int keep = cols < rung->cols ? cols : rung->cols;

	for (int row = 0; made && row < rows && row < rung->rows; row++)
		memcpy(rung_cell(made, row, 0), rung_at(rung, row, 0),
		       (size_t)keep * sizeof(struct cell));
	return made;
}

struct rung *rung_trim(const struct rung *rung)
{
	int rows = 1, cols = 1;

	for (int row = 0; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++) {
			if (is_empty(rung_at(rung, row, col)))
				continue;
			rows = row + 1;
			if (col + 1 > cols)
				cols = col + 1;
		}
	return rung_resize(rung, rows, cols);
}

/* ---- edits in place: one cell, one box ---- */

static bool is_inside(const struct rung *rung, int row, int col)
{
	return row >= 0 && row < rung->rows && col >= 0 && col < rung->cols;
}

static bool is_box(const struct cell *cell)
{
	const struct word_row *row = word_row((enum word)cell->word);

	return row->place == PLACE_BOX || row->operand == OPND_EXPR;
}

int rung_height(const struct rung *rung, int row, int col)
{
	int height = 1;

	if (!is_inside(rung, row, col) || !is_box(rung_at(rung, row, col)))
		return 1;
	while (row + height < rung->rows &&
	       rung_at(rung, row + height, col)->word == ELEM_PIN)
		height++;
	return height;
}

int rung_box_top(const struct rung *rung, int row, int col)
{
	while (row > 0 && rung_at(rung, row, col)->word == ELEM_PIN)
		row--;
	return word_row((enum word)rung_at(rung, row, col)->word)->kind == WORD_ELEM ? -1 :
										       row;
}

/* The cell gets another content and keeps its link. */
static void put(struct cell *cell, struct cell content)
{
	content.link = cell->link;
	*cell = content;
}

bool rung_set_cell(struct rung *rung, int row, int col, struct cell cell)
{
	if (!is_inside(rung, row, col))
		return false;
	cell.spare = 0;
	*rung_cell(rung, row, col) = cell;
	return true;
}

/* A box is removed with its pin rows. A pin row inside a box becomes a blank pin row,
 * so that the rows below it still belong to the box. */
bool rung_clear_cell(struct rung *rung, int row, int col)
{
	struct cell blank = { .word = ELEM_EMPTY };
	int height;

	if (!is_inside(rung, row, col))
		return false;
	height = rung_height(rung, row, col);
	if (rung_at(rung, row, col)->word == ELEM_PIN &&
	    row + 1 < rung->rows && rung_at(rung, row + 1, col)->word == ELEM_PIN)
		blank.word = ELEM_PIN;
	for (int i = 0; i < height; i++)
		put(rung_cell(rung, row + i, col), blank);
	return true;
}
