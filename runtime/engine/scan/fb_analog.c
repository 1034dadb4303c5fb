/* SPDX-License-Identifier: MIT
 *
 * fb_analog - HYSTERESIS, DEADBAND, RAMP, SCALE, SCALE_RANGE and AVERAGE.
 *
 * REAL in and out; computed in double and rounded once, with nothing but + - * / and
 * comparisons, so that every machine gives the same bits. An input or a result that
 * is infinite or not a number leaves the output as it was, and ENO FALSE.
 */
#include "engine/scan/fb.h"

#define SECONDS(ns) ((double)(ns) / 1e9)

void fb_HYSTERESIS_step(struct fb_HYSTERESIS *fb, int64_t now_ns)
{
	bool falling = fb->ON < fb->OFF;

	(void)now_ns;
	fb->Q = fb->EN && fb->Q;
	if (!fb->EN || !fb_is_number((double)fb->IN) ||
	    !fb_is_number((double)fb->ON) || !fb_is_number((double)fb->OFF))
		return;
	if (falling ? fb->IN <= fb->ON : fb->IN >= fb->ON)
		fb->Q = 1;
	else if (falling ? fb->IN >= fb->OFF : fb->IN <= fb->OFF)
		fb->Q = 0;
}

void fb_DEADBAND_step(struct fb_DEADBAND *fb, int64_t now_ns)
{
	double in = (double)fb->IN;
	double width = fb->WIDTH > 0.0f ? (double)fb->WIDTH : 0.0;
	double out = in > width ? in - width : in < -width ? in + width : 0.0;

	(void)now_ns;
	fb->ENO = fb->EN && fb_is_number(in) &&
		  fb_is_number((double)fb->WIDTH) && fb_give(&fb->OUT, out);
}

/* The most that OUT may change in @seconds; 0 for a negative rate. */
static double at_most(float rate, double seconds)
{
	return rate > 0.0f ? (double)rate * seconds : 0.0;
}

/* OUT is rounded; the rest is kept in @exact, or slow ramps would not move. */
static void follow(struct fb_RAMP *fb, double seconds)
{
	double in = (double)fb->IN, at = fb->exact;
	double up = at_most(fb->UP, seconds), down = at_most(fb->DOWN, seconds);

	if (!fb_is_number(at) || (float)at != fb->OUT)
		at = fb_is_number((double)fb->OUT) ? (double)fb->OUT : 0.0;
	if (fb->LOAD)
		at = in;
	else if (in > at)
		at = at + up < in ? at + up : in;
	else
		at = at - down > in ? at - down : in;
	fb->exact = at;
	fb->OUT = (float)at;
	fb->DONE = at == in;
}

void fb_RAMP_step(struct fb_RAMP *fb, int64_t now_ns)
{
	uint64_t since = fb->running ? fb_since(now_ns, fb->last) : 0;

	fb->running = fb->EN != 0;
	fb->last = now_ns;
	fb->ENO = fb->EN && fb_is_number((double)fb->IN) &&
		  fb_is_number((double)fb->UP) && fb_is_number((double)fb->DOWN);
	if (fb->ENO)
		follow(fb, SECONDS(since));
}

void fb_SCALE_step(struct fb_SCALE *fb, int64_t now_ns)
{
	double out = (double)fb->GAIN * (double)fb->IN + (double)fb->OFFSET;

	(void)now_ns;
	fb->ENO = fb->EN && fb_give(&fb->OUT, out);
}

/* Differences are computed in double: two REAL may be further apart than a REAL can
 * express. */
static bool is_finite(double value)
{
	return value >= -DBL_MAX && value <= DBL_MAX;
}

void fb_SCALE_RANGE_step(struct fb_SCALE_RANGE *fb, int64_t now_ns)
{
	double in = (double)fb->IN - (double)fb->IN_MIN;
	double from = (double)fb->IN_MAX - (double)fb->IN_MIN;
	double low = (double)fb->OUT_MIN, high = (double)fb->OUT_MAX;
	double out;

	(void)now_ns;
	fb->ENO = 0;
	if (!fb->EN || from == 0.0 || !is_finite(from) || !is_finite(in))
		return;
	out = low + in * (high - low) / from;
	if (fb->CLIP)
		out = low < high ? fb_clamp(out, low, high)
				 : fb_clamp(out, high, low);
	fb->ENO = is_finite(high - low) && fb_give(&fb->OUT, out);
}

enum { SAMPLES = 64 };

/* The last @count values before place @next. A damaged instance may hold values that
 * are not numbers; they are left out of the sum. */
static double mean(const float *value, int next, int count)
{
	double sum = 0.0;

	for (int i = 1; i <= count; i++) {
		double one = (double)value[(next + SAMPLES - i) % SAMPLES];

		if (fb_is_number(one))
			sum += one;
	}
	return sum / count;
}

void fb_AVERAGE_step(struct fb_AVERAGE *fb, int64_t now_ns)
{
	int used = fb->used[0] < SAMPLES ? fb->used[0] : SAMPLES;
	int next = fb->next[0] % SAMPLES, most = fb_bound(fb->N, SAMPLES);

	(void)now_ns;
	if (fb->R)
		used = fb->COUNT = 0;
	fb->used[0] = (uint8_t)used;
	fb->ENO = 0;
	if (!fb->EN || fb->R || !fb_is_number((double)fb->IN))
		return;
	fb->value[next] = fb->IN;
	next = (next + 1) % SAMPLES;
	used += used < SAMPLES;
	fb->used[0] = (uint8_t)used;
	fb->next[0] = (uint8_t)next;
	fb->COUNT = (int16_t)(used < most ? used : most);
	fb->ENO = fb_give(&fb->OUT, mean(fb->value, next, fb->COUNT));
}
