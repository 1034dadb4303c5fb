/* SPDX-License-Identifier: MIT
 *
 * test_fb_clock - WEEK_TIMER, YEAR_TIMER and SUN: 400 days minute by minute against the C
 * library's calendar, both changes of summer time, and the sun against published tables and
 * against another formula.
 */
#define _DEFAULT_SOURCE /* timegm(), tzset() */
#include "engine/scan/vm.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define SECOND INT64_C(1000000000)
#define MINUTE (60 * SECOND)
#define HOUR   (60 * MINUTE)
#define DAY    (24 * HOUR)
#define DAYS   400

/* Minutes from one try to the next: an emulator tries every tenth. The plan's times are whole multiples of it. */
static int step(void)
{
	return 10 / tap_rounds(10);
}

/* A date and time as blocks get it. */
static int64_t moment(const struct tm *local)
{
	struct tm copy = *local;

	return (int64_t)timegm(&copy) * SECOND;
}

static int64_t date(int year, int month, int day, int hour, int minute)
{
	return moment(&(struct tm){ .tm_year = year - 1900, .tm_mon = month - 1, .tm_mday = day,
				    .tm_hour = hour, .tm_min = minute });
}

/* ---- weeks ---- */

/* Monday to Friday 6:30 to 8:00; Friday and Saturday 22:00 to 2:00; Sunday 2:30 to 4:00. */
static const struct fb_WEEK_TIMER plan = {
	.EN = 1, .DAYS1 = 0x1f, .ON1 = 6 * HOUR + 30 * MINUTE, .OFF1 = 8 * HOUR,
	.DAYS2 = 0x30, .ON2 = 22 * HOUR, .OFF2 = 2 * HOUR,
	.DAYS3 = 0x40, .ON3 = 2 * HOUR + 30 * MINUTE, .OFF3 = 4 * HOUR,
};

static bool is_planned(const struct tm *local)
{
	const int minute = local->tm_hour * 60 + local->tm_min, day = local->tm_wday;

	return (day >= 1 && day <= 5 && minute >= 390 && minute < 480) ||
	       ((day == 5 || day == 6) && minute >= 1320) ||
	       ((day == 6 || day == 0) && minute < 120) ||
	       (day == 0 && minute >= 150 && minute < 240);
}

/* Minutes of the 400 days in which @zone has another answer than the plan; *on: minutes TRUE. */
static int weeks_in(const char *zone, int *on, int *shifts)
{
	struct fb_WEEK_TIMER timer = plan;
	time_t at = 1767225600; /* 2026-01-01, UTC */
	int wrong = 0, was = -1;
	const int every = step();

	setenv("TZ", zone, 1);
	tzset();
	*on = *shifts = 0;
	for (int i = 0; i < DAYS * 24 * 60; i += every, at += 60 * every) {
		struct tm local;

		localtime_r(&at, &local);
		timer.NOW = moment(&local);
		fb_WEEK_TIMER_step(&timer, 0);
		wrong += timer.Q != is_planned(&local);
		*on += timer.Q * every;
		*shifts += was >= 0 && local.tm_isdst != was;
		was = local.tm_isdst;
	}
	return wrong;
}

static void week_follows_local_time(void)
{
	int utc, berlin, sydney, shifts;

	CHECK_AS(weeks_in("UTC0", &utc, &shifts) == 0 && shifts == 0 && utc > 50000, "UTC");
	CHECK_AS(weeks_in("CET-1CEST,M3.5.0,M10.5.0/3", &berlin, &shifts) == 0 && shifts == 2,
		 "central Europe: both changes of summer time");
	CHECK_AS(weeks_in("AEST-10AEDT,M10.1.0,M4.1.0/3", &sydney, &shifts) == 0 && shifts == 2,
		 "Sydney: summer in January");
}

/* On the last Sunday of March 2 to 3 is missing; in October it comes twice. */
static void changes_of_summer_time(void)
{
	struct fb_WEEK_TIMER timer = plan;
	int on[2] = { 0, 0 };
	const time_t begin[2] = { 1774738800, 1792879200 }; /* midnight of both Sundays */

	setenv("TZ", "CET-1CEST,M3.5.0,M10.5.0/3", 1);
	tzset();
	for (int side = 0; side < 2; side++)
		for (int minute = 0; minute < 6 * 60; minute++) {
			const time_t at = begin[side] + minute * 60;
			struct tm local;

			localtime_r(&at, &local);
			timer.NOW = moment(&local);
			fb_WEEK_TIMER_step(&timer, 0);
			on[side] += timer.Q && local.tm_hour >= 2;
		}
	CHECK_AS(on[0] == 60, "March: 2:30 does not come, so it is on from 3:00 to 4:00");
	CHECK_AS(on[1] == 120, "October: on from 2:30 to 3:00, and again from 2:30 to 4:00");
}

static void week_takes_anything(void)
{
	struct fb_WEEK_TIMER timer;

	for (int byte = 0; byte < 256; byte += 51) {
		memset(&timer, byte, sizeof(timer));
		timer.EN = 1;
		fb_WEEK_TIMER_step(&timer, 0);
		CHECK(timer.Q <= 1);
	}
	timer = (struct fb_WEEK_TIMER){ .EN = 1, .DAYS1 = 127, .DAYS2 = 127, .DAYS3 = 127 };
	fb_WEEK_TIMER_step(&timer, 0);
	CHECK_AS(!timer.Q, "a programme without times is never on");
	timer = plan;
	timer.NOW = date(2026, 11, 30, 7, 0);
	fb_WEEK_TIMER_step(&timer, 0);
	CHECK_AS(timer.Q, "a Monday at seven");
	timer.EN = 0;
	fb_WEEK_TIMER_step(&timer, 0);
	CHECK_AS(!timer.Q, "not without EN");
}

/* ---- years ---- */

/* Days of 400 on which it is on, from 2027-12-01; 2028 has a 29 February. */
static int year_days(int from_month, int from_day, int to_month, int to_day)
{
	struct fb_YEAR_TIMER timer = { .EN = 1, .FROM_MONTH = (uint8_t)from_month,
				       .FROM_DAY = (uint8_t)from_day,
				       .TO_MONTH = (uint8_t)to_month, .TO_DAY = (uint8_t)to_day };
	int days = 0;

	for (int64_t day = 0; day < DAYS; day++) {
		const int64_t at = date(2027, 12, 1, 0, 0) + day * DAY;
		bool first, last;

		timer.NOW = at;
		fb_YEAR_TIMER_step(&timer, 0);
		first = timer.Q;
		timer.NOW = at + DAY - 1;
		fb_YEAR_TIMER_step(&timer, 0);
		last = timer.Q;
		if (first != last || !timer.ENO)
			return -1;
		days += first;
	}
	return days;
}

static void year_counts_days(void)
{
	struct fb_YEAR_TIMER timer = { .EN = 1, .FROM_MONTH = 2, .FROM_DAY = 30, .TO_MONTH = 12,
				       .TO_DAY = 31 };

	CHECK_AS(year_days(1, 1, 12, 31) == DAYS, "the whole year");
	CHECK_AS(year_days(5, 1, 9, 30) == 153, "May to September");
	CHECK_AS(year_days(11, 1, 3, 31) == 122 + 61 + 3, "November to March, over New Year");
	CHECK_AS(year_days(2, 29, 2, 29) == 1, "29 February of 2028");
	CHECK_AS(year_days(2, 28, 3, 1) == 3, "three days in a leap year");
	CHECK_AS(year_days(12, 25, 12, 25) == 2, "one day: two Christmases in 400 days");
	fb_YEAR_TIMER_step(&timer, 0);
	CHECK_AS(!timer.ENO && !timer.Q, "there is no 30 February");
	timer.FROM_DAY = 29, timer.TO_MONTH = 13;
	fb_YEAR_TIMER_step(&timer, 0);
	CHECK_AS(!timer.ENO && !timer.Q, "nor a month 13");
	timer.TO_MONTH = 0;
	fb_YEAR_TIMER_step(&timer, 0);
	CHECK(!timer.ENO && !timer.Q);
	timer.TO_MONTH = 3, timer.NOW = date(2027, 2, 28, 23, 59);
	fb_YEAR_TIMER_step(&timer, 0);
	CHECK_AS(timer.ENO && !timer.Q, "without a 29 February it begins on 1 March");
	timer.NOW = date(2027, 3, 1, 0, 0);
	fb_YEAR_TIMER_step(&timer, 0);
	CHECK(timer.ENO && timer.Q);
	memset(&timer, 0xff, sizeof(timer));
	fb_YEAR_TIMER_step(&timer, 0);
	CHECK(!timer.ENO && !timer.Q);
}

/* ---- the sun ---- */

static struct fb_SUN sun(double latitude, double longitude, int64_t zone, int64_t now)
{
	struct fb_SUN fb = { .EN = 1, .NOW = now, .ZONE = zone, .LATITUDE = (float)latitude,
			     .LONGITUDE = (float)longitude };

	fb_SUN_step(&fb, 0);
	return fb;
}

static bool within(int64_t time, int hour, int minute, int minutes)
{
	return llabs(time - (hour * HOUR + minute * MINUTE)) <= minutes * MINUTE;
}

/* Sunrise of 2002-01-01 in mean local time: L. Strous, "The Position of the Sun: Tables",
 * Astronomy Answers, table 1. Day lengths of London in 2024: stjerneskinn.com. */
static void sun_of_tables(void)
{
	static const struct { int latitude, hour, minute; } rises[] = {
		{ -64, 1, 43 }, { -60, 2, 43 }, { -50, 3, 55 }, { -40, 4, 35 }, { -30, 5, 2 },
		{ -20, 5, 24 }, { -10, 5, 43 }, { 0, 6, 0 }, { 10, 6, 17 }, { 20, 6, 35 },
		{ 30, 6, 56 }, { 40, 7, 22 }, { 44, 7, 35 }, { 48, 7, 50 }, { 50, 7, 59 },
	};
	static const struct { int month, day, hour, minute; } lengths[] = {
		{ 1, 1, 7, 55 }, { 1, 15, 8, 20 }, { 1, 31, 9, 6 }, { 2, 14, 9, 55 },
	};

	for (size_t i = 0; i < sizeof(rises) / sizeof(*rises); i++) {
		const struct fb_SUN fb = sun(rises[i].latitude, 0, 0, date(2002, 1, 1, 3, 0));

		CHECK_AS(fb.ENO && within(fb.RISE, rises[i].hour, rises[i].minute, 2),
			 "sunrise at a latitude");
	}
	for (size_t i = 0; i < sizeof(lengths) / sizeof(*lengths); i++) {
		const struct fb_SUN fb = sun(51.5, -0.12, 0, date(2024, lengths[i].month,
								lengths[i].day, 12, 0));

		CHECK_AS(within(fb.LENGTH, lengths[i].hour, lengths[i].minute, 2), "a day in London");
	}
}

static double radians(double degrees)
{
	return degrees * 3.14159265358979323846 / 180;
}

/* Degrees of the sun above the horizon: the low-precision formulas of the Astronomical
 * Almanac, by right ascension and sidereal time. */
static double altitude(double latitude, double longitude, int64_t utc_ns)
{
	const double n = (double)(utc_ns - date(2000, 1, 1, 12, 0)) / (double)DAY;
	const double g = radians(357.528 + 0.9856003 * n);
	const double l = radians(280.460 + 0.9856474 * n + 1.915 * sin(g) + 0.020 * sin(2 * g));
	const double e = radians(23.439 - 0.0000004 * n);
	const double ascension = atan2(cos(e) * sin(l), cos(l)), declination = asin(sin(e) * sin(l));
	const double sidereal = radians(280.46061837 + 360.98564736629 * n + longitude);
	const double turned = sidereal - ascension, at = radians(latitude);

	return asin(sin(at) * sin(declination) + cos(at) * cos(declination) * cos(turned)) /
	       radians(1);
}

/* RISE or SET of the day as a moment in UTC: the one near the noon of the place. */
static int64_t utc_of(const struct fb_SUN *fb, int64_t event, int64_t midnight, int side)
{
	const int64_t noon = midnight + DAY / 2 -
			     (int64_t)((double)fb->LONGITUDE / 360 * (double)DAY);
	int64_t utc = midnight + event - fb->ZONE;

	while (side < 0 ? utc > noon : utc > noon + DAY)
		utc -= DAY;
	while (side < 0 ? utc <= noon - DAY : utc <= noon)
		utc += DAY;
	return utc;
}

static void sun_of_another_formula(void)
{
	static const struct { double latitude, longitude; int64_t zone; } places[] = {
		{ 48.1, 11.6, HOUR }, { -33.9, 151.2, 10 * HOUR }, { 0.1, -78.5, -5 * HOUR },
		{ 64.1, -21.9, 0 }, { 40.7, -74.0, -5 * HOUR }, { -18.1, 178.4, 12 * HOUR },
		{ 39.9, 116.4, 8 * HOUR }, { -54.8, -68.3, -3 * HOUR },
	};
	double worst = 0;
	int days = 0;

	for (size_t i = 0; i < sizeof(places) / sizeof(*places); i++) {
		struct fb_SUN fb = { .EN = 1, .ZONE = places[i].zone,
				     .LATITUDE = (float)places[i].latitude,
				     .LONGITUDE = (float)places[i].longitude };

		for (int day = 0; day < DAYS; day++, days++) {
			const int64_t midnight = date(2026, 1, 1, 0, 0) + day * DAY;
			double rise, set;

			fb.NOW = midnight + 11 * HOUR;
			fb_SUN_step(&fb, 0);
			rise = altitude(places[i].latitude, places[i].longitude,
					utc_of(&fb, fb.RISE, midnight, -1));
			set = altitude(places[i].latitude, places[i].longitude,
				       utc_of(&fb, fb.SET, midnight, 1));
			worst = fmax(worst, fmax(fabs(rise + 0.8333), fabs(set + 0.8333)));
		}
	}
	printf("# %d days, at most %.3f degrees from the horizon\n", days, worst);
	CHECK_AS(worst < 0.05, "at sunrise and sunset the sun is at the horizon");
}

/* Q minute by minute: it is up while it is above the horizon, but for a minute at the ends. */
static void sun_is_up(void)
{
	static const double latitudes[] = { 78.2, 69.6, 66.6, 52.5, 1.3, -43.5, -77.8 };
	const int every = 7 * step();
	int wrong = 0, up = 0;

	for (size_t i = 0; i < sizeof(latitudes) / sizeof(*latitudes); i++) {
		struct fb_SUN fb = { .EN = 1, .ZONE = 2 * HOUR, .LATITUDE = (float)latitudes[i],
				     .LONGITUDE = 18.9f };

		for (int64_t minute = 0; minute < DAYS * 24 * 60; minute += every) {
			double above;

			fb.NOW = date(2026, 1, 1, 0, 0) + minute * MINUTE;
			fb_SUN_step(&fb, 0);
			above = altitude(latitudes[i], 18.9, fb.NOW - fb.ZONE) + 0.8333;
			/* Near a pole the sun moves along the horizon. */
			wrong += fabs(above) > 0.25 && fb.Q != (above > 0);
			up += fb.Q;
		}
	}
	CHECK_AS(wrong == 0, "TRUE exactly while the sun is up, polar day and night included");
	CHECK(up > 7 * DAYS * 24 * 60 / every / 3);
}

static void sun_takes_anything(void)
{
	struct fb_SUN fb = sun(69.6, 18.9, 2 * HOUR, date(2026, 6, 21, 0, 30));

	CHECK_AS(fb.Q && fb.LENGTH == DAY && !fb.RISE && !fb.SET, "the sun does not set");
	fb = sun(69.6, 18.9, HOUR, date(2026, 12, 21, 12, 0));
	CHECK_AS(!fb.Q && fb.ENO && !fb.LENGTH, "nor rise");
	fb.HEIGHT = -6;
	fb_SUN_step(&fb, 0);
	CHECK_AS(fb.Q && fb.LENGTH > HOUR, "but there is a civil twilight");
	fb = sun(90, 0, 0, date(2026, 6, 21, 0, 0));
	CHECK_AS(fb.ENO && fb.Q, "the north pole");
	fb = sun(-90, 180, 0, date(2026, 6, 21, 0, 0));
	CHECK_AS(fb.ENO && !fb.Q, "the south pole");
	CHECK_AS(!sun(90.5, 0, 0, 0).ENO && !sun(0, -181, 0, 0).ENO && !sun(0, NAN, 0, 0).ENO &&
		 !sun(0, 0, 19 * HOUR, 0).ENO && !sun(0, 0, 0, INT64_MIN).ENO &&
		 !sun(0, 0, 0, INT64_MAX).ENO, "what cannot be");
	for (int byte = 0; byte < 256; byte += 17) {
		memset(&fb, byte, sizeof(fb));
		fb.EN = 1, fb.LATITUDE = 48, fb.LONGITUDE = 11, fb.HEIGHT = 0, fb.ZONE = 0;
		fb.NOW = date(2026, 6, 21, 12, 0);
		fb_SUN_step(&fb, 0);
		CHECK(fb.Q <= 1 && fb.RISE >= 0 && fb.RISE < DAY && fb.SET >= 0 && fb.SET < DAY &&
		      fb.LENGTH >= 0 && fb.LENGTH <= DAY);
	}
}

/* Whatever was computed before: the next day, another place, a clock that is set back. */
static void sun_forgets(void)
{
	static const int steps[] = { 1, 1, -1, 40, 0, -400, 1, 2, 1, 1 };
	struct fb_SUN fb = sun(48.1, 11.6, HOUR, date(2026, 3, 1, 12, 0));

	for (size_t i = 0; i < sizeof(steps) / sizeof(*steps); i++) {
		struct fb_SUN fresh;

		fb.NOW += steps[i] * DAY;
		if (i == 4)
			fb.LONGITUDE = -3;
		if (i == 7)
			fb.ZONE = 0;
		fb_SUN_step(&fb, 0);
		fresh = sun((double)fb.LATITUDE, (double)fb.LONGITUDE, fb.ZONE, fb.NOW);
		CHECK(fb.RISE == fresh.RISE && fb.SET == fresh.SET && fb.Q == fresh.Q);
	}
}

int main(void)
{
	week_follows_local_time();
	changes_of_summer_time();
	week_takes_anything();
	year_counts_days();
	sun_of_tables();
	sun_of_another_formula();
	sun_is_up();
	sun_takes_anything();
	sun_forgets();
	return tap_done();
}
