/* SPDX-License-Identifier: MIT
 *
 * stores - what the instructions of an image write, one place after another.
 *
 * For whoever must know more of a program than its symbols tell: which outputs it uses
 * without a name, where the memory of an edge comes from. It runs nothing, and of what an
 * index leads to it tells all that it could lead to.
 */
#ifndef TRIAL_STORES_H
#define TRIAL_STORES_H

#include "engine/scan/code.h"

struct store {
	uint32_t text;      /* word index of the instruction in CODE_TEXT     */
	uint64_t bit, bits; /* of memory: the first, how many. A BOOL outside
			       of the areas is a byte, so 8                   */
	uint32_t table;     /* of a LUT, with bits of a, b, c; else 0         */
	uint32_t read[3];   /* BOOLs that a LUT or BITPUT reads: offsets      */
};

/** stores_each - all that CODE_TEXT writes, in its order. What a called block keeps in its
 * instance is one store. Scan-safe: no. */
void stores_each(const struct program *program,
		 void (*take)(void *context, const struct store *store), void *context);
#endif
