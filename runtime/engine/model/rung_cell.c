/* SPDX-License-Identifier: MIT
 *
 * rung_cell - the edits of a rung in place: one cell, one box, one row.
 *
 * Links stay where they are; a box and its pin rows stay together. An edit that fails
 * changes nothing.
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
