/* SPDX-License-Identifier: MIT
 *
 * place - names the place of a cell or line for a person.
 *
 * A cell has the letter of the column in which the sheet shows it. The file and the engine's
 * messages have the column of the file, which differs where a wire is stretched up to an
 * output. A line of a chart has the name of its step, because nobody sees the text of a chart.
 */
#ifndef EDITOR_PLACE_H
#define EDITOR_PLACE_H

#include "engine/model/project.h"

/* The sheet of the last call, because many calls are about the same one. Zero it first. */
struct place_sheet {
	const struct project *project;
	int pou, first, count; /* its rungs                                   */
	int columns;
};

#define PLACE_LETTERS 4

/** place_column - "A", "Z", "AA" of a column, 0-based; returns @out. */
const char *place_column(int column, char out[PLACE_LETTERS]);
/**
 * place_shown - the column, 0-based, in which the sheet shows a cell of the file
 * @sheet: of this project as it is; @rung, @row, @col: 0-based
 *
 * Returns @col for a cell that does not exist.
 */
int place_shown(struct place_sheet *sheet, const struct project *project, int pou, int rung,
		int row, int col);
/**
 * place_line - the place of a line of a POU: "Main, line 3"; in a chart "Main, step Fill"; in an
 * EXECUTE box "Main.Count, line 1", as its sheet counts them
 * @pou: of @project; @row: lines below its heading
 *
 * In the language of the session. Owns: the caller, g_free().
 */
char *place_line(const struct project *project, int pou, int row);
/**
 * place_rung - the part of a POU that a rung belongs to: "Main"; in a chart "Main, transition
 * Idle → Fill", "Main, action Count"
 * @rung: 0-based; @whole: gets whether the rung is an expression beside its transition, so that
 *        a rung number means nothing
 *
 * In the language of the session. Owns: the caller, g_free().
 */
char *place_rung(const struct project *project, int pou, int rung, bool *whole);
/**
 * place_cell - "Main, rung 2, row 1, column C"; in a chart as place_rung()
 * @pou: of @project; @rung, @row, @col: 0-based, of the file; @row -1: the whole rung
 *
 * In the language of the session. Owns: the caller, g_free().
 */
char *place_cell(struct place_sheet *sheet, const struct project *project, int pou, int rung,
		 int row, int col);

#endif
