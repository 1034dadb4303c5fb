/* SPDX-License-Identifier: MIT
 *
 * rung_cell - the edits of a rung in place: one cell, one box, one row.
 *
 * Links stay where they are; a box and its pin rows stay together. An edit that
 * cannot be done changes nothing.
 */
#include "engine/model/rung.h"

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

/* A box goes with its pin rows; a pin row inside a box stays as a blank one, so
 * that those below it do not lose their box. */
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

static void move_content(struct rung *rung, int row, int col, int to_row,
			 int to_col)
{
	struct cell *from = rung_cell(rung, row, col);

	put(rung_cell(rung, to_row, to_col), *from);
	put(from, (struct cell){ .word = ELEM_EMPTY });
}

bool rung_move_cell(struct rung *rung, int row, int col, int to_row, int to_col)
{
	int height;

	if (!is_inside(rung, row, col) || !is_inside(rung, to_row, to_col))
		return false;
	height = rung_height(rung, row, col);
	if (to_row + height > rung->rows)
		return false;
	if (row == to_row && col == to_col)
		return true;
	/* From the end that cannot overwrite what is still to be moved. */
	for (int i = 0; i < height; i++) {
		int step = to_row > row ? height - 1 - i : i;

		move_content(rung, row + step, col, to_row + step, to_col);
	}
	return true;
}

static bool is_free(const struct cell *cell)
{
	return cell->word == ELEM_EMPTY || cell->word == ELEM_WIRE;
}

bool rung_insert_cell(struct rung *rung, int row, int col)
{
	int end = col;

	if (!is_inside(rung, row, col))
		return false;
	for (; end < rung->cols; end++) {
		const struct cell *cell = rung_at(rung, row, end);

		if (is_free(cell))
			break;
		/* Its other rows cannot come along. */
		if (cell->word == ELEM_PIN || rung_height(rung, row, end) > 1)
			return false;
	}
	if (end == rung->cols)
		return false;
	if (end == col)
		return true;
	for (; end > col; end--)
		put(rung_cell(rung, row, end), *rung_at(rung, row, end - 1));
	put(rung_cell(rung, row, col), (struct cell){ .word = ELEM_WIRE });
	return true;
}

bool rung_delete_cell(struct rung *rung, int row, int col)
{
	bool between;
	uint16_t word;

	if (!is_inside(rung, row, col))
		return false;
	word = rung_at(rung, row, col)->word;
	between = word != ELEM_EMPTY && word != ELEM_PIN &&
		  (col == 0 || rung_at(rung, row, col - 1)->word != ELEM_EMPTY) &&
		  col + 1 < rung->cols &&
		  rung_at(rung, row, col + 1)->word != ELEM_EMPTY;
	rung_clear_cell(rung, row, col);
	if (between)
		rung_cell(rung, row, col)->word = ELEM_WIRE;
	return true;
}

bool rung_set_link(struct rung *rung, int row, int col, bool link)
{
	if (!is_inside(rung, row, col) || row == 0)
		return false;
	rung_cell(rung, row, col)->link = link;
	return true;
}
