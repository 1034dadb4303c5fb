/* SPDX-License-Identifier: MIT
 *
 * pages - a project on paper: pages with a title block, rungs, lists, symbols.
 *
 * PDF and print have the same pages; both use pages_paint(). It uses no printer and writes
 * no file: a PDF is bytes, which disk_save() writes.
 */
#ifndef EDITOR_PAGES_H
#define EDITOR_PAGES_H

#include "editor-gtk/kit/picture.h"
#include "editor-gtk/draw/sheet.h"

struct paper {
	float width, height;  /* mm                                              */
	const char *date;     /* text for the title block; NULL: none. No clock is read, so
				 that the same file gives the same pages */
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
 * Owns: the caller, pages_free(). @project and @lettering must outlive it.
 */
struct pages *pages_new(const struct project *project, const char *file, int pou, int rung,
			enum drafting_show show, const struct paper *paper,
			struct lettering *lettering);
void pages_free(struct pages *pages);
int pages_count(const struct pages *pages);
/** pages_paint - paints page @page (0-based) on a surface with units of 1/72 inch. */
void pages_paint(const struct pages *pages, int page, cairo_t *cr);

/**
 * pages_pdf - all of @pages, with a table of contents
 * @paper: the paper of @pages
 * @title: of the document, shown by readers
 * @made:  date as in ISO 8601; NULL: now
 *
 * Owns: the caller, g_bytes_unref.   Fails: NULL, out of memory.
 */
GBytes *pages_pdf(const struct pages *pages, const struct paper *paper, const char *title,
		  const char *made);

#endif
