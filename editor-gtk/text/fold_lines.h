/* SPDX-License-Identifier: MIT
 *
 * fold_lines - which lines of a text begin a block that can be folded, and where the block ends.
 *
 * Blocks are statements such as IF and FOR, declarations, parts of charts, program units, comments of
 * several lines, and lines of // below each other. It works on texts with mistakes, too: an unfinished
 * block ends where the one around it ends. No GTK.
 */
#ifndef EDITOR_FOLD_LINES_H
#define EDITOR_FOLD_LINES_H

#include <glib.h>
#include <stdbool.h>

/* A comment that goes on in the next line. */
struct fold_state {
	char kind;            /* '(' or '/'; 0: none                           */
	unsigned char depth;  /* comments in each other                        */
};

enum fold_kind {
	FOLD_NONE,
	FOLD_BLOCK,           /* a block begins here and does not end here      */
	FOLD_COMMENT,         /* so does a comment                              */
	FOLD_SLASHES,         /* nothing but a comment of //                    */
};

/** fold_kind_of - of a line; @state: at its begin, becomes that at its end. */
enum fold_kind fold_kind_of(const char *line, struct fold_state *state);

/**
 * fold_end - the last line of the block that begins in the first line of @text
 * @state: at its begin
 * @known: gets false if the end of @text was reached before that of the block
 *
 * Counts from 0, which is also the answer when no block of several lines begins there.
 */
int fold_end(const char *text, struct fold_state state, bool *known);

/** fold_ends - for each line of @text: the last line of its block, or the line itself. Gives an array
 * of @count ints. Owns: the caller, g_free(). */
int *fold_ends(const char *text, int *count);

/** fold_next - behind the end of the line at @line, as GtkTextBuffer counts lines; NULL: it is the
 * last one. */
const char *fold_next(const char *line);

/** fold_key - what the first line of a block keeps when the text is formatted: "IFX>3THEN". Owns: the
 * caller, g_free(). */
char *fold_key(const char *line);

#endif
