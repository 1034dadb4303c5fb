/* SPDX-License-Identifier: MIT
 *
 * ladder_words - random.h, and what ladder_random asks for besides.
 */
#ifndef CLASSIC_LADDER_WORDS_H
#define CLASSIC_LADDER_WORDS_H

#include "tests/walker/random.h"

/** random_block - is it the name of a pool's instance? @which: its number, below 32. */
bool random_block(const char *name, size_t len, size_t *which);
#endif
