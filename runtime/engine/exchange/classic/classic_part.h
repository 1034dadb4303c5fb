/* SPDX-License-Identifier: MIT
 *
 * classic_part - a part of an expression of ClassicLadder, as it is written here, and
 * between which numbers it lies. Private to import/.
 */
#ifndef CLASSIC_PART_H
#define CLASSIC_PART_H

#include "engine/exchange/classic/classic_convert.h"

/* A part of an expression: its text, and how strongly it holds together here. */
struct part {
	const char *text;
	const char *a, *b; /* of what may wrap: its operands, of this function */
	enum classic_function function;
	int rank;          /* 0: an operand or call; greater: weaker           */
	bool constant;
	int32_t value;     /* of a constant                                    */
	bool known;        /* it lies between these two; else it can be any    */
	int32_t low, high;
};

enum { RANK_OPERAND, RANK_SIGN, RANK_PRODUCT, RANK_SUM };

/** part_low, part_high - the least and the greatest that it can be. */
int32_t part_low(struct part part);
int32_t part_high(struct part part);
/** part_keep - it lies between these two. What goes beyond 32 bits wraps, and can be any. */
void part_keep(struct part *part, int64_t low, int64_t high);
/** part_keep_product - it is @a times @b. */
void part_keep_product(struct part *part, struct part a, struct part b);
#endif
