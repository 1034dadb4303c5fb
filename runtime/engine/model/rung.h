/* SPDX-License-Identifier: MIT
 *
 * rung - one grid of ladder: cells, links, and the edits an editor makes.
 *
 * A rung is plain data in one block: strings are ids of the project's table, so a copy
 * is one memcpy and undo keeps the old block. model/network.h and check/ interpret it.
 *
 * Bars: row r has the bars 0 … cols. Bar 0 of every row is the left rail; cell (r, c)
 * stands between bar c and bar c+1. `link` of a cell joins the bar at its right end
 * with the same bar of the row above.
 */
#ifndef MODEL_RUNG_H
#define MODEL_RUNG_H

#include "engine/base/catalog.h"
#include "engine/base/limits.h"

struct cell {
	uint16_t word;    /* enum word; ELEM_EMPTY 0                           */
	uint8_t link;     /* 1: right end joined to the row above             */
	uint8_t spare;    /* 0                                                 */
	uint32_t operand; /* string id: operand, instance, expression, label,
			     pin of a PIN row; 0: none                         */
	uint32_t args;    /* string id: "PT:=T#3s CV=>Count", canonical text   */
	uint32_t comment; /* string id: with its delimiters; 0: none           */
};

struct rung {
	uint32_t label;   /* string id; 0: none                                */
	uint32_t title;   /* string id: the quoted text after the label        */
	uint32_t comment; /* string id: comments above it, with delimiters     */
	uint32_t line;    /* of its RUNG word in the file; 0: not from a file  */
	uint16_t rows, cols;
	uint8_t off;      /* 1: kept, but not checked and not run              */
	uint8_t gaps;     /* 1: its rows are not on consecutive lines          */
	uint8_t spare[2];
	struct cell cell[]; /* rows * cols, row by row                         */
};

/**
 * rung_new - an empty rung of @rows x @cols cells
 *
 * Owns: the caller, rung_free(). Scan-safe: no.
 * Fails: NULL when a size is 0 or beyond its limit, or memory is out. The same holds
 * for all functions here that return a rung; their argument does not change.
 */
struct rung *rung_new(int rows, int cols);
void rung_free(struct rung *rung);
struct rung *rung_copy(const struct rung *rung);
size_t rung_size(const struct rung *rung); /* bytes of the block */
/** rung_equal - same grid and texts; the line in the file is ignored. */
bool rung_equal(const struct rung *a, const struct rung *b);

/** rung_cell - @row, @col 0-based and inside the rung. */
struct cell *rung_cell(struct rung *rung, int row, int col);
const struct cell *rung_at(const struct rung *rung, int row, int col);

/* Edits of whole rows and columns give a new rung; rows and columns are 0-based, an
 * insertion comes before @at (0 … count). Deleting the only row or column fails.
 * Connections stay: a new row continues links, a new column gets wires, the links of a
 * deleted column move to the bar before it, and a row that moves inside its branch
 * stays in it. A box includes its pin rows. */
struct rung *rung_insert_row(const struct rung *rung, int at);
struct rung *rung_delete_row(const struct rung *rung, int at);
struct rung *rung_insert_column(const struct rung *rung, int at);
struct rung *rung_delete_column(const struct rung *rung, int at);
/** rung_trim - removes empty rows and columns at the end (at least 1x1 remains). */
struct rung *rung_trim(const struct rung *rung);
/** rung_resize - cuts, or adds empty cells. */
struct rung *rung_resize(const struct rung *rung, int rows, int cols);

/* Edits in place; false (and nothing changed) outside the rung. Scan-safe: yes. */
bool rung_set_cell(struct rung *rung, int row, int col, struct cell cell);
/** rung_clear_cell - clears a cell but keeps its link; a box with its pin rows. */
bool rung_clear_cell(struct rung *rung, int row, int col);
/** rung_line - line of @row (1-based; 0: the RUNG word) in its file. The line of the
 * RUNG word if its rows are not on consecutive lines; 0: not from a file. */
int rung_line(const struct rung *rung, int row);
/** rung_height - rows of the box at (row, col): 1 + PIN cells below it. */
int rung_height(const struct rung *rung, int row, int col);
/** rung_box_top - first row of the box that covers cell (row, col); -1: none. */
int rung_box_top(const struct rung *rung, int row, int col);
#endif
