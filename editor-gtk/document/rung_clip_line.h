/* SPDX-License-Identifier: MIT
 *
 * rung_clip_line - lines of mnemonics as rungs.
 */
#ifndef EDITOR_RUNG_CLIP_LINE_H
#define EDITOR_RUNG_CLIP_LINE_H

#include "editor-gtk/document/document.h"

/**
 * rung_clip_lines - `XIC Start OTE Motor` as the text of a rung for POU @pou, not yet read
 * @text: on one line or on several, as lists are; what follows an output is another rung
 * @why:  gets the reason, which the caller frees; @line the number of its line
 *
 * Owns: the caller, g_strfreev(): one a rung.   Fails: NULL, it is no such text.
 */
char **rung_clip_lines(LadderDocument *document, int pou, const char *text, char **why,
		       int *line);

#endif
