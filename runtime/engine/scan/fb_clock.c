/* SPDX-License-Identifier: MIT
 *
 * fb_clock - RTC_ALARM and WEEK_TIMER, weekly time switches; YEAR_TIMER, a yearly one.
 *
 * The date and time come through a pin: no block reads a wall clock itself.
 */
#include "engine/scan/fb.h"

#include "engine/base/iec.h"

#define DAY_NS (INT64_C(86400) * 1000000000)
#define WEEK   7
#define MONTHS 12

/* Whether the day is marked. Day 0, 1970-01-01, was a Thursday: bit 3. */
static bool is_marked(uint8_t days, int64_t day)
{
	int64_t bit = (day + 3) % WEEK;

	return days >> (bit < 0 ? bit + WEEK : bit) & 1;
}

/* The day of a moment, counted from 1970-01-01; *time: since its midnight. */
static int64_t day_of(int64_t now_ns, int64_t *time)
{
	const int64_t day = now_ns / DAY_NS - (now_ns % DAY_NS < 0);

	*time = now_ns % DAY_NS + (now_ns % DAY_NS < 0 ? DAY_NS : 0);
	return day;
}

/* From @on to @off on the marked days; if @off is before @on, on the next day. */
static bool is_on(int64_t now_ns, uint8_t days, int64_t on, int64_t off)
{
	int64_t time, day = day_of(now_ns, &time);
	const bool today = is_marked(days, day);

	if (on == off)
		return false;
	if (on < off)
		return today && time >= on && time < off;
	return (today && time >= on) || (is_marked(days, day - 1) && time < off);
}

void fb_RTC_ALARM_step(struct fb_RTC_ALARM *fb, int64_t now_ns)
{
	(void)now_ns;
	fb->Q = fb->EN && is_on(fb->NOW, fb->DAYS, fb->ON, fb->OFF);
}

void fb_WEEK_TIMER_step(struct fb_WEEK_TIMER *fb, int64_t now_ns)
{
	(void)now_ns;
	fb->Q = fb->EN && (is_on(fb->NOW, fb->DAYS1, fb->ON1, fb->OFF1) ||
			   is_on(fb->NOW, fb->DAYS2, fb->ON2, fb->OFF2) ||
			   is_on(fb->NOW, fb->DAYS3, fb->ON3, fb->OFF3));
}

/* A day of some year: 29 February, too. */
static bool is_day(int month, int day)
{
	static const uint8_t days[MONTHS] = { 31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31 };

	return month >= 1 && month <= MONTHS && day >= 1 && day <= days[month - 1];
}

void fb_YEAR_TIMER_step(struct fb_YEAR_TIMER *fb, int64_t now_ns)
{
	const int from = fb->FROM_MONTH * 32 + fb->FROM_DAY, to = fb->TO_MONTH * 32 + fb->TO_DAY;
	int year, month, of_month, today;
	int64_t time;

	(void)now_ns;
	fb->ENO = fb->EN && is_day(fb->FROM_MONTH, fb->FROM_DAY) &&
		  is_day(fb->TO_MONTH, fb->TO_DAY);
	iec_civil(day_of(fb->NOW, &time), &year, &month, &of_month);
	today = month * 32 + of_month;
	fb->Q = fb->ENO && (from <= to ? today >= from && today <= to :
					 today >= from || today <= to);
}
