/* SPDX-License-Identifier: MIT
 *
 * comment_text - the text of a comment.
 */
#ifndef EDITOR_COMMENT_TEXT_H
#define EDITOR_COMMENT_TEXT_H

/**
 * comment_text - a comment as the project holds it, without its delimiters, on one line
 *
 * Several comments are joined; blanks and ends of lines become one blank.
 * @comment: "(* … *)", "// …", or "". Owns: the caller, g_free(). Fails: no.
 */
char *comment_text(const char *comment);
/** comment_text_safe - @text made safe for a comment behind a declaration: one line,
 * single blanks, no comment delimiters. Owns: the caller. */
char *comment_text_safe(const char *text);

#endif
