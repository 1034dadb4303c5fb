/* SPDX-License-Identifier: MIT
 *
 * rung_fold - lines of a folded rung, and the places in them; see rung_fold.h.
 */
#include "editor-gtk/draw/rung_fold.h"

#include <glib.h>

#define LINK_AIR 3    /* px behind a link that stays with its row              */
#define BELOW    9    /* px below the last line, as below a rung that is not folded */

/* ---- where it is folded ---- */

/* Is there a link from @row to the row above, at @x? */
static bool row_is_linked(const struct rung_layout *layout, int row, float x)
{
	const struct rung *rung = layout->rung;

	for (int col = 0; row < rung->rows && col < rung->cols; col++)
		if (rung_at(rung, row, col)->link && ABS(rung_layout_bar(layout, row, col + 1) - x) < 1)
			return true;
	return false;
}

static bool is_linked(const struct rung_layout *layout, float x)
{
	for (int row = 0; row < layout->rung->rows; row++)
		if (row_is_linked(layout, row, x))
			return true;
	return false;
}

/* The column that begins the line behind one that begins with @first and has room up to @most. Links are not
 * cut through, unless half of the line would stay empty. */
static int next_column(const struct rung_layout *layout, int first, float from, float most, bool *linked)
{
	int joined = 0;

	for (int column = layout->columns - 1; column > first; column--) {
		const float x = layout->column_x[column];

		if (x + LINK_AIR > most)
			continue;
		if (joined && x < (from + most) / 2)
			break;
		*linked = is_linked(layout, x);
		if (!*linked)
			return column;
		if (!joined)
			joined = column;
	}
	*linked = joined > 0;
	return joined ? joined : first + 1;
}

float rung_fold_room(const struct rung_layout *layout)
{
	float widest = RUNG_CELL_WIDTH;

	for (int column = 0; column < layout->columns; column++)
		widest = MAX(widest, layout->column_need[column]);
	return widest + LINK_AIR + FOLD_LEFT - RUNG_LEFT + FOLD_RIGHT;
}

struct rung_fold *rung_fold_new(struct rung_layout *layout, float width)
{
	struct rung_fold *fold = g_malloc0(sizeof(*fold) + (size_t)layout->columns * sizeof(fold->line[0]));
	const float rail = RUNG_LEFT + width;
	struct rung_fold_line *line = fold->line;
	bool linked = false;

	rung_layout_pack(layout, 0);
	fold->top = layout->top;
	fold->width = width;
	while (line->from + rail - line->x < layout->right && line->first + 1 < layout->columns) {
		const float most = line->from + rail - line->x - FOLD_RIGHT;

		line[1].first = line->last = next_column(layout, line->first, line->from, most, &linked);
		line[1].from = line->to = layout->column_x[line->last] + (linked ? LINK_AIR : 0);
		line[1].x = FOLD_LEFT;
		line++;
	}
	rung_layout_pack(layout, line->from + rail - line->x - RUNG_LEFT);
	line->last = layout->columns;
	line->to = rung_layout_width(layout);
	fold->lines = (int)(line - fold->line) + 1;
	return fold;
}

/* ---- rows ---- */

/* Is something drawn in a row, from column @from to before @to? */
static bool is_used(const struct rung_layout *layout, int row, int from, int to)
{
	for (int column = from; column < to; column++) {
		const int col = rung_layout_col(layout, row, column);

		if (rung_layout_goes_on(layout, row, column) || (col >= 0 && rung_at(layout->rung, row, col)->link))
			return true;
	}
	return false;
}

/* Rows below those of the rung are shown for who wants to put something there. */
static int rows_of(const struct rung_layout *layout, const struct rung_fold_line *line,
		   const struct rung_fold_wish *wish, int wishes)
{
	int rows = layout->rung->rows;

	while (rows > 1 && !is_used(layout, rows - 1, line->first, line->last))
		rows--;
	for (int i = 0; i < wishes; i++)
		if (wish[i].column < line->last && (wish[i].on || wish[i].column >= line->first))
			rows = MAX(rows, MIN(wish[i].row + 1, layout->rows));
	return rows;
}

float rung_fold_bottom(const struct rung_fold *fold, const struct rung_layout *layout, int line)
{
	const struct rung_row *last = &layout->row[fold->line[line].rows - 1];

	return last->y + last->height;
}

bool rung_fold_place(struct rung_fold *fold, const struct rung_layout *layout, const struct rung_fold_wish *wish,
		     int wishes)
{
	const float before = fold->height;
	float y = layout->top;

	for (int i = 0; i < fold->lines; i++) {
		struct rung_fold_line *line = &fold->line[i];

		line->rows = rows_of(layout, line, wish, wishes);
		line->y = y;
		y += rung_fold_bottom(fold, layout, i) - layout->top + FOLD_GAP;
	}
	fold->height = y - FOLD_GAP + BELOW;
	return fold->height != before;
}

/* ---- places ---- */

int rung_fold_line_at(const struct rung_fold *fold, float x)
{
	int line = 0;

	while (line + 1 < fold->lines && x >= fold->line[line].to)
		line++;
	return line;
}

/* The line at or above y as shown. */
static int line_below(const struct rung_fold *fold, float y)
{
	int line = fold->lines - 1;

	while (line > 0 && y < fold->line[line].y)
		line--;
	return line;
}

graphene_point_t rung_fold_shown(const struct rung_fold *fold, float x, float y)
{
	const struct rung_fold_line *line = &fold->line[rung_fold_line_at(fold, x)];

	if (y < fold->top) /* the title */
		return GRAPHENE_POINT_INIT(x, y);
	return GRAPHENE_POINT_INIT(x - line->from + line->x, y - fold->top + line->y);
}

graphene_point_t rung_fold_laid(const struct rung_fold *fold, const struct rung_layout *layout, float x, float y)
{
	const int number = line_below(fold, y);
	const struct rung_fold_line *line = &fold->line[number];
	graphene_point_t at = { x, y };

	if (y < fold->top)
		return at;
	at.y = y - line->y + fold->top;
	if (number + 1 < fold->lines || line->rows < layout->rows) /* the gap below belongs to the last row */
		at.y = MIN(at.y, rung_fold_bottom(fold, layout, number) - 1);
	if (x < RUNG_GUTTER)
		return at;
	at.x = MAX(x - line->x, 0) + line->from;
	if (number + 1 < fold->lines)
		at.x = MIN(at.x, line->to - 0.1f);
	return at;
}

bool rung_fold_goes_on(const struct rung_fold *fold, const struct rung_layout *layout, int line, int row)
{
	const int behind = fold->line[line].last, before = rung_layout_col(layout, row, behind - 1);
	const float x = layout->column_x[behind - 1] + layout->column_width[behind - 1];

	if (row >= layout->rung->rows || !rung_layout_goes_on(layout, row, behind))
		return false;
	if (row_is_linked(layout, row, x) || row_is_linked(layout, row + 1, x)) /* it begins at the link */
		return true;
	if (!rung_layout_goes_on(layout, row, behind - 1))
		return false;
	return before < 0 || word_row(rung_at(layout->rung, row, before)->word)->place != PLACE_PIN;
}
