/* SPDX-License-Identifier: MIT
 *
 * pages_chart - a chart on paper: down and across over as many pages as it takes, what had
 * no room beside it below, then its actions and conditions.
 */
#include "editor-gtk/draw/pages_inside.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/draw/sfc_bodies.h"
#include "editor-gtk/draw/sfc_draw.h"

#include <math.h>

/* Is there something to be read? */
static bool is_blank(const struct pages *pages, const struct picture *picture, float from,
		     float to)
{
	const float right = pages->right > 0 ? pages->right : INFINITY;

	for (int i = 0; i < picture->count; i++) {
		const struct stroke *stroke = &picture->stroke[i];

		if (stroke->kind == STROKE_TEXT && stroke->y > from && stroke->y < to &&
		    stroke->x >= pages->left && stroke->x < right)
			return false;
	}
	return true;
}

/* On a page of its own, unless it is the first; returns how much of the next one's room is
 * used: none. Nothing is put where nothing is. */
static float put_slice(struct pages *pages, const struct picture *picture, float scale,
		       float from, float to, float room_used)
{
	if (is_blank(pages, picture, from, to))
		return room_used;
	if (pages->y > room_used)
		pages_next(pages);
	pages_put_span(pages, picture, scale, from, to);
	return 0;
}

/* Rows of a chart, as many as fit on each page; it ends between boxes if it can. */
static void put_chart_slices(struct pages *pages, const struct sfc_sheet *chart,
			     const struct picture *picture, float scale)
{
	float from = 0, end = 0, room_used = pages->y;

	for (int row = 0; row < chart->layout->rows; row++) {
		float to = sfc_sheet_y(row) + SFC_ROW / 2.0f;

		if (!sfc_sheet_can_part(chart, row))
			continue;
		if (end > from && (to - from) * scale > pages->room_height - room_used) {
			room_used = put_slice(pages, picture, scale, from, end, room_used);
			from = end;
		}
		end = to;
	}
	put_slice(pages, picture, scale, from, chart->height, room_used);
}

static void put_bodies(struct pages *pages, const struct pou *pou)
{
	struct sheet *sheet = pages_sheet(pages);
	int count;
	struct sfc_part_body *bodies = sfc_bodies_new(pages->project, pou, &count);

	for (int i = 0; i < count; i++) {
		const struct sfc_body *body = bodies[i].body;

		if (body->kind == BODY_LIST)
			pages_put_list(pages, bodies[i].heading,
				 sfc_body_lines(pages->project, pou, body));
		else
			pages_put_rungs(pages, sheet, bodies[i].heading, body->first,
				  body->first + body->count);
	}
	pages_put_references(pages);
	sfc_bodies_free(bodies, count);
	sheet_free(sheet);
}

/* As much of a chart as fits beside each other, from @left on. */
static float cut_at(const struct picture *picture, float left, float room, float width)
{
	float x = left + room;

	if (x + 1 >= width) /* what fits is no two pages for a rounding */
		return width;
	while (x > left + room / 2 && !pages_can_cut(picture, x, -1, room))
		x -= 4;
	return x > left + room / 2 ? x : left + room;
}

static void put_columns(struct pages *pages, const struct sfc_sheet *chart,
			const struct picture *picture, const char *heading, float scale)
{
	const float room = pages->room_width / scale;
	int number = 0;

	for (float left = 0, right; left < chart->width; left = right) {
		char *text = left > 0 || chart->width > room + 1 ?
			g_strdup_printf(_("%s, part %d"), heading, ++number) :
			g_strdup(heading);

		right = cut_at(picture, left, room, chart->width);
		if (left > 0)
			pages_next(pages);
		pages_put_heading(pages, text, 5 * TEXT_LINE);
		pages->left = left;
		pages->right = right;
		if (chart->height * scale <= pages->room_height - pages->y)
			pages_put_whole(pages, picture, chart->height, scale, 0);
		else
			put_chart_slices(pages, chart, picture, scale);
		pages->left = pages->right = 0;
		g_free(text);
	}
}

/* A comment for which there was too little room at @x beside its box. */
static void put_comment(struct pages *pages, const struct sfc_sheet *chart, int shape,
			const char *comment, float x, bool *any)
{
	const float room = fminf(SFC_BOUND,
			sfc_sheet_room(chart, chart->layout->shape[shape].lane, x));
	char *line;

	if (!*comment || lettering_fit(pages->lettering, LETTER_COMMENT, comment, -1,
				       0).width <= room)
		return;
	if (!*any)
		pages_put_heading(pages, _("Comments"), 3 * TEXT_LINE);
	*any = true;
	line = g_strdup_printf("%s: %s", chart->name[shape], comment);
	pages_put_line(pages, line);
	g_free(line);
}

static void put_comments(struct pages *pages, const struct sfc_sheet *chart)
{
	const struct sfc *sfc = chart->layout->sfc;
	bool any = false;

	for (int i = 0; i < chart->layout->shape_count; i++)
		put_comment(pages, chart, i, chart->comment[i],
			    sfc_sheet_comment(chart, i).x, &any);
	for (int i = 0; i < sfc->use_count; i++) {
		const graphene_rect_t use = sfc_sheet_use(chart, i);

		put_comment(pages, chart, sfc->use[i].step, chart->use_comment[i],
			    use.origin.x + use.size.width + SFC_APART, &any);
	}
	pages->y += any ? PAGE_AIR : 0;
}

/* A page more is not begun for comments alone: they get what is left of the last one. */
static void narrow(struct sfc_sheet *chart, const struct picture *picture, float room)
{
	float width = 0, left = 0;

	for (int i = 0; i < picture->count; i++) {
		const struct stroke *stroke = &picture->stroke[i];

		if (stroke->kind == STROKE_FRAME || (stroke->kind == STROKE_TEXT &&
						     stroke->letter != LETTER_COMMENT))
			width = fmaxf(width, stroke->x + stroke->w + SFC_EDGE);
	}
	while (cut_at(picture, left, room, width) < width)
		left = cut_at(picture, left, room, width);
	chart->width = fminf(chart->width, left + room);
}

void pages_put_chart(struct pages *pages, const char *heading)
{
	const struct pou *pou = &pages->project->pou[pages->pou];
	struct sfc_sheet *chart = sfc_sheet_new(pages->project, pou, pages->lettering);
	const struct sfc_scene scene = { .sheet = chart, .theme = pages->theme };
	const float scale = fmaxf(fminf(1, pages->room_width / chart->width), PAGE_LEAST);
	struct picture *picture = pages_picture(pages);

	sfc_draw(&scene, picture);
	if (chart->width * scale > pages->room_width) {
		narrow(chart, picture, pages->room_width / scale);
		picture = pages_picture(pages);
		sfc_draw(&scene, picture);
	}
	put_columns(pages, chart, picture, heading, scale);
	put_comments(pages, chart);
	sfc_sheet_free(chart);
	put_bodies(pages, pou);
}
