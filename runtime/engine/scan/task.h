/* SPDX-License-Identifier: MIT
 *
 * task - when each task of a program runs, and its statistics.
 *
 * (IEC 61131-3, 2.7.2: periodic tasks and tasks that an event starts, by priority.) One
 * thread runs them; a task of higher priority may interrupt another at a safe point
 * (scan/interrupt.h). This file decides which tasks are due; resource.c runs them. It reads no
 * clock: times are arguments.
 */
#ifndef SCAN_TASK_H
#define SCAN_TASK_H

#include "engine/scan/code.h"

/* All counted since the start of the resource. */
struct task_state {
	int64_t next_ns;    /* TASK_INTERVAL: its next deadline               */
	int64_t began_ns;   /* its last run                                   */
	bool began;
	uint64_t runs;
	uint64_t overruns;  /* periods left out; events that came too early   */
	uint32_t late_row;  /* consecutive runs that left out a period        */
	bool due, ran;      /* has run in this cycle                          */
	bool was;           /* TASK_EVENT: last seen value of its variable    */
	int64_t last_ns, max_ns; /* how long it ran; 0 without a clock        */
	uint64_t interrupted; /* how often tasks ran at its safe points       */
	int64_t wait_ns;    /* the longest time from its deadline to its run; TASK_INTERVAL,
			     * with a clock                                  */
};

struct tasks {
	struct task_state state[LIMIT_TASKS];
};

/** task_interval, task_watchdog - in ns; 0: none. Scan-safe: yes. */
int64_t task_interval(const struct code_task *task);
int64_t task_watchdog(const struct code_task *task);
/** task_limit - the limit of one run in ns: its WATCHDOG, or @patience intervals (one
 * above a second counts as a second: a hang must be noticed), or, without an interval,
 * @patience times @period_ns. 0: none.
 * Scan-safe: yes. */
int64_t task_limit(const struct code_task *task, uint32_t patience,
		   int64_t period_ns);
/** task_name - as declared; "" for the implicit task and for an image without names.
 * Lives with the program. Scan-safe: yes. */
const char *task_name(const struct program *program, uint32_t task);
/** tasks_declared - whether the program declares tasks. Otherwise one task runs all
 * programs in every cycle. Scan-safe: yes. */
bool tasks_declared(const struct program *program);

/**
 * tasks_tick - the cycle time of a program
 * @period_ns: set by the user; 0: not set
 * @preset_ns: default if neither the user nor the program sets it
 *
 * The greatest common divisor of all intervals and of @period_ns; of @preset_ns, too,
 * if @period_ns is 0 and there are tasks without an interval, which may run in every
 * cycle. Not less than LIMIT_TICK: then a task runs in the first cycle behind its
 * deadline.
 * Scan-safe: yes.
 */
int64_t tasks_tick(const struct program *program, int64_t period_ns,
		   int64_t preset_ns);

/** tasks_start - sets all deadlines to @start_ns. Scan-safe: yes. */
void tasks_start(struct tasks *tasks, const struct program *program,
		 int64_t start_ns);
/** tasks_skip - moves deadlines that have passed to the last one before @now_ns, so that none
 * of them counts as missed. Scan-safe: yes. */
void tasks_skip(struct tasks *tasks, const struct program *program, int64_t now_ns);
/** tasks_begin - starts a cycle: finds the tasks that are due at @now_ns.
 * Scan-safe: yes. */
void tasks_begin(struct tasks *tasks, const struct program *program,
		 const uint8_t *m, int64_t now_ns);
/** tasks_above - how many tasks, from the first one on, have a higher priority than @task.
 * Scan-safe: yes. */
uint32_t tasks_above(const struct program *program, uint32_t task);
/** tasks_may_begin - whether one of the first @count tasks may be due at @now_ns: a deadline
 * has come, or it waits for an event. Scan-safe: yes. */
bool tasks_may_begin(const struct tasks *tasks, const struct program *program, uint32_t count,
		     int64_t now_ns);
/** tasks_begin_above - as tasks_begin(), for the first @count tasks. Scan-safe: yes. */
void tasks_begin_above(struct tasks *tasks, const struct program *program, uint32_t count,
		       const uint8_t *m, int64_t now_ns);
/** tasks_look - records rising edges of the variables that start tasks. Scan-safe: yes. */
void tasks_look(struct tasks *tasks, const struct program *program,
		const uint8_t *m);
/** tasks_next - the due task of the highest priority that did not run in this
 * cycle; task_count: none. Scan-safe: yes. */
uint32_t tasks_next(const struct tasks *tasks, const struct program *program);
/** tasks_take - notes that @task runs now: counts missed periods and sets the next
 * deadline, a multiple of its interval. Scan-safe: yes. */
void tasks_take(struct tasks *tasks, const struct program *program, uint32_t task,
		int64_t now_ns);
/**
 * tasks_must_yield - whether the cycle must end before @task, so that a task of higher
 * priority waits for one other at most
 * @late: the next cycle should have begun by now
 *
 * True if the deadline of such a task has come at @now_ns; or if it is @late, as an
 * event may have come that only a new cycle sees. Scan-safe: yes.
 */
bool tasks_must_yield(const struct tasks *tasks, const struct program *program,
		      uint32_t task, int64_t now_ns, bool late);
#endif
