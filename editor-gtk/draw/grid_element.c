/* SPDX-License-Identifier: MIT
 *
 * grid_element - one cell: its wires, its strokes, its names. Boxes are grid_box.c.
 */
#include "editor-gtk/draw/grid_pen.h"

#include <glib.h>

#define BELOW_BASELINE 30 /* px below the wire: comment, value                  */

/* How the strokes of an element are drawn. A coil has no power behind it, so it is
 * judged by what comes. */
static struct wire shape_wire(const struct pen *pen, const struct word_row *word,
			      unsigned int live)
{
	unsigned int lit = word->place == PLACE_LAST ? LIVE_IN : LIVE_OUT;
	struct wire wire = { pen->ink, STROKE_SOLID, pen->theme->shape_width };

	if (live & LIVE_KNOWN && live & lit)
		wire = (struct wire){ TOKEN_POWER, STROKE_SOLID, pen->theme->power_width };
	else if (pen->scene->live && !(live & LIVE_KNOWN))
		wire.token = TOKEN_COMMENT;
	return wire;
}

static void draw_label(const struct pen *pen, int row, int col, float x)
{
	const struct rung_row *r = &pen->layout->row[row];
	struct rung_label label = rung_label(pen->drafting, rung_at(pen->rung, row, col));
	int column = rung_layout_column(pen->layout, row, col);
	bool wrong = pen_marks(pen, row, column) & MARK_ERROR;

	pen_text(pen, wrong ? TOKEN_ERROR : pen->ink, LETTER_SYMBOL, label.symbol, x,
		 r->wire - (r->addressed ? 31 : 18));
	pen_text(pen, TOKEN_COMMENT, LETTER_ADDRESS, label.address, x, r->wire - 17);
}

/* A coil's comment, and where it is read. There is room up to where its wire begins to
 * run alone. */
static void draw_reference(const struct pen *pen, int row, int col, float x)
{
	const struct rung_layout *layout = pen->layout;
	float from = MAX(rung_layout_bar(layout, row, col), pen->scene->reference_from) + 6;
	float room = layout->right - 6 - from, baseline = layout->row[row].wire + BELOW_BASELINE;
	struct lettered fits = rung_element_comment(pen->drafting,
						    rung_at(pen->rung, row, col), room);
	char *before = g_strdup_printf("%s%s", fits.text, *fits.text ? " \xc2\xb7 " : "");
	float taken = lettering_fit(pen->drafting->lettering, LETTER_PIN, before, -1,
				    0).width;
	char *read = pen->scene->reference(pen->scene->context, row, col, room - taken);
	char *text = g_strdup_printf("%s%s", read ? before : fits.text, read ? read : "");

	fits = lettering_fit(pen->drafting->lettering, LETTER_PIN, text, -1, room);
	g_free(read);
	g_free(text);
	g_free(before);
	float left = MIN(x - fits.width / 2, layout->right - 6 - fits.width);
	picture_text(pen->picture, TOKEN_COMMENT, LETTER_PIN, fits, left, baseline);
}

/* @up: of the strokes. An expression of many lines leaves room above it only. */
static void draw_below(const struct pen *pen, int row, int col, float x, float room,
		       float up)
{
	const struct grid_scene *scene = pen->scene;
	const struct cell *cell = rung_at(pen->rung, row, col);
	float baseline = pen->layout->row[row].wire +
			 (up > RUNG_HALF ? -up - 4 : BELOW_BASELINE);
	struct live_value value;

	if (pen_note(pen, row, rung_layout_column(pen->layout, row, col)))
		return; /* it stands there */
	if (scene->live && scene->live->value &&
	    scene->live->value(scene->live->context, row, col, &value)) {
		pen_text(pen, TOKEN_ACCENT, LETTER_VALUE,
			 lettering_fit(pen->drafting->lettering, LETTER_VALUE, value.text,
				       -1, room), x, baseline);
		return;
	}
	if (scene->reference && word_row(cell->word)->place == PLACE_LAST)
		draw_reference(pen, row, col, x);
	else
		pen_text(pen, TOKEN_COMMENT, LETTER_PIN,
			 rung_element_comment(pen->drafting, cell, room), x, baseline);
}

static void draw_shape(const struct pen *pen, int row, int col)
{
	const struct rung_layout *layout = pen->layout;
	const struct cell *cell = rung_at(pen->rung, row, col);
	const struct word_row *word = word_row(cell->word);
	int column = rung_layout_column(layout, row, col);
	float width = layout->column_width[column], y = layout->row[row].wire;
	unsigned int live = pen_live(pen, row, col), left = pen_net(pen, row, col);
	bool last = word->place == PLACE_LAST;
	struct glyph glyph = { .strokes = word->glyph, .y = y, .half = glyph_half(word),
			       .x = layout->column_x[column] + width / 2,
			       .wire = shape_wire(pen, word, live), .up = RUNG_HALF,
			       .lit = live & LIVE_CLOSED };

	struct rung_framed framed;

	if (rung_is_framed(word)) {
		framed = rung_framed(pen->drafting, cell);
		glyph.framed = &framed;
		glyph.half = framed.width / 2 + FRAMED_SIDE;
		glyph.up = framed.up;
	} else if (word->operand == OPND_NONE) {
		glyph.inside = word->word;
		glyph.letter = LETTER_TYPE;
	}
	pen_line(pen, pen_wire(pen, left), rung_layout_bar(layout, row, col), y,
		 glyph.x - glyph.half, y);
	pen_line(pen, pen_wire(pen, last ? left : live), glyph.x + glyph.half, y,
		 rung_layout_bar(layout, row, col + 1), y);
	if (live & LIVE_FRESH)
		picture_fill(pen->picture, TOKEN_ACCENT, pen->theme->wash,
			     glyph.x - glyph.half - 4, y - glyph.up - 2,
			     2 * glyph.half + 8, 2 * glyph.up + 4);
	glyph_draw(pen, &glyph);
	draw_label(pen, row, col, glyph.x);
	draw_below(pen, row, col, glyph.x, width - 8 - 2 * pen->drafting->beside, glyph.up);
}

void grid_draw_element(const struct pen *pen, int row, int col)
{
	const struct cell *cell = rung_at(pen->rung, row, col);
	const struct word_row *word = words_row(&pen->drafting->project->words, cell->word);
	float y = pen->layout->row[row].wire;

	if (word->kind != WORD_ELEM)
		grid_draw_box(pen, row, col);
	else if (word->place == PLACE_WIRE)
		pen_line(pen, pen_wire(pen, pen_net(pen, row, col)),
			 rung_layout_bar(pen->layout, row, col), y,
			 rung_layout_bar(pen->layout, row, col + 1), y);
	else if (word->place != PLACE_NONE && word->place != PLACE_PIN)
		draw_shape(pen, row, col);
}
