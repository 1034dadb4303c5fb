/* SPDX-License-Identifier: MIT
 *
 * test_fb_pulse - TONR, DEBOUNCE, BLINK, PWM and RTC_ALARM at their limits.
 */
#include "engine/scan/vm.h"
#include "tests/tap.h"

#define SECOND INT64_C(1000000000)
#define HOUR   (3600 * SECOND)
#define DAY    (24 * HOUR)

static void tonr_gathers(void)
{
	struct fb_TONR tonr = { .PT = 50, .IN = 1 };

	fb_TONR_step(&tonr, 1000);
	CHECK_AS(!tonr.Q && tonr.ET == 0, "ET is 0 in the first call with IN");
	fb_TONR_step(&tonr, 1020);
	CHECK(!tonr.Q && tonr.ET == 20);
	tonr.IN = 0;
	fb_TONR_step(&tonr, 1030);
	CHECK_AS(tonr.ET == 30, "the time before the first call without IN counts");
	fb_TONR_step(&tonr, 5000);
	CHECK_AS(tonr.ET == 30 && !tonr.Q, "ET stays while IN is FALSE");
	tonr.IN = 1;
	fb_TONR_step(&tonr, 6000);
	CHECK_AS(tonr.ET == 30, "the time while IN was FALSE does not count");
	fb_TONR_step(&tonr, 6019);
	CHECK(tonr.ET == 49 && !tonr.Q);
	fb_TONR_step(&tonr, 6020);
	CHECK_AS(tonr.ET == 50 && tonr.Q, "Q is on as soon as ET = PT");
	fb_TONR_step(&tonr, 7000);
	CHECK_AS(tonr.ET == 50, "ET stops at PT");
	tonr.IN = 0;
	fb_TONR_step(&tonr, 8000);
	CHECK_AS(tonr.Q && tonr.ET == 50, "Q stays on when IN is FALSE");
	tonr.IN = tonr.R = 1;
	fb_TONR_step(&tonr, 9000);
	CHECK_AS(!tonr.Q && tonr.ET == 0, "R wins over IN");
	fb_TONR_step(&tonr, 9010);
	CHECK(!tonr.Q && tonr.ET == 0);
	tonr.R = 0;
	fb_TONR_step(&tonr, 9015);
	CHECK_AS(tonr.ET == 5, "time counts from the last call with R");
}

static void tonr_takes_anything(void)
{
	struct fb_TONR tonr = { .PT = 0 };

	fb_TONR_step(&tonr, 5);
	CHECK_AS(!tonr.Q, "a TONR with PT = 0 is off before IN");
	tonr.IN = 1;
	fb_TONR_step(&tonr, 6);
	CHECK_AS(tonr.Q && tonr.ET == 0,
		 "a TONR with PT = 0 is on in the same call as IN");
	tonr = (struct fb_TONR){ .PT = -1, .IN = 1 };
	fb_TONR_step(&tonr, 6);
	CHECK(tonr.Q && tonr.ET == 0);
	tonr.PT = 10;
	fb_TONR_step(&tonr, 10);
	CHECK_AS(!tonr.Q && tonr.ET == 4, "a longer PT switches Q off again");
	fb_TONR_step(&tonr, 2);
	CHECK_AS(tonr.ET == 4, "ET stays when the clock goes back");
	fb_TONR_step(&tonr, 3);
	CHECK(tonr.ET == 5);
	tonr.PT = 3;
	fb_TONR_step(&tonr, 4);
	CHECK(tonr.Q && tonr.ET == 3);
	tonr = (struct fb_TONR){ .PT = INT64_MAX, .IN = 0xff, .running = 0x80,
				 .last = INT64_MIN, .ET = INT64_MIN };
	fb_TONR_step(&tonr, INT64_MAX);
	CHECK_AS(tonr.Q && tonr.ET == INT64_MAX,
		 "ET stops at PT whatever the instance held");
}

static void debounce_wants_it_steady(void)
{
	struct fb_DEBOUNCE filter = { .IN = 1, .T_ON = 20, .T_OFF = 30 };

	fb_DEBOUNCE_step(&filter, 0);
	fb_DEBOUNCE_step(&filter, 19);
	CHECK(!filter.Q);
	filter.IN = 0;
	fb_DEBOUNCE_step(&filter, 19);
	filter.IN = 1;
	fb_DEBOUNCE_step(&filter, 20);
	CHECK_AS(!filter.Q, "one call with IN = FALSE starts T_ON again");
	fb_DEBOUNCE_step(&filter, 39);
	CHECK(!filter.Q);
	fb_DEBOUNCE_step(&filter, 40);
	CHECK_AS(filter.Q == 1, "Q is on as soon as T_ON has passed");
	filter.IN = 0;
	fb_DEBOUNCE_step(&filter, 50);
	fb_DEBOUNCE_step(&filter, 79);
	CHECK(filter.Q);
	fb_DEBOUNCE_step(&filter, 80);
	CHECK_AS(!filter.Q, "Q is off as soon as T_OFF has passed");
	filter.T_ON = 0;
	filter.IN = 1;
	fb_DEBOUNCE_step(&filter, 81);
	CHECK_AS(filter.Q, "with T_ON = 0, Q is on in the same call as IN");
	filter.T_OFF = -1;
	filter.IN = 0;
	fb_DEBOUNCE_step(&filter, 82);
	CHECK_AS(!filter.Q, "a negative T_OFF counts as 0");
	filter = (struct fb_DEBOUNCE){ .IN = 0x40, .Q = 0x80 };
	fb_DEBOUNCE_step(&filter, 0);
	CHECK_AS(filter.Q == 1, "Q is 1 for an IN of 16#40");
}

static void blink_keeps_its_beat(void)
{
	struct fb_BLINK blink = { .EN = 1, .TH = 30, .TL = 20 };

	fb_BLINK_step(&blink, 100);
	CHECK_AS(blink.Q, "Q is on in the first call");
	fb_BLINK_step(&blink, 129);
	CHECK(blink.Q);
	fb_BLINK_step(&blink, 130);
	CHECK(!blink.Q);
	fb_BLINK_step(&blink, 149);
	CHECK(!blink.Q);
	fb_BLINK_step(&blink, 155);
	CHECK_AS(blink.Q && blink.start == 150,
		 "a late scan does not move the next period");
	fb_BLINK_step(&blink, 180);
	CHECK(!blink.Q);
	fb_BLINK_step(&blink, 150 + 50 * 1000000 + 29);
	CHECK_AS(blink.Q && blink.start == 150 + 50 * 1000000,
		 "a scan after a million periods does not move the next one");
	blink.EN = 0;
	fb_BLINK_step(&blink, 150 + 50 * 1000000 + 29);
	CHECK(!blink.Q);
	blink.EN = 1;
	fb_BLINK_step(&blink, 7);
	CHECK_AS(blink.Q && blink.start == 7, "EN starts with a new TH");
	fb_BLINK_step(&blink, 3);
	CHECK_AS(blink.Q && blink.start == 3, "a clock that went back starts a new TH");
	blink.TL = 0;
	fb_BLINK_step(&blink, 1000);
	CHECK_AS(blink.Q, "without TL, Q is always on");
	blink.TH = -5;
	blink.TL = 10;
	fb_BLINK_step(&blink, 1001);
	CHECK_AS(!blink.Q, "without TH, Q is never on");
	blink.TL = INT64_MIN;
	fb_BLINK_step(&blink, 1002);
	CHECK_AS(!blink.Q, "without TH and TL, Q is never on");
	blink = (struct fb_BLINK){ .EN = 1, .TH = INT64_MAX, .TL = INT64_MAX,
				   .running = 1, .start = INT64_MIN };
	fb_BLINK_step(&blink, INT64_MAX);
	CHECK_AS(blink.Q, "the longest times do not overflow");
}

/* How many of 100 calls, one unit apart, starting at @from, are TRUE. */
static int count_on(struct fb_PWM *pwm, int64_t from)
{
	int on = 0;

	for (int i = 0; i < 100; i++) {
		fb_PWM_step(pwm, from + i);
		on += pwm->Q;
	}
	return on;
}

static void pwm_gives_its_share(void)
{
	struct fb_PWM pwm = { .EN = 1, .PERIOD = 100, .DUTY = 25.0f };

	CHECK(count_on(&pwm, 1000) == 25);
	pwm.DUTY = 0.0f;
	CHECK(count_on(&pwm, 1100) == 0);
	pwm.DUTY = 100.0f;
	CHECK(count_on(&pwm, 1200) == 100);
	pwm.DUTY = 1.0e30f;
	CHECK_AS(count_on(&pwm, 1300) == 100, "a DUTY above 100 is always on");
	pwm.DUTY = -1.0f;
	CHECK(count_on(&pwm, 1400) == 0);
	pwm.DUTY = 50.0f;
	CHECK(count_on(&pwm, 1500) == 50);
	pwm.DUTY = __builtin_nanf("");
	CHECK_AS(count_on(&pwm, 1600) == 50, "a DUTY of NaN keeps the last DUTY");
	pwm.DUTY = 10.0f;
	pwm.MIN_ON = 10;
	CHECK(count_on(&pwm, 1700) == 10);
	pwm.MIN_ON = 11;
	CHECK_AS(count_on(&pwm, 1800) == 0, "a pulse shorter than MIN_ON is left out");
	pwm.DUTY = 90.0f;
	pwm.MIN_OFF = 11;
	CHECK_AS(count_on(&pwm, 1900) == 100, "a pause shorter than MIN_OFF is left out");
	pwm.DUTY = 0.0f;
	pwm.MIN_OFF = 1000;
	CHECK_AS(count_on(&pwm, 2000) == 0,
		 "a DUTY of 0 is off even if MIN_OFF is longer than the period");
}

static void pwm_holds_a_pulse(void)
{
	struct fb_PWM pwm = { .EN = 1, .PERIOD = 100, .DUTY = 50.0f };

	fb_PWM_step(&pwm, 0);
	pwm.DUTY = 10.0f;
	fb_PWM_step(&pwm, 49);
	CHECK_AS(pwm.Q, "a new DUTY counts from the next period");
	fb_PWM_step(&pwm, 50);
	CHECK(!pwm.Q);
	fb_PWM_step(&pwm, 109);
	CHECK_AS(pwm.Q, "a period begins on time although the scan is late");
	fb_PWM_step(&pwm, 110);
	CHECK(!pwm.Q);
	pwm.EN = 0;
	fb_PWM_step(&pwm, 200);
	CHECK(!pwm.Q);
	pwm.EN = 1;
	fb_PWM_step(&pwm, 255);
	CHECK_AS(pwm.Q && pwm.start == 255, "EN starts a new period");
	pwm.PERIOD = 0;
	fb_PWM_step(&pwm, 256);
	CHECK_AS(!pwm.Q, "without PERIOD, Q is off");
	pwm = (struct fb_PWM){ .EN = 1, .PERIOD = INT64_MAX, .running = 9,
			       .DUTY = 99.99999f, .start = INT64_MIN,
			       .on = INT64_MIN, .MIN_ON = INT64_MIN,
			       .MIN_OFF = INT64_MIN };
	fb_PWM_step(&pwm, INT64_MAX);
	CHECK_AS(pwm.Q <= 1, "Q is 0 or 1 whatever the instance held");
}

/* Q, @ns after Monday, 2024-01-01, 0:00. */
static bool alarm(struct fb_RTC_ALARM *alarm_clock, int64_t since_monday)
{
	alarm_clock->NOW = 19723 * DAY + since_monday;
	fb_RTC_ALARM_step(alarm_clock, 0);
	return alarm_clock->Q;
}

static void alarm_knows_the_week(void)
{
	struct fb_RTC_ALARM work = { .EN = 1, .DAYS = 0x1f, .ON = 8 * HOUR,
				     .OFF = 16 * HOUR };
	struct fb_RTC_ALARM night = { .EN = 1, .DAYS = 1 << 4, .ON = 22 * HOUR,
				      .OFF = 6 * HOUR };

	CHECK(!alarm(&work, 8 * HOUR - 1));
	CHECK_AS(alarm(&work, 8 * HOUR), "Q is on at ON on Monday");
	CHECK(alarm(&work, 16 * HOUR - 1));
	CHECK_AS(!alarm(&work, 16 * HOUR), "Q is off at OFF");
	CHECK(alarm(&work, 4 * DAY + 12 * HOUR));
	CHECK_AS(!alarm(&work, 5 * DAY + 12 * HOUR),
		 "Q is off on Saturday, which DAYS does not name");
	CHECK(!alarm(&work, -DAY + 12 * HOUR));
	CHECK_AS(!alarm(&night, 4 * DAY + 3 * HOUR),
		 "Q is off in the night before Friday");
	CHECK(alarm(&night, 4 * DAY + 22 * HOUR));
	CHECK_AS(alarm(&night, 5 * DAY + 6 * HOUR - 1),
		 "the alarm of Friday night lasts into Saturday");
	CHECK(!alarm(&night, 5 * DAY + 6 * HOUR));
	CHECK(!alarm(&night, 5 * DAY + 22 * HOUR));
	night.DAYS = 1 << 6;
	CHECK_AS(alarm(&night, 0), "the alarm of Sunday night lasts into Monday");
	work.EN = 0;
	CHECK(!alarm(&work, 8 * HOUR));
	work = (struct fb_RTC_ALARM){ .EN = 1, .DAYS = 0x7f, .ON = 5, .OFF = 5 };
	CHECK_AS(!alarm(&work, 5), "with ON = OFF, Q is never on");
	work = (struct fb_RTC_ALARM){ .EN = 1, .DAYS = 1 << 2, .ON = 23 * HOUR,
				      .OFF = 24 * HOUR, .NOW = -1 };
	fb_RTC_ALARM_step(&work, 0);
	CHECK_AS(work.Q == 1, "a negative NOW: the last moment of 1969 was a Wednesday");
	work.NOW = INT64_MIN;
	fb_RTC_ALARM_step(&work, 0);
	work.ON = INT64_MAX;
	work.OFF = INT64_MIN;
	fb_RTC_ALARM_step(&work, 0);
	CHECK(work.Q <= 1);
}

int main(void)
{
	tonr_gathers();
	tonr_takes_anything();
	debounce_wants_it_steady();
	blink_keeps_its_beat();
	pwm_gives_its_share();
	pwm_holds_a_pulse();
	alarm_knows_the_week();
	return tap_done();
}
