/* SPDX-License-Identifier: MIT
 *
 * wall - reads CLOCK_REALTIME and the time zone. An unknown zone counts as UTC.
 */
#include "ladderd/wall.h"

#include "engine/base/iec.h"

#include <time.h>

#define SECOND  INT64_C(1000000000)
#define QUARTER (900 * SECOND)

static void look_up_zone(struct wall *wall, time_t seconds)
{
	int64_t utc_ns = (int64_t)seconds * SECOND;
	struct tm local;

	wall->from_ns = utc_ns / QUARTER * QUARTER;
	wall->until_ns = wall->from_ns + QUARTER;
	wall->zone_ns = 0;
	if (!localtime_r(&seconds, &local))
		return;
	wall->zone_ns = iec_days(local.tm_year + 1900, local.tm_mon + 1,
				 local.tm_mday) * 86400 * SECOND;
	wall->zone_ns += (local.tm_hour * INT64_C(3600) + local.tm_min * 60 +
			  local.tm_sec) * SECOND - utc_ns;
}

int64_t wall_offset(struct wall *wall, int64_t now_ns)
{
	struct timespec now;
	int64_t utc_ns;

	clock_gettime(CLOCK_REALTIME, &now);
	utc_ns = (int64_t)now.tv_sec * SECOND + now.tv_nsec;
	if (utc_ns >= wall->until_ns || utc_ns < wall->from_ns)
		look_up_zone(wall, now.tv_sec);
	return utc_ns + wall->zone_ns - now_ns;
}
