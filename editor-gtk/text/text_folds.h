/* SPDX-License-Identifier: MIT
 *
 * text_folds - blocks of a text that are folded: only their first line is shown.
 *
 * The text itself is not changed. A cursor that is put into hidden lines, by a search or an error, shows
 * them; one that a key moves goes past them.
 */
#ifndef EDITOR_TEXT_FOLDS_H
#define EDITOR_TEXT_FOLDS_H

#include "editor-gtk/text/line_values.h"

struct text_folds;

/** text_folds_new - on @view, in whose margin it puts numbers and triangles. Owns:
 * text_folds_free(), before @view goes. */
struct text_folds *text_folds_new(LadderLineValues *view);
void text_folds_free(struct text_folds *folds);
/** text_folds_keep - from now on a text that replaces another one keeps the folds of the same blocks;
 * text_folds_kept: it has been replaced, and the cursor is where it shall be. May be nested. */
void text_folds_keep(struct text_folds *folds);
void text_folds_kept(struct text_folds *folds);
/** text_folds_close - folds the innermost block of line @line, from 0, that is not folded. Fails:
 * false: there is none. */
bool text_folds_close(struct text_folds *folds, int line);
/** text_folds_open - unfolds the block that begins in that line. Fails: false: it is not folded. */
bool text_folds_open(struct text_folds *folds, int line);
/** text_folds_close_all - folds all blocks, without the one that is the whole text; open_all unfolds all. */
void text_folds_close_all(struct text_folds *folds);
void text_folds_open_all(struct text_folds *folds);
/** text_folds_say - what a screen reader says about it; NULL: nothing. Caller frees. */
char *text_folds_say(const struct text_folds *folds, int line);
#endif
