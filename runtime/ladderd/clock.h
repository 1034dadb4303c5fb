/* SPDX-License-Identifier: MIT
 *
 * clock - the date and time of the board for the link: read, and set where the kernel allows it.
 *
 * Timers of programs use another clock, which never moves; wall.h has what the scan needs.
 */
#ifndef LADDERD_CLOCK_H
#define LADDERD_CLOCK_H

#include "online/board_time.h"

/** clock_wall - CLOCK_REALTIME, ns since 1970. */
int64_t clock_wall(void);
/** clock_read - @at_ns: when the zone is wanted; 0: now. The first call may allocate. */
void clock_read(int64_t at_ns, struct board_time *out);
/** clock_set - Fails: REFUSAL_TIME_RIGHT, REFUSAL_RANGE. */
enum refusal clock_set(int64_t time_ns);
#endif
