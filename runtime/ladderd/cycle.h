/* SPDX-License-Identifier: MIT
 *
 * cycle - runs scans at absolute times.
 *
 * Missed periods are counted and skipped, never caught up. It allocates nothing. It opens
 * only lines that were lost, and only in FAULT. Apart from wall.c, no other part of a scan
 * reads a clock.
 */
#ifndef LADDERD_CYCLE_H
#define LADDERD_CYCLE_H

#include "engine/scan/resource.h"
#include "ladderd/notify.h"
#include "ladderd/safe.h"
#include "ladderd/stats.h"
#include "ladderd/store.h"
#include "ladderd/wall.h"
#include "online/service.h"

#include <stdatomic.h>

struct cycle {
	struct resource resource;
	struct hal hal;
	struct monitor monitor;
	struct notify notify;
	struct wall wall;
	struct requests *requests;
	struct store *store;   /* retained values; NULL: no --retain          */
	struct link *link;     /* to desks; NULL: no --link                   */
	const char *_Atomic board; /* its name; borrowed                      */
	char given[64];        /* … by a desk                                 */
	uint8_t identity_bytes[32]; /* SHA-256 of the program                 */
	char identity[65];   /* the same in hex                           */
	int64_t period_ns;   /* from one cycle to the next                  */
	int64_t watchdog;      /* late scans in a row, or periods of one scan */
	bool tasks;            /* tasks are declared: each has its own limit  */
	int64_t next_ns;       /* when the next cycle is due; while a scan runs, also one of
				* tasks that interrupt it                     */
	int64_t asked_ns;      /* a time at which the timer of safe_ask() comes; 0: none */
	int64_t wanted_ns;     /* --period; 0: not given                      */
	bool full_scan;        /* each scan runs the whole program            */
	bool begin_stopped;    /* does not run at the start                   */
	const char *stopped;   /* why it began in STOP; NULL: not known        */
	bool restart;          /* ends in order to begin with the newest slot */
	bool restart_stopped;  /* … in STOP                                   */
	uint64_t most_scans;   /* 0: no limit                                 */
	struct standby *trial; /* the program that runs, if a FAULT brings the one before
				* back; else NULL                             */
	uint32_t trial_left;   /* scans until it need not come back           */
	/* Since the daemon began. */
	uint64_t scans;
	uint64_t late;         /* skipped periods                             */
	uint64_t resets;       /* of a latched fault                          */
	int64_t late_row;      /* late scans in a row                         */
	int64_t late_limit;    /* … that are an event                         */
	_Atomic uint32_t late_rows; /* how often there were so many           */
	_Atomic bool disk_bad; /* something cannot be stored: for SYS_DISK_FAULT */
	bool failed;           /* a failed operation was reported             */
	struct stats scan, wake;
	struct stats body;     /* the program alone, no lines                 */
	uint64_t words;        /* of the instructions that ran in this time   */
	int64_t tended_ns;     /* last tend_lines()                           */
	int clock_error;       /* errno of clock_nanosleep()                  */
};

/**
 * cycle_plan - sets the period and the limit of a scan's time
 * @period_ns: --period; 0: not given
 *
 * The resource must be initialised. Returns the time in ns after which a scan counts as
 * hung.   Scan-safe: no.
 */
int64_t cycle_plan(struct cycle *cycle, int64_t period_ns, int64_t watchdog);

/**
 * cycle_run - scans until a stop is requested, or most_scans are done
 *
 * The HAL must be open with safe outputs, the resource initialised. Afterwards the resource
 * is in STOP or FAULT, and the caller writes the safe outputs (hal_close()).
 * Returns the exit status: 1 if it ended in FAULT, else 0.
 */
int cycle_run(struct cycle *cycle);
struct options;
/** cycle_name - the name of the board is @name; "": @of_map. It borrows them. Scan-safe: yes. */
void cycle_name(struct cycle *cycle, const char *name, const char *of_map);
/** cycle_board - the name of the board, for the scan thread. Scan-safe: yes. */
static inline const char *cycle_board(const struct cycle *cycle)
{
	return atomic_load_explicit(&cycle->board, memory_order_relaxed);
}
struct standby;
/**
 * cycle_swap - goes on with the program of @standby, in the state of the present one
 * @back: a FAULT within so many scans brings the present program back, as it is now; 0: none
 *
 * Retained values are not stored until cycle->store is set again. Scan-safe: between scans.
 * Fails: REFUSAL_CONFLICT: it was made beside another program; nothing has changed.
 */
enum refusal cycle_swap(struct cycle *cycle, struct standby *standby, uint32_t back);
/** cycle_back - the program before goes on instead of entering @fault. Scan-safe: yes. Only
 * during a trial. */
void cycle_back(struct cycle *cycle, enum fault fault);
/** cycle_pass - the trial, if there is one, is over: the program stays. Scan-safe: yes. */
void cycle_pass(struct cycle *cycle);
/**
 * cycle_mode - what a desk orders: stop, run, reset
 *
 * Scan-safe: between scans.
 * Fails: REFUSAL_NOT_NOW: not in this state; REFUSAL_IO: a line does not answer.
 */
enum refusal cycle_mode(struct cycle *cycle, enum mode_wish wish);

/* A small board has neither link nor trial, or with LINK=serial a link without trials; the
 * compiler leaves out what would use them. */
#ifndef RUNGBOARD_SMALL
#define HAS_LINK 1
#define HAS_TRIAL 1
#elif defined(RUNGBOARD_SERIAL)
#define HAS_LINK 1
#define HAS_TRIAL 0
#else
#define HAS_LINK 0
#define HAS_TRIAL 0
#endif
/** cycle_link - the link to desks; NULL: none. Scan-safe: yes. */
static inline struct link *cycle_link(const struct cycle *cycle)
{
	return HAS_LINK ? cycle->link : NULL;
}
/** cycle_on_trial - whether a FAULT brings the program before back. Scan-safe: yes. */
static inline bool cycle_on_trial(const struct cycle *cycle)
{
	return HAS_TRIAL && cycle->trial;
}
#endif
