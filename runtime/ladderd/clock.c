/* SPDX-License-Identifier: MIT
 *
 * clock - CLOCK_REALTIME, and what the kernel knows of its time server.
 */
#define _DEFAULT_SOURCE /* tm_gmtoff, adjtimex() */
#include "ladderd/clock.h"

#include <errno.h>
#include <stdio.h>
#include <sys/timex.h>
#include <time.h>

#define SECOND INT64_C(1000000000)

int64_t clock_wall(void)
{
	struct timespec now;

	clock_gettime(CLOCK_REALTIME, &now);
	return now.tv_sec * SECOND + now.tv_nsec;
}

/* A sandbox may forbid the question. */
static enum board_sync ask_sync(void)
{
	struct timex kernel = { .modes = 0 };

	if (adjtimex(&kernel) < 0)
		return SYNC_UNKNOWN;
	return kernel.status & STA_UNSYNC ? SYNC_NO : SYNC_YES;
}

void clock_read(int64_t at_ns, struct board_time *out)
{
	struct tm local;
	time_t at;

	*out = (struct board_time){ .time_ns = clock_wall(), .sync = (uint8_t)ask_sync() };
	at = (time_t)((at_ns ? at_ns : out->time_ns) / SECOND);
	if (!localtime_r(&at, &local))
		return;
	out->zone_s = (int32_t)local.tm_gmtoff;
	if (local.tm_zone)
		snprintf(out->zone, sizeof(out->zone), "%s", local.tm_zone);
}

enum refusal clock_set(int64_t time_ns)
{
	const struct timespec to = { .tv_sec = (time_t)(time_ns / SECOND),
				     .tv_nsec = (long)(time_ns % SECOND) };

	if (clock_settime(CLOCK_REALTIME, &to) == 0)
		return REFUSAL_NONE;
	return errno == EINVAL ? REFUSAL_RANGE : REFUSAL_TIME_RIGHT;
}
