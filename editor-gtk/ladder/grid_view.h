/* SPDX-License-Identifier: MIT
 *
 * grid_view - a sheet: the rungs of one POU, with a cursor.
 *
 * It shows rungs by rung_layout and grid_draw, turns keys and gestures into edits of grid_edit,
 * and gives the new rungs to the document. It knows no element by name: the catalogue of the
 * engine does.
 */
#ifndef EDITOR_GRID_VIEW_H
#define EDITOR_GRID_VIEW_H

#include "editor-gtk/canvas/canvas.h"
#include "editor-gtk/document/find.h"
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
/** ladder_grid_view_set_range - shows only @count rungs of the POU from @first on, as rungs 0
 * … @count - 1 of the sheet: a body of a chart. @count -1: all, the default. */
void ladder_grid_view_set_range(LadderGridView *view, int first, int count);
/** ladder_grid_view_range - the first one; @count gets how many, -1: all. */
int ladder_grid_view_range(LadderGridView *view, int *count);
/** ladder_grid_view_first - the same, without the count. */
int ladder_grid_view_first(LadderGridView *view);

struct grid_cursor ladder_grid_view_cursor(LadderGridView *view);
/** ladder_grid_view_go - moves the cursor and scrolls to it; @row, @col: cells of the rung,
 * as diagnostics have them, 0-based; -1: its first element. */
void ladder_grid_view_go(LadderGridView *view, int rung, int row, int col);
/** ladder_grid_view_move - moves the cursor to a display cell and scrolls to it. */
void ladder_grid_view_move(LadderGridView *view, struct grid_cursor to);
/** ladder_grid_view_rename_box - asks for another name of the EXECUTE box at the cursor. Fails: false: there
 * is none. */
bool ladder_grid_view_rename_box(LadderGridView *view);
/** ladder_grid_view_cell - the cell of the element at the cursor, 0-based; false: there is
 * no element. */
bool ladder_grid_view_cell(LadderGridView *view, int *row, int *col);
/** ladder_grid_view_tip - the tooltip of a cell of a rung, 0-based: name, address, type,
 * comment, value, errors; NULL: none. Caller frees. */
char *ladder_grid_view_tip(LadderGridView *view, int rung, int row, int col);

/** ladder_grid_view_has_begun - is there an entry, a wire or a selection that Esc ends? */
bool ladder_grid_view_has_begun(LadderGridView *view);
/** ladder_grid_view_put - puts an element of the palette at the cursor. */
void ladder_grid_view_put(LadderGridView *view, enum word word);

void ladder_grid_view_set_show(LadderGridView *view, enum drafting_show show);
enum drafting_show ladder_grid_view_show(LadderGridView *view);
/** ladder_grid_view_set_folds - are rungs that are wider than the sheet shown in lines below each other? */
void ladder_grid_view_set_folds(LadderGridView *view, bool folds);
bool ladder_grid_view_folds(LadderGridView *view);
/** ladder_grid_view_set_found - marks the hits of a search in these rungs. */
void ladder_grid_view_set_found(LadderGridView *view, const struct find_seen *seen);

/** ladder_grid_view_drag - the drag content of a palette tile. */
GdkContentProvider *ladder_grid_view_drag(enum word word);

/* ---- while simulating ---- */

/** ladder_grid_view_set_instance - of a function block: the instance whose values are shown,
 * "Line.Belt1"; NULL: the first one. */
void ladder_grid_view_set_instance(LadderGridView *view, const char *instance);
/** ladder_grid_view_instance - NULL: no block, no instance, or nothing runs.
 * Borrowed until the program changes. */
const char *ladder_grid_view_instance(LadderGridView *view);

/* A cell that blocks the power, 0-based, of the rung. */
struct grid_blocker {
	int row, col;
	const char *note;   /* short: "must be on"; NULL: none                  */
};
/** ladder_grid_view_set_blockers - marks only these cells, in @rung; -1: none. Copies them.
 * The marks stay until the rung is edited or others are set. */
void ladder_grid_view_set_blockers(LadderGridView *view, int rung,
				   const struct grid_blocker *cells, int count);


#endif
