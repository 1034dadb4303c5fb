/* SPDX-License-Identifier: MIT
 *
 * ladder_words - random.h, and a function for ladder_random.
 */
#ifndef CLASSIC_LADDER_WORDS_H
#define CLASSIC_LADDER_WORDS_H

#include "tests/walker/random.h"

/** random_block - true for the name of an instance. @which: gets its number, below 32. */
bool random_block(const char *name, size_t len, size_t *which);
#endif
