/* SPDX-License-Identifier: MIT
 *
 * load_text - prints the load of the tasks of a program: `ladder check --tasks`.
 */
#ifndef LADDER_LOAD_TEXT_H
#define LADDER_LOAD_TEXT_H

#include "ladder/report.h"

/** load_print - a table, or a field of JSON that begins with a comma
 * @ladder: built
 * @speed:  words of instructions a millisecond; 0: not given, tells a speed that is enough
 *
 * Returns STATUS_NO if the tasks leave out periods at this speed; STATUS_WRONG after a
 * message: no memory. */
enum status load_print(struct ladder *ladder, const char *path, int64_t speed, bool json,
		       const struct sink *out);
#endif
