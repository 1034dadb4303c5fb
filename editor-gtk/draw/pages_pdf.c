/* SPDX-License-Identifier: MIT
 *
 * pages_pdf - the pages of a project as a PDF in memory.
 */
#include "editor-gtk/draw/pages_pdf.h"

#include <cairo-pdf.h>
#include <stdio.h>
#include <string.h>

static double points(float mm)
{
	return (double)mm / 25.4 * 72;
}

/* The table of contents that a reader shows beside the pages: POUs, symbols. */
static void add_outline(cairo_surface_t *surface, const struct pages *pages, int page)
{
	const char *subject = pages_subject(pages, page);
	char place[32];

	if (page > 0 && strcmp(subject, pages_subject(pages, page - 1)) == 0)
		return;
	snprintf(place, sizeof(place), "page=%d", page + 1);
	cairo_pdf_surface_add_outline(surface, CAIRO_PDF_OUTLINE_ROOT, subject, place, 0);
}

static void paint(cairo_surface_t *surface, const struct pages *pages)
{
	cairo_t *cr = cairo_create(surface);

	for (int page = 0; page < pages_count(pages); page++) {
		pages_paint(pages, page, cr);
		add_outline(surface, pages, page);
		cairo_show_page(cr);
	}
	cairo_destroy(cr);
}

GBytes *pages_pdf(const struct pages *pages, const struct paper *paper, const char *title,
		  const char *made)
{
	GByteArray *bytes = g_byte_array_new();
	const float width = paper->landscape ? paper->height : paper->width;
	const float height = paper->landscape ? paper->width : paper->height;
	cairo_surface_t *surface = cairo_pdf_surface_create_for_stream(picture_append, bytes,
		points(width), points(height));
	bool good;

	if (made)
		cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, made);
	cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, title);
	paint(surface, pages);
	cairo_surface_finish(surface);
	good = cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS;
	cairo_surface_destroy(surface);
	if (good)
		return g_byte_array_free_to_bytes(bytes);
	g_byte_array_unref(bytes);
	return NULL;
}
