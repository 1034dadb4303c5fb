/* SPDX-License-Identifier: MIT
 *
 * sfc_view - the sheet of a chart, with a cursor.
 *
 * It draws by sfc_sheet and sfc_draw, turns keys and gestures into edits of sfc_edit, and gives
 * their texts to the document. It needs a GtkScrolledWindow around it.
 *
 * Signals, besides those of the canvas:
 *   body-wanted (int first, int count)  show these rungs of the POU for editing; count 0: a
 *                                       body without rungs, which begins in line first of the file
 */
#ifndef EDITOR_SFC_VIEW_H
#define EDITOR_SFC_VIEW_H

#include "editor-gtk/canvas/canvas.h"
#include "editor-gtk/document/find.h"
#include "editor-gtk/draw/sfc_tool.h"

#define LADDER_TYPE_SFC_VIEW (ladder_sfc_view_get_type())
G_DECLARE_FINAL_TYPE(LadderSfcView, ladder_sfc_view, LADDER, SFC_VIEW, LadderCanvas)

/** ladder_sfc_view_new - shows POU @pou of @document, a chart. */
GtkWidget *ladder_sfc_view_new(LadderDocument *document, int pou);

/** ladder_sfc_view_place - what a person does with a tool of the palette, at the cursor. */
void ladder_sfc_view_place(LadderSfcView *view, enum sfc_tool tool);
/** ladder_sfc_view_drag - the drag content of a tool. Owns: the caller. */
GdkContentProvider *ladder_sfc_view_drag(int tool);
/** ladder_sfc_view_why - asks for the condition of the transition at the cursor as rungs,
 * by "body-wanted"; false: the cursor is on none. */
bool ladder_sfc_view_why(LadderSfcView *view);
/** ladder_sfc_view_go - moves the cursor to the shape with @rung (0-based). */
void ladder_sfc_view_go(LadderSfcView *view, int rung);
/** ladder_sfc_view_go_row - moves it to the shape of a line of the POU's text, 0-based from its
 * heading. Does nothing for a line without step, transition or action. */
void ladder_sfc_view_go_row(LadderSfcView *view, int row);
/** ladder_sfc_view_row - the line of the cursor, counted so; -1: none. */
int ladder_sfc_view_row(LadderSfcView *view);
/** ladder_sfc_view_is_at - is the cursor where ladder_sfc_view_go_row() would move it? */
bool ladder_sfc_view_is_at(LadderSfcView *view, int row);
/** ladder_sfc_view_set_found - marks the hits of a search in the chart. */
void ladder_sfc_view_set_found(LadderSfcView *view, const struct find_seen *seen);
/** ladder_sfc_view_use - of the name at the cursor: a step, what a line does, the first
 * name of a condition, a transition; NULL: there is none. Borrowed from @xref. */
const struct xref_use *ladder_sfc_view_use(LadderSfcView *view, const struct xref *xref);

#endif
