/* SPDX-License-Identifier: MIT
 *
 * plant - what a program drives, as another program: a door, a tank, a belt.
 *
 * It is bound crosswise, byte by byte: what it has at its outputs (Q, AQ, XQ, XAQ) are
 * inputs of the program (I, AI, XI, XAI), and the outputs of the program are its inputs.
 * Inputs that it neither declares nor uses at its outputs it leaves alone: somebody else
 * switches them. It has its turn before each scan of the program, so that it sees outputs
 * as they were set a scan ago, and the program sees the world as it is.
 */
#ifndef TRIAL_PLANT_H
#define TRIAL_PLANT_H

#include "engine/scan/resource.h"

/* Which area of one is which of the other. */
#define PLANT_PAIRS 4
extern const struct plant_pair { enum iec_area out, in; } plant_pairs[PLANT_PAIRS];

/** plant_find - the inputs of a program that @plant gives
 * @areas: of the program   @drives: a bit for each bit of them, zeroed; areas->size bytes
 *
 * Owns: nothing.   Scan-safe: no. */
void plant_find(const struct image *plant, const struct areas *areas, uint8_t *drives);
/** plant_turn - outputs of @program go to the plant, it runs once, its outputs come back
 * @drives: as plant_find() made it   @program: between two scans
 *
 * A plant in STOP or FAULT stands still. Scan-safe: as resource_scan(). */
void plant_turn(struct resource *plant, const uint8_t *drives, struct image *program,
		int64_t now_ns);

/* One by itself, beside a resource that somebody else has. */
struct plant {
	struct resource resource;
	void *memory;
	uint8_t *drives;
};
/** plant_init - in STOP; resource_start() it with the program
 * @program: of the plant   @beside: the program it is the plant of; both borrowed
 *
 * Owns: plant_free().   Scan-safe: no.   Fails: false: no memory; nothing to free. */
bool plant_init(struct plant *plant, const struct program *program,
		const struct program *beside);
void plant_free(struct plant *plant);
/** plant_scan - a turn of it. As plant_turn(). */
void plant_scan(struct plant *plant, struct image *program, int64_t now_ns);
#endif
