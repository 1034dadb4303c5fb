/* SPDX-License-Identifier: MIT
 *
 * why_parts - an expression that does not hold, or holds, taken apart at AND, OR and NOT.
 * It is looked at alone: what else of the rung reads the same names is not thought of.
 *
 * Private to trial/why.c.
 */
#ifndef TRIAL_WHY_PARTS_H
#define TRIAL_WHY_PARTS_H

#include "engine/trial/why.h"

/* Ways: of each all parts must change; of one that holds, all hold. */
struct why_parts {
	struct why_way way[WHY_WAYS];
	int ways;
};

/**
 * why_parts - of an expression of @cell
 * @cell: names it; each part is a copy with a name, values and a kind of its own
 * @on:   how it was in the scan
 *
 * Scan-safe: no.   Fails: false if it cannot be taken apart, or its parts are not known.
 */
bool why_parts(const struct why_place *at, const struct why_cell *cell, const char *text,
	       size_t len, bool on, struct arena *arena, struct why_parts *out);
#endif
