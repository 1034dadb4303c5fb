/* SPDX-License-Identifier: MIT
 *
 * control - prints the status, messages about faults, and traced outputs.
 *
 * It uses a fixed buffer and never waits for a reader while the program runs: text that a
 * full pipe does not take is lost.
 */
#ifndef LADDERD_CONTROL_H
#define LADDERD_CONTROL_H

#include "ladderd/cycle.h"

/**
 * control_status - prints the status to stdout, ended by an empty line
 * @wait: waits for a slow reader; for the last status
 *
 * Scan-safe: between scans.   Fails: text that cannot be written is lost.
 */
void control_status(const struct cycle *cycle, bool wait);
struct board_status;
/** control_fill_status - the same as fields, for a desk. Scan-safe: between scans. */
void control_fill_status(const struct cycle *cycle, struct board_status *status);
/** control_print_fault - the fault and its place, as text. Scan-safe: between scans. */
void control_print_fault(const struct resource *resource, char *out, size_t size);
/** control_tell - prints "ladderd: TEXT" to stderr. Scan-safe: between scans. */
void control_tell(const char *text);
/** control_tell_error - prints @text and an error of the system. Any thread. */
void control_tell_error(const char *text, const char *why);
/** control_tell_halt - prints that the program executed STOP, and where. */
void control_tell_halt(const struct cycle *cycle);
/** control_tell_failed - prints the place of the first operation that set ENO to FALSE. */
void control_tell_failed(const struct cycle *cycle);
/** control_tell_fault - prints the fault and its place. */
void control_tell_fault(const struct cycle *cycle);
/** control_trace - prints "%QX0.0 1" to stderr; for struct hal. Scan-safe: yes, also
 * in a signal handler. */
void control_trace(void *context, const struct io_point *point, bool value);
/** control_trace_values - of the points with channels: "%AQW0 1200", "%AIW2 0 stale". After a scan;
 * nothing without --trace-io. Scan-safe: yes, but not in a signal handler. */
#ifdef RUNGBOARD_SMALL
#define control_trace_values(cycle) ((void)0)
#else
void control_trace_values(struct cycle *cycle);
#endif
#endif
