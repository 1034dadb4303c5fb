/* SPDX-License-Identifier: MIT
 *
 * original_draw - see original_draw.h.
 */
#include "editor-gtk/draw/original_draw.h"

#include "editor-gtk/draw/fbd_draw.h"
#include "editor-gtk/draw/grid_classic.h"
#include "editor-gtk/kit/i18n.h"

#define MARGIN  28.0f /* room for names above the first elements              */
#define SMALL   4.0f  /* radius of the circle of a negated pin                */

struct nib { struct picture *picture; const struct original_scene *scene; };

static void put_line(const struct nib *nib, enum token token, float width, float x1, float y1, float x2, float y2)
{
	picture_line(nib->picture, token, STROKE_SOLID, width, x1 + MARGIN, y1 + MARGIN, x2 + MARGIN, y2 + MARGIN);
}

/* @side: -1: @text ends at @x; 0: is centred; 1: begins. */
static void put_text(const struct nib *nib, enum letter letter, const char *text, float x, float y, int side)
{
	const struct lettered fits = lettering_fit(nib->scene->lettering, letter, text, -1, 0);
	const float left = x + MARGIN - fits.width * (float)(1 - side) / 2;

	if (!*text)
		return;
	picture_text(nib->picture, TOKEN_INK, letter, fits, left, y + MARGIN);
	picture_grow(nib->picture, left + fits.width + 8, y + MARGIN + 8);
}

static void put_frame(const struct nib *nib, const struct drawn_shape *shape)
{
	picture_frame(nib->picture, TOKEN_INK, STROKE_SOLID, nib->scene->theme->shape_width, (float)shape->x + MARGIN,
		      (float)shape->y + MARGIN, (float)shape->width, (float)shape->height);
}

/* One side of a coil: @x is where its wire ends. */
static void put_bow(const struct nib *nib, float x, float y, float radius, bool right)
{
	const float middle = right ? 0 : (float)G_PI;

	picture_arc(nib->picture, TOKEN_INK, nib->scene->theme->shape_width, x + (right ? -radius : radius) + MARGIN, y + MARGIN,
		    radius, middle - 0.8f, middle + 0.8f);
}

/* | | and ( ) with what stands in them, and the variable above. */
static void put_contact(const struct nib *nib, const struct drawn_shape *shape)
{
	const float left = (float)shape->x, top = (float)shape->y, right = left + (float)shape->width;
	const float bottom = top + (float)shape->height, width = nib->scene->theme->shape_width;

	if (shape->kind == DRAWN_COIL) {
		put_bow(nib, left, (top + bottom) / 2, (bottom - top) / 2 + 3, false);
		put_bow(nib, right, (top + bottom) / 2, (bottom - top) / 2 + 3, true);
	} else {
		put_line(nib, TOKEN_INK, width, left, top, left, bottom);
		put_line(nib, TOKEN_INK, width, right, top, right, bottom);
	}
	put_text(nib, LETTER_TYPE, shape->sign, (left + right) / 2, (top + bottom) / 2 + 4, 0);
	put_text(nib, LETTER_SYMBOL, shape->text, (left + right) / 2, top - 6, 0);
}

static void put_value(const struct nib *nib, const struct drawn_shape *shape)
{
	const float middle = (float)shape->y + (float)shape->height / 2;

	put_frame(nib, shape);
	put_text(nib, LETTER_OPERAND, shape->text, (float)shape->x + (float)shape->width / 2, middle + 4, 0);
	put_text(nib, LETTER_TYPE, shape->sign, (float)shape->x + 4, middle + 4, 1);
}

static void put_shape(const struct nib *nib, const struct drawn_shape *shape)
{
	const float middle = (float)shape->x + (float)shape->width / 2;

	switch (shape->kind) {
	case DRAWN_RAIL:
		put_line(nib, TOKEN_IDLE, nib->scene->theme->rail_width, middle, (float)shape->y, middle,
			 (float)(shape->y + shape->height));
		break;
	case DRAWN_CONTACT:
	case DRAWN_COIL:
		put_contact(nib, shape);
		break;
	case DRAWN_BOX:
		put_frame(nib, shape);
		put_text(nib, LETTER_TYPE, shape->text, middle, (float)shape->y + 15, 0);
		put_text(nib, LETTER_SYMBOL, shape->above, middle, (float)shape->y - 6, 0);
		break;
	case DRAWN_VALUE:
		put_value(nib, shape);
		break;
	case DRAWN_JUMP:
		put_text(nib, LETTER_SYMBOL, "≫", (float)shape->x, (float)shape->y + (float)shape->height / 2 + 4, 1);
		put_text(nib, LETTER_SYMBOL, shape->text, (float)shape->x + 16, (float)shape->y + (float)shape->height / 2 + 4, 1);
		break;
	}
	picture_grow(nib->picture, (float)(shape->x + shape->width) + 2 * MARGIN, (float)(shape->y + shape->height) + 2 * MARGIN);
}

static void put_pin(const struct nib *nib, const struct drawn_pin *pin)
{
	const float x = (float)pin->x + (pin->output ? -5 : 5), side = pin->output ? SMALL : -SMALL;

	put_text(nib, LETTER_PIN, pin->name, x, (float)pin->y + 4, pin->output ? -1 : 1);
	if (pin->negated)
		picture_arc(nib->picture, TOKEN_INK, nib->scene->theme->shape_width, (float)pin->x + side + MARGIN,
			    (float)pin->y + MARGIN, SMALL, 0, (float)(2 * G_PI));
}

/* The original alone, added to @picture at its origin. Returns the height.
 * Units: px at 100 %. */
static float original_draw(const struct original_scene *scene, struct picture *picture)
{
	const struct nib nib = { picture, scene };
	const struct drawing *drawing = scene->drawing;

	for (int i = 0; i < drawing->wires; i++)
		put_line(&nib, TOKEN_IDLE, scene->theme->idle_width, (float)drawing->wire[i].x1, (float)drawing->wire[i].y1,
			 (float)drawing->wire[i].x2, (float)drawing->wire[i].y2);
	for (int i = 0; i < drawing->shapes; i++)
		put_shape(&nib, &drawing->shape[i]);
	for (int i = 0; i < drawing->pins; i++)
		put_pin(&nib, &drawing->pin[i]);
	picture->width = MAX(picture->width, (float)drawing->width + 2 * MARGIN);
	return (float)drawing->height + 2 * MARGIN;
}

/* ---- original and import ---- */

static float put_network(const struct original_scene *scene, float y, struct picture *picture)
{
	const struct pou *pou = &scene->project->pou[scene->pou];
	struct fbd_layout *layout = fbd_layout_new(scene->project, pou, scene->number, scene->lettering);
	const struct fbd_scene network = { .layout = layout, .theme = scene->theme, .state = RUNG_NO_GUTTER };

	picture_move(picture, 0, y);
	fbd_draw(&network, picture);
	picture_move(picture, 0, 0);
	picture->width = MAX(picture->width, layout->width);
	y += layout->height;
	fbd_layout_free(layout);
	return y;
}

static float put_ours(const struct original_scene *scene, float y, struct picture *picture)
{
	const struct pou *pou = &scene->project->pou[scene->pou];
	const char *name = project_text(scene->project, pou->name);
	const struct classic_pair pair = { .there = { .lettering = scene->lettering, .theme = scene->theme },
					   .project = scene->project, .pou = scene->pou, .rung = &scene->number,
					   .rungs = 1, .show = scene->show };

	if (pou->language == LANGUAGE_FBD && scene->number < fbd_layout_networks(pou)) {
		y += picture_caption(picture, scene->lettering,
				     g_strdup_printf(_("Here: %s, network %d"), name, scene->number + 1), y);
		return put_network(scene, y, picture);
	}
	return pou->language == LANGUAGE_LD && scene->number < pou->rung_count ? grid_classic_here(&pair, y, picture) : y;
}

void original_pair(const struct original_scene *scene, struct picture *picture)
{
	float y = picture_caption(picture, scene->lettering,
		g_strdup_printf(_("There: %s, line %d"), scene->name, scene->drawing->line), 0);

	picture_move(picture, 0, y);
	y += original_draw(scene, picture);
	picture_move(picture, 0, 0);
	if (scene->project && scene->pou < scene->project->pou_count)
		y = put_ours(scene, y, picture);
	picture->height = MAX(picture->height, y + 4);
}
