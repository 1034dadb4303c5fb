/* SPDX-License-Identifier: MIT
 *
 * twin - a simulated controller: a program, perhaps a plant (trial/plant.h), and the
 * time.
 *
 * Its state changes only by scans and acts. So a twin is a function of its start and
 * the sequence of its acts, and any scan can be computed again from these
 * (trial/record.h). Time is virtual. It starts no thread.
 */
#ifndef TRIAL_TWIN_H
#define TRIAL_TWIN_H

#include "engine/scan/resource.h"

enum act_kind {
	ACT_SET,         /* a value, at once                                  */
	ACT_FORCE,       /* held at both edges of every scan                  */
	ACT_RELEASE,
	ACT_RELEASE_ALL,
	ACT_START,       /* cold start, but inputs and forces stay; time and scan numbers go
			  * on */
	ACT_WARM,        /* likewise, but VAR RETAIN keeps its value, and the plant goes on:
			  * only the controller lost power */
	ACT_STOP,        /* to STOP: outputs are safe                         */
	ACT_PERIOD,      /* value.i ns from now on                            */
	ACT_SPEED,       /* value.i words a millisecond from now on; 0: scans take no time */
};
struct act {
	enum act_kind kind;
	bool plant;             /* of the plant, not of the program           */
	struct location at;
	union iec_value value;  /* of a STRING: borrowed                      */
};

struct twin {
	struct resource resource; /* with power, if the image has the map     */
	struct resource plant;    /* image.program NULL: no plant             */
	int64_t now_ns;           /* of the last scan; 0 before the first     */
	int64_t period_ns;
	uint64_t scan;            /* of the last one; 0: none yet             */
	size_t memory_size, plant_size;
	uint8_t *plant_drives;    /* a bit for each bit of I that the plant sets; borrowed
				   * by copies */
	const uint8_t *safe;      /* see twin_set_safe()                        */
};

/**
 * twin_init - at scan 0, in STOP
 * @program, @plant: borrowed as long as the twin is used; @plant NULL: none
 * @period_ns: from scan to scan, more than 0
 *
 * Owns: the twin, twin_free().   Scan-safe: no.   Fails: false: no memory; nothing to free.
 */
bool twin_init(struct twin *twin, const struct program *program,
	      const struct program *plant, int64_t period_ns);
void twin_free(struct twin *twin);
/** twin_clone - a twin of the same programs with the same state. As twin_init. */
bool twin_clone(struct twin *twin, const struct twin *from);
/** twin_copy - copies the state of @from to a clone of it. Scan-safe: yes; takes the
 * time to copy the data of both programs. */
void twin_copy(struct twin *twin, const struct twin *from);

/**
 * twin_change - continues an edited program: @twin, with the new program, takes over
 * the state of @from (scan/carry.h); so does its plant, if both have one
 * @twin: just initialised @from: does not change
 *
 * Between two scans, @from is not `stopped`; one that stands is finished first. A record of @from cannot continue.
 * Owns: nothing. Scan-safe: no. Fails: false: no memory; free @twin.
 */
bool twin_change(struct twin *twin, const struct twin *from);

/** twin_restart - starts any resource again, cold or warm; inputs and forces stay, as
 * they come from outside.   Scan-safe: no.   Fails: false: no memory; nothing has
 * changed. */
bool twin_restart(struct resource *resource, bool warm);

/** twin_act - between two scans. Scan-safe: no. Fails: false: no such place, it cannot
 * be set or forced, too many forces, no memory; nothing has changed. */
bool twin_act(struct twin *twin, const struct act *act);
/**
 * twin_set_safe - sets the safe outputs of an I/O map: used now, if it is not in RUN,
 * and whenever it stops. Call it again after twin_change(), which copies the old ones
 * @safe: a bit for each bit of Q, 8 a byte, then a bit for each that keeps its value
 *        instead; borrowed, by clones, too. NULL, as at first: all 0
 *
 * Outputs that are not bits become 0. Scan-safe: yes. Fails: no.
 */
void twin_set_safe(struct twin *twin, const uint8_t *safe);
/** twin_outputs_safe - sets the outputs to their safe values, even forced ones, as a
 * board does.
 * Scan-safe: yes. Fails: no. */
void twin_outputs_safe(struct twin *twin);
/**
 * twin_scan - advances time by a period: the plant runs once, then the program
 *
 * With a speed a scan may take several periods (trial/pace.h): then not each call begins one.
 * Does nothing unless the program is in RUN. After a FAULT outputs are safe. Scan-safe:
 * as resource_scan().
 * Fails: false: it is not in RUN now. A scan that ends in FAULT or STOP counts.
 */
bool twin_scan(struct twin *twin);
/** twin_go_on - goes on with a scan in which the program is `stopped` (trial/stops.h). As
 * twin_scan(). */
bool twin_go_on(struct twin *twin);
#endif
