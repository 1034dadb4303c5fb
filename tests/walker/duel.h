/* SPDX-License-Identifier: MIT
 *
 * duel - the engine and the walker run one program, side by side.
 *
 * In each scan both get the same inputs and the same time; every variable, output and
 * marker, and in some scans the power of every cell, must be the same afterwards, in the
 * image as it is and in the watched one. It decides nothing about who is right.
 */
#ifndef WALKER_DUEL_H
#define WALKER_DUEL_H

#include "tests/walker/random.h"

enum verdict { AGREE, DISAGREE, REFUSED, UNWALKED };

struct duel_plan {
	uint64_t seed;
	bool values;           /* the power of cells does not count             */
	int scans, more_scans; /* at least; so many more by chance              */
	void (*inputs)(struct random_source *source, uint8_t *inputs);
	int64_t (*passed)(struct random_source *source); /* ns since the scan before */
};

/** duel_judge - one whole comparison; a scan that fails on both sides ends it.
 * @why: what they differ in, or why it was not run. */
enum verdict duel_judge(const char *text, size_t len, const struct duel_plan *plan,
			char *why, size_t size);
#endif
