/* SPDX-License-Identifier: MIT
 *
 * wall - local date and time for SYS_DATE_TIME and similar names. It may jump, so no timer
 * uses it.
 */
#ifndef LADDERD_WALL_H
#define LADDERD_WALL_H

#include <stdint.h>

struct wall {
	int64_t zone_ns;       /* local time less UTC                         */
	int64_t until_ns;      /* zone_ns holds until this UTC                */
	int64_t from_ns;       /* zone_ns holds from this UTC                 */
};

/**
 * wall_offset - local date and time, less @now_ns of CLOCK_MONOTONIC
 * @wall: {0} before the first call
 *
 * Looks up the zone at the first call and every quarter of an hour, because daylight saving
 * time may change then. The first call may allocate.   Scan-safe: between scans.
 */
int64_t wall_offset(struct wall *wall, int64_t now_ns);
#endif
