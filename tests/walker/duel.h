/* SPDX-License-Identifier: MIT
 *
 * duel - runs one program in the engine and in the walker.
 *
 * In each scan both get the same inputs and the same time; afterwards every variable,
 * output and marker, and in some scans the power of every cell, must be the same, in
 * the plain and in the watched section.
 */
#ifndef WALKER_DUEL_H
#define WALKER_DUEL_H

#include "tests/walker/random.h"

enum verdict { AGREE, DISAGREE, REFUSED, UNWALKED };

struct duel_plan {
	uint64_t seed;
	bool values;           /* do not compare the power of cells             */
	int scans, more_scans; /* at least; a random number more                */
	void (*inputs)(struct random_source *source, uint8_t *inputs);
	int64_t (*passed)(struct random_source *source); /* ns since the scan before */
};

/** duel_judge - one comparison; a scan that fails on both sides ends it.
 * @why: the difference, or the reason why it was not run. */
enum verdict duel_judge(const char *text, size_t len, const struct duel_plan *plan,
			char *why, size_t size);
#endif
