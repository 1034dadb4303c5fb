/* SPDX-License-Identifier: MIT
 *
 * fbd_view - the sheet of a function block diagram: its networks one below the other, with a cursor.
 *
 * It draws by fbd_layout and fbd_draw, turns keys and gestures into edits of fbd_edit, and gives their
 * texts to the document. It needs a GtkScrolledWindow around it.
 */
#ifndef EDITOR_FBD_VIEW_H
#define EDITOR_FBD_VIEW_H

#include "editor-gtk/canvas/canvas.h"
#include "editor-gtk/document/find.h"

#define LADDER_TYPE_FBD_VIEW (ladder_fbd_view_get_type())
G_DECLARE_FINAL_TYPE(LadderFbdView, ladder_fbd_view, LADDER, FBD_VIEW, LadderCanvas)

/** ladder_fbd_view_new - shows POU @pou of @document, in FBD. */
GtkWidget *ladder_fbd_view_new(LadderDocument *document, int pou);

/** ladder_fbd_view_put - what a person does with a word of the palette, at the cursor. */
void ladder_fbd_view_put(LadderFbdView *view, enum word word);
/** ladder_fbd_view_drag - the drag content of a word. Owns: the caller. */
GdkContentProvider *ladder_fbd_view_drag(int word);
/** ladder_fbd_view_go - moves the cursor to a network, 0-based. */
void ladder_fbd_view_go(LadderFbdView *view, int network);
/** ladder_fbd_view_network - that of the cursor; -1: there is none. */
int ladder_fbd_view_network(LadderFbdView *view);
/** ladder_fbd_view_count - how many networks there are. */
int ladder_fbd_view_count(LadderFbdView *view);
/** ladder_fbd_view_go_row - moves it to the box or pin of a line of the POU's text, 0-based from its heading.
 * @col: byte of the line, 0-based; -1: any. Does nothing for a line without one. */
void ladder_fbd_view_go_row(LadderFbdView *view, int row, int col);
/** ladder_fbd_view_row - the line of the cursor, counted so; -1: none. */
int ladder_fbd_view_row(LadderFbdView *view);
/** ladder_fbd_view_is_at - is the cursor in that line? */
bool ladder_fbd_view_is_at(LadderFbdView *view, int row);
/** ladder_fbd_view_set_found - marks the hits of a search in the networks. */
void ladder_fbd_view_set_found(LadderFbdView *view, const struct find_seen *seen);
/** ladder_fbd_view_use - of the name at the cursor; NULL: there is none. Borrowed from @xref. */
const struct xref_use *ladder_fbd_view_use(LadderFbdView *view, const struct xref *xref);
/** ladder_fbd_view_word - the word of the box at the cursor, "TON"; NULL: none. Borrowed until the next change. */
const char *ladder_fbd_view_word(LadderFbdView *view);
/** ladder_fbd_view_why - why the BOOL at the cursor is TRUE or FALSE, in the scan that is shown; of an instance also why
 * its first BOOL input is. Caller frees; NULL: there is none, or its values are unknown. */
char *ladder_fbd_view_why(LadderFbdView *view);

#endif
