/* SPDX-License-Identifier: MIT
 *
 * grid_marks - cursor, selection, errors, forces: what is said about cells and rungs
 * besides what stands in them. Each has a shape or a letter, never a colour alone.
 */
#include "editor-gtk/draw/grid_pen.h"

#include <math.h>

#define INSET 3 /* below; above, Chinese names need the room */
#define HATCH 9 /* px from line to line                      */
#define CORNER 7 /* px of a side, at a corner that is marked  */
#define CORNER_INSET 3 /* px, inside of what else is framed   */

unsigned int pen_marks(const struct pen *pen, int row, int column)
{
	unsigned int marks = 0;

	for (int i = 0; i < pen->scene->mark_count; i++) {
		const struct grid_mark *mark = &pen->scene->mark[i];

		if (mark->row == row && mark->column == column)
			marks |= mark->marks;
	}
	return marks;
}

const char *pen_note(const struct pen *pen, int row, int column)
{
	const struct grid_scene *scene = pen->scene;

	return scene->note && pen_marks(pen, row, column) & MARK_BLOCKS ?
	       scene->note(scene->context, row, column) : NULL;
}

static bool is_inside(const struct pen *pen, const struct grid_mark *mark)
{
	return mark->row >= 0 && mark->row < pen->layout->rows && mark->column >= 0 &&
	       mark->column < pen->layout->columns;
}

static graphene_rect_t place_of(const struct pen *pen, const struct grid_mark *mark)
{
	graphene_rect_t rect = rung_layout_cell(pen->layout, mark->row, mark->column);

	return GRAPHENE_RECT_INIT(rect.origin.x + 1, rect.origin.y,
				  rect.size.width - 2, rect.size.height - INSET);
}

/* Slanting lines, faint enough for what stands upon them. */
static void draw_hatch(const struct pen *pen, const graphene_rect_t *r)
{
	const float width = r->size.width, height = r->size.height;

	for (float at = HATCH; at < width + height; at += HATCH) {
		const float left = MAX(at - height, 0), right = MIN(at, width);

		picture_line(pen->picture, TOKEN_BLOCKS, STROKE_SOLID, 1,
			     r->origin.x + left, r->origin.y + at - left,
			     r->origin.x + right, r->origin.y + at - right);
		pen->picture->stroke[pen->picture->count - 1].alpha = 0.35f;
	}
}

void grid_draw_grounds(const struct pen *pen)
{
	for (int i = 0; i < pen->scene->mark_count; i++) {
		const struct grid_mark *mark = &pen->scene->mark[i];

		if (!is_inside(pen, mark))
			continue;
		graphene_rect_t r = place_of(pen, mark);
		if (mark->marks & MARK_FOUND) {
			picture_fill(pen->picture, TOKEN_FOUND, 1, r.origin.x, r.origin.y,
				     r.size.width, r.size.height);
			picture_frame(pen->picture, TOKEN_COMMENT, STROKE_SOLID, 1,
				      r.origin.x, r.origin.y, r.size.width,
				      r.size.height);
		}
		if (mark->marks & MARK_BLOCKS)
			draw_hatch(pen, &r);
		if (mark->marks & (MARK_CURSOR | MARK_SELECTED | MARK_DROP))
			picture_fill(pen->picture, TOKEN_ACCENT, pen->theme->wash,
				     r.origin.x, r.origin.y, r.size.width, r.size.height);
	}
}

/* A letter on a small ground, its left upper corner at (x, y); returns its width. */
static float badge(const struct pen *pen, enum token ground, const char *text, float x,
		   float y)
{
	struct lettered fits = lettering_fit(pen->drafting->lettering, LETTER_BADGE, text,
					     -1, 0);

	picture_fill(pen->picture, ground, 1, x, y, fits.width + 6, 13);
	picture_text(pen->picture, TOKEN_BADGE, LETTER_BADGE, fits, x + 3, y + 10);
	return fits.width + 6;
}

#define FORCED "F"
#define TWICE  "2\xc3\x97"
#define FAILED "!"
#define REFUSED "\xc3\x97"

static void mark_wrong(const struct pen *pen, unsigned int marks, float x, float y, float w)
{
	if (marks & MARK_ERROR)
		picture_wave(pen->picture, TOKEN_ERROR, x, y, w);
	else if (marks & MARK_WARNING)
		picture_line(pen->picture, TOKEN_FORCE, STROKE_DASHED, 2, x, y + 1, x + w,
			     y + 1);
}

/* An expression may have several lines: what is wrong stands below them. */
static void mark_framed(const struct pen *pen, unsigned int marks, const struct cell *cell,
			float middle, float y)
{
	struct rung_framed framed = rung_framed(pen->drafting, cell);
	float x = middle + framed.width / 2 + FRAMED_SIDE + 2;

	mark_wrong(pen, marks, middle - 22, y + framed.up + 2, 44);
	if (marks & (MARK_FORCED | MARK_TWICE))
		badge(pen, TOKEN_FORCE, marks & MARK_FORCED ? FORCED : TWICE, x,
		      y - 15);
	if (marks & MARK_FAILED)
		badge(pen, TOKEN_ERROR, FAILED, x, y + 2);
}

/* Behind the address if there is room, else below the wire. */
static void mark_element(const struct pen *pen, unsigned int marks, int row, int col,
			 const graphene_rect_t *r)
{
	const struct cell *cell = col >= 0 ? rung_at(pen->rung, row, col) : NULL;
	const struct word_row *word = cell ? word_row(cell->word) : NULL;
	float middle = r->origin.x + r->size.width / 2, y = pen->layout->row[row].wire;
	float half = word ? glyph_half(word) : 8, address = 0;

	if (word && rung_is_framed(word)) {
		mark_framed(pen, marks, cell, middle, y);
		return;
	}
	if (word)
		address = rung_label(pen->drafting, cell).address.width;
	float behind = middle + address / 2 + 2;
	bool fits = address > 0 && behind + 13 < r->origin.x + r->size.width;
	mark_wrong(pen, marks, middle - 22, y + RUNG_HALF + 2, 44);
	if (marks & MARK_FORCED && fits)
		badge(pen, TOKEN_FORCE, FORCED, behind, y - 28);
	else if (marks & MARK_FORCED)
		badge(pen, TOKEN_FORCE, FORCED, middle + half + 3, y + 1.5f);
	if (marks & MARK_TWICE)
		badge(pen, TOKEN_FORCE, TWICE, middle + half + 3, y - 15);
}

/* Those of a box stand below it. */
static void mark_box(const struct pen *pen, unsigned int marks, int row, int col)
{
	const struct rung_layout *layout = pen->layout;
	int column = rung_layout_column(layout, row, col);
	struct rung_box box;

	rung_box_make(pen->drafting, pen->rung, row, col, &box);
	rung_box_place(&box, layout->row, layout->column_x[column],
		       layout->column_width[column]);
	float x = box.x, y = layout->row[row].wire + box.bottom + 2;
	if (marks & (MARK_ERROR | MARK_WARNING)) {
		mark_wrong(pen, marks, x, y + 1, 36);
		x += 38;
	}
	if (marks & MARK_FORCED)
		x += badge(pen, TOKEN_FORCE, FORCED, x, y) + 2;
	if (marks & MARK_TWICE)
		x += badge(pen, TOKEN_FORCE, TWICE, x, y) + 2;
	if (marks & MARK_FAILED)
		badge(pen, TOKEN_ERROR, FAILED, x, y);
}

/* Where else its value would be. */
static void draw_note(const struct pen *pen, const struct grid_mark *mark,
		      const graphene_rect_t *r)
{
	const char *note = pen_note(pen, mark->row, mark->column);
	struct lettered fits = lettering_fit(pen->drafting->lettering, LETTER_BADGE, note,
					     -1, r->size.width - 10);

	badge(pen, TOKEN_BLOCKS, fits.text,
	      r->origin.x + (r->size.width - fits.width) / 2 - 3,
	      r->origin.y + r->size.height - 17);
}

/* Its four corners: all round so many cells would be more than what stands in them, and
 * what is broken would be an image for each rung. */
static void draw_corners(const struct pen *pen, const graphene_rect_t *r)
{
	const float left = r->origin.x + CORNER_INSET, top = r->origin.y + CORNER_INSET;
	const float right = r->origin.x + r->size.width - CORNER_INSET;
	const float bottom = r->origin.y + r->size.height - CORNER_INSET;
	const float thick = floorf(pen->theme->idle_width);

	for (int i = 0; i < 4; i++) {
		const bool after = i % 2, below = i / 2;

		picture_fill(pen->picture, TOKEN_ACCENT, 1, after ? right - CORNER : left,
			     below ? bottom - thick : top, CORNER, thick);
		picture_fill(pen->picture, TOKEN_ACCENT, 1, after ? right - thick : left,
			     below ? bottom - CORNER : top + thick, thick,
			     CORNER - thick);
	}
}

static void draw_frames(const struct pen *pen, const struct grid_mark *mark,
			const graphene_rect_t *r)
{
	if (mark->marks & MARK_CURSOR)
		picture_frame(pen->picture, TOKEN_ACCENT, STROKE_SOLID, 1.5f, r->origin.x,
			      r->origin.y, r->size.width, r->size.height);
	if (mark->marks & MARK_DROP)
		picture_frame(pen->picture, TOKEN_ACCENT, STROKE_DASHED, 1.5f,
			      r->origin.x, r->origin.y, r->size.width, r->size.height);
	if (mark->marks & MARK_ILLEGAL)
		picture_frame(pen->picture, TOKEN_ERROR, STROKE_SOLID, 1.5f, r->origin.x,
			      r->origin.y, r->size.width, r->size.height);
	if (mark->marks & MARK_BLOCKS)
		picture_frame(pen->picture, TOKEN_BLOCKS, STROKE_SOLID, 2, r->origin.x,
			      r->origin.y, r->size.width, r->size.height);
	if (mark->marks & MARK_CHANGED)
		picture_frame(pen->picture, TOKEN_FORCE, STROKE_DOTTED, 1.5f, r->origin.x,
			      r->origin.y, r->size.width, r->size.height);
}

static void draw_takes(const struct pen *pen)
{
	const int columns = pen->layout->columns;

	for (int i = 0; pen->scene->takes && i < pen->layout->rows * columns; i++) {
		const struct grid_mark mark = { i / columns, i % columns, 0 };
		const graphene_rect_t r = place_of(pen, &mark);

		if (pen->scene->takes[i])
			draw_corners(pen, &r);
	}
}

void grid_draw_marks(const struct pen *pen)
{
	draw_takes(pen);
	for (int i = 0; i < pen->scene->mark_count; i++) {
		const struct grid_mark *mark = &pen->scene->mark[i];

		if (!is_inside(pen, mark))
			continue;
		graphene_rect_t r = place_of(pen, mark);
		int col = rung_layout_col(pen->layout, mark->row, mark->column);
		int top = col < 0 ? -1 : rung_box_top(pen->rung, mark->row, col);
		draw_frames(pen, mark, &r);
		if (top >= 0)
			mark_box(pen, mark->marks, top, col);
		else
			mark_element(pen, mark->marks, mark->row, col, &r);
		if (mark->marks & MARK_CHANGED)
			badge(pen, TOKEN_FORCE, "\xe2\x89\xa0", r.origin.x + 1,
			      r.origin.y + r.size.height - 14);
		if (mark->marks & MARK_ILLEGAL)
			badge(pen, TOKEN_ERROR, REFUSED, r.origin.x + 1,
			      r.origin.y + r.size.height - 14);
		if (pen_note(pen, mark->row, mark->column))
			draw_note(pen, mark, &r);
	}
}
