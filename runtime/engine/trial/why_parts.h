/* SPDX-License-Identifier: MIT
 *
 * why_parts - splits an expression at AND, OR, XOR and NOT.
 *
 * It is examined alone: other elements of the rung that read the same names are not
 * considered.
 *
 * Private to trial/why.c.
 */
#ifndef TRIAL_WHY_PARTS_H
#define TRIAL_WHY_PARTS_H

#include "engine/trial/why.h"

/* Ways: all parts of one must change together; for a TRUE expression, all are TRUE. */
struct why_parts {
	struct why_way way[WHY_WAYS];
	int ways;
};

/**
 * why_parts - of an expression of @cell
 * @cell: names it; each part is a copy with a name, values and a kind of its own
 * @on:   how it was in the scan
 *
 * Scan-safe: no. Fails: false if it cannot be split, or a part is not known.
 */
bool why_parts(const struct why_place *at, const struct why_cell *cell, const char *text,
	       size_t len, bool on, struct arena *arena, struct why_parts *out);
#endif
