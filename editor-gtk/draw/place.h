/* SPDX-License-Identifier: MIT
 *
 * place - how a person is told where a cell is: by the letter of the column that the sheet
 * shows it in. A file and the engine's messages have the number of the cell, which is another
 * where wire is stretched up to an output. Of a chart by the step, not by the line of a text
 * that nobody sees.
 */
#ifndef EDITOR_PLACE_H
#define EDITOR_PLACE_H

#include "engine/model/project.h"

/* Of the sheet that was asked for last: many cells are asked for in a row. Zeroed first. */
struct place_sheet {
	const struct project *project;
	int pou, first, count; /* its rungs                                   */
	int columns;
};

#define PLACE_LETTERS 4

/** place_column - "A", "Z", "AA" of a column, 0-based; returns @out. */
const char *place_column(int column, char out[PLACE_LETTERS]);
/**
 * place_shown - the column, 0-based, in which a cell of the file is seen
 * @sheet: of this project as it is; @rung, @row, @col: 0-based
 *
 * Of a cell that is not there: @col.
 */
int place_shown(struct place_sheet *sheet, const struct project *project, int pou, int rung,
		int row, int col);
/**
 * place_line - of what a line of a POU's text is: "Main, line 3"; of a chart "Main, step Fill"
 * @pou: of @project; @row: lines below its heading
 *
 * In the language of the session. Owns: the caller, g_free().
 */
char *place_line(const struct project *project, int pou, int row);

#endif
