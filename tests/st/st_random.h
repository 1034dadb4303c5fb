/* SPDX-License-Identifier: MIT
 *
 * st_random - random programs of Structured Text, from a seed.
 */
#ifndef ST_ST_RANDOM_H
#define ST_ST_RANDOM_H

#include "tests/walker/random.h"

/** st_random_print - the program of a seed; length. */
size_t st_random_print(uint64_t seed, char *out, size_t size);
/* A variable that the test sets before a scan, and its type. */
struct st_input { const char *name, *type; };
/** st_random_input - number @index; name NULL: there are fewer. */
struct st_input st_random_input(int index);
#endif
