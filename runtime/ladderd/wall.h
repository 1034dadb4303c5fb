/* SPDX-License-Identifier: MIT
 *
 * wall - date and time of the wall, in the zone of this machine, for SYS_DATE_TIME
 * and its like. No timer follows it: it may jump.
 */
#ifndef LADDERD_WALL_H
#define LADDERD_WALL_H

#include <stdint.h>

struct wall {
	int64_t zone_ns;       /* east of Greenwich                           */
	int64_t until_ns;      /* looked up again when UTC is not before this */
	int64_t from_ns;       /* … or before this: it was set back           */
};

/**
 * wall_offset - date and time of the wall, less @now_ns of CLOCK_MONOTONIC
 * @wall: {0} to begin with
 *
 * Looks the zone up at the first call and once in a quarter of an hour, when summer
 * may begin or end; the first call may allocate.   Scan-safe: between scans.
 */
int64_t wall_offset(struct wall *wall, int64_t now_ns);
#endif
