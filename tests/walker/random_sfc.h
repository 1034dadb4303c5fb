/* SPDX-License-Identifier: MIT
 *
 * random_sfc - random valid sequential function charts, from a seed.
 *
 * A chart grows from sequences in which one token moves from step to step, so tokens
 * never meet; some charts get more transitions, in which they do. Each part has a key,
 * and can be left out without changing the others, so that a failing chart can be
 * reduced.
 */
#ifndef WALKER_RANDOM_SFC_H
#define WALKER_RANDOM_SFC_H

#include "tests/walker/random.h"

#define SFC_STEPS 160
#define SFC_ARCS  320
#define SFC_ENDS  4
#define SFC_PARTS 2000

struct random_step {
	uint64_t key;
	int macro;               /* macro-step that contains it; -1: none      */
	bool initial, is_macro;
};

struct random_arc {
	uint64_t key;
	int macro;
	int from[SFC_ENDS], from_count;
	int to[SFC_ENDS], to_count;
};

struct random_sfc {
	uint64_t seed;
	uint64_t dropped[SFC_PARTS]; /* keys of parts that are left out      */
	int dropped_count;
	uint64_t part[SFC_PARTS];    /* keys of its parts, set by printing    */
	int part_count;
	/* made by printing */
	struct random_step step[SFC_STEPS];
	int steps;
	struct random_arc arc[SFC_ARCS];
	int arcs;
	bool unsafe;
};

/** random_sfc_print - its text; @chart gets the keys of parts that may be left out. */
size_t random_sfc_print(struct random_sfc *sfc, char *out, size_t size);

/* Between the parts of the generator. */
/** sfc_grow - steps and transitions. */
void sfc_grow(struct random_sfc *sfc);
/** sfc_key - the key of part @number of the part with key @of. */
uint64_t sfc_key(uint64_t of, uint32_t number);
/** sfc_has - whether the chart has this part. */
bool sfc_has(struct random_sfc *sfc, uint64_t key);
struct random_source sfc_source(uint64_t key);
#endif
