/* SPDX-License-Identifier: MIT
 *
 * comment_text - what a comment says.
 */
#ifndef EDITOR_COMMENT_TEXT_H
#define EDITOR_COMMENT_TEXT_H

/**
 * comment_text - a comment as the project holds it, without its delimiters, on one line
 *
 * Several stand one behind the other; blanks and ends of lines are one blank.
 * @comment: "(* … *)", "// …", or "". Owns: the caller, g_free(). Fails: no.
 */
char *comment_text(const char *comment);

#endif
