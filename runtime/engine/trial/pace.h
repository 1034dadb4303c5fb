/* SPDX-License-Identifier: MIT
 *
 * pace - the time that a board would need for its scans, in virtual time.
 *
 * Without a speed a scan takes no time. With one, each word of instructions takes its part of a
 * millisecond. A scan that is not complete when the next period begins stands at a safe point:
 * tasks of higher priority that are due run first, then it goes on. Where no task may interrupt,
 * the scan takes as many periods as it needs, and no other begins in them. So the order is that of
 * a board, and the same each time.
 */
#ifndef TRIAL_PACE_H
#define TRIAL_PACE_H

#include "engine/scan/resource.h"

#define PACE_SPEED_MOST UINT64_C(100000000)
#define PACE_NO_NUMBER  UINT64_MAX
#define PACE_PATIENCE   10 /* as `ladderd --watchdog`, if that is not given */

/** pace_read - a speed as it is written, in digits; 0, too. Scan-safe: yes. Fails: PACE_NO_NUMBER; any
 * other result above PACE_SPEED_MOST: the number is too large. */
uint64_t pace_read(const char *text, size_t len);
/** pace_set - @speed: words a millisecond, PACE_SPEED_MOST at most; 0: scans take no time. Between
 * two calls of pace_scan(). What is left of a scan then takes no time. Scan-safe: yes. */
void pace_set(struct resource *resource, uint64_t speed);
/**
 * pace_scan - one period, instead of resource_scan()
 * @now_ns: its begin @period_ns: its length, above 0; one above a minute counts as a minute
 *
 * A scan begins in it, or goes on, or goes on working at an instruction. Scan-safe: as
 * resource_scan(). Fails: likewise; FAULT_WATCHDOG as of ladderd: a scan or a run that takes
 * PACE_PATIENCE periods, so many late ones in a row, or the WATCHDOG of a task.
 */
bool pace_scan(struct resource *resource, int64_t now_ns, int64_t period_ns);
/** pace_go_on - goes on with a scan that is `stopped`; @period_ns: as before. As resource_go_on(). */
bool pace_go_on(struct resource *resource, int64_t period_ns);
/** pace_finish - the rest of a scan that stands, at no cost. Scan-safe: as resource_scan(). */
void pace_finish(struct resource *resource);
/** pace_at - the time of a word of this period, as `pace.part` has it, in ns; with a speed.
 * Scan-safe: yes. */
int64_t pace_at(const struct resource *resource, uint64_t words);
#endif
