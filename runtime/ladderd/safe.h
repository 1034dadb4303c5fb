/* SPDX-License-Identifier: MIT
 *
 * safe - writes the safe outputs when a scan hangs or the daemon crashes.
 *
 * A timer signal finds scans that hang. It is a signal and not a thread because targets
 * without an MMU may have no threads, and because a handler in the thread that hangs needs
 * no lock. cycle.c handles late scans.
 */
#ifndef LADDERD_SAFE_H
#define LADDERD_SAFE_H

#include "hal/hal.h"

#include <signal.h>
#include <stdint.h>

/* Set by signals, served between scans. */
struct requests {
	volatile sig_atomic_t stop;   /* SIGINT, SIGTERM                      */
	volatile sig_atomic_t status; /* SIGUSR1                              */
	volatile sig_atomic_t reset;  /* SIGHUP                               */
	bool attended;                /* --attended                           */
};
/** requests_hold - signals wait until requests_listen() and requests_heed(): the first thing that
 * ladderd does, and each other start of it. */
void requests_hold(void);
/** requests_end - whether one that waits asks for the end. */
bool requests_end(void);
/** requests_heed - those that waited come now. */
void requests_heed(void);
/** requests_listen - installs the handlers. The struct is static. */
struct requests *requests_listen(void);
/**
 * requests_attend - with --attended, requests a stop when standard input has ended
 *
 * Standard input is a pipe from the program that started ladderd; its bytes are dropped.
 * Scan-safe: between scans, and in a signal handler: two system calls at most.
 */
void requests_attend(struct requests *requests);

struct monitor {
	struct hal *hal;
	struct requests *requests;
	struct guard_page *page;
	volatile int64_t began_ns;    /* the scan that runs                   */
	volatile int64_t limit_ns;
	volatile sig_atomic_t tripped;
};

/**
 * monitor_start - writes the safe outputs if a scan takes longer than @limit_ns
 * @limit_ns: at least 2 us
 *
 * Calls hal_write_safe() again at each further tick, and ends the process with status 1 if
 * a stop is requested meanwhile. There is only one monitor at a time.
 * Owns: the caller, monitor_stop(); @monitor must not move.   Scan-safe: no.
 * Fails: -errno.
 */
int monitor_start(struct monitor *monitor, struct hal *hal,
		  struct requests *requests, int64_t limit_ns);
/** monitor_limit - another limit from now on. Scan-safe: between scans, a system call. */
void monitor_limit(int64_t limit_ns);
void monitor_stop(struct monitor *monitor);
/** monitor_begin, monitor_end - called around each scan, which begins at @now_ns. Scan-safe: yes, no
 * system call. */
void monitor_begin(struct monitor *monitor, int64_t now_ns);
void monitor_end(struct monitor *monitor);
/** monitor_hangs - the outputs are safe since a scan is over its limit, and that scan has not ended yet.
 * In any thread. Scan-safe: yes. */
bool monitor_hangs(void);

/**
 * safe_ask - makes a POSIX timer, whose signal sets *@ask to 1: then the scan looks at the clock
 * at its next safe point
 * @ask: must not move; NULL: no more
 *
 * Without threads. Scan-safe: between scans, some system calls. Fails: false: NULL, or the kernel
 * has no such timers; then no task interrupts another.
 */
bool safe_ask(volatile int *ask);
/** safe_ask_from - after safe_ask(): at @first_ns of CLOCK_MONOTONIC, and each @period_ns from
 * then on. Scan-safe: yes, a system call. */
void safe_ask_from(int64_t first_ns, int64_t period_ns);
/**
 * safe_on_crash - writes the safe outputs before a signal such as SIGSEGV ends the daemon
 * @stack: SAFE_STACK_BYTES for the handler; NULL: no longer (call before hal_close())
 */
#define SAFE_STACK_BYTES 32768
void safe_on_crash(struct hal *hal, void *stack);
#endif
