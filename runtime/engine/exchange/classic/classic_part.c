/* SPDX-License-Identifier: MIT
 *
 * classic_part - between which numbers the parts of an expression lie. What stays within
 * 32 bits needs no function that wraps.
 */
#include "engine/exchange/classic/classic_part.h"

int32_t part_low(struct part part)
{
	return part.known ? part.low : INT32_MIN;
}

int32_t part_high(struct part part)
{
	return part.known ? part.high : INT32_MAX;
}

void part_keep(struct part *part, int64_t low, int64_t high)
{
	part->known = low >= INT32_MIN && high <= INT32_MAX;
	part->low = part->known ? (int32_t)low : 0;
	part->high = part->known ? (int32_t)high : 0;
}

void part_keep_product(struct part *part, struct part a, struct part b)
{
	const int64_t corner[] = {
		(int64_t)part_low(a) * part_low(b), (int64_t)part_low(a) * part_high(b),
		(int64_t)part_high(a) * part_low(b), (int64_t)part_high(a) * part_high(b),
	};
	int64_t low = corner[0], high = corner[0];

	for (int i = 1; i < 4; i++) {
		low = corner[i] < low ? corner[i] : low;
		high = corner[i] > high ? corner[i] : high;
	}
	part_keep(part, low, high);
}
