/* SPDX-License-Identifier: MIT
 *
 * script - stimulus scripts: inputs over virtual time, one scan a line.
 *
 *   %I0=1 Start=0    set these, then scan        # a comment
 *   .                scan, nothing set
 *   +25 x10 quiet    10 scans 25 ms apart, show only the last one
 *   @print %Q0..7    what is shown from here on; alone: everything declared
 *   @period 20       time from scan to scan, ms (or 20us, 1s, …)
 *   @reset           cold start; inputs, the clock and the scan number stay
 *   @warm            the same, but VAR RETAIN keeps its values, too
 *   @echo text       `# text` in the trace
 *
 * Time is virtual. A script with an error anywhere does not start.
 */
#ifndef TRIAL_SCRIPT_H
#define TRIAL_SCRIPT_H

#include "engine/scan/resource.h"
#include "engine/trial/plant.h"
#include "engine/trial/trace.h"

/**
 * script_run - reads a whole script, then runs it
 * @file:      names it in diagnostics; outlives @diags
 * @period_ns: until @period; more than 0
 * @resource:  freshly initialised; it is started here
 * @plant:     NULL: none; started and reset with the program; @warm does not change it
 * @trace:     shows the scans; without @print it shows everything declared
 *
 * Each scan first moves the clock on, from 0, then runs at that time. Owns: nothing.
 * Scan-safe: no. Fails: false after a diagnostic (a text error, or DIAG_FAULT of the
 * program), or, without one, when trace_stopped().
 */
bool script_run(const char *file, const char *text, size_t len,
		int64_t period_ns, struct resource *resource, struct plant *plant,
		struct trace *trace, struct diag_list *diags);

/** script_fault - adds the latched fault of @resource as DIAG_FAULT. Returns false. */
bool script_fault(const struct resource *resource, const char *file, int line,
		  struct diag_list *diags);
#endif
