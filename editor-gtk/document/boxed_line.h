/* SPDX-License-Identifier: MIT
 *
 * boxed_line - where the statements of an EXECUTE box stand in the text of its program.
 */
#ifndef EDITOR_BOXED_LINE_H
#define EDITOR_BOXED_LINE_H

#include "engine/model/project.h"

/** boxed_line - the line below `EXECUTE Name:`, counted from the first line of @text
 * @text: of the POU, from its heading on
 * @rung: 0-based, as @row and @col: its cell
 *
 * Returns 1-based; 0: none. */
int boxed_line(const char *text, const struct pou *pou, int rung, int row, int col);

#endif
