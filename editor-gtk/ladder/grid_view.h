/* SPDX-License-Identifier: MIT
 *
 * grid_view - a sheet: the rungs of one POU, with a cursor.
 *
 * It shows what rung_layout and grid_draw make, turns keys and gestures into the edits of
 * grid_edit, and hands the new rungs to the document. The meaning of elements is the
 * engine's; questions about an element are asked in the popup at its place.
 */
#ifndef EDITOR_GRID_VIEW_H
#define EDITOR_GRID_VIEW_H

#include "editor-gtk/canvas/canvas.h"
#include "editor-gtk/draw/rung_layout.h"

#define LADDER_TYPE_GRID_VIEW (ladder_grid_view_get_type())
G_DECLARE_FINAL_TYPE(LadderGridView, ladder_grid_view, LADDER, GRID_VIEW, LadderCanvas)

/* Where the cursor is: a display cell (grid_display.h) of a rung, all 0-based. */
struct grid_cursor {
	int rung, row, col;
};

/** ladder_grid_view_new - shows POU @pou of @document; scrolls by itself, in a
 * GtkScrolledWindow. */
GtkWidget *ladder_grid_view_new(LadderDocument *document, int pou);
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
/** ladder_grid_view_tip - what there is to know of a cell of a rung, 0-based: name,
 * address, type, comment, why it is wrong; NULL: nothing. Caller frees. */
char *ladder_grid_view_tip(LadderGridView *view, int rung, int row, int col);

/** ladder_grid_view_has_begun - a line, a wire or a selection, that Esc ends. */
bool ladder_grid_view_has_begun(LadderGridView *view);
/** ladder_grid_view_put - an element of the palette at the cursor. */
void ladder_grid_view_put(LadderGridView *view, enum word word);

void ladder_grid_view_set_show(LadderGridView *view, enum drafting_show show);
enum drafting_show ladder_grid_view_show(LadderGridView *view);
/** ladder_grid_view_set_found - marks what a search found; @rung -1: nothing. */
void ladder_grid_view_set_found(LadderGridView *view, int rung, int row, int col);

/** ladder_grid_view_drag - what a palette tile offers to be dropped on a sheet. */
GdkContentProvider *ladder_grid_view_drag(enum word word);

/* ---- while it simulates ---- */

/** ladder_grid_view_set_instance - whose body is shown, of a function block: "Line.Belt1";
 * NULL: the first one. */
void ladder_grid_view_set_instance(LadderGridView *view, const char *instance);
/** ladder_grid_view_instance - NULL: it is no block, has no instance, or nothing runs.
 * Borrowed until the program changes. */
const char *ladder_grid_view_instance(LadderGridView *view);

/* A cell that keeps power from where it is wanted, 0-based, of the rung. */
struct grid_blocker {
	int row, col;
	const char *note;   /* short: "must be on"; NULL: none                  */
};
/** ladder_grid_view_set_blockers - marks these cells of a rung, and no others; of rung -1:
 * none. Copies are made. They stay until the rung is edited or others are set. */
void ladder_grid_view_set_blockers(LadderGridView *view, int rung,
				   const struct grid_blocker *cells, int count);

/** ladder_grid_view_drawn - how many rungs were drawn since the view was made. */
guint ladder_grid_view_drawn(LadderGridView *view);
/** ladder_grid_view_live - LIVE_… bits (grid_draw.h) of a cell as it is shown, and its
 * value's text, if there is one; false: nothing of it is shown. @text: 48 bytes. */
bool ladder_grid_view_live(LadderGridView *view, int rung, int row, int col,
			   unsigned int *bits, char *text);

#endif
