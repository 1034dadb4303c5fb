/* SPDX-License-Identifier: MIT
 *
 * fb_sun - SUN: when the sun rises and sets at a place.
 *
 * The position of the sun is computed as in chapters 25 and 28 of Jean Meeus, "Astronomical
 * Algorithms", with the terms that the solar calculator of NOAA uses: good to a minute
 * between the polar circles. It is computed once a day, for the day before, the day itself
 * and the day after, because the night of a place need not lie between two local midnights.
 */
#include "engine/scan/fb.h"
#include "engine/scan/math.h"

#include <math.h>

#define SECOND_NS INT64_C(1000000000)
#define HOUR_NS   (3600 * SECOND_NS)
#define DAY_NS    (24 * HOUR_NS)
#define J2000     (INT64_C(946728000) * SECOND_NS) /* 2000-01-01 12:00 UTC, since 1970 */
#define CENTURY   36525.0                          /* days                      */
#define DEGREE    (3.14159265358979323846 / 180)
#define ZONES     (18 * HOUR_NS)                   /* no zone is further from UTC */
#define FAR       (INT64_MAX - 4 * DAY_NS)

static double sin_of(double degrees)
{
	return math_sin(degrees * DEGREE);
}

static double cos_of(double degrees)
{
	return math_cos(degrees * DEGREE);
}

/* Where the sun is. */
struct sun {
	double sin_declination;
	double ahead_ns;     /* how much a sundial is ahead of mean time      */
};

/* @utc_ns: since 1970. */
static struct sun sun_at(int64_t utc_ns)
{
	const double t = (double)(utc_ns - J2000) / (double)DAY_NS / CENTURY;
	const double mean = 280.46646 + t * (36000.76983 + t * 0.0003032);
	const double anomaly = 357.52911 + t * (35999.05029 - t * 0.0001537);
	const double eccentricity = 0.016708634 - t * (0.000042037 + t * 0.0000001267);
	const double sin_anomaly = sin_of(anomaly), sin_twice = sin_of(2 * anomaly);
	const double centre = sin_anomaly * (1.914602 - t * (0.004817 + t * 0.000014)) +
			      sin_twice * (0.019993 - t * 0.000101) +
			      sin_of(3 * anomaly) * 0.000289;
	const double node = 125.04 - 1934.136 * t;
	const double longitude = mean + centre - 0.00569 - 0.00478 * sin_of(node);
	const double tilt = 23.4392911 - t * (0.0130042 + t * (0.00000016 - t * 0.0000005)) +
			    0.00256 * cos_of(node);
	const double half = math_tan(tilt / 2 * DEGREE), y = half * half;
	const double ahead = y * sin_of(2 * mean) - 2 * eccentricity * sin_anomaly +
			     4 * eccentricity * y * sin_anomaly * cos_of(2 * mean) -
			     y * y / 2 * sin_of(4 * mean) -
			     1.25 * eccentricity * eccentricity * sin_twice;

	/* The sky turns 360 degrees in a day. */
	return (struct sun){ sin_of(tilt) * sin_of(longitude),
			     ahead / DEGREE / 360 * (double)DAY_NS };
}

/* An almanac means the upper edge of the sun, and the air lifts it: 50 minutes of an arc. */
static double horizon(const struct fb_SUN *fb)
{
	return fb->height == 0.0f ? -50.0 / 60 : (double)fb->height;
}

/* Half of the day's length in ns; 0: the sun does not rise; a day: it does not set. */
static double half_day(const struct fb_SUN *fb, const struct sun *sun)
{
	const double latitude = (double)fb->latitude, sine = sun->sin_declination;
	const double cosine = (sin_of(horizon(fb)) - sin_of(latitude) * sine) /
			      (cos_of(latitude) * sqrt(1 - sine * sine));

	if (!(cosine < 1))
		return 0;
	return cosine > -1 ? math_acos(cosine) / DEGREE / 360 * (double)DAY_NS : (double)DAY_NS;
}

/* Noon by a clock that shows @zone, where the sun stands as it does at @utc_ns. */
static int64_t noon_of(const struct fb_SUN *fb, int64_t day, const struct sun *sun)
{
	return day * DAY_NS + DAY_NS / 2 + fb->zone -
	       (int64_t)((double)fb->longitude / 360 * (double)DAY_NS + sun->ahead_ns);
}

/* An event before or behind noon, with the sun as it stands then. */
static int64_t event(const struct fb_SUN *fb, int64_t day, int64_t guess_ns, int side)
{
	const struct sun sun = sun_at(guess_ns - fb->zone);

	return noon_of(fb, day, &sun) + side * (int64_t)half_day(fb, &sun);
}

/* Local sunrise and sunset of a day. The same moment: none; a day and more: no night. */
static void find_day(const struct fb_SUN *fb, int64_t day, int64_t *rise, int64_t *set)
{
	const struct sun sun = sun_at(day * DAY_NS + DAY_NS / 2);
	const int64_t noon = noon_of(fb, day, &sun), half = (int64_t)half_day(fb, &sun);

	*rise = *set = noon;
	if (half == DAY_NS) {
		*rise = noon - half;
		*set = noon + half;
	} else if (half) {
		*rise = event(fb, day, noon - half, -1);
		*set = event(fb, day, noon + half, 1);
	}
}

static bool is_same(const struct fb_SUN *fb)
{
	return fb->known && fb->zone == fb->ZONE && fb->latitude == fb->LATITUDE &&
	       fb->longitude == fb->LONGITUDE && fb->height == fb->HEIGHT;
}

/* On the next day two of the three days are known. */
static void find_days(struct fb_SUN *fb, int64_t day)
{
	const bool same = is_same(fb);

	if (same && day == fb->day)
		return;
	fb->zone = fb->ZONE, fb->latitude = fb->LATITUDE;
	fb->longitude = fb->LONGITUDE, fb->height = fb->HEIGHT;
	if (same && day - 1 == fb->day) {
		fb->rise0 = fb->rise1, fb->set0 = fb->set1;
		fb->rise1 = fb->rise2, fb->set1 = fb->set2;
	} else {
		find_day(fb, day - 1, &fb->rise0, &fb->set0);
		find_day(fb, day, &fb->rise1, &fb->set1);
	}
	find_day(fb, day + 1, &fb->rise2, &fb->set2);
	fb->day = day;
	fb->known = 1;
}

static bool is_within(float value, double most)
{
	return (double)value >= -most && (double)value <= most;
}

static int64_t time_of(int64_t local_ns)
{
	const int64_t time = local_ns % DAY_NS;

	return time < 0 ? time + DAY_NS : time;
}

void fb_SUN_step(struct fb_SUN *fb, int64_t now_ns)
{
	const int64_t now = fb->NOW;
	int64_t length;

	(void)now_ns;
	fb->ENO = fb->EN && now > -FAR && now < FAR && fb->ZONE >= -ZONES && fb->ZONE <= ZONES &&
		  is_within(fb->LATITUDE, 90) && is_within(fb->LONGITUDE, 180) &&
		  is_within(fb->HEIGHT, 90);
	fb->Q = 0;
	if (!fb->ENO)
		return;
	find_days(fb, now / DAY_NS - (now % DAY_NS < 0));
	fb->Q = (now >= fb->rise0 && now < fb->set0) || (now >= fb->rise1 && now < fb->set1) ||
		(now >= fb->rise2 && now < fb->set2);
	length = fb->rise1 < fb->set1 ? (int64_t)((uint64_t)fb->set1 - (uint64_t)fb->rise1) : 0;
	fb->LENGTH = length < 0 || length > DAY_NS ? DAY_NS : length;
	fb->RISE = length > 0 && length < DAY_NS ? time_of(fb->rise1) : 0;
	fb->SET = length > 0 && length < DAY_NS ? time_of(fb->set1) : 0;
}
