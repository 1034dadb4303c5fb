/* SPDX-License-Identifier: MIT
 *
 * pages - a project on paper: pages with a title block, rungs, lists, symbols.
 *
 * PDF and print have the same pages; both use pages_paint(). It knows no
 * printer and writes no file: a PDF is bytes, disk_save() writes them.
 */
#ifndef EDITOR_PAGES_H
#define EDITOR_PAGES_H

#include "editor-gtk/kit/picture.h"
#include "editor-gtk/draw/sheet.h"

struct paper {
	float width, height;  /* mm                                              */
	const char *date;     /* text for the title block; NULL: none. No clock is
				 read: the same file gives the same pages        */
	bool landscape;
};
/** paper_find - "a4", "a3", "a5", "letter", "legal", any case; false: unknown. */
bool paper_find(const char *name, struct paper *out);

struct pages;
/**
 * pages_new - breaks a project into pages
 * @pou, @rung: index of the only POU (-1: all), 1-based number of its only rung (0: all)
 * @file:       its name in the title block
 *
 * Owns: the caller, pages_free(). @project and @lettering must live as long.
 */
struct pages *pages_new(const struct project *project, const char *file, int pou, int rung,
			enum drafting_show show, const struct paper *paper,
			struct lettering *lettering);
void pages_free(struct pages *pages);
int pages_count(const struct pages *pages);
/** pages_paint - page @page (0-based) upon a surface whose unit is 1/72 inch. */
void pages_paint(const struct pages *pages, int page, cairo_t *cr);

/**
 * pages_pdf - all of @pages, with a table of contents
 * @paper: what the pages were made for
 * @title: of the document, as a reader shows it
 * @made:  when, as ISO 8601 has it; NULL: now
 *
 * Owns: the caller, g_bytes_unref.   Fails: NULL, there is no memory for it.
 */
GBytes *pages_pdf(const struct pages *pages, const struct paper *paper, const char *title,
		  const char *made);

#endif
