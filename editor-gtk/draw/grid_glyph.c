/* SPDX-License-Identifier: MIT
 *
 * grid_glyph - the three characters of an element as strokes.
 *
 * It knows characters and no elements: `|` is a bar, `(` and `)` are arcs, `[` `]`
 * brackets, `<` `>` arrows, a blank is nothing; in the middle `/` is a slanting line, `>` a second
 * arrow behind the left one, a letter is a letter.
 */
#include "editor-gtk/draw/grid_glyph.h"

#include <glib.h>
#include <string.h>

#define BAR_HALF    8     /* px from the middle of a contact to its bars         */
#define COIL_HALF   13
#define COIL_RADIUS 18
#define TIP         7     /* of a bracket, an arrow                             */
#define SECOND      6     /* from an arrow to the second one                    */

static void shape_line(const struct nib *nib, const struct glyph *glyph, float x1,
		       float y1, float x2, float y2)
{
	picture_line(nib->picture, glyph->wire.token, STROKE_SOLID, glyph->wire.width,
		     glyph->x + x1, glyph->y + y1, glyph->x + x2, glyph->y + y2);
}

/* One stroke at the left (@side -1) or at the right (1). */
static void side_stroke(const struct nib *nib, const struct glyph *glyph, char stroke,
			float side)
{
	float x = side * glyph->half, up = glyph->up;
	float opening = side < 0 ? (float)G_PI : 0;

	switch (stroke) {
	case ' ':
		return;
	case '|':
		shape_line(nib, glyph, x, -up, x, up);
		return;
	case '(':
	case ')':
		picture_arc(nib->picture, glyph->wire.token, glyph->wire.width,
			    glyph->x + x - side * COIL_RADIUS, glyph->y, COIL_RADIUS,
			    opening - 0.73f, opening + 0.73f);
		return;
	case '<':
	case '>':
		up = RUNG_HALF - 2;
		if ((stroke == '<') == (side < 0)) { /* its tip points outwards */
			shape_line(nib, glyph, x, 0, x - side * TIP, -up);
			shape_line(nib, glyph, x, 0, x - side * TIP, up);
		} else {
			shape_line(nib, glyph, x - side * TIP, 0, x, -up);
			shape_line(nib, glyph, x - side * TIP, 0, x, up);
		}
		return;
	default: /* brackets, and words such as FOR */
		shape_line(nib, glyph, x, -up, x, up);
		shape_line(nib, glyph, x, -up, x - side * TIP, -up);
		shape_line(nib, glyph, x, up, x - side * TIP, up);
		return;
	}
}

static void centred(const struct nib *nib, enum token token, enum letter letter,
		    struct lettered text, float x, float baseline)
{
	picture_text(nib->picture, token, letter, text, x - text.width / 2, baseline);
}

static void fill(const struct nib *nib, const struct glyph *glyph)
{
	float alpha = nib->theme->fill;

	if (glyph->strokes[0] == '(')
		picture_disc(nib->picture, TOKEN_POWER, alpha, glyph->x, glyph->y,
			     glyph->half);
	else
		picture_fill(nib->picture, TOKEN_POWER, alpha, glyph->x - glyph->half,
			     glyph->y - RUNG_HALF, 2 * glyph->half, 2 * RUNG_HALF);
}

static void lines_inside(const struct nib *nib, const struct glyph *glyph)
{
	const float behind = glyph->strokes[1] == '>' ? SECOND : 0;
	float y = glyph->y + 4.5f - (float)(glyph->framed->lines - 1) * FRAMED_LINE / 2;

	for (int i = 0; i < glyph->framed->lines; i++) {
		const struct lettered *line = &glyph->framed->line[i];
		const float aside = glyph->framed->left ? (line->width - glyph->framed->width) / 2 : 0;

		centred(nib, nib->ink, LETTER_OPERAND, *line, glyph->x + aside + behind,
			y + (float)(i * FRAMED_LINE));
	}
}

static void middle(const struct nib *nib, const struct glyph *glyph)
{
	char letter[2] = { glyph->strokes[1], 0 };
	const char *text = glyph->inside ? glyph->inside : letter;
	enum letter kind = glyph->inside ? glyph->letter : LETTER_TYPE;

	if (!glyph->inside && letter[0] == ' ')
		return;
	if (!glyph->inside && letter[0] == '/') {
		float x = glyph->strokes[0] == '(' ? 5 : glyph->half + 1;

		shape_line(nib, glyph, -x, RUNG_HALF - 3, x, 3 - RUNG_HALF);
		return;
	}
	struct lettered fits = lettering_fit(nib->lettering, kind, text, -1, 0);
	centred(nib, glyph->inside ? nib->ink : glyph->wire.token, kind, fits, glyph->x,
		glyph->y + 4.5f);
}

void glyph_outline(const struct nib *nib, const struct glyph *glyph)
{
	struct glyph second = *glyph;

	side_stroke(nib, glyph, glyph->strokes[0], -1);
	side_stroke(nib, glyph, glyph->strokes[2], 1);
	second.x += SECOND;
	if (glyph->strokes[1] == '>')
		side_stroke(nib, &second, '>', -1);
}

void glyph_draw(const struct nib *nib, const struct glyph *glyph)
{
	if (glyph->lit)
		fill(nib, glyph);
	glyph_outline(nib, glyph);
	if (glyph->framed)
		lines_inside(nib, glyph);
	else
		middle(nib, glyph);
}

float glyph_meets(const struct glyph *glyph)
{
	return glyph->x - glyph->half + (glyph->strokes[0] == '>' ? TIP : 0);
}

float glyph_half(const struct word_row *word)
{
	if (explain_glyph(word)[0] == '(')
		return COIL_HALF;
	return word->operand == OPND_NONE && word->place == PLACE_SERIES ? 20 : BAR_HALF;
}
