/* SPDX-License-Identifier: MIT
 *
 * foreign - text that a board or another machine sent, for a terminal.
 *
 * It may hold any bytes: a line end would make a second line of it, an escape sequence could
 * change what the terminal shows. JSON has its own escapes and needs none of this.
 */
#ifndef LADDER_FOREIGN_H
#define LADDER_FOREIGN_H

#include "engine/base/sink.h"

/** foreign_write - @len bytes; each control character becomes a question mark. Owns: nothing. */
void foreign_write(const struct sink *out, const char *text, size_t len);
/** foreign_text - the same of a NUL-ended text. */
void foreign_text(const struct sink *out, const char *text);
#endif
