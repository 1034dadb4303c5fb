/* SPDX-License-Identifier: MIT
 *
 * iomap_view - an I/O map as a table, or as its text: one row a point, edited in place.
 *
 * The text of the buffer stays the truth; every edit is one step of its undo. What is wrong
 * with a line, or what this machine does not have, stands in its row; what the program uses
 * and the map lacks, below. It reads and writes no file but the chips' lists of lines.
 */
#ifndef EDITOR_IOMAP_VIEW_H
#define EDITOR_IOMAP_VIEW_H

#include "editor-gtk/document/side_file.h"

#define LADDER_TYPE_IOMAP_VIEW (ladder_iomap_view_get_type())
G_DECLARE_FINAL_TYPE(LadderIomapView, ladder_iomap_view, LADDER, IOMAP_VIEW, GtkBox)

/** ladder_iomap_view_new - a table of @file. @text: the widget that shows it as text, on the
 * other page of the table. */
GtkWidget *ladder_iomap_view_new(LadderSideFile *file, GtkWidget *text);
/** ladder_iomap_view_is_text - does it show the text, not the table? Signal "turned" when
 * that changes. */
bool ladder_iomap_view_is_text(LadderIomapView *view);

#endif
