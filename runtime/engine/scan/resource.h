/* SPDX-License-Identifier: MIT
 *
 * resource - a controller at work: state, scan, system bits, faults.
 *
 * (IEC 61131-3: a RESOURCE runs programs.) The daemon, the simulator and the tests all
 * run a scan with it. It reads no clock and accesses no hardware.
 */
#ifndef SCAN_RESOURCE_H
#define SCAN_RESOURCE_H

#include "engine/scan/task.h"
#include "engine/scan/vm.h"

enum resource_state { STATE_STOP, STATE_RUN, STATE_FAULT };

struct fault_place {
	const char *pou;        /* name, or ""; lives with the program        */
	const char *task;       /* likewise, of a declared task; or NULL      */
	uint32_t rung, row, col; /* 1-based; 0: unknown                       */
	uint32_t line;          /* of the file instead, in a list; 0: unknown */
};

struct resource;
struct still;
/* How tasks interrupt others: of ladderd, of the simulation, of a record. */
struct interrupts {
	/* At a safe point, while vm.ask is not 0: shall tasks that have become due run? Then
	 * @now_ns gets their time. */
	bool (*asks)(struct resource *resource, int64_t *now_ns);
	/* Reads inputs into the image. Fails: false: FAULT_IO. NULL: the scan stands at this
	 * point, and the next call of resource_scan() goes on with it. */
	bool (*begin)(struct resource *resource, int64_t now_ns);
	/* Uses the outputs in the image. Fails: likewise. */
	bool (*end)(struct resource *resource, int64_t now_ns);
	/* A task ran from @from of `words` up to now; @whole: it has ended. NULL: nobody wants
	 * to know. */
	void (*ran)(struct resource *resource, uint32_t task, uint64_t from, bool whole);
};

/* Work in virtual time; for trial/pace.h only. */
#define PACE_PARTS 16
struct pace_part {
	uint32_t from, to; /* words since the begin of the work; 2^32 - 1: or more */
	uint8_t task;
	bool whole;        /* the run ended; otherwise it goes on later       */
};
/* A jump back, the words that a round costs, and those that the last safe point in it counted too
 * much. */
struct pace_loop { const uint32_t *from; uint32_t words, behind; };
#define PACE_LOOPS 8

struct paced {
	uint64_t speed;              /* words a millisecond; 0: work takes no time */
	uint64_t most;               /* words left in this period when it began */
	uint64_t owed;               /* words that reach into the next period */
	uint64_t taken;              /* of the scan, in all its periods       */
	uint32_t late_row;
	int64_t begin_ns;            /* of the work in this period            */
	struct pace_part part[PACE_PARTS]; /* the first ones of this period   */
	uint32_t parts;
#ifndef RUNGBOARD_SMALL
	struct pace_loop loop[PACE_LOOPS]; /* those of this period, by `from` */
#endif
};

/* A task that runs, or was interrupted and goes on later. */
struct level_run {
	uint32_t task, call;         /* which one of its programs runs        */
	uint32_t resume;             /* where that goes on, as vm.resume      */
	uint32_t ahead;              /* words from there to the next safe point */
	uint32_t budget;             /* that is left                          */
	bool begun, passed;          /* the point before it, or before the program, is passed */
	int64_t now_ns;              /* of its cycle                          */
	int64_t second_ns, day_ns;   /* likewise, as those of the resource    */
	int64_t begin_ns;            /* by clock_ns                           */
};

struct resource {
	struct image image;
	struct vm vm;
	struct tasks tasks;
	enum resource_state state;
	enum fault fault;            /* first one since the reset             */
	struct fault_place fault_at;
	bool halted;                 /* in STOP because the program executed a STOP */
	struct fault_place halt_at;  /* its STOP                              */
	uint64_t scans;              /* since resource_start                  */
	int64_t start_ns;            /* time of the first scan                */
	uint32_t errors_before;      /* errors when this scan began           */
	struct fault_place error_at; /* the first operation that failed       */
	bool watch;                  /* run the instrumented section          */
	/* Set by the caller before a scan; shown as SYS_ bits and words. */
	bool late, io_fault;
	bool warm, retain_lost, retain_old_copy; /* after resource_start()   */
	int64_t timers_ns;           /* of function blocks' time - now_ns, that
					retained timers go on; else 0         */
	uint32_t scan_us, scan_max_us;
	uint32_t tasks_most;         /* tasks that run in the scan, when it is computed again;
				      * 0: as the clock allows               */
	uint32_t tasks_ran;          /* in this scan, without those that interrupted others */
	struct level_run run[LIMIT_LEVELS + 1]; /* run[level] runs, those below it wait */
	uint32_t level;              /* how many are interrupted              */
	bool standing;               /* the scan stands at a safe point: see interrupts.begin */
#ifndef RUNGBOARD_SMALL
	bool stopped;                /* it stands in a program, where vm.run ended with
				      * FAULT_PAUSED: see resource_go_on()    */
	bool stopped_late;           /* likewise, in a scan that stood before */
#endif
	int64_t asked_ns;            /* the time that interrupts.asks() gave  */
	uint64_t words;              /* of the programs that ended in this call of
				      * resource_scan(), all of each, and those that they
				      * called. With interrupts.ran, and vm.ask then set,
				      * safe points count instead, up to the next one   */
	int64_t wall_offset_ns;      /* date and time of the wall - now_ns    */
	int64_t second_ns, day_ns;   /* what SYS_SECOND and SYS_DATE show     */
	/* Set once by the caller; a start does not change them. */
	/* Measures declared tasks; NULL: no times. */
	int64_t (*clock_ns)(const struct resource *resource);
	const struct interrupts *interrupts; /* NULL: no task interrupts another */
	struct paced pace;
	int64_t tick_ns;             /* from one cycle to the next; 0: unknown */
	int64_t period_ns;           /* of cycles, where tasks have no INTERVAL */
	uint32_t patience;           /* watchdog of each task: so many late runs in a row,
				      * or one run that takes so many periods; 0: none.
				      * WATCHDOG is always active. */
	struct still *still;         /* leaves out what has not changed; NULL: each scan runs
				      * all. Of this program; borrowed       */
	int64_t due_ns;              /* when this scan should have begun, not later than
				      * now; 0: now. Set before each scan if tick_ns is not
				      * 0 */
};

/* The start of SYS_DATE_TIME if wall_offset_ns is not set: in virtual time,
 * DT#2000-01-01-00:00:00 at time 0. */
#define RESOURCE_WALL INT64_C(946684800000000000)

#define RESOURCE_ZONE 56 /* of SYS_ZONE in its area                             */
#define RESOURCE_CYCLE 48 /* of SYS_CYCLE                                       */
#define RESOURCE_DISK 2  /* of SYS_DISK_FAULT: the lowest bit                   */

/** resource_init - in STOP, image as at a cold start. @memory as image_init. */
void resource_init(struct resource *resource, const struct program *program,
		   void *memory);
/** resource_start - to RUN with a cold image; resets a latched fault. */
void resource_start(struct resource *resource);
/** resource_zone - sets SYS_ZONE, in ns; before a scan, as inputs are read. A cold start and
 * virtual time have 0. Scan-safe: yes. */
void resource_zone(struct resource *resource, int64_t zone_ns);
/** resource_disk - sets SYS_DISK_FAULT; before a scan, as inputs are read. Scan-safe: yes. */
void resource_disk(struct resource *resource, bool fault);
/** resource_stop - to STOP. The caller sets the outputs to their safe values. */
void resource_stop(struct resource *resource);
/** resource_fail - to FAULT, latched; the first cause is kept. */
void resource_fail(struct resource *resource, enum fault fault);

/**
 * resource_scan - one scan at @now_ns: system bits, forces, due tasks, forces
 * @now_ns: monotonic; not before that of the scan before
 *
 * Tasks run by priority, each at most once. At a safe point of a task (between two rungs or
 * statements, or before a program) tasks of higher priority that are due interrupt it, if
 * `interrupts` is set; not in the first scan. Without `interrupts`, and with a clock, the scan
 * ends early, between two tasks: see tasks_must_yield().
 * If `standing` is set afterwards, the scan is not complete: the image shows inputs and outputs
 * as a task of higher priority would see them. The next call goes on with it at its own @now_ns,
 * after the tasks of higher priority that are due then.
 * Inputs must be in the image; outputs are in it afterwards. In STOP and FAULT it
 * does nothing. Scan-safe: yes, it is the scan.
 * Fails: false and STATE_FAULT when a program faults. Also false when a program asked
 * for STOP: then `halted` is set and the outputs in the image are 0.
 */
bool resource_scan(struct resource *resource, int64_t now_ns);

#ifndef RUNGBOARD_SMALL
/** resource_go_on - goes on with a scan that is `stopped`: no time has passed, nothing begins anew.
 * It may be `stopped` again. Returns, scan-safe, fails: as resource_scan(). */
bool resource_go_on(struct resource *resource);
#endif

/**
 * resource_power - power of a cell in the last scan, when `watch` was on
 * @in, @out: power at its left end and what it lets through
 * Fails: false if the map lacks the cell.   Scan-safe: yes (a search).
 */
bool resource_power(const struct resource *resource, uint32_t pou, uint32_t rung,
		    uint32_t row, uint32_t col, bool *in, bool *out);
/** resource_fault_print - what went wrong, and in which task if tasks are declared:
 * "task Fast: watchdog: …". @size at least 96. Scan-safe: yes. */
void resource_fault_print(const struct resource *resource, char *out, size_t size);
/** resource_power_in - the same for a cell in the body of a function block, for one
 * instance
 * @instance: "Belt1", "Line.Belt1.Soft" (any case). resource_power() gives the power of
 *            the instance that was called last. Fails: false if there is no such
 *            instance or cell. Scan-safe: no. */
bool resource_power_in(const struct resource *resource, const char *instance,
		       size_t len, uint32_t rung, uint32_t row, uint32_t col,
		       bool *in, bool *out);
/** resource_halt_print - the place where the program executed a STOP: "STOP, outputs are
 * safe: the program says so: Main rung 3". @size at least 96. Scan-safe: yes. */
void resource_halt_print(const struct resource *resource, char *out, size_t size);
/** resource_place - POU, rung and cell of a word of CODE_TEXT; those of CODE_WATCH are
 * counted on behind it. Scan-safe: yes (a search). */
struct fault_place resource_place(const struct program *program, uint32_t text);
#endif
