/* SPDX-License-Identifier: MIT
 *
 * rung_clip_line - a line of mnemonics as a rung.
 */
#ifndef EDITOR_RUNG_CLIP_LINE_H
#define EDITOR_RUNG_CLIP_LINE_H

#include "editor-gtk/document.h"

/** rung_clip_line - `XIC Start OTE Motor` as the text of a rung for POU @pou, not yet
 * read. Owns: the caller, g_free(). NULL: it is no such line. */
char *rung_clip_line(LadderDocument *document, int pou, const char *text);

#endif
