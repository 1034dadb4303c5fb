/* SPDX-License-Identifier: MIT
 *
 * pages_fold - a rung that is too wide for a page: its columns go on in strips below each
 * other. Each wire that is cut has a number, with an arrow where it ends and where it goes
 * on.
 */
#include "editor-gtk/draw/pages_inside.h"

#include <math.h>

#define MOST_STRIPS LIMIT_COLS
#define LINK_AIR    3    /* px behind a wire between rows that stays whole            */
#define MARK        38   /* px of an arrow with its number                           */
#define ARROW       12   /* of them the arrow                                        */
#define HEAD        5    /* of it its point                                          */

struct fold {
	struct pages *pages;
	const struct rung_layout *layout;
	struct picture *picture;
	float scale;
	float cut[MOST_STRIPS + 1]; /* x of the picture: where strips begin, and the end */
	int strips;
	int wires[MOST_STRIPS + 1]; /* that were cut before                            */
};

/* Is there a stroke through (@x, @y), along a row (@across) or between rows? */
static bool is_wire(const struct picture *picture, float x, float y, bool across)
{
	for (int i = 0; i < picture->count; i++) {
		const struct stroke *line = &picture->stroke[i];

		if (line->kind != STROKE_LINE)
			continue;
		if (across ? line->y == line->h && fabsf(line->y - y) < 1 &&
			     fminf(line->x, line->w) <= x && fmaxf(line->x, line->w) >= x
			   : line->x == line->w && fabsf(line->x - x) < 2 &&
			     fmaxf(line->y, line->h) > y)
			return true;
	}
	return false;
}

/* Where a strip from @left on ends: between columns, and between no rows that are joined
 * there if that does not leave half of it empty. */
static float fold_at(const struct fold *fold, float left, float room)
{
	const struct rung_layout *layout = fold->layout;
	float joined = 0;

	for (int column = layout->columns - 1; column > 0; column--) {
		const float x = layout->column_x[column];

		if (x > left + room - LINK_AIR || x <= left + LINK_AIR)
			continue;
		if (joined > 0 && x < left + room / 2)
			break;
		if (!is_wire(fold->picture, x, layout->top, false) &&
		    pages_can_cut(fold->picture, x, layout->top, room))
			return x;
		if (joined <= 0 &&
		    pages_can_cut(fold->picture, x + LINK_AIR, layout->top, room))
			joined = x + LINK_AIR;
	}
	return joined > 0 ? joined : left + room;
}

/* Strips, as wide as the page; the first one begins with the number of the rung. */
static void find_strips(struct fold *fold)
{
	const struct rung_layout *layout = fold->layout;
	const float room = fold->pages->room_width / fold->scale;
	float left = 0, end = layout->right + RUNG_AFTER;

	while (fold->strips < MOST_STRIPS - 1 &&
	       end - left > room - (fold->strips ? RUNG_LEFT : 0)) {
		left = fold_at(fold, left, room - MARK - (fold->strips ? RUNG_LEFT : 0));
		fold->cut[++fold->strips] = left;
	}
	fold->cut[++fold->strips] = end;
}

static bool goes_on(const struct fold *fold, int row, float x)
{
	const float y = fold->layout->row[row].wire;

	return is_wire(fold->picture, x - 1, y, true) &&
	       is_wire(fold->picture, x + 1, y, true);
}

/* From @x on to the right; its number stands at the end at which no wire is. */
static void draw_arrow(const struct fold *fold, struct picture *picture, float x, float y,
		       int number, bool ends)
{
	const struct theme *theme = fold->pages->theme;
	const float to = x + ARROW;
	char text[16];

	g_snprintf(text, sizeof(text), "%d", number);
	struct lettered fits = lettering_fit(fold->pages->lettering, LETTER_PIN, text, -1, 0);
	picture_line(picture, TOKEN_INK, STROKE_SOLID, theme->idle_width, x, y, to, y);
	picture_line(picture, TOKEN_INK, STROKE_SOLID, theme->idle_width, to - HEAD,
		     y - HEAD, to, y);
	picture_line(picture, TOKEN_INK, STROKE_SOLID, theme->idle_width, to - HEAD,
		     y + HEAD, to, y);
	picture_text(picture, TOKEN_INK, LETTER_PIN, fits,
		     ends ? to + 4 : x - 4 - fits.width, y + 4);
}

/* At the end of a strip, or where the next one begins. */
static void draw_arrows(const struct fold *fold, struct picture *picture, int cut, float x,
			bool ends)
{
	int number = fold->wires[cut];

	for (int row = 0; row < fold->layout->rung->rows; row++)
		if (goes_on(fold, row, fold->cut[cut]))
			draw_arrow(fold, picture, ends ? x : x - ARROW,
				   fold->layout->row[row].wire, ++number, ends);
}

static void number_wires(struct fold *fold)
{
	for (int cut = 1; cut < fold->strips; cut++) {
		fold->wires[cut + 1] = fold->wires[cut];
		for (int row = 0; row < fold->layout->rung->rows; row++)
			fold->wires[cut + 1] += goes_on(fold, row, fold->cut[cut]);
	}
}

/* The number of the rung, and of its strips which this is. */
static void draw_number(const struct fold *fold, struct picture *picture, int strip)
{
	struct lettering *lettering = fold->pages->lettering;
	char number[16], part[32];

	g_snprintf(number, sizeof(number), "%d", fold->layout->number);
	g_snprintf(part, sizeof(part), "%d/%d", strip + 1, fold->strips);
	struct lettered first = lettering_fit(lettering, LETTER_NUMBER, number, -1, 0);
	struct lettered second = lettering_fit(lettering, LETTER_PIN, part, -1, 0);
	picture_text(picture, TOKEN_COMMENT, LETTER_NUMBER, first,
		     (RUNG_GUTTER - first.width) / 2, fold->layout->top + 14);
	picture_text(picture, TOKEN_COMMENT, LETTER_PIN, second,
		     (RUNG_GUTTER - second.width) / 2, fold->layout->top + 29);
}

static float stroke_bottom(const struct stroke *stroke)
{
	switch (stroke->kind) {
	case STROKE_LINE:
		return fmaxf(stroke->y, stroke->h);
	case STROKE_ARC:
	case STROKE_DISC:
		return stroke->y + stroke->w;
	case STROKE_FILL:
	case STROKE_FRAME:
		return stroke->y + stroke->h;
	case STROKE_WAVE:
	case STROKE_TEXT:
		break;
	}
	return stroke->y;
}

/* Below the last row of which there is something in a strip; rails do not count. */
static float strip_bottom(const struct fold *fold, int strip)
{
	const struct rung_layout *layout = fold->layout;
	const float from = fold->cut[strip], to = fminf(fold->cut[strip + 1],
							layout->right - 2);
	float most = layout->top;
	int row = 0;

	if (strip == 0)
		return layout->height;
	for (int i = 0; i < fold->picture->count; i++) {
		const struct stroke *stroke = &fold->picture->stroke[i];
		const float end = stroke->kind == STROKE_LINE ? stroke->w :
								stroke->x + stroke->w;

		if (fminf(stroke->x, end) < to && fmaxf(stroke->x, end) > from)
			most = fmaxf(most, stroke_bottom(stroke));
	}
	while (row + 1 < layout->rows && layout->row[row + 1].y < most)
		row++;
	return row + 1 < layout->rows ? layout->row[row + 1].y : layout->height;
}

/* What stands beside the columns: numbers and arrows. @x: where those begin. */
static struct picture *draw_beside(const struct fold *fold, int strip, float x)
{
	struct picture *beside = pages_picture(fold->pages);

	if (strip > 0) {
		draw_number(fold, beside, strip);
		draw_arrows(fold, beside, strip, x, false);
	}
	if (strip + 1 < fold->strips)
		draw_arrows(fold, beside, strip + 1,
			    x + fold->cut[strip + 1] - fold->cut[strip], true);
	return beside;
}

/* @room: px of a page that it may take. */
static void put_strip(struct fold *fold, int strip, float room)
{
	struct pages *pages = fold->pages;
	const struct rung_layout *layout = fold->layout;
	const float x = strip ? RUNG_LEFT : 0, bottom = strip_bottom(fold, strip);
	const float top = strip ? 0 : layout->top;
	float height = (bottom - layout->top + top) * fold->scale;

	if (height > room) /* its title stands with its first row */
		height = (layout->row[0].height + top) * fold->scale;
	if (pages->y + height > pages->room_height && height <= room)
		pages_next(pages);
	if (strip == 0) /* title and comment are as wide as the page */
		pages_put_span(pages, fold->picture, fold->scale, 0, layout->top);
	pages->left = fold->cut[strip];
	pages->right = fold->cut[strip + 1];
	pages->x = x;
	pages->beside = draw_beside(fold, strip, x);
	pages_put_rows(pages, layout, fold->picture, fold->scale, layout->top, bottom);
	pages->left = pages->right = pages->x = 0;
	pages->beside = NULL;
}

/* A column is not wider than a strip, if it need not be. */
static float scale_for(const struct pages *pages, const struct rung_layout *layout,
		       float scale)
{
	float widest = 0;

	for (int column = 0; column < layout->columns; column++)
		widest = fmaxf(widest, layout->column_width[column]);
	return fmaxf(PAGE_LEAST, fminf(scale, pages->room_width / (RUNG_LEFT + widest +
								  2 * LINK_AIR + MARK)));
}

/* Where it is cut is known before what there is room for below its outputs. Its right rail
 * stands below that of the others. */
static void draw(struct fold *fold, struct grid_scene scene, struct rung_layout *layout,
		 float rails)
{
	struct picture plain;
	char *(*reference)(void *, int, int, float) = scene.reference;

	picture_init(&plain);
	scene.reference = NULL;
	grid_draw(&scene, &plain);
	fold->picture = &plain;
	find_strips(fold);
	picture_clear(&plain);
	scene.reference = reference;
	scene.reference_from = fold->cut[fold->strips - 1];
	float last = layout->right - scene.reference_from;
	if (last < rails)
		rung_layout_stretch(layout, layout->right - RUNG_LEFT + rails - last);
	fold->cut[fold->strips] = layout->right + RUNG_AFTER;
	fold->picture = pages_picture(fold->pages);
	grid_draw(&scene, fold->picture);
	number_wires(fold);
}

void pages_fold(struct pages *pages, const struct sheet *sheet, int index, float scale,
		bool first)
{
	const struct rung *rung = sheet->rung[index]->rung;
	const float room = pages->room_height - (first ? pages->y : 0);
	struct drafting drafting = sheet->drafting;
	struct fold fold = { .pages = pages,
			     .scale = scale_for(pages, sheet->rung[index], scale) };

	drafting.columns = 0;
	drafting.most = pages->room_width / fold.scale - RUNG_LEFT - RUNG_AFTER;
	struct rung_layout *layout = rung_layout_new(&drafting, rung, index + 1, 0);
	struct grid_scene scene = pages_scene(pages, sheet, layout);
	scene.drafting = &drafting;
	fold.layout = layout;
	draw(&fold, scene, layout, sheet->rails * scale / fold.scale);
	for (int strip = 0; strip < fold.strips; strip++)
		put_strip(&fold, strip, strip ? pages->room_height : room);
	rung_layout_free(layout);
}
