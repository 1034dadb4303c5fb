/* SPDX-License-Identifier: MIT
 *
 * load - how much the tasks of a program have to do, and whether a machine of a given speed
 * is fast enough for their periods.
 *
 * The figures come from the code, not from a clock. A run is counted in words of instructions;
 * a schedule is computed with scan/task.h and a virtual clock, so it is that of a board.
 */
#ifndef TRIAL_LOAD_H
#define TRIAL_LOAD_H

#include "engine/scan/task.h"

struct load_task {
	uint64_t words;    /* of its longest run, with POUs that are called; each loop
			    * is counted once                                    */
	bool loops;        /* there are loops, so a run may have more words      */
	uint64_t way;      /* the most words from one safe point to the next; 0: no task
			    * interrupts this one                                */
	uint64_t *point;   /* the safe points: words from the begin of the run   */
	uint32_t points;
	bool way_loops;    /* … with loops of a function or block that it calls */
	/* The result of load_run(). */
	int64_t run_ns;    /* of one run, without interruptions                  */
	int64_t wait_ns;   /* the longest time from its deadline to its run      */
	uint64_t runs, overruns; /* periods left out; without an interval: cycles   */
};

/* The clock of a schedule. Of no use to a caller. */
struct load_schedule {
	struct program program;       /* its events wait at a byte of zero        */
	struct code_task task[LIMIT_TASKS];
	struct tasks tasks;
	int64_t due_ns, now_ns;       /* of the cycle; the clock                  */
	int64_t busy_ns;
	uint64_t skipped;             /* cycles that programs without a task have not */
	bool first;                   /* cycle                                   */
};

/* Some kilobytes: not for a frame. */
struct load {
	const struct program *program; /* borrowed                               */
	int64_t tick_ns;               /* of the cycles                          */
	uint64_t speed;                /* of load_run()                          */
	struct load_task task[LIMIT_TASKS];
	uint32_t busy_permille;        /* result of load_run(): the time that tasks take */
	struct load_schedule at;
};

/** load_measure - counts the words of each task
 * @tick_ns: the time of a cycle, above 0
 *
 * Owns: load_free(); @out borrows @program. Scan-safe: no. Fails: false: no memory; nothing to
 * free. */
bool load_measure(const struct program *program, int64_t tick_ns, struct load *out);
void load_free(struct load *load);
/** load_run - computes a schedule from a start, in which every run is the longest one and each
 * event comes in every cycle
 * @speed: words a millisecond, 1 … LOAD_SPEED_MOST
 *
 * Tasks interrupt each other at their safe points, as on a board with POSIX timers.
 * It ends when all intervals have met again, or after LOAD_CYCLES cycles. Reading inputs and
 * writing outputs take no time in it. Scan-safe: no. Returns whether no task leaves out a
 * period. */
bool load_run(struct load *load, uint64_t speed);
/** load_enough - a speed at which load_run() is true, about the least one; 0: there is none
 *
 * The results of load_run() are lost. Scan-safe: no; about 60 schedules. */
uint64_t load_enough(struct load *load);

#define LOAD_SPEED_MOST UINT64_C(100000000)
#define LOAD_CYCLES     INT64_C(20000)
#endif
