/* SPDX-License-Identifier: MIT
 *
 * fb_pulse - DEBOUNCE, BLINK and PWM: levels that change with time.
 *
 * All measure against a start on the scan's monotonic clock. A period begins where the
 * previous one ended, not in the scan that sees it, so a late scan causes no drift;
 * whole periods between two scans are skipped. TIMEs below 0 count as 0.
 */
#include "engine/scan/fb.h"

void fb_DEBOUNCE_step(struct fb_DEBOUNCE *fb, int64_t now_ns)
{
	int64_t delay = fb->IN ? fb->T_ON : fb->T_OFF;

	fb->Q = fb->Q != 0;
	if ((fb->IN != 0) == fb->Q) {
		fb->waiting = 0;
		return;
	}
	if (!fb->waiting) {
		fb->waiting = 1;
		fb->start = now_ns;
	}
	if (fb_elapsed(now_ns, fb->start, delay) < delay)
		return;
	fb->Q = fb->IN != 0;
	fb->waiting = 0;
}

static uint64_t not_negative(int64_t time)
{
	return time > 0 ? (uint64_t)time : 0;
}

/* Moves a start past the elapsed periods; returns the ns since the new start. */
static uint64_t go_on(int64_t *start, int64_t now_ns, uint64_t period)
{
	uint64_t since = fb_since(now_ns, *start);

	if (since >= period) {
		*start = (int64_t)((uint64_t)*start + since - since % period);
		since %= period;
	}
	return since;
}

void fb_BLINK_step(struct fb_BLINK *fb, int64_t now_ns)
{
	uint64_t high = not_negative(fb->TH), low = not_negative(fb->TL);

	if (!fb->EN || high + low == 0) {
		fb->running = fb->Q = 0;
		return;
	}
	if (!fb->running || now_ns < fb->start) {
		fb->running = 1;
		fb->start = now_ns;
	}
	fb->Q = go_on(&fb->start, now_ns, high + low) < high;
}

/* The TRUE time of a new period: a pulse or pause that is too short is left out. */
static int64_t pulse(const struct fb_PWM *fb)
{
	double duty = fb_clamp((double)fb->DUTY, 0.0, 100.0);
	int64_t on = fb->PERIOD;

	if (duty < 100.0)
		on = (int64_t)((double)fb->PERIOD * (duty / 100.0));
	if (on == 0 || on < fb->MIN_ON)
		return 0;
	return fb->PERIOD - on < fb->MIN_OFF ? fb->PERIOD : on;
}

void fb_PWM_step(struct fb_PWM *fb, int64_t now_ns)
{
	int64_t before = fb->start;
	uint64_t since;

	if (!fb->EN || fb->PERIOD <= 0) {
		fb->running = fb->Q = 0;
		return;
	}
	if (!fb->running || now_ns < fb->start)
		fb->start = now_ns;
	since = go_on(&fb->start, now_ns, (uint64_t)fb->PERIOD);
	if ((!fb->running || fb->start != before) &&
	    fb_is_number((double)fb->DUTY))
		fb->on = pulse(fb);
	fb->running = 1;
	fb->Q = fb->on > 0 && since < (uint64_t)fb->on;
}
