/* SPDX-License-Identifier: MIT
 *
 * compare_view - a page that compares an older version of the project with the document, or two
 * other files: a list of differences, and the drawings of both side by side.
 *
 * It follows edits, and files and their I/O maps that are written. Actions: compare.next,
 * compare.previous, compare.go (activates win.go-to, win.open-text or win.open-path).
 */
#ifndef EDITOR_COMPARE_VIEW_H
#define EDITOR_COMPARE_VIEW_H

#include <gtk/gtk.h>

#include "editor-gtk/document/comparison.h"
#include "editor-gtk/document/document.h"

#define LADDER_TYPE_COMPARE_VIEW (ladder_compare_view_get_type())
G_DECLARE_FINAL_TYPE(LadderCompareView, ladder_compare_view, LADDER, COMPARE_VIEW, GtkWidget)

GtkWidget *ladder_compare_view_new(LadderDocument *document);
/** ladder_compare_view_show - compares two versions, which are taken over; @newer NULL: the document.
 * A side without text is read from its file, again after each change. */
void ladder_compare_view_show(LadderCompareView *view, struct compare_side *older,
			      struct compare_side *newer);
/** ladder_compare_view_step - selects the next or previous difference. */
void ladder_compare_view_step(LadderCompareView *view, bool back);
/** ladder_compare_view_enter - focuses the list. */
void ladder_compare_view_enter(LadderCompareView *view);

#endif
