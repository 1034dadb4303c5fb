/* SPDX-License-Identifier: MIT
 *
 * diff_match - the longest common subsequence of two lists of numbers.
 */
#ifndef COMPARE_DIFF_MATCH_H
#define COMPARE_DIFF_MATCH_H

#include "engine/base/arena.h"

#include <stdint.h>

#define DIFF_LIMIT 1500      /* insertions and deletions searched at most     */

/**
 * diff_match - matches the elements of @a with those of @b
 * @match: for each of the @a_count its index in @b, or -1
 *
 * Beyond DIFF_LIMIT changes only elements at the same index match.
 * Scan-safe: no. Fails: false: no memory.
 */
bool diff_match(struct arena *arena, const uint32_t *a, int a_count,
		const uint32_t *b, int b_count, int *match);

#endif
