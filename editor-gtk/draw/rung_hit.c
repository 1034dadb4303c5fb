/* SPDX-License-Identifier: MIT
 *
 * rung_hit - what stands at a point of a rung, and the rectangle of a cell.
 */
#include "editor-gtk/draw/rung_box.h"
#include "editor-gtk/draw/rung_text.h"

#include <glib.h>
#include <math.h>

#define REACH 7   /* px: as near as a pointer must come to a wire               */
#define GRIP  24  /* px left and right of its middle an element is held        */
#define ROUND 12  /* px left and right of the end of an empty cell             */

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
	return rung_box_top(layout->rung, row, *col);
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
						  output, side->pin[i].name,
						  side->pin[i].name_len };
			return true;
		}
	return false;
}

/* Is there something at the cell, or wire? */
static bool goes_on(const struct rung_layout *layout, int row, int column)
{
	const int col = rung_layout_col(layout, row, column);

	return rung_layout_wired(layout, row, column) ||
	       (col >= 0 && word_row(rung_at(layout->rung, row, col)->word)->place !=
			    PLACE_NONE);
}

/* A link is drawn at the bar on the right of its cell. Where it meets the wire of a row that
 * is meant, behind the link. */
static bool hits_link(const struct rung_layout *layout, struct rung_hit *hit, float x,
		      float y)
{
	const struct rung *rung = layout->rung;
	const bool meets = fabsf(y - layout->row[hit->row].wire) <= REACH;
	int below = y < layout->row[hit->row].wire ? hit->row : hit->row + 1;

	if (below < 1 || below >= rung->rows)
		return false;
	for (int col = 0; col < rung->cols; col++)
		if (rung_at(rung, below, col)->link &&
		    fabsf(rung_layout_bar(layout, below, col + 1) - x) <= REACH) {
			const int column = rung_layout_column(layout, below, col);

			if (meets && goes_on(layout, hit->row, column + 1))
				hit->column = column + 1;
			if (meets)
				return false;
			hit->part = RUNG_PART_LINK;
			hit->row = below;
			hit->column = column;
			return true;
		}
	return false;
}

struct rung_hit rung_layout_hit(const struct drafting *drafting,
				const struct rung_layout *layout, float x, float y)
{
	struct rung_hit hit = { .part = RUNG_PART_NONE, .pin = -1 };

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

/* ---- ends of cells ---- */

float rung_layout_end_x(const struct rung_layout *layout, int bar)
{
	return rung_layout_bar(layout, layout->rung->rows, MIN(bar, layout->columns - 1));
}

static int nearest_bar(const struct rung_layout *layout, float x)
{
	int best = 0;

	for (int bar = 1; bar < layout->columns; bar++)
		if (fabsf(rung_layout_end_x(layout, bar) - x) <
		    fabsf(rung_layout_end_x(layout, best) - x))
			best = bar;
	return best;
}

void rung_layout_nearest(const struct rung_layout *layout, float x, float y, int *row,
			 int *bar)
{
	const struct rung_row *last = &layout->row[layout->rows - 1];

	*row = y >= last->y + last->height ? layout->rows : row_at(layout, y);
	*bar = nearest_bar(layout, x);
}

/* From where to where an element is held; beside that are its wires. */
struct held { float from, to; };

static struct held held_of(const struct drafting *drafting,
			   const struct rung_layout *layout, int row, int column, int col)
{
	const struct cell *cell = rung_at(layout->rung, row, col);
	const struct word_row *word = words_row(&drafting->project->words, cell->word);
	const float x = layout->column_x[column], width = layout->column_width[column];
	const float middle = x + width / 2;
	int at, top = box_row(layout, row, column, &at);

	if (top >= 0) {
		struct rung_box box;

		rung_box_make(drafting, layout->rung, top, col, &box);
		rung_box_place(&box, layout->row, x, width);
		return (struct held){ box.x, top == row ? box.x + box.inner : x + width };
	}
	float half = rung_is_framed(word) ?
		rung_framed(drafting, cell).width / 2 + FRAMED_SIDE : GRIP;
	return (struct held){ middle - half,
			      word->place == PLACE_LAST ? layout->right : middle + half };
}

static bool is_free_end(const struct drafting *drafting, const struct rung_layout *layout,
			float x, int row, int column)
{
	const int col = rung_layout_col(layout, row, column);
	enum place place = PLACE_NONE;

	if (rung_layout_wired(layout, row, column))
		return true;
	if (col >= 0)
		place = word_row(rung_at(layout->rung, row, col)->word)->place;
	if (place == PLACE_NONE)
		return fabsf(rung_layout_end_x(layout, nearest_bar(layout, x)) - x) <= ROUND;
	const struct held held = held_of(drafting, layout, row, column, col);
	return x < held.from || x > held.to;
}

bool rung_layout_end(const struct drafting *drafting, const struct rung_layout *layout,
		     float x, float y, int *row, int *bar)
{
	struct rung_hit link = { .row = row_at(layout, y) };

	if (x < RUNG_LEFT - REACH || x > layout->right || y < layout->top ||
	    y >= layout->height)
		return false;
	*row = link.row;
	*bar = nearest_bar(layout, x);
	if (fabsf(layout->row[*row].wire - y) <= REACH)
		return is_free_end(drafting, layout, x, *row, column_at(layout, x));
	if (!hits_link(layout, &link, x, y))
		return false;
	if (layout->row[link.row].wire - y > y - layout->row[link.row - 1].wire)
		link.row--;
	*row = link.row;
	return true;
}
