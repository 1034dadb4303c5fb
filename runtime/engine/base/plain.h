/* SPDX-License-Identifier: MIT
 *
 * plain - makes a user's text safe for a terminal and measures it.
 *
 * Control characters and broken bytes are shown as `?`, so that no comment can move a
 * cursor. It wraps nothing.
 */
#ifndef BASE_PLAIN_H
#define BASE_PLAIN_H

#include "engine/base/sink.h"

/**
 * plain_clip - how much of @text fits into @columns
 * @width: gets the columns of what fits
 * Returns its bytes; a combining character stays with its base.
 */
size_t plain_clip(const char *text, size_t len, int columns, int *width);

/** plain_write - writes it without control characters. */
void plain_write(const struct sink *sink, const char *text, size_t len);
void plain_text(const struct sink *sink, const char *text);

/**
 * plain_comment_line - the next line of a comment, without delimiters and
 * blanks @at:  start with *at = the comment; moves on @len: gets its bytes
 * Returns it, borrowed; NULL at the end. Empty lines are left out.
 */
const char *plain_comment_line(const char **at, size_t *len);

#endif
