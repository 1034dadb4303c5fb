/* SPDX-License-Identifier: MIT
 *
 * sfc_draw - strokes of a chart; see sfc_draw.h.
 */
#include "editor-gtk/draw/sfc_draw.h"
#include "editor-gtk/kit/i18n.h"

#include <glib.h>

#define INSET      3.5f  /* from the outer to the inner frame of an initial step  */
#define TWIN_HALF  2.5f
#define TWIN_MORE  12    /* px of a double line beyond its outer lanes             */
#define ARROW      6
#define BASE       4     /* from the middle of a row to the baseline of its text   */
#define TOKEN_DOT  4.5f
#define SIGN_APART 2     /* px from a frame to the sign of a comparison            */
#define SIGN_BASE  5
#define SIGN_ROOM  10    /* px of a comment that are left free for it             */

struct nib {
	const struct sfc_scene *scene;
	const struct sfc_sheet *sheet;
	const struct sfc_layout *layout;
	const struct theme *theme;
	struct picture *picture;
	bool compared;           /* it has signs of a comparison               */
};

static void line(const struct nib *nib, enum token token, float width, float x1, float y1,
		 float x2, float y2)
{
	picture_line(nib->picture, token, STROKE_SOLID, width, x1, y1, x2, y2);
}

static struct lettered fit(const struct nib *nib, enum letter letter, const char *text)
{
	return lettering_fit(nib->sheet->lettering, letter, text, -1, SFC_BOUND);
}

static bool is_seen(const struct nib *nib, int row, int end)
{
	const struct sfc_scene *scene = nib->scene;

	return (scene->top == 0 && scene->bottom == 0) ||
	       (sfc_sheet_y(row) - SFC_ROW <= scene->bottom &&
		sfc_sheet_y(end) + SFC_ROW >= scene->top);
}

static unsigned int step_bits(const struct nib *nib, int step)
{
	return nib->scene->live ? nib->scene->live->step[step] : 0;
}

/* ---- marks ---- */

static graphene_rect_t mark_box(const struct nib *nib, const struct sfc_mark *mark)
{
	return mark->use >= 0 ? sfc_sheet_use(nib->sheet, mark->use) :
				sfc_sheet_box(nib->sheet, mark->shape);
}

/* A place may have several marks: its ground is washed once. */
static bool is_washed(const struct nib *nib, int mark)
{
	const unsigned int washes = SFC_CURSOR | SFC_SELECTED | SFC_DROP;
	const struct sfc_mark *of = nib->scene->mark;

	for (int i = 0; i < mark; i++)
		if (of[i].shape == of[mark].shape && of[i].use == of[mark].use && of[i].signs & washes)
			return false;
	return of[mark].signs & washes;
}

static void draw_grounds(const struct nib *nib)
{
	for (int i = 0; i < nib->scene->mark_count; i++) {
		const struct sfc_mark *mark = &nib->scene->mark[i];
		graphene_rect_t box = mark_box(nib, mark);

		graphene_rect_inset(&box, -4, mark->use >= 0 ? 0 : -4);
		if (is_washed(nib, i))
			picture_fill(nib->picture, TOKEN_ACCENT, nib->theme->wash,
				     box.origin.x, box.origin.y, box.size.width,
				     box.size.height);
	}
}

/* As in rungs: the current hit of a search covers others of the same place and has a frame. */
static void draw_found(const struct nib *nib, bool now)
{
	for (int i = 0; i < nib->scene->mark_count; i++) {
		const struct sfc_mark *mark = &nib->scene->mark[i];
		graphene_rect_t box = mark_box(nib, mark);

		if (!(mark->signs & (now ? SFC_FOUND_NOW : SFC_FOUND)))
			continue;
		graphene_rect_inset(&box, -4, mark->use >= 0 ? 0 : -4);
		picture_fill(nib->picture, now ? TOKEN_FOUND_NOW : TOKEN_FOUND, 1, box.origin.x,
			     box.origin.y, box.size.width, box.size.height);
		if (now)
			picture_frame(nib->picture, TOKEN_INK, STROKE_SOLID, 2, box.origin.x,
				      box.origin.y, box.size.width, box.size.height);
	}
}

/* In a comparison, as in rungs: a dotted frame and a sign beside the colour. The sign
 * stands before a step or transition, and behind a line of a step. */
static void draw_difference(const struct nib *nib, const struct sfc_mark *mark)
{
	const bool added = mark->signs & SFC_ADDED, removed = mark->signs & SFC_REMOVED;
	const bool step = nib->layout->shape[mark->shape].part == SFC_STEP;
	const enum token token = added ? TOKEN_POWER : removed ? TOKEN_ERROR : TOKEN_FORCE;
	const struct lettered sign = fit(nib, LETTER_HEADING, added ? "+" : removed ?
					 "\xe2\x88\x92" : "\xe2\x89\xa0");
	graphene_rect_t box = mark_box(nib, mark);

	graphene_rect_inset(&box, -3, mark->use < 0 && step ? -3 : 0);
	picture_frame(nib->picture, token, STROKE_DOTTED, 1.5f, box.origin.x, box.origin.y,
		      box.size.width, box.size.height);
	picture_text(nib->picture, token, LETTER_HEADING, sign, mark->use >= 0 ?
		     box.origin.x + box.size.width + SIGN_APART :
		     box.origin.x - sign.width - SIGN_APART,
		     box.origin.y + box.size.height / 2 + SIGN_BASE);
}

/* As in rungs: an arrow that waits before a step or transition, or behind a line of a step. */
static void draw_missing(const struct nib *nib, const struct sfc_mark *mark)
{
	const struct lettered sign = fit(nib, LETTER_HEADING, "\xe2\x86\x93");
	const graphene_rect_t box = mark_box(nib, mark);

	picture_text(nib->picture, TOKEN_FORCE, LETTER_HEADING, sign, mark->use >= 0 ?
		     box.origin.x + box.size.width + SIGN_APART :
		     box.origin.x - sign.width - 2 * SIGN_APART,
		     box.origin.y + box.size.height / 2 + SIGN_BASE);
}

static void draw_marks(const struct nib *nib)
{
	for (int i = 0; i < nib->scene->mark_count; i++) {
		const struct sfc_mark *mark = &nib->scene->mark[i];
		graphene_rect_t box = mark_box(nib, mark);
		float bottom = box.origin.y + box.size.height;

		if (mark->signs & (SFC_ERROR | SFC_WARNING))
			picture_wave(nib->picture, mark->signs & SFC_ERROR ? TOKEN_ERROR :
				     TOKEN_FORCE, box.origin.x + 3, bottom - 3,
				     box.size.width - 6);
		graphene_rect_inset(&box, -4, mark->use >= 0 ? 0 : -4);
		if (mark->signs & (SFC_CHANGED | SFC_ADDED | SFC_REMOVED))
			draw_difference(nib, mark);
		if (mark->signs & SFC_MISSING)
			draw_missing(nib, mark);
		if (mark->signs & (SFC_CURSOR | SFC_DROP))
			picture_frame(nib->picture, TOKEN_ACCENT, mark->signs & SFC_DROP ?
				      STROKE_DASHED : STROKE_SOLID, 1.5f, box.origin.x,
				      box.origin.y, box.size.width, box.size.height);
	}
}

/* ---- lines ---- */

static void draw_wires(const struct nib *nib)
{
	const float width = nib->theme->idle_width;

	for (int i = 0; i < nib->layout->wire_count; i++) {
		const struct sfc_wire *wire = &nib->layout->wire[i];
		float x1 = nib->sheet->lane[wire->lane].x;
		float x2 = nib->sheet->lane[wire->end_lane].x, y1, y2;

		if (!is_seen(nib, wire->row, wire->end_row))
			continue;
		sfc_sheet_ends(nib->sheet, wire, &y1, &y2);
		if (wire->lane == wire->end_lane) {
			line(nib, TOKEN_INK, width, x1, y1, x1, y2);
		} else if (wire->twin) {
			float y = sfc_sheet_y(wire->row);

			line(nib, TOKEN_INK, width, x1 - TWIN_MORE, y - TWIN_HALF,
			     x2 + TWIN_MORE, y - TWIN_HALF);
			line(nib, TOKEN_INK, width, x1 - TWIN_MORE, y + TWIN_HALF,
			     x2 + TWIN_MORE, y + TWIN_HALF);
		} else {
			line(nib, TOKEN_INK, width, x1 - width / 2, y1, x2 + width / 2,
			     y1);
		}
	}
}

/* ---- steps ---- */

static void draw_frame(const struct nib *nib, enum step_kind kind,
		       const graphene_rect_t *box, bool active)
{
	const enum token token = active ? TOKEN_POWER : TOKEN_INK;
	const float shape = nib->theme->shape_width;
	const float width = active ? nib->theme->power_width : shape;
	const float x = box->origin.x, y = box->origin.y;
	const float w = box->size.width, h = box->size.height;

	if (active)
		picture_fill(nib->picture, TOKEN_POWER, nib->theme->fill, x, y, w, h);
	picture_frame(nib->picture, token, STROKE_SOLID, width, x, y, w, h);
	if (kind == STEP_INITIAL)
		picture_frame(nib->picture, token, STROKE_SOLID, shape * 0.75f,
			      x + INSET + width / 2, y + INSET + width / 2,
			      w - 2 * INSET - width, h - 2 * INSET - width);
	if (kind == STEP_MACRO) {
		line(nib, token, shape * 0.75f, x, y + INSET + width, x + w,
		     y + INSET + width);
		line(nib, token, shape * 0.75f, x, y + h - INSET - width, x + w,
		     y + h - INSET - width);
	}
}

static void draw_middle(const struct nib *nib, enum token token, enum letter letter,
			const char *text, float x, float baseline)
{
	struct lettered fits = fit(nib, letter, text);

	picture_text(nib->picture, token, letter, fits, x - fits.width / 2, baseline);
}

/* Name, times and active time: a row each, in the middle of the box. */
static void draw_texts(const struct nib *nib, int step, const graphene_rect_t *box)
{
	const struct sfc_live *live = nib->scene->live;
	const char *times = nib->sheet->times[step];
	char time[48] = "";
	const bool told = live && live->time &&
			  live->time(live->context, step, time, sizeof(time));
	const int rows = 1 + (*times != 0) + told;
	const float pitch = MIN(17, (box->size.height - 16) / (float)rows);
	const float x = box->origin.x + box->size.width / 2;
	float y = box->origin.y + box->size.height / 2 -
		  pitch * (float)(rows - 1) / 2 + BASE;

	draw_middle(nib, TOKEN_INK, LETTER_SYMBOL, nib->sheet->name[step], x, y);
	if (*times)
		draw_middle(nib, TOKEN_COMMENT, LETTER_PIN, times, x, y += pitch);
	if (told)
		draw_middle(nib, TOKEN_ACCENT, LETTER_VALUE, time, x, y + pitch);
}

/* Draws a comment, cut to the room it has. */
static void draw_aside(const struct nib *nib, int shape, const char *text, float x, float y)
{
	const float room = sfc_sheet_room(nib->sheet, nib->layout->shape[shape].lane, x, y) -
			   (nib->compared ? SIGN_ROOM : 0);

	if (*text && room > SFC_APART)
		picture_text(nib->picture, TOKEN_COMMENT, LETTER_COMMENT,
			     lettering_fit(nib->sheet->lettering, LETTER_COMMENT, text, -1,
					   (int)MIN(room, SFC_BOUND)), x, y + BASE);
}

static void draw_comment(const struct nib *nib, int shape)
{
	const graphene_point_t at = sfc_sheet_comment(nib->sheet, shape);

	draw_aside(nib, shape, nib->sheet->comment[shape], at.x, at.y);
}

/* Draws the actions: a table beside the box, qualifiers on the left. */
static void draw_table(const struct nib *nib, int step)
{
	const struct sfc_step *s = &nib->layout->sfc->step[step];
	const struct sfc_shape *shape = &nib->layout->shape[step];
	const struct sfc_table *table = &nib->sheet->table[step];
	const float width = nib->theme->idle_width, half = SFC_ROW / 2.0f;
	const float y = sfc_sheet_y(shape->top + 1), w = table->what + table->does;

	if (!s->use_count)
		return;
	line(nib, TOKEN_INK, width, table->x - SFC_LEAD, y, table->x, y);
	picture_frame(nib->picture, TOKEN_INK, STROKE_SOLID, width, table->x, y - half, w,
		      (float)(s->use_count * SFC_ROW));
	line(nib, TOKEN_INK, width, table->x + table->what, y - half,
	     table->x + table->what, y - half + (float)(s->use_count * SFC_ROW));
	for (int i = 0; i < s->use_count; i++) {
		const int use = s->first_use + i;
		const float at = y + (float)(i * SFC_ROW);

		if (i > 0)
			line(nib, TOKEN_IDLE, width / 2, table->x, at - half,
			     table->x + w, at - half);
		picture_text(nib->picture, TOKEN_COMMENT, LETTER_OPERAND,
			     fit(nib, LETTER_OPERAND, nib->sheet->what[use]),
			     table->x + SFC_CELL, at + BASE);
		picture_text(nib->picture, TOKEN_INK, LETTER_SYMBOL,
			     fit(nib, LETTER_SYMBOL, nib->sheet->does[use]),
			     table->x + table->what + SFC_CELL, at + BASE);
		draw_aside(nib, step, nib->sheet->use_comment[use],
			   table->x + w + SFC_APART + (nib->compared ? SIGN_ROOM : 0),
			   at);
	}
}

static void draw_step(const struct nib *nib, int step)
{
	const graphene_rect_t box = sfc_sheet_box(nib->sheet, step);
	const bool active = step_bits(nib, step) & SFC_ACTIVE;

	draw_frame(nib, nib->layout->sfc->step[step].kind, &box, active);
	if (active) /* a token, as on paper: active steps differ not only in colour */
		picture_disc(nib->picture, TOKEN_POWER, 1, box.origin.x + 13,
			     box.origin.y + 13, TOKEN_DOT);
	draw_texts(nib, step, &box);
	draw_table(nib, step);
	draw_comment(nib, step);
}

/* ---- transitions and jumps ---- */

static void draw_transition(const struct nib *nib, int shape)
{
	const struct sfc_shape *s = &nib->layout->shape[shape];
	const struct sfc_live *live = nib->scene->live;
	const unsigned int bits = live ? live->transition[s->index] : 0;
	const float x = nib->sheet->lane[s->lane].x, y = sfc_sheet_y(s->top);
	const enum token token = bits & SFC_TRUE ? TOKEN_POWER :
				 bits & SFC_ENABLED ? TOKEN_BLOCKS : TOKEN_INK;

	line(nib, token, bits & SFC_ENABLED ? nib->theme->power_width + 1 :
	     nib->theme->shape_width + 1, x - SFC_BAR, y, x + SFC_BAR, y);
	picture_text(nib->picture, TOKEN_INK, LETTER_OPERAND,
		     fit(nib, LETTER_OPERAND, nib->sheet->name[shape]),
		     x + SFC_BAR + 7, y + BASE);
	draw_comment(nib, shape);
}

static void draw_jump(const struct nib *nib, int shape)
{
	const struct sfc_shape *s = &nib->layout->shape[shape];
	const struct sfc_jump *jump = &nib->layout->jump[s->index];
	const enum token token = jump->target < 0 ? TOKEN_ERROR : TOKEN_INK;
	const float x = nib->sheet->lane[s->lane].x, y = sfc_sheet_y(s->top);
	const float width = nib->theme->shape_width;

	line(nib, token, width, x - ARROW, y - ARROW, x, y);
	line(nib, token, width, x + ARROW, y - ARROW, x, y);
	if (jump->to_transition)
		line(nib, token, width, x - ARROW, y + 2, x + ARROW, y + 2);
	picture_text(nib->picture, token, LETTER_OPERAND,
		     fit(nib, LETTER_OPERAND, nib->sheet->name[shape]), x + SFC_BAR + 7,
		     y + BASE);
}

/* ---- */

static void draw_titles(const struct nib *nib)
{
	for (int i = 0; i < nib->layout->frame_count; i++) {
		const struct sfc_frame *frame = &nib->layout->frame[i];
		char *text;

		if (frame->title < 0 || !is_seen(nib, frame->title, frame->title))
			continue;
		text = g_strdup_printf(_("Inside %s"), nib->sheet->name[frame->macro]);
		picture_text(nib->picture, TOKEN_INK, LETTER_TITLE,
			     fit(nib, LETTER_TITLE, text), SFC_EDGE,
			     sfc_sheet_y(frame->title) + BASE);
		picture_fill(nib->picture, TOKEN_LINE, 1, SFC_EDGE,
			     sfc_sheet_y(frame->title) - SFC_ROW,
			     nib->sheet->width - 2 * SFC_EDGE, 1);
		g_free(text);
	}
}

void sfc_draw(const struct sfc_scene *scene, struct picture *picture)
{
	struct nib nib = { scene, scene->sheet, scene->sheet->layout, scene->theme, picture,
			   false };

	for (int i = 0; i < scene->mark_count; i++)
		nib.compared |= scene->mark[i].signs & (SFC_CHANGED | SFC_ADDED | SFC_REMOVED);

	draw_grounds(&nib);
	draw_found(&nib, false);
	draw_found(&nib, true);
	draw_titles(&nib);
	draw_wires(&nib);
	for (int i = 0; i < nib.layout->shape_count; i++) {
		const struct sfc_shape *shape = &nib.layout->shape[i];

		if (!is_seen(&nib, shape->top, shape->bottom))
			continue;
		if (shape->part == SFC_STEP)
			draw_step(&nib, shape->index);
		else if (shape->part == SFC_TRANSITION)
			draw_transition(&nib, i);
		else
			draw_jump(&nib, i);
	}
	draw_marks(&nib);
}

GskRenderNode *sfc_draw_node(const struct sfc_scene *scene)
{
	struct picture picture;

	picture_init(&picture);
	sfc_draw(scene, &picture);
	GskRenderNode *node = picture_node(&picture, scene->theme,
					   scene->sheet->lettering);
	picture_clear(&picture);
	return node;
}
