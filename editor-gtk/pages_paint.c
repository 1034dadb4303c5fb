/* SPDX-License-Identifier: MIT
 *
 * pages_paint - one page upon a cairo surface, with its title block.
 */
#include "editor-gtk/i18n.h"
#include "editor-gtk/pages_inside.h"

static void paint_piece(const struct pages *pages, const struct piece *piece, cairo_t *cr)
{
	cairo_save(cr);
	cairo_translate(cr, PAGE_MARGIN, (double)(PAGE_MARGIN + piece->y));
	cairo_scale(cr, (double)piece->scale, (double)piece->scale);
	if (piece->right > 0)
		cairo_rectangle(cr, (double)piece->x, 0, (double)(piece->right - piece->left),
				(double)(piece->to - piece->from));
	else
		cairo_rectangle(cr, -PAGE_MARGIN, 0, (double)(pages->width / piece->scale),
				(double)(piece->to - piece->from));
	cairo_clip(cr);
	cairo_translate(cr, (double)(piece->x - piece->left), (double)-piece->from);
	picture_cairo(piece->picture, pages->theme, pages->lettering, cr);
	cairo_restore(cr);
}

/* A field of the title block: what it is in small type, and its text. */
static void field(const struct pages *pages, struct picture *picture, float x, float end,
		  const char *what, const char *text)
{
	const float room = end - x - 16;
	const bool wide = lettering_fit(pages->lettering, LETTER_SYMBOL, text, -1, 0).width >
			  room;
	const enum letter letter = wide ? LETTER_BADGE : LETTER_SYMBOL;

	if (end < pages->room_width)
		picture_line(picture, TOKEN_INK, STROKE_SOLID, 0.75f, end, 0, end, 36);
	picture_text(picture, TOKEN_COMMENT, LETTER_BADGE,
		     lettering_fit(pages->lettering, LETTER_BADGE, what, -1, room), x + 8,
		     12);
	picture_text(picture, TOKEN_INK, letter,
		     lettering_fit(pages->lettering, letter, text, -1, room), x + 8, 29);
}

static void title_block(const struct pages *pages, int page, struct picture *picture)
{
	const struct page *this = g_ptr_array_index(pages->page, page);
	const char *title = project_text(pages->project, pages->project->title);
	float width = pages->room_width, part = width / 100;
	char *count = g_strdup_printf(_("%d of %d"), page + 1, pages_count(pages));
	float date = pages->date ? 70 : 86;

	picture_move(picture, PAGE_MARGIN, pages->height - PAGE_MARGIN - 36);
	picture_frame(picture, TOKEN_INK, STROKE_SOLID, 0.75f, 0, 0, width, 36);
	field(pages, picture, 0, 34 * part, _("Project"), *title ? title : pages->file);
	field(pages, picture, 34 * part, 56 * part, _("File"), pages->file);
	field(pages, picture, 56 * part, date * part, _("Program unit"),
	      this->subject ? this->subject : "");
	if (pages->date)
		field(pages, picture, date * part, 86 * part, _("Date"), pages->date);
	field(pages, picture, 86 * part, width, _("Page"), count);
	g_free(count);
}

void pages_paint(const struct pages *pages, int page, cairo_t *cr)
{
	const struct page *this = g_ptr_array_index(pages->page, page);
	struct picture picture;

	cairo_save(cr);
	cairo_scale(cr, 0.75, 0.75); /* px of 1/96 inch to points */
	for (guint i = 0; i < this->piece->len; i++)
		paint_piece(pages, &g_array_index(this->piece, struct piece, i), cr);
	picture_init(&picture);
	title_block(pages, page, &picture);
	picture_cairo(&picture, pages->theme, pages->lettering, cr);
	picture_clear(&picture);
	cairo_restore(cr);
}
