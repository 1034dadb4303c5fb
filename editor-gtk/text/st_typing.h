/* SPDX-License-Identifier: MIT
 *
 * st_typing - what typing Structured Text is made easier by: statements that appear whole, and
 * lines that indent themselves.
 *
 * A line behind THEN, DO, OF, ELSE, REPEAT or a choice of CASE begins two blanks further; END_IF and
 * its like move back to the line that opened the block. It checks nothing.
 */
#ifndef EDITOR_ST_TYPING_H
#define EDITOR_ST_TYPING_H

#include <gtksourceview/gtksource.h>

/** st_skeleton_is - does a whole statement begin with @word: IF … THEN … END_IF;? */
gboolean st_skeleton_is(const char *word);
/** st_skeleton_put - writes it at @at, with the cursor at its first empty place; Tab goes to the
 * next one, as long as the cursor stays in its lines. For words that have one. */
void st_skeleton_put(GtkSourceView *view, GtkTextIter *at, const char *word);
/** st_typing_set - lines of @view indent themselves, Tab makes two blanks; or no longer. */
void st_typing_set(GtkSourceView *view, gboolean on);
/** st_indent - the blanks that line @line of @text, from 0, should begin with. */
int st_indent(const char *text, int line);

#endif
