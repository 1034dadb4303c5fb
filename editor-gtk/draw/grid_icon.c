/* SPDX-License-Identifier: MIT
 *
 * grid_icon - an element as a small picture for the palette: the strokes of the sheet.
 *
 * What an element says by a text, an icon says by its word, in two lines if it is long.
 */
#include "editor-gtk/draw/grid_pen.h"

#include <glib.h>
#include <string.h>

#define EDGE 5  /* px between a word and the side, and of wire that stays       */
#define LINE 10

struct word_lines {
	struct lettered line[2];
	int lines;
	float width;
};

/* Behind the last `_` of the first half or a little more; without one in the middle. */
static size_t break_at(const char *word)
{
	size_t len = strlen(word), at = 0;

	for (size_t i = 1; i < len; i++)
		if (word[i - 1] == '_' && (i <= len / 2 + 2 || at == 0))
			at = i;
	return at ? at : (len + 1) / 2;
}

static struct word_lines lines_of(struct lettering *lettering, const char *word,
				  float room)
{
	struct lettered whole = lettering_fit(lettering, LETTER_BADGE, word, -1, 0);
	struct word_lines lines = { { whole }, 1, whole.width };

	if (whole.width <= room)
		return lines;
	size_t at = break_at(word);
	lines.line[0] = lettering_fit(lettering, LETTER_BADGE, word, (ptrdiff_t)at, room);
	lines.line[1] = lettering_fit(lettering, LETTER_BADGE, word + at, -1, room);
	lines.lines = 2;
	lines.width = MAX(lines.line[0].width, lines.line[1].width);
	return lines;
}

/* Words of a project may have any letters: they are not cut in two but clipped. */
static bool is_plain(const char *word)
{
	for (; *word; word++)
		if ((guchar)*word >= 0x80)
			return false;
	return true;
}

static void say_word(const struct pen *pen, const struct glyph *glyph,
		     const struct word_lines *lines)
{
	float y = glyph->y + (lines->lines > 1 ? -2 : 3.5f);

	for (int i = 0; i < lines->lines; i++)
		pen_text(pen, TOKEN_INK, LETTER_BADGE, lines->line[i], glyph->x,
			 y + (float)(i * LINE));
}

static void draw_word(const struct pen *pen, struct glyph *glyph, bool box,
		      const struct word_lines *lines)
{
	float up = lines->lines > 1 ? RUNG_HALF + 2 : RUNG_HALF;
	if (box)
		picture_frame(pen->picture, TOKEN_INK, STROKE_SOLID,
			      pen->theme->shape_width, glyph->x - glyph->half,
			      glyph->y - up, 2 * glyph->half, 2 * up);
	else
		glyph_outline(pen, glyph);
	say_word(pen, glyph, lines);
}

void grid_draw_icon(const struct word_row *word, const struct theme *theme,
		    struct lettering *lettering, float width, float height,
		    struct picture *picture)
{
	struct drafting drafting = { .lettering = lettering };
	struct grid_scene scene = { .drafting = &drafting, .theme = theme };
	struct pen pen = { .scene = &scene, .drafting = &drafting, .theme = theme,
			   .picture = picture, .ink = TOKEN_INK };
	struct wire wire = { TOKEN_INK, STROKE_SOLID, theme->shape_width };
	struct glyph glyph = { .strokes = word->glyph, .x = width / 2, .y = height / 2,
			       .half = glyph_half(word), .wire = wire, .up = RUNG_HALF };
	bool box = word->kind != WORD_ELEM;
	bool pointed = !box && strchr("<>", word->glyph[0]);
	bool says = box || rung_is_framed(word) || word->operand == OPND_NONE;
	float room = width - 2 * EDGE - 2;
	struct word_lines lines = { .lines = 0 };

	if (word->place == PLACE_WIRE) {
		pen_line(&pen, wire, 0, glyph.y, width, glyph.y);
		return;
	}
	if (says && is_plain(word->word))
		lines = lines_of(lettering, word->word, room);
	else if (says)
		lines = (struct word_lines){ { lettering_fit(lettering, LETTER_BADGE,
			word->word, -1, room) }, 1, room };
	float side = pointed ? 10 : lines.width + 8 > room ? 3 : EDGE;
	if (says)
		glyph.half = MAX(lines.width / 2 + side, 14);
	pen_line(&pen, wire, 0, glyph.y, glyph.x - glyph.half, glyph.y);
	pen_line(&pen, wire, glyph.x + glyph.half, glyph.y, width, glyph.y);
	if (says)
		draw_word(&pen, &glyph, box, &lines);
	else
		glyph_draw(&pen, &glyph);
}
