/* SPDX-License-Identifier: MIT
 *
 * rung_layout - measures a rung, places its rows and columns, and finds the part at a
 * point; see rung_layout.h.
 */
#include "editor-gtk/draw/rung_layout.h"
#include "editor-gtk/draw/rung_box.h"
#include "editor-gtk/draw/rung_text.h"
#include "editor-gtk/edit/grid_display.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#define TITLE_HEIGHT 36   /* above the rows                                     */
#define BARE_HEIGHT  14   /* of a rung without title and comment                */
#define TITLE_LINE   24   /* baseline of the title                              */
#define COMMENT_LINE 17
#define SHORT_LINES  3    /* most lines of a title, of a comment, on the screen  */
#define BELOW        9
#define BESIDE       16   /* px around a name                                   */
#define BOX_AIR      18   /* px below a box, for its marks                      */
#define REACH 7   /* px: how far from a wire the pointer still hits it          */
#define GRIP  24  /* px left and right of an element's middle that hit the element */
#define ROUND 12  /* px left and right of the end of an empty cell             */

static const struct word_row *word_at(const struct drafting *drafting,
				      const struct rung *rung, int row, int col)
{
	return words_row(&drafting->project->words, rung_at(rung, row, col)->word);
}

static enum place place_at(const struct rung *rung, int row, int col)
{
	return word_row(rung_at(rung, row, col)->word)->place;
}

static bool linked_behind(const struct rung *rung, int row, int bar)
{
	for (; bar <= rung->cols; bar++)
		if (rung_at(rung, row, bar - 1)->link ||
		    (row + 1 < rung->rows && rung_at(rung, row + 1, bar - 1)->link))
			return true;
	return false;
}

/* The last element of a row if nothing is joined behind it; -1: there is none. */
static int free_end(const struct rung *rung, int row)
{
	int col = rung->cols - 1;

	while (col >= 0 && place_at(rung, row, col) == PLACE_NONE)
		col--;
	return col < 0 || linked_behind(rung, row, col + 1) ? -1 : col;
}

int rung_layout_columns(const struct rung *rung)
{
	return grid_display_columns(rung, RUNG_LEAST_COLUMNS);
}

int rung_layout_column(const struct rung_layout *layout, int row, int col)
{
	return row < layout->rung->rows && col == layout->row[row].output ?
	       layout->columns - 1 : col;
}

int rung_layout_col(const struct rung_layout *layout, int row, int column)
{
	if (row >= layout->rung->rows)
		return -1;
	int output = layout->row[row].output;
	if (output >= 0 && column == layout->columns - 1)
		return output;
	if (output >= 0 && column >= output)
		return -1;
	return column < layout->rung->cols ? column : -1;
}

bool rung_layout_wired(const struct rung_layout *layout, int row, int column)
{
	if (row >= layout->rung->rows)
		return false;
	const struct rung_row *r = &layout->row[row];
	int col = rung_layout_col(layout, row, column);
	if (col >= 0 && place_at(layout->rung, row, col) == PLACE_WIRE)
		return true;
	return (r->output >= 0 && column >= r->output && column < layout->columns - 1) ||
	       (r->trail >= 0 && column > r->trail);
}

/* ---- widths ---- */

static float names_width(const struct drafting *drafting, const struct cell *cell)
{
	struct rung_label label = rung_label(drafting, cell);

	return MAX(label.symbol.width, label.address.width);
}

static float element_width(const struct drafting *drafting, const struct rung *rung,
			   int row, int col)
{
	const struct word_row *word = word_at(drafting, rung, row, col);
	const struct cell *cell = rung_at(rung, row, col);
	struct rung_box box;

	if (word->kind != WORD_ELEM) {
		rung_box_make(drafting, rung, row, col, &box);
		return box.left + box.right;
	}
	if (word->place == PLACE_NONE || word->place == PLACE_WIRE ||
	    word->place == PLACE_PIN)
		return 0;
	float need = rung_is_framed(word) ?
		rung_framed(drafting, cell).width + 2 * FRAMED_SIDE + BESIDE :
		names_width(drafting, cell);
	if (drafting->all_comments)
		need = MAX(need, rung_element_comment(drafting, cell, LABEL_BOUND).width +
				 2 * drafting->beside);
	return need + BESIDE;
}

static void measure_columns(const struct drafting *drafting, struct rung_layout *layout)
{
	const struct rung *rung = layout->rung;

	for (int d = 0; d < layout->columns; d++)
		layout->column_need[d] = drafting->folds ? RUNG_BLANK_WIDTH : RUNG_TIGHT_WIDTH;
	for (int row = 0; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++) {
			int d = rung_layout_column(layout, row, col);
			float need;

			if (rung_at(rung, row, col)->word == ELEM_EMPTY ||
			    d >= layout->columns)
				continue;
			need = element_width(drafting, rung, row, col);
			if (need > 0)
				layout->column_need[d] = MAX(layout->column_need[d],
							     MAX(need, RUNG_TIGHT_WIDTH));
		}
	layout->natural = layout->tight = 0;
	for (int d = 0; d < layout->columns; d++) {
		layout->natural += MAX(layout->column_need[d], RUNG_CELL_WIDTH);
		layout->tight += layout->column_need[d];
	}
}

/* ---- heights ---- */

/* How far boxes that end in @row reach below its wire. */
static float box_reach(const struct drafting *drafting, const struct rung_layout *layout,
		       int row)
{
	const struct rung *rung = layout->rung;
	float most = 0;

	for (int col = 0; col < rung->cols; col++) {
		struct rung_box box;
		int top;

		if (word_row(rung_at(rung, row, col)->word)->kind == WORD_ELEM &&
		    place_at(rung, row, col) != PLACE_PIN)
			continue;
		top = rung_box_top(rung, row, col);
		if (top < 0 || top + rung_height(rung, top, col) - 1 != row)
			continue;
		rung_box_make(drafting, rung, top, col, &box);
		rung_box_place(&box, layout->row, 0, 0);
		float reach = box.bottom - (layout->row[row].wire - layout->row[top].wire);
		most = MAX(most, reach);
	}
	return most;
}

static void measure_row(const struct drafting *drafting, struct rung_layout *layout,
			int row, float y)
{
	struct rung_row *r = &layout->row[row];
	float below = RUNG_CELL_HEIGHT - RUNG_WIRE;

	r->y = y;
	r->wire = y + RUNG_WIRE;
	if (row < layout->rung->rows) {
		float reach = box_reach(drafting, layout, row);

		if (reach > 0)
			below = MAX(below, reach + BOX_AIR);
		for (int col = 0; col < layout->rung->cols; col++)
			r->addressed |= *rung_label(drafting, rung_at(layout->rung, row,
								      col)).address.text;
	}
	r->height = RUNG_WIRE + below;
}

static void find_ends(struct rung_layout *layout)
{
	const struct rung *rung = layout->rung;

	for (int row = 0; row < layout->rows; row++) {
		struct rung_row *r = &layout->row[row];

		r->output = r->trail = -1;
		if (row >= rung->rows)
			continue;
		r->output = grid_display_output(rung, row);
		int end = free_end(rung, row);
		if (r->output < 0 && end >= 0 && place_at(rung, row, end) == PLACE_BOX)
			r->trail = end;
	}
}

/* A short title alone is not measured: letters are at most a third wider than high. */
static bool has_short_heading(const struct drafting *drafting, const struct rung *rung,
			      float room)
{
	const char *title = project_text(drafting->project, rung->title);
	const float size = letter_style(LETTER_TITLE)->size;

	return !rung->comment &&
	       (!rung->title || (!rung->label && (float)strlen(title) * size * 4 / 3 < room));
}

static void break_heading(const struct drafting *drafting, struct rung_layout *layout,
			  const struct rung_heading *heading)
{
	const char *title = project_text(drafting->project, layout->rung->title);
	const float room = layout->heading_room;
	const int most = drafting->all_comments ? 1000 : SHORT_LINES;

	if (layout->rung->title && heading->indent + heading->title.width > room) {
		layout->title_lines = rung_lines(drafting, LETTER_TITLE, title,
						 room - heading->indent, most, NULL, NULL);
		layout->top += (float)((layout->title_lines - 1) * TITLE_STEP);
	}
	if (*heading->comment &&
	    (layout->title_lines || heading->comment_width + heading->width > room)) {
		layout->comment_lines = rung_lines(drafting, LETTER_COMMENT,
						   heading->comment, room, most, NULL, NULL);
		/* Without a title the first line of the comment has its place. */
		int more = layout->comment_lines - (heading->width > 0 ? 0 : 1);
		layout->top += (float)(more * COMMENT_LINE);
	}
}

static void measure_title(const struct drafting *drafting, struct rung_layout *layout)
{
	const struct rung *rung = layout->rung;
	struct rung_heading heading;
	float room = MAX(layout->natural, drafting->width);

	if (drafting->most > 0)
		room = MIN(room, drafting->most);
	layout->heading_room = room;
	layout->title_y = TITLE_LINE;
	layout->top = rung->label || rung->title || rung->comment ? TITLE_HEIGHT :
								    BARE_HEIGHT;
	if (has_short_heading(drafting, rung, room))
		return;
	heading = rung_heading(drafting, rung);
	break_heading(drafting, layout, &heading);
	g_free(heading.comment);
}

/* Is there nothing but wire in a column? */
static bool is_blank(const struct rung_layout *layout, int column)
{
	return layout->column_need[column] <= RUNG_BLANK_WIDTH;
}

/* What a column has more if it is as wide as usual. */
static float spare_of(const struct rung_layout *layout, int column)
{
	return MAX(RUNG_CELL_WIDTH - layout->column_need[column], 0);
}

/* Columns become narrower where there is no room: first those where there is nothing. */
struct shrink { float blank, used; /* 0 … 1 of what they have more              */ };

static struct shrink shrink_to(const struct rung_layout *layout, float width)
{
	const float lacks = MAX(layout->natural - width, 0);
	float blank = 0, used = 0;

	for (int d = 0; d < layout->columns; d++)
		*(is_blank(layout, d) ? &blank : &used) += spare_of(layout, d);
	return (struct shrink){
		.blank = lacks < blank ? 1 - lacks / blank : lacks == 0,
		.used = lacks <= blank || used <= 0 ? 1 : MAX(1 - (lacks - blank) / used, 0),
	};
}

/* The right rail is @width from the left one. @spread: factor of the width of all columns. */
static void place_columns(struct rung_layout *layout, float width, struct shrink shrink, float spread)
{
	int last = layout->columns - 1;
	float x = RUNG_LEFT;

	layout->right = RUNG_LEFT + width;
	for (int d = 0; d <= last; d++)
		layout->column_width[d] = spread * (layout->column_need[d] + spare_of(layout, d) *
			(is_blank(layout, d) ? shrink.blank : shrink.used));
	for (int d = 0; d < last; d++) {
		layout->column_x[d] = x;
		x += layout->column_width[d];
	}
	layout->column_x[last] = layout->right - layout->column_width[last];
	layout->whole_from = 0;
}

struct rung_layout *rung_layout_new(const struct drafting *drafting,
				    const struct rung *rung, int number, int rows)
{
	int shown = MAX(rows, rung->rows), columns = MAX(drafting->columns,
							 RUNG_LEAST_COLUMNS);
	struct rung_layout *layout;

	columns = MAX(columns, rung_layout_columns(rung));
	layout = g_malloc0(sizeof(*layout) + (size_t)shown * sizeof(struct rung_row) +
			   (size_t)columns * 3 * sizeof(float));
	layout->row = (struct rung_row *)(layout + 1);
	layout->column_x = (float *)(layout->row + shown);
	layout->column_width = layout->column_x + columns;
	layout->column_need = layout->column_width + columns;
	layout->rung = rung;
	layout->number = number;
	layout->rows = shown;
	layout->columns = columns;
	find_ends(layout);
	measure_columns(drafting, layout);
	measure_title(drafting, layout);
	float y = layout->top;
	for (int row = 0; row < shown; row++) {
		measure_row(drafting, layout, row, y);
		y += layout->row[row].height;
	}
	layout->height = y + BELOW;
	rung_layout_stretch(layout, drafting->width);
	return layout;
}

void rung_layout_free(struct rung_layout *layout)
{
	g_free(layout);
}

void rung_layout_stretch(struct rung_layout *layout, float width)
{
	place_columns(layout, MAX(width, layout->natural), (struct shrink){ 1, 1 }, 1);
}

void rung_layout_fit(struct rung_layout *layout, float width)
{
	const float usual = MAX(layout->natural, RUNG_WIDE / RUNG_SPREAD);

	width = MAX(width, layout->tight);
	place_columns(layout, width, shrink_to(layout, width), MAX(width / usual, 1));
}

void rung_layout_pack(struct rung_layout *layout, float width)
{
	float packed = 0;

	for (int d = 0; d < layout->columns; d++)
		packed += layout->column_need[d] + (is_blank(layout, d) ? 0 : spare_of(layout, d));
	place_columns(layout, MAX(width, packed), (struct shrink){ 0, 1 }, 1);
}

float rung_layout_width(const struct rung_layout *layout)
{
	return layout->right + RUNG_AFTER;
}

float rung_layout_bar(const struct rung_layout *layout, int row, int bar)
{
	int last = layout->columns - 1;

	if (bar == 0)
		return RUNG_LEFT;
	if (row < layout->rung->rows && bar == layout->row[row].output + 1 &&
	    layout->row[row].output >= 0)
		return layout->right;
	if (bar > last)
		return layout->right;
	return layout->column_x[bar - 1] + layout->column_width[bar - 1];
}

float rung_layout_label(const struct drafting *drafting, const struct cell *cell)
{
	const struct rung_label label = rung_label(drafting, cell);

	return MAX(label.symbol.width, label.address.width);
}

/* The element in cell (row, col) as drawn, with its names: from *left to *right. False: none. */
static bool element_ends(const struct drafting *drafting, const struct rung_layout *layout,
			 int row, int col, float *left, float *right)
{
	const int d = rung_layout_column(layout, row, col);
	float width = rung_at(layout->rung, row, col)->word == ELEM_EMPTY ? 0 :
		      element_width(drafting, layout->rung, row, col);
	float middle = layout->column_x[d] + layout->column_width[d] / 2;
	struct rung_box box;

	if (width <= 0)
		return false;
	if (word_at(drafting, layout->rung, row, col)->kind != WORD_ELEM) {
		rung_box_at(drafting, layout, row, col, &box);
		middle = box.x + box.inner / 2;
		*left = middle - box.left;
		*right = middle + box.right;
		return true;
	}
	width = MAX(width, RUNG_TIGHT_WIDTH / 2);
	*left = middle - width / 2;
	*right = middle + width / 2;
	return true;
}

float rung_layout_whole(const struct drafting *drafting, struct rung_layout *layout, float x)
{
	const struct rung *rung = layout->rung;
	const float from = x;
	float left, right, before;

	if (from == layout->whole_from && from > 0)
		return layout->whole;
	do {
		before = x;
		for (int i = 0; i < rung->rows * rung->cols; i++)
			if (rung_layout_column(layout, i / rung->cols, i % rung->cols) <
			    layout->columns - 1 &&
			    element_ends(drafting, layout, i / rung->cols, i % rung->cols, &left,
					 &right) && left < x && x < right - 1)
				x = left;
	} while (x < before);
	layout->whole_from = from;
	layout->whole = x;
	return x;
}

/* ---- the part at a point ---- */

static int row_at(const struct rung_layout *layout, float y)
{
	int row = layout->rows - 1;

	while (row > 0 && y < layout->row[row].y)
		row--;
	return row;
}

/* The space between the columns belongs to the right column. */
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

	if (top < 0) /* beside a tall box cells have the usual height       */
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
	rung_box_at(drafting, layout, top, col, &box);
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

bool rung_layout_goes_on(const struct rung_layout *layout, int row, int column)
{
	const int col = rung_layout_col(layout, row, column);

	return rung_layout_wired(layout, row, column) ||
	       (col >= 0 && word_row(rung_at(layout->rung, row, col)->word)->place !=
			    PLACE_NONE);
}

/* A link is drawn at the right bar of its cell. Where it crosses the wire of a row, the
 * wire is hit, behind the link. */
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

			if (meets && rung_layout_goes_on(layout, hit->row, column + 1))
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

/* The part of a cell that hits the element; beside it are its wires. */
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

		rung_box_at(drafting, layout, top, col, &box);
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
