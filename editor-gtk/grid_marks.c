/* SPDX-License-Identifier: MIT
 *
 * grid_marks - cursor, selection, errors, forces: what is said about cells and rungs
 * besides what stands in them. Each has a shape or a letter, never a colour alone.
 */
#include "editor-gtk/grid_pen.h"

#define INSET 3

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

static bool is_inside(const struct pen *pen, const struct grid_mark *mark)
{
	return mark->row >= 0 && mark->row < pen->layout->rows && mark->column >= 0 &&
	       mark->column < pen->layout->columns;
}

static graphene_rect_t place_of(const struct pen *pen, const struct grid_mark *mark)
{
	graphene_rect_t rect = rung_layout_cell(pen->layout, mark->row, mark->column);

	return GRAPHENE_RECT_INIT(rect.origin.x + 1, rect.origin.y + INSET,
				  rect.size.width - 2, rect.size.height - 2 * INSET);
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
		if (mark->marks & (MARK_CURSOR | MARK_SELECTED))
			picture_fill(pen->picture, TOKEN_ACCENT, pen->theme->wash,
				     r.origin.x, r.origin.y, r.size.width, r.size.height);
	}
}

/* A letter on a small ground, its left upper corner at (x, y). */
static void badge(const struct pen *pen, const char *text, float x, float y)
{
	struct lettered fits = lettering_fit(pen->drafting->lettering, LETTER_BADGE, text,
					     -1, 0);

	picture_fill(pen->picture, TOKEN_FORCE, 1, x, y, fits.width + 6, 13);
	picture_text(pen->picture, TOKEN_BADGE, LETTER_BADGE, fits, x + 3, y + 10);
}

/* Behind the address of the element, or beside its strokes if it has none. */
static void draw_badges(const struct pen *pen, const struct grid_mark *mark,
			const graphene_rect_t *r)
{
	int col = rung_layout_col(pen->layout, mark->row, mark->column);
	float middle = r->origin.x + r->size.width / 2, y = pen->layout->row[mark->row].wire;
	float x = middle + 15;

	if (col >= 0) {
		struct rung_label label = rung_label(pen->drafting,
						     rung_at(pen->rung, mark->row, col));

		if (label.address.width > 0)
			x = middle + label.address.width / 2 + 2;
	}
	if (x > r->origin.x + r->size.width - 14)
		x = r->origin.x + r->size.width - 14;
	if (mark->marks & MARK_FORCED)
		badge(pen, "F", x, y - 28);
	if (mark->marks & MARK_TWICE)
		badge(pen, "2\xc3\x97", middle + 17, y - 14);
	if (mark->marks & MARK_CHANGED)
		badge(pen, "\xe2\x89\xa0", r->origin.x + 1,
		      r->origin.y + r->size.height - 14);
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
	if (mark->marks & MARK_CHANGED)
		picture_frame(pen->picture, TOKEN_FORCE, STROKE_DOTTED, 1.5f, r->origin.x,
			      r->origin.y, r->size.width, r->size.height);
}

void grid_draw_marks(const struct pen *pen)
{
	for (int i = 0; i < pen->scene->mark_count; i++) {
		const struct grid_mark *mark = &pen->scene->mark[i];

		if (!is_inside(pen, mark))
			continue;
		graphene_rect_t r = place_of(pen, mark);
		float x = r.origin.x + r.size.width / 2 - 22;
		float y = pen->layout->row[mark->row].wire + RUNG_HALF + 2;
		draw_frames(pen, mark, &r);
		if (mark->marks & MARK_ERROR)
			picture_wave(pen->picture, TOKEN_ERROR, x, y, 44);
		else if (mark->marks & MARK_WARNING)
			picture_line(pen->picture, TOKEN_FORCE, STROKE_DASHED, 2, x, y + 1,
				     x + 44, y + 1);
		draw_badges(pen, mark, &r);
	}
}
