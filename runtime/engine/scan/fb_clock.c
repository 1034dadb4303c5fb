/* SPDX-License-Identifier: MIT
 *
 * fb_clock - RTC_ALARM, a weekly time switch.
 *
 * The date and time come through a pin: no block reads a wall clock itself.
 */
#include "engine/scan/fb.h"

#define DAY_NS (INT64_C(86400) * 1000000000)
#define WEEK   7

/* Whether the day is marked. Day 0, 1970-01-01, was a Thursday: bit 3. */
static bool is_marked(uint8_t days, int64_t day)
{
	int64_t bit = (day + 3) % WEEK;

	return days >> (bit < 0 ? bit + WEEK : bit) & 1;
}

void fb_RTC_ALARM_step(struct fb_RTC_ALARM *fb, int64_t now_ns)
{
	int64_t day = fb->NOW / DAY_NS - (fb->NOW % DAY_NS < 0);
	int64_t time = fb->NOW % DAY_NS;
	bool today = is_marked(fb->DAYS, day);

	(void)now_ns;
	time += time < 0 ? DAY_NS : 0;
	if (!fb->EN || fb->ON == fb->OFF)
		fb->Q = 0;
	else if (fb->ON < fb->OFF)
		fb->Q = today && time >= fb->ON && time < fb->OFF;
	else
		fb->Q = (today && time >= fb->ON) ||
			(is_marked(fb->DAYS, day - 1) && time < fb->OFF);
}
