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

#include <gtk/gtk.h>

#include "editor-gtk/document/document.h"

#define LADDER_TYPE_IOMAP_VIEW (ladder_iomap_view_get_type())
G_DECLARE_FINAL_TYPE(LadderIomapView, ladder_iomap_view, LADDER, IOMAP_VIEW, GtkBox)

/**
 * ladder_iomap_view_new - a view of @buffer
 * @text: the widget that shows the buffer as text; its switch is here
 * @document: whose inputs and outputs are meant; NULL: none
 */
GtkWidget *ladder_iomap_view_new(GtkTextBuffer *buffer, GtkWidget *text,
				 LadderDocument *document);
/** ladder_iomap_view_is_text - is that shown, and not the table? Signal "turned" when it is
 * the other. */
bool ladder_iomap_view_is_text(LadderIomapView *view);
/** ladder_iomap_view_list - the rows shown (LadderPanelRow). Borrowed. */
GListModel *ladder_iomap_view_list(LadderIomapView *view);
/** ladder_iomap_view_refresh - now, seen or not. */
void ladder_iomap_view_refresh(LadderIomapView *view);
/** ladder_iomap_view_commit - what a person is typing in a cell counts now. */
void ladder_iomap_view_commit(LadderIomapView *view);
/** ladder_iomap_view_message - what stands below the table; "": nothing. Borrowed. */
const char *ladder_iomap_view_message(LadderIomapView *view);

#endif
