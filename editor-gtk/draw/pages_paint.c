/* SPDX-License-Identifier: MIT
 *
 * pages_paint - one page upon a cairo surface.
 */
#include "editor-gtk/draw/pages_inside.h"

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

void pages_paint(const struct pages *pages, int page, cairo_t *cr)
{
	const struct page *this = g_ptr_array_index(pages->page, page);
	struct picture picture;

	cairo_save(cr);
	cairo_scale(cr, 0.75, 0.75); /* px of 1/96 inch to points */
	for (guint i = 0; i < this->piece->len; i++)
		paint_piece(pages, &g_array_index(this->piece, struct piece, i), cr);
	picture_init(&picture);
	if (pages_title_height(pages) > 0)
		pages_draw_title(pages, page, &picture);
	picture_cairo(&picture, pages->theme, pages->lettering, cr);
	picture_clear(&picture);
	cairo_restore(cr);
}
