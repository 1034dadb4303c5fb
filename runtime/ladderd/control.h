/* SPDX-License-Identifier: MIT
 *
 * control - what the daemon says: the status block, faults, traced outputs.
 *
 * It writes into a fixed buffer and never waits for a reader while the program
 * runs: what a full pipe does not take is lost.
 */
#ifndef LADDERD_CONTROL_H
#define LADDERD_CONTROL_H

#include "ladderd/cycle.h"

/**
 * control_status - the status block on stdout, ended by an empty line
 * @wait: the last one; wait for a slow reader
 *
 * Scan-safe: between scans.   Fails: what cannot be written is lost.
 */
void control_status(const struct cycle *cycle, bool wait);
/** control_tell - "ladderd: TEXT" on stderr. Scan-safe: between scans. */
void control_tell(const char *text);
/** control_tell_error - the same with what the system says. Any thread. */
void control_tell_error(const char *text, const char *why);
/** control_tell_halt - the same when the program asked for STOP, and where. */
void control_tell_halt(const struct cycle *cycle);
/** control_tell_failed - the same with the operation that failed first: no fault. */
void control_tell_failed(const struct cycle *cycle);
/** control_tell_fault - the same with the fault and its place. */
void control_tell_fault(const struct cycle *cycle);
/** control_trace - "%QX0.0 1" on stderr; for struct hal. Scan-safe: yes, also
 * in a signal handler. */
void control_trace(void *context, const struct io_point *point, bool value);
#endif
