/* SPDX-License-Identifier: MIT
 *
 * cycle - one scan after the other, each at its absolute time.
 *
 * With wall.c the only place of the runtime that reads a clock. It never catches up:
 * periods that were missed are counted and left out. It allocates nothing and
 * opens nothing but lines that were lost, and those only in FAULT.
 */
#ifndef LADDERD_CYCLE_H
#define LADDERD_CYCLE_H

#include "engine/scan/resource.h"
#include "ladderd/notify.h"
#include "ladderd/safe.h"
#include "ladderd/stats.h"
#include "ladderd/store.h"
#include "ladderd/wall.h"

struct cycle {
	struct resource resource;
	struct hal hal;
	struct monitor monitor;
	struct notify notify;
	struct wall wall;
	struct requests *requests;
	struct store *store;   /* of retained values; NULL: none              */
	const char *board;
	char identity[65];   /* SHA-256 of the program, hex               */
	int64_t period_ns;   /* from one cycle to the next                  */
	int64_t watchdog;      /* periods: late in a row, or of one scan      */
	bool tasks;            /* are declared: they are judged, not scans    */
	uint64_t most_scans;   /* 0: until it is stopped                      */
	/* Since the daemon began. */
	uint64_t scans;
	uint64_t late;         /* periods that were left out                  */
	uint64_t resets;       /* of a latched fault                          */
	int64_t late_row;      /* scans in a row that were late               */
	bool failed;           /* told that an operation failed, since a start */
	struct stats scan, wake;
	struct stats body;     /* the program alone, no lines                 */
	int64_t tended_ns;     /* lines, in FAULT                             */
	int clock_error;       /* errno of a clock that does not work         */
};

/**
 * cycle_plan - sets the period and the limit of a scan's time
 * @period_ns: asked for; 0: not
 *
 * The resource is initialised. Returns how long one scan may take before it counts
 * as hung, in ns.   Scan-safe: no.
 */
int64_t cycle_plan(struct cycle *cycle, int64_t period_ns, int64_t watchdog);

/**
 * cycle_run - scans until a stop is asked for, or most_scans are done
 *
 * The HAL is open, its outputs are safe, the resource is initialised.
 * Afterwards it is in STOP or FAULT; the caller drives the safe outputs
 * (hal_close).
 * Returns the exit status: 1 if it ended in FAULT, else 0.
 */
int cycle_run(struct cycle *cycle);
#endif
