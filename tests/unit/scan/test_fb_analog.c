/* SPDX-License-Identifier: MIT
 *
 * test_fb_analog - HYSTERESIS, DEADBAND, RAMP, SCALE, SCALE_RANGE, AVERAGE and PID:
 * formulas, limits, NaN and infinity.
 */
#include "engine/scan/vm.h"
#include "tests/tap.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define MS INT64_C(1000000)
#define SECOND (1000 * MS)

static bool hysteresis(struct fb_HYSTERESIS *fb, float in)
{
	fb->IN = in;
	fb_HYSTERESIS_step(fb, 0);
	return fb->Q == 1;
}

static void hysteresis_keeps_between(void)
{
	struct fb_HYSTERESIS high = { .EN = 1, .ON = 20.0f, .OFF = 10.0f };
	struct fb_HYSTERESIS low = { .EN = 1, .ON = 10.0f, .OFF = 20.0f };
	struct fb_HYSTERESIS one = { .EN = 1, .ON = 5.0f, .OFF = 5.0f };

	CHECK(!hysteresis(&high, 19.9f));
	CHECK_AS(hysteresis(&high, 20.0f), "Q is on when IN = ON");
	CHECK(hysteresis(&high, 10.1f));
	CHECK_AS(!hysteresis(&high, 10.0f), "Q is off when IN = OFF");
	CHECK(!hysteresis(&high, 19.0f));
	CHECK_AS(hysteresis(&low, 10.0f),
		 "with ON below OFF, Q is on when IN falls to ON");
	CHECK(hysteresis(&low, 19.9f));
	CHECK(!hysteresis(&low, 20.0f));
	CHECK(!hysteresis(&low, 10.1f));
	CHECK_AS(hysteresis(&one, 5.0f), "with ON = OFF, Q is on when IN equals both");
	CHECK(!hysteresis(&one, 4.9f));
	hysteresis(&high, 25.0f);
	CHECK_AS(hysteresis(&high, NAN), "Q does not change when IN is NaN");
	CHECK(hysteresis(&high, -INFINITY));
	high.ON = NAN;
	CHECK(hysteresis(&high, 0.0f));
	high.ON = 20.0f;
	high.EN = 0;
	CHECK_AS(!hysteresis(&high, 25.0f), "Q is off while EN is FALSE");
	high.EN = 1;
	CHECK(!hysteresis(&high, 15.0f));
}

static float deadband(float in, float width)
{
	struct fb_DEADBAND fb = { .EN = 1, .IN = in, .WIDTH = width, .OUT = -9.0f };

	fb_DEADBAND_step(&fb, 0);
	return fb.ENO ? fb.OUT : -999.0f;
}

static void deadband_has_no_step(void)
{
	struct fb_DEADBAND off = { .IN = 5.0f, .OUT = 3.0f, .ENO = 1 };

	CHECK(deadband(2.0f, 2.0f) == 0.0f && deadband(-2.0f, 2.0f) == 0.0f);
	CHECK(deadband(2.5f, 2.0f) == 0.5f && deadband(-2.5f, 2.0f) == -0.5f);
	CHECK(deadband(2.5f, -1.0f) == 2.5f);
	CHECK(deadband(FLT_MAX, 0.0f) == FLT_MAX);
	CHECK(deadband(NAN, 1.0f) == -999.0f && deadband(1.0f, NAN) == -999.0f);
	CHECK(deadband(INFINITY, 1.0f) == -999.0f);
	CHECK(deadband(1.0f, INFINITY) == -999.0f);
	fb_DEADBAND_step(&off, 0);
	CHECK_AS(!off.ENO && off.OUT == 3.0f, "EN FALSE: OUT rests");
}

static void ramp_takes_its_time(void)
{
	struct fb_RAMP ramp = { .EN = 1, .IN = 10.0f, .UP = 2.0f, .DOWN = 4.0f };

	fb_RAMP_step(&ramp, 5 * SECOND);
	CHECK_AS(ramp.ENO && ramp.OUT == 0.0f && !ramp.DONE,
		 "the first call does not change OUT");
	fb_RAMP_step(&ramp, 6 * SECOND);
	CHECK(ramp.OUT == 2.0f);
	fb_RAMP_step(&ramp, 8 * SECOND);
	CHECK_AS(ramp.OUT == 6.0f,
		 "OUT rises by UP times the seconds since the last call");
	fb_RAMP_step(&ramp, 20 * SECOND);
	CHECK(ramp.OUT == 10.0f && ramp.DONE == 1);
	ramp.IN = 0.0f;
	fb_RAMP_step(&ramp, 21 * SECOND);
	CHECK(ramp.OUT == 6.0f && !ramp.DONE);
	ramp.EN = 0;
	fb_RAMP_step(&ramp, 22 * SECOND);
	CHECK(!ramp.ENO && ramp.OUT == 6.0f);
	ramp.EN = 1;
	fb_RAMP_step(&ramp, 30 * SECOND);
	CHECK_AS(ramp.OUT == 6.0f, "the time while EN was FALSE does not count");
	fb_RAMP_step(&ramp, 29 * SECOND);
	CHECK_AS(ramp.OUT == 6.0f, "OUT stays when the clock goes back");
	ramp.IN = NAN;
	fb_RAMP_step(&ramp, 30 * SECOND);
	CHECK(!ramp.ENO && ramp.OUT == 6.0f);
	ramp.IN = 100.0f;
	ramp.LOAD = 1;
	fb_RAMP_step(&ramp, 30 * SECOND);
	CHECK(ramp.OUT == 100.0f && ramp.DONE == 1);
	ramp.LOAD = 0;
	ramp.DOWN = -3.0f;
	ramp.IN = 0.0f;
	fb_RAMP_step(&ramp, 40 * SECOND);
	CHECK_AS(ramp.ENO && ramp.OUT == 100.0f, "OUT stays when DOWN is negative");
}

static void ramp_loses_nothing(void)
{
	struct fb_RAMP ramp = { .EN = 1, .IN = 20000.0f, .UP = 0.01f,
				.OUT = 16000.0f };

	for (int i = 0; i <= 100000; i++)
		fb_RAMP_step(&ramp, i * MS);
	CHECK_AS(fabsf(ramp.OUT - 16001.0f) < 0.01f,
		 "steps smaller than the last digit of OUT add up");
	memset(&ramp, 0xff, sizeof(ramp));
	ramp.IN = 1.0f;
	ramp.UP = ramp.DOWN = 1.0f;
	ramp.LOAD = 0;
	fb_RAMP_step(&ramp, 0);
	CHECK_AS(ramp.ENO == 1 && ramp.OUT == ramp.OUT,
		 "OUT is a number even if the instance held NaNs");
	ramp.exact = 1e300;
	ramp.OUT = INFINITY;
	fb_RAMP_step(&ramp, 1);
	CHECK(ramp.OUT <= 1.0f);
}

static void scale_is_a_line(void)
{
	struct fb_SCALE scale = { .EN = 1, .IN = 3.0f, .GAIN = 2.0f, .OFFSET = -1.0f };

	fb_SCALE_step(&scale, 0);
	CHECK(scale.ENO && scale.OUT == 5.0f);
	scale.IN = FLT_MAX;
	fb_SCALE_step(&scale, 0);
	CHECK_AS(!scale.ENO && scale.OUT == 5.0f,
		 "OUT stays when the result is too large");
	scale.OFFSET = -FLT_MAX;
	fb_SCALE_step(&scale, 0);
	CHECK_AS(scale.ENO && scale.OUT == FLT_MAX,
		 "only the result must fit a REAL, not the product");
	scale.IN = NAN;
	fb_SCALE_step(&scale, 0);
	CHECK(!scale.ENO && scale.OUT == FLT_MAX);
	scale.EN = 0;
	scale.IN = 0.0f;
	fb_SCALE_step(&scale, 0);
	CHECK(!scale.ENO && scale.OUT == FLT_MAX);
}

static float range(struct fb_SCALE_RANGE *fb, float in)
{
	fb->IN = in;
	fb_SCALE_RANGE_step(fb, 0);
	return fb->ENO ? fb->OUT : -999.0f;
}

static void range_goes_to_range(void)
{
	struct fb_SCALE_RANGE fb = { .EN = 1, .IN_MIN = 6400.0f, .IN_MAX = 32000.0f,
				     .OUT_MIN = 0.0f, .OUT_MAX = 100.0f };

	CHECK(range(&fb, 6400.0f) == 0.0f && range(&fb, 32000.0f) == 100.0f);
	CHECK(range(&fb, 19200.0f) == 50.0f && range(&fb, 0.0f) == -25.0f);
	fb.CLIP = 1;
	CHECK(range(&fb, 0.0f) == 0.0f && range(&fb, 60000.0f) == 100.0f);
	fb.OUT_MIN = 100.0f;
	fb.OUT_MAX = 0.0f;
	CHECK_AS(range(&fb, 0.0f) == 100.0f && range(&fb, 12800.0f) == 75.0f &&
		 range(&fb, 60000.0f) == 0.0f, "OUT_MIN may be above OUT_MAX");
	CHECK(range(&fb, NAN) == -999.0f && range(&fb, INFINITY) == -999.0f);
	fb.IN_MAX = INFINITY;
	CHECK(range(&fb, 1.0f) == -999.0f);
	fb.IN_MAX = 6400.0f;
	CHECK_AS(range(&fb, 1.0f) == -999.0f, "IN_MIN = IN_MAX gives ENO = FALSE");
	fb.IN_MAX = 32000.0f;
	fb.EN = 0;
	CHECK(range(&fb, 1.0f) == -999.0f);
}

static float average(struct fb_AVERAGE *fb, float in)
{
	fb->IN = in;
	fb_AVERAGE_step(fb, 0);
	return fb->ENO ? fb->OUT : -999.0f;
}

static void average_moves(void)
{
	struct fb_AVERAGE fb = { .EN = 1, .N = 3 };

	CHECK(average(&fb, 3.0f) == 3.0f && fb.COUNT == 1);
	CHECK(average(&fb, 6.0f) == 4.5f && fb.COUNT == 2);
	CHECK(average(&fb, 9.0f) == 6.0f && average(&fb, 12.0f) == 9.0f);
	CHECK(average(&fb, NAN) == -999.0f && fb.OUT == 9.0f);
	CHECK_AS(average(&fb, 15.0f) == 12.0f, "NaN was not added to the values");
	fb.N = 1;
	CHECK(average(&fb, 1.0f) == 1.0f);
	fb.N = 5;
	CHECK_AS(average(&fb, 3.0f) == 8.0f,
		 "a larger N takes older values into the mean again");
	fb.EN = 0;
	CHECK(average(&fb, 100.0f) == -999.0f && fb.OUT == 8.0f);
	fb.EN = fb.R = 1;
	CHECK(average(&fb, 100.0f) == -999.0f && fb.COUNT == 0 && fb.OUT == 8.0f);
	fb.R = 0;
	CHECK_AS(average(&fb, 2.0f) == 2.0f, "the first value after R is the mean");
	fb.N = 0;
	CHECK(average(&fb, 7.0f) == 7.0f);
	fb.N = INT16_MAX;
	for (int i = 0; i < 200; i++)
		average(&fb, (float)i);
	CHECK_AS(fb.COUNT == 64 && fb.OUT == 167.5f, "the mean is of at most 64 values");
	CHECK_AS(average(&fb, FLT_MAX) == FLT_MAX / 64.0f,
		 "the sum of the values does not overflow");
	memset(&fb, 0xff, sizeof(fb));
	fb.R = 0;
	fb.N = 64;
	CHECK_AS(average(&fb, 64.0f) == 1.0f,
		 "OUT is a number even if the instance held NaNs");
}

static bool near(float a, double b)
{
	return fabs((double)a - b) < 1e-4;
}

static void pid_has_three_terms(void)
{
	struct fb_PID p = { .EN = 1, .SP = 50.0f, .PV = 40.0f, .KP = 2.0f, .N = 8.0f,
			    .MAX = 100.0f };
	struct fb_PID d = { .EN = 1, .KP = 1.0f, .TD = SECOND, .N = 8.0f,
			    .MIN = -100.0f, .MAX = 100.0f };

	fb_PID_step(&p, 0);
	CHECK_AS(p.ENO && p.OUT == 20.0f && !p.HI && !p.LO, "P: KP * error");
	fb_PID_step(&p, 10 * SECOND);
	CHECK_AS(p.OUT == 20.0f, "without TI the error is not integrated");
	p.TI = 2 * SECOND;
	fb_PID_step(&p, 11 * SECOND);
	CHECK_AS(p.OUT == 30.0f, "I: KP * error / TI a second");
	fb_PID_step(&p, 13 * SECOND);
	CHECK_AS(p.OUT == 50.0f,
		 "the integral grows with the seconds since the last call");
	p.INVERT = 1;
	p.PV = 60.0f;
	p.TI = 0;
	fb_PID_step(&p, 14 * SECOND);
	CHECK_AS(p.OUT == 20.0f, "INVERT turns the sign of the error");
	fb_PID_step(&d, 0);
	d.PV = 1.0f;
	fb_PID_step(&d, 100 * MS);
	CHECK_AS(near(d.OUT, -1.0 - 8.0 * (1.0 - 0.1 / 0.225)),
		 "D: the filtered change of PV");
	d.SP = 1.0f;
	fb_PID_step(&d, 100 * MS);
	CHECK_AS(near(d.OUT, -8.0 * (1.0 - 0.1 / 0.225)),
		 "D: a new SP does not change OUT");
	fb_PID_step(&d, 60 * SECOND);
	CHECK_AS(fabsf(d.OUT) < 0.02f, "D: OUT goes back to 0 while PV stays");
}

static void pid_does_not_wind_up(void)
{
	struct fb_PID pid = { .EN = 1, .SP = 50.0f, .KP = 1.0f, .TI = SECOND,
			      .N = 8.0f, .MAX = 100.0f };

	for (int i = 0; i < 1000; i++)
		fb_PID_step(&pid, i * 100 * MS);
	CHECK_AS(pid.OUT == 100.0f && pid.HI == 1, "OUT stops at MAX");
	pid.PV = 51.0f;
	fb_PID_step(&pid, 1000 * 100 * MS);
	CHECK_AS(pid.OUT < 50.0f && !pid.HI,
		 "OUT leaves MAX in the call in which the error changes its sign");
	pid.PV = 200.0f;
	for (int i = 1001; i < 2000; i++)
		fb_PID_step(&pid, i * 100 * MS);
	CHECK(pid.OUT == 0.0f && pid.LO == 1);
	pid.PV = 49.0f;
	fb_PID_step(&pid, 2000 * 100 * MS);
	CHECK(pid.OUT > 0.0f && !pid.LO);
}

static void pid_goes_over_without_a_bump(void)
{
	struct fb_PID pid = { .EN = 1, .SP = 50.0f, .PV = 40.0f, .KP = 2.0f,
			      .TI = 10 * SECOND, .N = 8.0f, .MAX = 100.0f,
			      .MANUAL = 1, .MAN = 33.0f };

	fb_PID_step(&pid, 0);
	CHECK(pid.ENO && pid.OUT == 33.0f);
	pid.MAN = 500.0f;
	fb_PID_step(&pid, SECOND);
	CHECK_AS(pid.OUT == 100.0f && pid.HI, "MAN is limited to MAX");
	pid.MAN = 70.0f;
	fb_PID_step(&pid, 2 * SECOND);
	pid.MANUAL = 0;
	fb_PID_step(&pid, 2 * SECOND + 10 * MS);
	CHECK_AS(near(pid.OUT, 70.0 + 0.02),
		 "automatic mode starts at the last OUT of manual mode");
	pid.EN = 0;
	fb_PID_step(&pid, 3 * SECOND);
	CHECK(!pid.ENO && near(pid.OUT, 70.02));
	pid.PV = 45.0f;
	pid.EN = 1;
	fb_PID_step(&pid, 100 * SECOND);
	CHECK_AS(near(pid.OUT, 70.02),
		 "OUT starts at its last value when EN is TRUE again");
	fb_PID_step(&pid, 101 * SECOND);
	CHECK(near(pid.OUT, 71.02));
	fb_PID_step(&pid, 99 * SECOND);
	CHECK_AS(near(pid.OUT, 71.02), "OUT stays when the clock goes back");
}

static void pid_takes_anything(void)
{
	struct fb_PID pid = { .EN = 1, .SP = 50.0f, .PV = 40.0f, .KP = 2.0f,
			      .TI = SECOND, .TD = SECOND, .N = 8.0f, .MAX = 100.0f };
	struct fb_PID bad[5];
	bool held = true;

	fb_PID_step(&pid, 0);
	CHECK(pid.OUT == 20.0f);
	for (int i = 0; i < 5; i++)
		bad[i] = pid;
	bad[0].PV = NAN;
	bad[1].SP = INFINITY;
	bad[2].KP = -INFINITY;
	bad[3].N = NAN;
	bad[4].MIN = 200.0f;
	for (int i = 0; i < 5; i++) {
		fb_PID_step(&bad[i], SECOND);
		held &= !bad[i].ENO && bad[i].OUT == 20.0f;
	}
	CHECK_AS(held, "OUT stays when an input is not finite or MIN is above MAX");
	bad[0].PV = 40.0f;
	fb_PID_step(&bad[0], SECOND);
	CHECK_AS(bad[0].ENO && bad[0].OUT == 20.0f,
		 "OUT goes on from its last value when PV is a number again");
	pid.MAN = NAN;
	fb_PID_step(&pid, 0);
	CHECK_AS(pid.ENO, "automatic mode does not read MAN");
	pid.MANUAL = 1;
	fb_PID_step(&pid, 0);
	CHECK(!pid.ENO);
	pid.MANUAL = 0;
	pid.integral = NAN;
	pid.smooth = -INFINITY;
	fb_PID_step(&pid, SECOND);
	fb_PID_step(&pid, SECOND);
	CHECK_AS(pid.ENO && pid.OUT >= 0.0f && pid.OUT <= 100.0f,
		 "OUT is within MIN and MAX even if the instance held NaNs");
	pid.integral = 1e308;
	pid.smooth = 1e308;
	pid.KP = FLT_MAX;
	fb_PID_step(&pid, 2 * SECOND);
	fb_PID_step(&pid, 3 * SECOND);
	CHECK(pid.OUT >= 0.0f && pid.OUT <= 100.0f);
	pid.OUT = NAN;
	pid.running = 0;
	fb_PID_step(&pid, 3 * SECOND);
	fb_PID_step(&pid, 4 * SECOND);
	CHECK(pid.OUT >= 0.0f && pid.OUT <= 100.0f);
}

int main(void)
{
	hysteresis_keeps_between();
	deadband_has_no_step();
	ramp_takes_its_time();
	ramp_loses_nothing();
	scale_is_a_line();
	range_goes_to_range();
	average_moves();
	pid_has_three_terms();
	pid_does_not_wind_up();
	pid_goes_over_without_a_bump();
	pid_takes_anything();
	return tap_done();
}
