/* SPDX-License-Identifier: MIT
 *
 * grid_draw - a whole rung: ground, rails, wires between rows, elements, marks, heading.
 */
#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/draw/grid_pen.h"
#include "editor-gtk/draw/rung_text.h"

#include <glib.h>

#define COMMENT_LINE 17

struct wire pen_wire(const struct pen *pen, unsigned int live)
{
	struct wire wire = { TOKEN_IDLE, STROKE_SOLID, pen->theme->idle_width };

	if (!pen->scene->live)
		return wire;
	if (!(live & LIVE_KNOWN))
		wire.style = STROKE_DOTTED;
	else if (live & LIVE_OUT)
		wire = (struct wire){ TOKEN_POWER, STROKE_SOLID, pen->theme->power_width };
	return wire;
}

unsigned int pen_live(const struct pen *pen, int row, int col)
{
	const struct grid_live *live = pen->scene->live;

	return live ? live->cell[row * pen->rung->cols + col] : 0;
}

unsigned int pen_net(const struct pen *pen, int row, int bar)
{
	return pen->net_live[row * (pen->rung->cols + 1) + bar];
}

void pen_line(const struct pen *pen, struct wire wire, float x1, float y1, float x2,
	      float y2)
{
	if (x2 != x1 || y2 != y1)
		picture_line(pen->picture, wire.token, wire.style, wire.width, x1, y1, x2,
			     y2);
}

void pen_text(const struct pen *pen, enum token token, enum letter letter,
	      struct lettered text, float x, float baseline)
{
	picture_text(pen->picture, token, letter, text, x - text.width / 2, baseline);
}

/* ---- wires that belong to no cell ---- */

static void draw_links(const struct pen *pen)
{
	const struct rung *rung = pen->rung;

	for (int row = 1; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++) {
			if (!rung_at(rung, row, col)->link)
				continue;
			struct wire wire = pen_wire(pen, pen_net(pen, row, col + 1));
			float x = rung_layout_bar(pen->layout, row, col + 1);
			float half = wire.width / 2;

			pen_line(pen, wire, x, pen->layout->row[row - 1].wire - half, x,
				 pen->layout->row[row].wire + half);
		}
}

/* Power of a box that ends its row goes on to the right rail. */
static void draw_trails(const struct pen *pen)
{
	for (int row = 0; row < pen->rung->rows; row++) {
		const struct rung_row *r = &pen->layout->row[row];

		if (r->trail >= 0)
			pen_line(pen, pen_wire(pen, pen_live(pen, row, r->trail)),
				 rung_layout_bar(pen->layout, row, r->trail + 1), r->wire,
				 pen->layout->right, r->wire);
	}
}

static void draw_rails(const struct pen *pen)
{
	const struct rung_row *last = &pen->layout->row[pen->layout->rows - 1];
	float width = pen->theme->rail_width, end = last->y + last->height;
	bool live = pen->scene->live && !pen->rung->off &&
		    !(pen->scene->state & RUNG_STILL);
	enum stroke_style style = pen->rung->off ? STROKE_DASHED : STROKE_SOLID;

	picture_line(pen->picture, live ? TOKEN_POWER : TOKEN_IDLE, style, width,
		     RUNG_LEFT, pen->layout->top, RUNG_LEFT, end);
	picture_line(pen->picture, TOKEN_IDLE, style, width, pen->layout->right,
		     pen->layout->top, pen->layout->right, end);
}

/* ---- what stands round the grid ---- */

struct line_place {
	struct picture *picture;
	enum token token;
	enum letter letter;
	float x, y, step;
};

static void take_line(void *context, int line, struct lettered text)
{
	const struct line_place *place = context;

	picture_text(place->picture, place->token, place->letter, text, place->x,
		     place->y + (float)line * place->step);
}

static void draw_title(const struct pen *pen, const struct rung_heading *heading)
{
	const struct rung_layout *layout = pen->layout;
	struct line_place place = { pen->picture, pen->ink, LETTER_TITLE,
				    RUNG_LEFT + heading->indent, layout->title_y,
				    TITLE_STEP };

	if (layout->title_lines)
		rung_lines(pen->drafting, LETTER_TITLE,
			   project_text(pen->drafting->project, pen->rung->title),
			   layout->heading_room - heading->indent, layout->title_lines,
			   take_line, &place);
	else
		take_line(&place, 0, heading->title);
}

static void draw_heading(const struct pen *pen)
{
	const struct rung_layout *layout = pen->layout;
	struct rung_heading heading = rung_heading(pen->drafting, pen->rung);
	float y = layout->title_y;

	picture_text(pen->picture, TOKEN_ACCENT, LETTER_OPERAND, heading.label, RUNG_LEFT, y);
	draw_title(pen, &heading);
	y += layout->title_lines ? (float)((layout->title_lines - 1) * TITLE_STEP) : 0;
	if (layout->comment_lines) {
		struct line_place place = { pen->picture, TOKEN_COMMENT, LETTER_COMMENT,
					    RUNG_LEFT, y + (heading.width > 0 ?
							    COMMENT_LINE : 0),
					    COMMENT_LINE };

		rung_lines(pen->drafting, LETTER_COMMENT, heading.comment,
			   layout->heading_room, layout->comment_lines, take_line, &place);
	} else if (*heading.comment) {
		picture_text(pen->picture, TOKEN_COMMENT, LETTER_COMMENT,
			     lettering_fit(pen->drafting->lettering, LETTER_COMMENT,
					   heading.comment, -1, 0),
			     RUNG_LEFT + heading.width, y);
	}
	g_free(heading.comment);
}

static void draw_ground(const struct pen *pen)
{
	const struct rung_layout *layout = pen->layout;
	unsigned int state = pen->scene->state;
	float width = rung_layout_width(layout);

	if (!(state & (RUNG_NO_GUTTER | RUNG_ON_GUTTER)))
		picture_fill(pen->picture, TOKEN_GUTTER, 1, 0, 0, RUNG_GUTTER,
			     layout->height);
	if (state & RUNG_SELECTED)
		picture_fill(pen->picture, TOKEN_ACCENT, pen->theme->wash, 0, 0, width,
			     layout->height);
	if (state & RUNG_ADDED)
		picture_fill(pen->picture, TOKEN_POWER, 0.10f, 0, 0, width, layout->height);
	if (state & RUNG_REMOVED)
		picture_fill(pen->picture, TOKEN_ERROR, 0.10f, 0, 0, width, layout->height);
	if (state & RUNG_CURRENT)
		picture_fill(pen->picture, TOKEN_ACCENT, 1, 0, 2, 3, layout->height - 4);
	if (!(state & RUNG_NO_GUTTER))
		picture_fill(pen->picture, TOKEN_LINE, 1, 0, layout->height - 1, width, 1);
}

static void draw_number(const struct pen *pen)
{
	unsigned int state = pen->scene->state;
	enum token token = state & RUNG_CURRENT ? TOKEN_ACCENT : TOKEN_COMMENT;
	const char *sign = state & RUNG_ADDED ? "+" : state & RUNG_REMOVED ?
		"\xe2\x88\x92" : state & RUNG_CHANGED ? "\xe2\x89\xa0" : NULL;
	enum letter small = state & RUNG_NO_GUTTER ? LETTER_PIN : LETTER_BADGE;
	float y = pen->layout->title_y, x = RUNG_GUTTER / 2.0f;
	struct lettering *lettering = pen->drafting->lettering;
	char number[16];

	g_snprintf(number, sizeof(number), "%d", pen->layout->number);
	pen_text(pen, token, LETTER_NUMBER,
		 lettering_fit(lettering, LETTER_NUMBER, number, -1, 0), x, y);
	if (pen->rung->off) /* paper may be made smaller */
		pen_text(pen, TOKEN_COMMENT, small,
			 lettering_fit(lettering, small, "OFF", -1, 0), x, y + 15);
	if (sign)
		pen_text(pen, state & RUNG_ADDED ? TOKEN_POWER : state & RUNG_REMOVED ?
			 TOKEN_ERROR : TOKEN_FORCE, LETTER_HEADING,
			 lettering_fit(lettering, LETTER_HEADING, sign, -1, 0), x, y + 36);
	if (state & RUNG_MARKED) /* a ribbon */
		picture_fill(pen->picture, TOKEN_ACCENT, 1, 7, 0, 6, y + 6);
	if (state & RUNG_EDITED)
		picture_disc(pen->picture, TOKEN_ACCENT, 1, RUNG_GUTTER - 6, y - 5, 3);
}

void grid_draw(const struct grid_scene *scene, struct picture *picture)
{
	struct grid_scene still = *scene;
	struct pen pen = { .scene = &still, .drafting = scene->drafting,
			   .layout = scene->layout, .rung = scene->layout->rung,
			   .theme = scene->theme, .picture = picture };

	/* A rung that is OFF is not scanned. */
	pen.ink = pen.rung->off ? TOKEN_COMMENT : TOKEN_INK;
	if (pen.rung->off)
		still.live = NULL;
	grid_net_make(&pen);
	draw_ground(&pen);
	grid_draw_grounds(&pen);
	draw_links(&pen);
	draw_trails(&pen);
	for (int row = 0; row < pen.rung->rows; row++)
		for (int col = 0; col < pen.rung->cols; col++)
			grid_draw_element(&pen, row, col);
	draw_rails(&pen);
	draw_heading(&pen);
	draw_number(&pen);
	grid_draw_marks(&pen);
	g_free(pen.net_live);
}

GskRenderNode *grid_draw_node(const struct grid_scene *scene)
{
	struct picture picture;

	picture_init(&picture);
	picture.scale = scene->scale;
	grid_draw(scene, &picture);
	GskRenderNode *node = picture_node(&picture, scene->theme,
					   scene->drafting->lettering);
	picture_clear(&picture);
	return node;
}
