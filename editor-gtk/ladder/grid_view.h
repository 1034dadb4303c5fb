/* SPDX-License-Identifier: MIT
 *
 * grid_view - a sheet: the rungs of one POU, with a cursor.
 *
 * It shows what rung_layout and grid_draw make, turns keys and gestures into the edits of
 * grid_edit, and hands the new rungs to the document. It knows no meaning and asks nobody
 * anything: what an element is asked for is asked in the entry at its place.
 *
 * Signals:
 *   cursor-moved ()
 *   told (const char *text)  why something was not done, or what the next key does
 *   zoom-changed ()
 */
#ifndef EDITOR_GRID_VIEW_H
#define EDITOR_GRID_VIEW_H

#include "editor-gtk/document/document.h"
#include "editor-gtk/draw/rung_layout.h"
#include "editor-gtk/kit/verbs.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_GRID_VIEW (ladder_grid_view_get_type())
G_DECLARE_FINAL_TYPE(LadderGridView, ladder_grid_view, LADDER, GRID_VIEW, GtkWidget)

/* Where the cursor is: a display cell (grid_display.h) of a rung, all 0-based. */
struct grid_cursor {
	int rung, row, col;
};

/** ladder_grid_view_new - shows POU @pou of @document; scrolls by itself, in a
 * GtkScrolledWindow. */
GtkWidget *ladder_grid_view_new(LadderDocument *document, int pou);
/** ladder_grid_view_document - whose rungs it shows. Borrowed. */
LadderDocument *ladder_grid_view_document(LadderGridView *view);
int ladder_grid_view_pou(LadderGridView *view);
/** ladder_grid_view_set_pou - when POUs were added or removed before it. */
void ladder_grid_view_set_pou(LadderGridView *view, int pou);

/** ladder_grid_view_set_range - only these rungs of its POU are shown and edited, as rungs 0
 * … @count - 1 of the sheet: a body of a chart. @count -1: all, as at first. */
void ladder_grid_view_set_range(LadderGridView *view, int first, int count);
/** ladder_grid_view_range - the first one; @count gets how many, -1: all. */
int ladder_grid_view_range(LadderGridView *view, int *count);
/** ladder_grid_view_first - the same: what a cursor's rung is counted from. */
int ladder_grid_view_first(LadderGridView *view);

struct grid_cursor ladder_grid_view_cursor(LadderGridView *view);
/** ladder_grid_view_go - moves the cursor and shows it; @row, @col: cells of the rung,
 * as diagnostics have them, 0-based; -1: its first element. */
void ladder_grid_view_go(LadderGridView *view, int rung, int row, int col);
/** ladder_grid_view_cell - the cell of the rung that the cursor is on, 0-based; false:
 * no element stands there. */
bool ladder_grid_view_cell(LadderGridView *view, int *row, int *col);
/** ladder_grid_view_place - "Rung 3 · column C": where the cursor is. Caller frees. */
char *ladder_grid_view_place(LadderGridView *view);

/** ladder_grid_view_keys - what the next key could do for the element at the cursor:
 * "Enter: Edit operand · /: Negate". Caller frees. */
char *ladder_grid_view_keys(LadderGridView *view);
/** ladder_grid_view_tip - what there is to know of a cell of a rung, 0-based: name,
 * address, type, comment, why it is wrong; NULL: nothing. Caller frees. */
char *ladder_grid_view_tip(LadderGridView *view, int rung, int row, int col);

/** ladder_grid_view_do - a SHEET verb. */
void ladder_grid_view_do(LadderGridView *view, enum verb verb);
/** ladder_grid_view_has_begun - a line, a wire or a selection, that Esc ends. */
bool ladder_grid_view_has_begun(LadderGridView *view);
/** ladder_grid_view_put - an element of the palette at the cursor. */
void ladder_grid_view_put(LadderGridView *view, enum word word);

double ladder_grid_view_zoom(LadderGridView *view);
/** ladder_grid_view_set_zoom - 0.5 to 3; a cursor that is in sight stays there. */
void ladder_grid_view_set_zoom(LadderGridView *view, double zoom);
void ladder_grid_view_set_show(LadderGridView *view, enum drafting_show show);
enum drafting_show ladder_grid_view_show(LadderGridView *view);
/** ladder_grid_view_set_found - marks what a search found; @rung -1: nothing. */
void ladder_grid_view_set_found(LadderGridView *view, int rung, int row, int col);

/** ladder_grid_view_drag - what a palette tile offers to be dropped on a sheet. */
GdkContentProvider *ladder_grid_view_drag(enum word word);

#endif
