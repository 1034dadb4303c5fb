/* SPDX-License-Identifier: MIT
 *
 * safe - the safe state when a scan hangs or the daemon itself is broken.
 *
 * A timer signal looks whether a scan stands still. It is a signal and not a
 * thread because targets without an MMU may have no threads, and because it
 * needs no lock: it runs in the thread that hangs. It decides nothing else;
 * late scans are judged by cycle.c.
 */
#ifndef LADDERD_SAFE_H
#define LADDERD_SAFE_H

#include "hal/hal.h"

#include <signal.h>
#include <stdint.h>

/* Set by signals, looked at between scans. */
struct requests {
	volatile sig_atomic_t stop;   /* SIGINT, SIGTERM                      */
	volatile sig_atomic_t status; /* SIGUSR1                              */
	volatile sig_atomic_t reset;  /* SIGHUP                               */
	bool attended;                /* requests_attend() is asked           */
};
/** requests_listen - installs the handlers; the struct lives for ever. */
struct requests *requests_listen(void);
/**
 * requests_attend - is standard input, a pipe of whoever began us, still open? If not, a
 * stop is asked for; what comes from it is thrown away.
 * Scan-safe: between scans, and in a signal handler: two system calls at most.
 */
void requests_attend(struct requests *requests);

struct monitor {
	struct hal *hal;
	struct requests *requests;
	volatile sig_atomic_t scan;   /* odd while a scan runs                */
	volatile sig_atomic_t tripped;
	int seen, still;              /* the handler's own                    */
};

/**
 * monitor_start - from now on a scan that takes @limit_ns is made safe
 *
 * Within @limit_ns, 2 us at least, and half of it: hal_write_safe(), again at every
 * further tick, and if a stop was asked for in the meantime, exit with status 1.
 * There is one monitor at a time.
 * Owns: the caller, monitor_stop(); @monitor must not move.   Scan-safe: no.
 * Fails: -errno.
 */
int monitor_start(struct monitor *monitor, struct hal *hal,
		  struct requests *requests, int64_t limit_ns);
void monitor_stop(struct monitor *monitor);
/* Around each scan. Scan-safe: yes, no system call. */
void monitor_begin(struct monitor *monitor);
void monitor_end(struct monitor *monitor);

/**
 * safe_on_crash - safe values before a signal such as SIGSEGV ends the daemon
 * @stack: for the handler, SAFE_STACK_BYTES; NULL ends it (before hal_close)
 */
#define SAFE_STACK_BYTES 32768
void safe_on_crash(struct hal *hal, void *stack);
#endif
