/* SPDX-License-Identifier: MIT
 *
 * random_inside - types and functions that the two files of random projects share.
 */
#ifndef CLASSIC_RANDOM_INSIDE_H
#define CLASSIC_RANDOM_INSIDE_H

#include "tests/walker/random.h"

enum {
	ROWS = 8, COLUMNS = 12,
	BITS = 24, INPUTS = 8, OUTPUTS = 10, WORDS = 12, BLOCKS = 4, PAGES = 3, PAGE_STEPS = 6, STEPS = PAGES * PAGE_STEPS,
	FIRST_INDEX = 40, INDICES = 3  /* words that hold 0 to 7               */
};

struct cell { int element, type, number, index; bool top; };
struct grid { int rows, columns; struct cell cell[ROWS][COLUMNS]; };

struct making {
	struct random_source random;
	bool odd, linuxcnc, failed;
	bool narrow;             /* rungs of 10 x 6                            */
	char *text;
	size_t len, size;
	int compares, operates;  /* numbers of expressions, in this order      */
	int used[5];             /* blocks of each kind                        */
	int target;              /* last rung of the section                   */
	int subroutines, callable; /* subroutines from callable on can be called */
	int pages, transitions;
	bool numbered[STEPS];    /* a step has this number                     */
};

/** making_put - adds text. */
void making_put(struct making *making, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** making_below - 0 to count - 1. */
int making_below(struct making *making, int count);
bool making_chance(struct making *making, int percent);
/** put_expressions - writes the member; sets compares and operates. */
void put_expressions(struct making *making);
#endif
