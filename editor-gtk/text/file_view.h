/* SPDX-License-Identifier: MIT
 *
 * file_view - shows a text file beside the project: as text, or behind a table of it.
 */
#ifndef EDITOR_FILE_VIEW_H
#define EDITOR_FILE_VIEW_H

#include "editor-gtk/document/side_file.h"

#define LADDER_TYPE_FILE_VIEW (ladder_file_view_get_type())
G_DECLARE_FINAL_TYPE(LadderFileView, ladder_file_view, LADDER, FILE_VIEW, GtkBox)

/** ladder_file_view_new - @file: referenced by the view. @table: makes a widget around @text,
 * the widget with the text; NULL: only the text. */
GtkWidget *ladder_file_view_new(LadderSideFile *file,
				GtkWidget *(*table)(LadderSideFile *file, GtkWidget *text));
/** ladder_file_view_file - Borrowed. */
LadderSideFile *ladder_file_view_file(LadderFileView *view);
/** ladder_file_view_table - the widget that @table made; NULL: none. Borrowed. */
GtkWidget *ladder_file_view_table(LadderFileView *view);
/** ladder_file_view_clear_flaws - removes all errors. */
void ladder_file_view_clear_flaws(LadderFileView *view);
/** ladder_file_view_add_flaw - underlines a line, and shows @text below while the cursor is
 * on it. Both follow the line. @line, @column: 1-based, bytes; column 0: the whole line. */
void ladder_file_view_add_flaw(LadderFileView *view, int line, int column, const char *text);
/** ladder_file_view_go - moves the cursor to a line, 1-based, and takes the focus. */
void ladder_file_view_go(LadderFileView *view, int line);

#endif
