/* SPDX-License-Identifier: MIT
 *
 * print - prints the pages of a project, and copies a rung as a picture.
 *
 * The pages are those of the PDF (pages.h). The caller runs the operation and decides
 * whether to show a dialog.
 */
#ifndef EDITOR_PRINT_H
#define EDITOR_PRINT_H

#include "editor-gtk/draw/pages.h"

#include <gtk/gtk.h>

/**
 * print_operation_new - pages for gtk_print_operation_run()
 * @file: its name in the title block
 * @pou:  index of the only POU to print; -1: all
 * @date: in the title block; NULL: none
 *
 * @project must outlive the operation unchanged. The page setup gives the paper. Owns: the
 * caller, g_object_unref.
 */
GtkPrintOperation *print_operation_new(const struct project *project, const char *file,
				       int pou, enum drafting_show show, const char *date);

/**
 * print_pdf - all pages as a PDF in memory, on the usual paper of the locale
 * @file: its name in the title block
 * @date: in the title block; NULL: none
 *
 * Owns: the caller, g_bytes_unref.   Fails: NULL, out of memory.
 */
GBytes *print_pdf(const struct project *project, const char *file,
		  enum drafting_show show, const char *date);

/**
 * print_rung_picture - a rung as SVG and PNG, for the clipboard or a drag
 * @index: of the sheet
 * @scale: of the PNG
 *
 * Owns: the caller, g_object_unref; NULL: there is no such rung.
 */
GdkContentProvider *print_rung_picture(const struct sheet *sheet, int index,
				       const struct theme *theme, float scale);
/** print_rung_svg, print_rung_png - the bytes of the two. Owns: the caller, g_bytes_unref.
 * Fails: a PNG is NULL when memory is out. */
GBytes *print_rung_svg(const struct sheet *sheet, int index, const struct theme *theme);
GBytes *print_rung_png(const struct sheet *sheet, int index, const struct theme *theme,
		       float scale);

#endif
