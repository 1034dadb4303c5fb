/* SPDX-License-Identifier: MIT
 *
 * grid_canvas - a rung spread out as it is shown, while an edit works on it.
 *
 * On a canvas a display cell is a cell: outputs stand in the last column, with real
 * wire up to them. Only edit/grid_*.c include this. After the first refusal a canvas does
 * nothing more.
 */
#ifndef EDITOR_GRID_CANVAS_H
#define EDITOR_GRID_CANVAS_H

#include "editor-gtk/edit/grid_edit.h"
#include "engine/model/network.h"

/* Marks in cell.spare, which is 0 in every rung that these files return. */
enum canvas_mark { CANVAS_CURSOR = 1, CANVAS_MOVED = 2 };

struct canvas {
	struct rung *rung;          /* of the canvas; replaced when it grows  */
	enum grid_refusal refusal;  /* the first one                          */
	struct arena arena;         /* of @network                            */
	struct network network;     /* of canvas_network()                    */
};

/** grid_spread - the rung with its outputs in column @columns - 1, which must be at
 * least grid_display_columns(); NULL: no memory. Owns: the caller. */
struct rung *grid_spread(const struct rung *rung, int columns);

/** canvas_open - spreads a rung out over @columns columns and at least @rows rows. Fails:
 * false; call canvas_close() all the same. */
bool canvas_open(struct canvas *c, const struct rung *rung, int columns, int rows);
/** canvas_close - gives the rung in normal form, or NULL if the canvas failed; @at gets
 * the refusal and the place of the mark CANVAS_CURSOR. */
struct rung *canvas_close(struct canvas *c, struct grid_at *at);
/** canvas_fail - first refusal wins. Returns false. */
bool canvas_fail(struct canvas *c, enum grid_refusal refusal);
/** canvas_mark - the cursor belongs to this cell. */
void canvas_mark(struct canvas *c, int row, int col);
/** canvas_network - the graph of the canvas as it is now, in c->network. */
bool canvas_network(struct canvas *c);

struct cell *canvas_cell(struct canvas *c, int row, int col);
int canvas_last(const struct canvas *c); /* number of the last column */
enum word canvas_word(const struct canvas *c, int row, int col);
/** canvas_put - the cell gets a content, with its marks, and keeps its link. */
void canvas_put(struct canvas *c, int row, int col, struct cell content);
/** canvas_clear - nothing but its link stays. */
void canvas_clear(struct canvas *c, int row, int col);
/** canvas_is_empty - neither element nor wire nor pin. */
bool canvas_is_empty(const struct canvas *c, int row, int col);
/** canvas_is_element - neither empty nor wire nor a row of pins. */
bool canvas_is_element(const struct canvas *c, int row, int col);
bool canvas_is_output(const struct canvas *c, int row, int col);

/* Bars: bar b of a row is the left end of cell b. False outside the canvas. */
bool canvas_left(const struct canvas *c, int row, int bar);  /* a cell ends there */
bool canvas_right(const struct canvas *c, int row, int bar); /* one begins there  */
bool canvas_up(const struct canvas *c, int row, int bar);    /* linked to the row above */
bool canvas_down(const struct canvas *c, int row, int bar);  /* to the row below */
bool canvas_linked(const struct canvas *c, int row, int bar);
bool canvas_bar_used(const struct canvas *c, int row, int bar);

/** canvas_rows - makes it at least so many rows high. */
bool canvas_rows(struct canvas *c, int rows);
/** canvas_replace - takes over another rung for its own; NULL: no memory. */
bool canvas_replace(struct canvas *c, struct rung *made);
bool canvas_insert_row(struct canvas *c, int at);
/** canvas_insert_column - power that crosses it gets wire; outputs stay last. */
bool canvas_insert_column(struct canvas *c, int at);
/** canvas_is_bare - is the row empty but for links? */
bool canvas_is_bare(const struct canvas *c, int row);
/** canvas_drop_row - deletes a row if it is empty and not the only one. */
void canvas_drop_row(struct canvas *c, int row);

/** canvas_close_left - wire from cell (@row, @col) leftwards to an element, a linked
 * bar or the rail. False, and nothing, if it would come to a row of pins, behind which
 * there is no power. */
bool canvas_close_left(struct canvas *c, int row, int col);
/** canvas_close_right - wire rightwards to an element without power, or a bare link. */
void canvas_close_right(struct canvas *c, int row, int col);
/** canvas_join_up - links bar @bar of @row with each row above it down from @top. */
void canvas_join_up(struct canvas *c, int top, int row, int bar);
/** canvas_prune - deletes links that lead from bar @bar of @row into nothing. Returns the
 * row where they came from. */
int canvas_prune(struct canvas *c, int row, int bar);

/** canvas_at_element - opens it, with the mark on the element at the cursor. Fails:
 * false if there is none. */
bool canvas_at_element(struct canvas *c, const struct rung *rung, struct grid_at *at);
/** canvas_place - as grid_place(), on the canvas. */
bool canvas_place(struct canvas *c, int row, int col, struct cell cell,
		  enum grid_how how);
/**
 * canvas_branch_row - a row in which cells @col … @last are free and whose bars @col and
 * @last + 1 can be linked with those of @row; made if there is none
 *
 * Below @row, or above it where a wire would have to be crossed below: @row follows when
 * a row comes before it. -1: a wire would have to cross on both sides.
 */
int canvas_branch_row(struct canvas *c, int *row, int col, int last);
/** canvas_join_branch - links bar @bar of row @branch, which canvas_branch_row() gave,
 * to the circuit of @row. */
void canvas_join_branch(struct canvas *c, int row, int branch, int bar);
/** canvas_parallel - as grid_parallel(), round the cells @col … @last. */
bool canvas_parallel(struct canvas *c, int row, int col, int last, struct cell cell);
/** canvas_delete_whole - deletes the element at (@row, @col) and rows that become empty; a
 * branch below moves up into a gap. */
void canvas_delete_whole(struct canvas *c, int row, int col);
#endif
