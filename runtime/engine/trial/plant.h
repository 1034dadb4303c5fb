/* SPDX-License-Identifier: MIT
 *
 * plant - a simulated machine (a door, a tank, a belt) as a second program.
 *
 * Its outputs (Q, AQ, XQ, XAQ) are copied byte by byte to the inputs of the program (I,
 * AI, XI, XAI), and the outputs of the program to its inputs. It does not change inputs
 * for which it has no output: a person or script sets them. The plant runs before each
 * scan of the program, so that it sees the outputs of the previous scan, and the
 * program sees current inputs.
 */
#ifndef TRIAL_PLANT_H
#define TRIAL_PLANT_H

#include "engine/scan/resource.h"

/* Pairs of areas that are connected. */
#define PLANT_PAIRS 4
extern const struct plant_pair { enum iec_area out, in; } plant_pairs[PLANT_PAIRS];

/** plant_find - finds the inputs of a program that @plant sets
 * @areas: of the program
 * @drives: zeroed, areas->size bytes; gets a 1 for each bit that it sets
 *
 * Owns: nothing. Scan-safe: no. */
void plant_find(const struct image *plant, const struct areas *areas, uint8_t *drives);
/** plant_turn - copies the outputs of @program to the plant, runs it once, and copies
 * its outputs back
 * @drives: from plant_find() @program: between two scans
 *
 * A plant in STOP or FAULT does not run. Scan-safe: as resource_scan(). */
void plant_turn(struct resource *plant, const uint8_t *drives, struct image *program,
		int64_t now_ns);

/* A plant with its own resource, for callers that run the program themselves. */
struct plant {
	struct resource resource;
	void *memory;
	uint8_t *drives;
};
/** plant_init - in STOP; start it with the program by resource_start()
 * @program: of the plant @beside: the controller's program; both borrowed
 *
 * Owns: plant_free(). Scan-safe: no. Fails: false: no memory; nothing to free. */
bool plant_init(struct plant *plant, const struct program *program,
		const struct program *beside);
void plant_free(struct plant *plant);
/** plant_scan - one turn. As plant_turn(). */
void plant_scan(struct plant *plant, struct image *program, int64_t now_ns);
#endif
