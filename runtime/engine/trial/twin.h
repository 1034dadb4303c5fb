/* SPDX-License-Identifier: MIT
 *
 * twin - a controller in numbers: its program, a plant beside it, and the time.
 *
 * The plant is a program, too, bound crosswise: the outputs that it has are inputs here,
 * and what goes out here is its input; each sees the other as it was a scan ago. What the
 * plant neither declares nor uses at its outputs is a person's to switch. Everything that
 * happens is a scan or an act, so that a twin is a function of its start, its acts and
 * their order: whoever keeps these can have any scan again (trial/record.h). Time is a
 * number; nothing here waits or knows a thread.
 */
#ifndef TRIAL_TWIN_H
#define TRIAL_TWIN_H

#include "engine/scan/resource.h"

enum act_kind {
	ACT_SET,         /* a value, at once                                  */
	ACT_FORCE,       /* held at both edges of every scan                  */
	ACT_RELEASE,
	ACT_RELEASE_ALL,
	ACT_START,       /* cold, but inputs and forces stay; time and scan
				     numbers go on                            */
	ACT_WARM,        /* likewise, but VAR RETAIN keeps its value, and the plant
				     goes on: the controller alone had no power */
	ACT_STOP,        /* outputs are safe                                  */
	ACT_PERIOD,      /* value.i ns from here on                           */
};
struct act {
	enum act_kind kind;
	bool plant;             /* of the plant, not of the program           */
	struct location at;
	union iec_value value;  /* of a STRING: borrowed                      */
};

struct twin {
	struct resource resource; /* with power, where the image can tell it  */
	struct resource plant;    /* image.program NULL: there is none        */
	int64_t now_ns;           /* of the last scan; 0 before the first     */
	int64_t period_ns;
	uint64_t scan;            /* of the last one; 0: none yet             */
	size_t memory_size, plant_size;
	uint8_t *plant_drives;    /* a bit for each bit of I that the plant gives;
				     borrowed by copies                       */
	const uint8_t *safe;      /* as twin_set_safe() has it                  */
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
/** twin_clone - another twin of the same programs, with the same state. As twin_init. */
bool twin_clone(struct twin *twin, const struct twin *from);
/** twin_copy - the state of @from into a clone of it.   Scan-safe: yes, as long as it
 * takes to copy the data of both programs. */
void twin_copy(struct twin *twin, const struct twin *from);

/**
 * twin_change - the program was edited: @twin, which has the new one, goes on where @from
 * is, as scan/carry.h tells; so does its plant, if both have one
 * @twin: initialised, nothing else   @from: stays as it is
 *
 * Between two scans. A record of @from cannot go on: it is of other programs.
 * Owns: nothing.   Scan-safe: no.   Fails: false: no memory; @twin is to be freed.
 */
bool twin_change(struct twin *twin, const struct twin *from);

/** twin_act - between two scans. Scan-safe: no.   Fails: false: no such place, one that
 * cannot be set or forced, too many forces, no memory; nothing has changed. */
bool twin_act(struct twin *twin, const struct act *act);
/**
 * twin_set_safe - what its outputs are while nothing runs, as an I/O map has it: now, if
 * nothing runs, and whenever it stops; after twin_change(), which brings the old ones
 * @safe: a bit for each bit of Q, 8 a byte; borrowed, by clones, too. NULL, as at first:
 *        all 0
 *
 * Outputs that are no bits are 0: no pin has them. Scan-safe: yes.   Fails: no.
 */
void twin_set_safe(struct twin *twin, const uint8_t *safe);
/** twin_outputs_safe - as on a board that drives its safe outputs, whatever is forced.
 * Scan-safe: yes.   Fails: no. */
void twin_outputs_safe(struct twin *twin);
/**
 * twin_scan - time goes on by a period: the plant runs once, then the program
 *
 * Does nothing unless the program is in RUN. After a FAULT outputs are safe. Scan-safe: as
 * resource_scan().
 * Fails: false: it is not in RUN now. A scan that ends in FAULT or STOP counts.
 */
bool twin_scan(struct twin *twin);
#endif
