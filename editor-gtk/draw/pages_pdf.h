/* SPDX-License-Identifier: MIT
 *
 * pages_pdf - the pages of a project as a PDF in memory.
 *
 * Who wants a file writes it with disk_save(): it is whole, or what was there stays.
 */
#ifndef EDITOR_PAGES_PDF_H
#define EDITOR_PAGES_PDF_H

#include "editor-gtk/draw/pages.h"

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
