/* SPDX-License-Identifier: MIT
 *
 * fb_pid - PID, a controller in the standard (ISA) form; docs/blocks.md has the
 * formula.
 *
 * The derivative is that of PV, behind a filter of the first order (backward Euler).
 * The integral stops at the limit of OUT. In manual, and when EN returns, the integral
 * is set so that OUT does not jump. The time step is the measured time between two
 * calls.
 */
#include "engine/scan/fb.h"

static double seconds(int64_t time)
{
	return time > 0 ? (double)time / 1e9 : 0.0;
}

static bool is_sound(const struct fb_PID *fb)
{
	return fb_is_number((double)fb->SP) && fb_is_number((double)fb->PV) &&
	       fb_is_number((double)fb->KP) && fb_is_number((double)fb->N) &&
	       fb_is_number((double)fb->MIN) && fb_is_number((double)fb->MAX) &&
	       (!fb->MANUAL || fb_is_number((double)fb->MAN)) &&
	       fb->MIN <= fb->MAX;
}

/* Filtered PV after @step seconds; PV itself at the first call. */
static double smoothed(const struct fb_PID *fb, double step, double filter,
		       bool fresh)
{
	double pv = (double)fb->PV, from = fb->smooth;

	if (fresh || filter <= 0.0 || !fb_is_number(from))
		return pv;
	return from + (pv - from) * (step / (filter + step));
}

/* The integral moves by @by, but stops where OUT reaches its limit. */
static double integrated(const struct fb_PID *fb, double integral, double rest,
			 double by)
{
	double high = (double)fb->MAX - rest, low = (double)fb->MIN - rest;

	if (by > 0.0 && integral + by > high)
		return integral < high ? high : integral;
	if (by < 0.0 && integral + by < low)
		return integral > low ? low : integral;
	return integral + by;
}

/* OUT of one call after @step seconds; @resumed: EN was FALSE before. */
static void control(struct fb_PID *fb, double step, bool resumed)
{
	double gain = fb->INVERT ? -(double)fb->KP : (double)fb->KP;
	double error = gain * ((double)fb->SP - (double)fb->PV);
	double n = fb->N < 1.0f ? 1.0 : (double)fb->N;
	double ti = seconds(fb->TI);
	double smooth = smoothed(fb, step, seconds(fb->TD) / n, resumed);
	double rest = error - gain * n * ((double)fb->PV - smooth);
	double integral = fb->integral, out;

	if (fb->MANUAL || (resumed && fb->started)) {
		out = fb->MANUAL ? (double)fb->MAN : (double)fb->OUT;
		out = fb_clamp(out, (double)fb->MIN, (double)fb->MAX);
		integral = out - rest;
	} else if (!fb->started) {
		integral = 0.0;
	}
	if (ti <= 0.0)
		integral = 0.0;
	else if (!fb->MANUAL)
		integral = integrated(fb, integral, rest, error * (step / ti));
	if (!fb->MANUAL)
		out = fb_clamp(rest + integral, (double)fb->MIN, (double)fb->MAX);
	fb->smooth = smooth;
	fb->integral = integral;
	fb->started = 1;
	if (!fb_give(&fb->OUT, out)) { /* only if the instance's memory was damaged */
		fb->started = 0;
		fb->ENO = 0;
	}
}

void fb_PID_step(struct fb_PID *fb, int64_t now_ns)
{
	bool resumed = !fb->running;
	uint64_t since = resumed ? 0 : fb_since(now_ns, fb->last);

	fb->running = fb->EN != 0;
	fb->last = now_ns;
	fb->ENO = fb->EN && is_sound(fb);
	if (!fb->ENO)
		return;
	control(fb, (double)since / 1e9, resumed);
	fb->HI = fb->OUT >= fb->MAX;
	fb->LO = fb->OUT <= fb->MIN;
}
