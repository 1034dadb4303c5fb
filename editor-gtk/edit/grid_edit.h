/* SPDX-License-Identifier: MIT
 *
 * grid_edit - the edits of a rung: each makes a new rung of an old one.
 *
 * No toolkit, no document, no undo: the old rung never changes, the new one is in normal
 * form. Places are display cells (grid_display.h), 0-based, on a sheet of grid_at.columns
 * columns. Outputs stand in the last column and nothing else does.
 *
 * "Element" includes a box with its rows of pins.
 * Owns: a returned rung is the caller's, rung_free(). None is scan-safe.
 * Fails: NULL, and grid_at.refusal says why; nothing else changed.
 */
#ifndef EDITOR_GRID_EDIT_H
#define EDITOR_GRID_EDIT_H

#include "editor-gtk/edit/grid_display.h"
#include "engine/model/project.h"

/* Why an edit was refused; texts for the status bar in grid_refusal.def. */
enum grid_refusal {
#define REFUSAL(id, text) GRID_##id,
#include "editor-gtk/edit/grid_refusal.def"
	GRID_REFUSAL_COUNT
};
/** grid_refusal_text - "only an output can stand in the last column"; not translated:
 * hand it to _(). Lives for ever. */
const char *grid_refusal_text(enum grid_refusal refusal);

/* The place of an edit; afterwards the place for the cursor. */
struct grid_at {
	int columns;               /* of the sheet, grid_display_columns()     */
	int row, col;              /* display cell; out: of the new element    */
	enum grid_refusal refusal; /* out: GRID_DONE or why not                */
};

/* Display cells from corner to corner, both included; first <= last. */
struct grid_area { int row, col, last_row, last_col; };

enum grid_way { GRID_LEFT, GRID_RIGHT, GRID_UP, GRID_DOWN };

/* ---- elements ---- */

/* Where the element that is in the cell goes. */
enum grid_how {
	GRID_REPLACE, /* it is replaced                                       */
	GRID_INSERT,  /* it moves to the right                                */
};

/**
 * grid_place - puts an element at a cell
 * @cell: its link and spare are ignored
 *
 * An element goes to an empty cell or into a wire. Wires are added: leftwards up to an
 * element, a linked bar or the rail, rightwards to the next element without power.
 * An output always goes to the last column: of this row, or of a new row below if an output
 * stands there and is not replaced. A box for the last column goes behind the last element
 * of its row. Columns and rows are added when needed.
 */
struct rung *grid_place(const struct rung *rung, struct grid_at *at, struct cell cell,
			enum grid_how how);
/**
 * grid_parallel - puts an element below the one at the cursor, joined at both ends
 * @area: cells of one row to go around; NULL: the element at @at
 *
 * Below an output only an output can stand; an output below another element gets a branch
 * behind it. If wires block the way down, such as those that feed pins of a box, the branch
 * goes above.
 */
struct rung *grid_parallel(const struct rung *rung, struct grid_at *at,
			   const struct grid_area *area, struct cell cell);
/** grid_set - gives the element at the cursor this word, operand, parameters and comment,
 * and leaves it in its place with its pin rows. The word must belong to the same place
 * (grid_place() for others). */
struct rung *grid_set(const struct rung *rung, struct grid_at *at, struct cell cell);

/**
 * grid_negate - NO to NC, COIL to COILNOT, P to N, and back
 * @project: a comparison gets the opposite operator, or NOT ( ) where that would differ
 *           (REAL); its text is stored there
 * @pou:     for the types of names
 */
struct rung *grid_negate(const struct rung *rung, struct grid_at *at,
			 struct project *project, const struct pou *pou);
/** grid_cycle - the next kind of its family: NO NC P N, COIL COILNOT S R COILP COILN. */
struct rung *grid_cycle(const struct rung *rung, struct grid_at *at);
/** grid_word_negated - the word that grid_negate() makes of @word; @word itself if there is
 * none. */
enum word grid_word_negated(enum word word);

/* ---- deleting ---- */

/** grid_delete - deletes the element or wire at the cursor. A wire stays where power must
 * pass; an empty branch is deleted with its row. */
struct rung *grid_delete(const struct rung *rung, struct grid_at *at);
/** grid_delete_area - deletes all elements in an area, or its wires and links if it has
 * none. */
struct rung *grid_delete_area(const struct rung *rung, struct grid_at *at,
			      const struct grid_area *area);
/* Whole rows and columns at the cursor; new ones are inserted before it. The last column
 * cannot be deleted. */
struct rung *grid_delete_row(const struct rung *rung, struct grid_at *at);
struct rung *grid_delete_column(const struct rung *rung, struct grid_at *at);
struct rung *grid_insert_row(const struct rung *rung, struct grid_at *at);
struct rung *grid_insert_column(const struct rung *rung, struct grid_at *at);

/* ---- wires ---- */

/**
 * grid_wire - draws a wire from the cursor, or erases the one that is there
 *
 * Left and right: in the cursor's own cell if it has no element, else in the next one. Up
 * and down: joins the right end of the cell with the row above or below. The cursor follows
 * the wire.
 */
struct rung *grid_wire(const struct rung *rung, struct grid_at *at, enum grid_way way);

/* An end of wire: bar b of a row is the left end of its display cell b. */
struct grid_end { int row, bar; };

/**
 * grid_draw_wire - draws a wire from one end of cells to another
 * @from, @to: in the last column their bar is left of the output; the row below the last
 * one is made
 * @along:     at the corner: first up or down and then across, if both are possible
 *
 * In one row it goes around elements in between, as a branch in its own row. It never goes
 * through an element; wires that it touches are joined. The cursor goes behind its end, or
 * to the first cell of the branch.
 */
struct rung *grid_draw_wire(const struct rung *rung, struct grid_at *at,
			    struct grid_end from, struct grid_end to, bool along);
/** grid_erase_wire - deletes wires and links on the way of such a stroke, no elements. */
struct rung *grid_erase_wire(const struct rung *rung, struct grid_at *at,
			     struct grid_end from, struct grid_end to, bool along);

enum grid_course {
	GRID_NO_COURSE, /* elements are in the way                             */
	GRID_ACROSS,    /* first to the left or right                          */
	GRID_ALONG,     /* first up or down                                    */
	GRID_ROUND,     /* around elements in between, below them              */
	GRID_OVER,      /* the same above them                                 */
};
/** grid_wire_course - the course that grid_draw_wire() would take. */
enum grid_course grid_wire_course(const struct rung *rung, int columns,
				  struct grid_end from, struct grid_end to, bool along);
/** grid_wire_ends - the possible ends of a wire from @from: @legal has @rows * @columns,
 * for each row the bars 0 … @columns - 1. */
void grid_wire_ends(const struct rung *rung, int columns, struct grid_end from,
		    int rows, bool *legal);
/** grid_open_branch - a link from the left end of the cursor's cell down to a row with
 * room, where the cursor goes. */
struct rung *grid_open_branch(const struct rung *rung, struct grid_at *at);
/** grid_close_gaps - gives every element without a wire at its left end one. */
struct rung *grid_close_gaps(const struct rung *rung, struct grid_at *at);

/* ---- pins of boxes ---- */

/**
 * grid_add_pin - adds a row for a further Boolean input below the box at the cursor, which
 * may be in any row of its pins
 * @pin:  string id of its name
 * @feed: its feeding element, to its left; NULL: none yet
 *
 * The cursor goes to the feeding element, or to its place.
 */
struct rung *grid_add_pin(const struct rung *rung, struct grid_at *at,
			  const struct project *project, uint32_t pin,
			  const struct cell *feed);

/* ---- blocks ---- */

/** grid_copy - an area as a rung of its own, for the clipboard (ladder_write_rung); its
 * left edge becomes the rail. NULL: nothing stands there, or memory is out. */
struct rung *grid_copy(const struct rung *rung, int columns,
		       const struct grid_area *area);
/**
 * grid_paste - inserts the cells of another rung at the cursor
 * @part:     its string ids are of the same project; label, title and comment are ignored
 * @parallel: as a branch below the element at the cursor; else in series: on a wire or an
 *            empty cell, or before an element
 *
 * A part with outputs and other elements becomes rows of its own; a part of outputs alone
 * goes into the row.
 */
struct rung *grid_paste(const struct rung *rung, struct grid_at *at,
			const struct rung *part, bool parallel);

/** grid_is_outputs - does it hold only outputs? Without a condition they would always be
 * on. */
bool grid_is_outputs(const struct rung *rung);

/* Where a dropped element goes. */
enum grid_drop {
	GRID_DROP_NOT,      /* nothing: no legal place                         */
	GRID_DROP_THERE,    /* goes into the empty cell                        */
	GRID_DROP_WIRE,     /* into the wire                                   */
	GRID_DROP_BEFORE,   /* before the element there                        */
	GRID_DROP_BELOW,    /* in parallel to the element above                */
	GRID_DROP_OUTPUT,   /* into the last column, perhaps in a row below    */
};
/** grid_can_drop - how can an element of @word be dropped at display cell (@row, @col)? */
enum grid_drop grid_can_drop(const struct rung *rung, int columns, int row, int col,
			     enum word word);
/** grid_takes - the same for all display cells: can it be dropped there?
 * @takes: @rows * @columns, by row; a row below the rung counts
 * Fails: false, and all cells are false, if there is no memory. */
bool grid_takes(const struct rung *rung, int columns, int rows, enum word word, bool *takes);
/** grid_drop - drops it as grid_can_drop() says. */
struct rung *grid_drop(const struct rung *rung, struct grid_at *at, struct cell cell);
/**
 * grid_move - moves the element at @from to @to
 * @source: gets the rung it came from without it, unless both are the same rung
 * @target: the rung it goes to; @rung itself: within the rung
 *
 * Returns the new target. Rows of pins stay behind with the elements that feed them.
 */
struct rung *grid_move(const struct rung *rung, struct grid_at *from,
		       const struct rung *target, struct grid_at *to,
		       struct rung **source);
/**
 * grid_move_area - moves all elements of an area
 * @to: the place of its upper left corner, as for grid_paste() with @parallel
 */
struct rung *grid_move_area(const struct rung *rung, struct grid_at *from,
			    const struct grid_area *area, const struct rung *target,
			    struct grid_at *to, bool parallel, struct rung **source);

/* ---- normal form ---- */

/**
 * grid_normalise - the same circuit in normal form
 *
 * All outputs stand in one column behind everything else, with wire up to them. No column
 * before them has only wire, and no row or column at the end is empty. Gaps stay gaps: the
 * meaning never changes.
 */
struct rung *grid_normalise(const struct rung *rung);
/** grid_same - do both hold the same elements in the same order, joined the same way? False
 * also when memory is out. */
bool grid_same(const struct rung *a, const struct rung *b);
#endif
