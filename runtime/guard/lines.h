/* SPDX-License-Identifier: MIT
 *
 * lines - the outputs that the guard holds at their safe levels, by version 2 of the GPIO
 * character device (Linux 5.10 and later).
 */
#ifndef GUARD_LINES_H
#define GUARD_LINES_H

#include "guard/say.h"

#include <stdbool.h>

struct lines {
	struct guard_table table; /* the last one of ladderd                  */
	struct guard_table next;  /* after the lines are released             */
	int more;                 /* lines behind those of table, see lines_more() */
	bool waits;               /* next is one                              */
	int16_t fd[GUARD_LINES];  /* of the request whose first line this is; else -1 */
	bool held[GUARD_LINES];
	bool told[GUARD_LINES];   /* that the line cannot be taken            */
};

/** lines_begin - no table, no line. */
void lines_begin(struct lines *lines);
/** lines_know - another table; lines that are held stay so until
 * lines_release(). */
void lines_know(struct lines *lines, const struct guard_table *table);
/** lines_more - lines beside those of the table, until another table or none; those that do not
 * fit are left out. */
void lines_more(struct lines *lines, const struct guard_table *more);
/** lines_levels - other levels of the lines that hold theirs. */
void lines_levels(struct lines *lines, const struct guard_levels *levels);
/** lines_answer - the levels of all lines, for a ladderd that is about to request them. */
void lines_answer(const struct lines *lines, struct guard_levels *out);
/** lines_take - requests the lines that are not held yet, with their safe levels. A line that
 * cannot be had is reported once, and does not hinder the others. Returns whether all are held. */
bool lines_take(struct lines *lines);
void lines_release(struct lines *lines);
#endif
