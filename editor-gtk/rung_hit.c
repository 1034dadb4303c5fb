/* SPDX-License-Identifier: MIT
 *
 * rung_hit - what stands at a point of a rung, and the rectangle of a cell.
 */
#include "editor-gtk/rung_box.h"

#include <glib.h>
#include <math.h>

#define REACH 7   /* px: as near as a pointer must come to a wire               */

static int row_at(const struct rung_layout *layout, float y)
{
	int row = layout->rows - 1;

	while (row > 0 && y < layout->row[row].y)
		row--;
	return row;
}

/* What lies between the columns belongs to the last one, where outputs stand. */
static int column_at(const struct rung_layout *layout, float x)
{
	int d = 0;

	while (d < layout->columns - 1 &&
	       x >= layout->column_x[d] + layout->column_width[d])
		d++;
	return d;
}

/* The first row of the box that covers (row, column), or -1. */
static int box_row(const struct rung_layout *layout, int row, int column, int *col)
{
	*col = rung_layout_col(layout, row, column);
	if (*col < 0)
		return -1;
	int top = row;
	while (top > 0 &&
	       word_row(rung_at(layout->rung, top, *col)->word)->place == PLACE_PIN)
		top--;
	return word_row(rung_at(layout->rung, top, *col)->word)->kind == WORD_ELEM ? -1 :
										     top;
}

graphene_rect_t rung_layout_cell(const struct rung_layout *layout, int row, int column)
{
	int col, top = box_row(layout, row, column, &col), last = row;
	float x = layout->column_x[column];

	if (top < 0) /* beside a tall box it is as high as elsewhere        */
		return GRAPHENE_RECT_INIT(x, layout->row[row].y,
					  layout->column_width[column],
					  RUNG_CELL_HEIGHT);
	last = top + rung_height(layout->rung, top, col) - 1;
	const struct rung_row *r = &layout->row[last];
	return GRAPHENE_RECT_INIT(x, layout->row[top].y, layout->column_width[column],
				  r->y + r->height - layout->row[top].y);
}

static bool hits_pin(const struct drafting *drafting, const struct rung_layout *layout,
		     struct rung_hit *hit, float x, float y)
{
	struct rung_box box;
	int col, top = box_row(layout, hit->row, hit->column, &col);

	if (top < 0)
		return false;
	rung_box_make(drafting, layout->rung, top, col, &box);
	rung_box_place(&box, layout->row, layout->column_x[hit->column],
		       layout->column_width[hit->column]);
	bool output = x > box.x + box.inner / 2;
	const struct rung_side *side = output ? &box.out : &box.in;
	hit->row = top;
	for (int i = 0; i < side->count; i++)
		if (!side->pin[i].power && fabsf(layout->row[top].wire + side->pin[i].y -
						 y) <= BOX_LINE / 2.0f) {
			*hit = (struct rung_hit){ RUNG_PART_PIN, top, hit->column, i,
						  output };
			return true;
		}
	return false;
}

/* A link is drawn at the bar on the right of its cell. */
static bool hits_link(const struct rung_layout *layout, struct rung_hit *hit, float x,
		      float y)
{
	const struct rung *rung = layout->rung;
	int below = y < layout->row[hit->row].wire ? hit->row : hit->row + 1;

	if (below < 1 || below >= rung->rows)
		return false;
	for (int col = 0; col < rung->cols; col++)
		if (rung_at(rung, below, col)->link &&
		    fabsf(rung_layout_bar(layout, below, col + 1) - x) <= REACH) {
			hit->part = RUNG_PART_LINK;
			hit->row = below;
			hit->column = rung_layout_column(layout, below, col);
			return true;
		}
	return false;
}

struct rung_hit rung_layout_hit(const struct drafting *drafting,
				const struct rung_layout *layout, float x, float y)
{
	struct rung_hit hit = { RUNG_PART_NONE, 0, 0, -1, false };

	if (x < 0 || y < 0 || y >= layout->height)
		return hit;
	hit.part = RUNG_PART_NUMBER;
	if (x < RUNG_GUTTER)
		return hit;
	hit.part = RUNG_PART_TITLE;
	if (y < layout->top)
		return hit;
	hit.part = RUNG_PART_NONE;
	if (x > layout->right || y >= layout->height - 1)
		return hit;
	hit.row = row_at(layout, y);
	hit.column = column_at(layout, x);
	if (hits_pin(drafting, layout, &hit, x, y) || hits_link(layout, &hit, x, y))
		return hit;
	hit.part = rung_layout_wired(layout, hit.row, hit.column) &&
		   fabsf(layout->row[hit.row].wire - y) <= REACH ? RUNG_PART_WIRE :
								   RUNG_PART_CELL;
	return hit;
}
