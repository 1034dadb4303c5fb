/* SPDX-License-Identifier: MIT
 *
 * grid_spread - a rung spread out as it is shown, while an edit works on it.
 *
 * Here a display cell is a cell: outputs stand in the last column, with real
 * wire up to them. Only edit/grid_*.c include this. After the first refusal it does
 * nothing more.
 */
#ifndef EDITOR_GRID_SPREAD_H
#define EDITOR_GRID_SPREAD_H

#include "editor-gtk/edit/grid_edit.h"
#include "engine/model/network.h"

/* Marks in cell.spare, which is 0 in every rung that these files return. */
enum spread_mark { SPREAD_CURSOR = 1, SPREAD_MOVED = 2 };

struct spread {
	struct rung *rung;          /* replaced when it grows                 */
	enum grid_refusal refusal;  /* the first one                          */
	struct arena arena;         /* of @network                            */
	struct network network;     /* of spread_network()                    */
};

/** grid_spread - the rung with its outputs in column @columns - 1, which must be at
 * least grid_display_columns(); NULL: no memory. Owns: the caller. */
struct rung *grid_spread(const struct rung *rung, int columns);

/** spread_open - spreads a rung out over @columns columns and at least @rows rows. Fails:
 * false; call spread_close() all the same. */
bool spread_open(struct spread *c, const struct rung *rung, int columns, int rows);
/** spread_close - gives the rung in normal form, or NULL if it failed; @at gets
 * the refusal and the place of the mark SPREAD_CURSOR. */
struct rung *spread_close(struct spread *c, struct grid_at *at);
/** spread_fail - first refusal wins. Returns false. */
bool spread_fail(struct spread *c, enum grid_refusal refusal);
/** spread_mark - the cursor belongs to this cell. */
void spread_mark(struct spread *c, int row, int col);
/** spread_network - the graph of the rung as it is now, in c->network. */
bool spread_network(struct spread *c);

struct cell *spread_cell(struct spread *c, int row, int col);
int spread_last(const struct spread *c); /* number of the last column */
enum word spread_word(const struct spread *c, int row, int col);
/** spread_put - the cell gets a content, with its marks, and keeps its link. */
void spread_put(struct spread *c, int row, int col, struct cell content);
/** spread_clear - nothing but its link stays. */
void spread_clear(struct spread *c, int row, int col);
/** spread_is_empty - neither element nor wire nor pin. */
bool spread_is_empty(const struct spread *c, int row, int col);
/** spread_is_element - neither empty nor wire nor a row of pins. */
bool spread_is_element(const struct spread *c, int row, int col);
bool spread_is_output(const struct spread *c, int row, int col);

/* Bars: bar b of a row is the left end of cell b. False outside the rung. */
bool spread_left(const struct spread *c, int row, int bar);  /* a cell ends there */
bool spread_right(const struct spread *c, int row, int bar); /* one begins there  */
bool spread_up(const struct spread *c, int row, int bar);    /* linked to the row above */
bool spread_down(const struct spread *c, int row, int bar);  /* to the row below */
bool spread_linked(const struct spread *c, int row, int bar);
bool spread_bar_used(const struct spread *c, int row, int bar);

/** spread_rows - makes it at least so many rows high. */
bool spread_rows(struct spread *c, int rows);
/** spread_replace - takes over another rung for its own; NULL: no memory. */
bool spread_replace(struct spread *c, struct rung *made);
bool spread_insert_row(struct spread *c, int at);
/** spread_insert_column - power that crosses it gets wire; outputs stay last. */
bool spread_insert_column(struct spread *c, int at);
/** spread_is_bare - is the row empty but for links? */
bool spread_is_bare(const struct spread *c, int row);
/** spread_drop_row - deletes a row if it is empty and not the only one. */
void spread_drop_row(struct spread *c, int row);

/** spread_close_left - wire from cell (@row, @col) leftwards to an element, a linked
 * bar or the rail. False, and nothing, if it would come to a row of pins, behind which
 * there is no power. */
bool spread_close_left(struct spread *c, int row, int col);
/** spread_close_right - wire rightwards to an element without power, or a bare link. */
void spread_close_right(struct spread *c, int row, int col);
/** spread_join_up - links bar @bar of @row with each row above it down from @top. */
void spread_join_up(struct spread *c, int top, int row, int bar);
/** spread_prune - deletes links that lead from bar @bar of @row into nothing. Returns the
 * row where they came from. */
int spread_prune(struct spread *c, int row, int bar);

/** spread_at_element - opens it, with the mark on the element at the cursor. Fails:
 * false if there is none. */
bool spread_at_element(struct spread *c, const struct rung *rung, struct grid_at *at);
/** spread_place - as grid_place(). */
bool spread_place(struct spread *c, int row, int col, struct cell cell,
		  enum grid_how how);
/**
 * spread_branch_row - a row in which cells @col … @last are free and whose bars @col and
 * @last + 1 can be linked with those of @row; made if there is none
 *
 * Below @row, or above it where a wire would have to be crossed below: @row follows when
 * a row comes before it. -1: a wire would have to cross on both sides.
 */
int spread_branch_row(struct spread *c, int *row, int col, int last);
/** spread_join_branch - links bar @bar of row @branch, which spread_branch_row() gave,
 * to the circuit of @row. */
void spread_join_branch(struct spread *c, int row, int branch, int bar);
/** spread_parallel - as grid_parallel(), round the cells @col … @last. */
bool spread_parallel(struct spread *c, int row, int col, int last, struct cell cell);
/** spread_delete_whole - deletes the element at (@row, @col) and rows that become empty; a
 * branch below moves up into a gap. */
void spread_delete_whole(struct spread *c, int row, int col);
#endif
