/* SPDX-License-Identifier: MIT
 *
 * fb_timer - TON, TOF and TP, IEC 61131-3 table 38 and figure 15.
 *
 * All measure against the start time on the scan's monotonic clock, so nothing
 * drifts when a scan is late. Exactly ET = PT is elapsed. PT may change while
 * the timer runs.
 */
#include "engine/scan/vm.h"

/* Time since @start, 0 … @preset; a clock that stood still or a negative preset
 * gives 0. Unsigned, because the difference of two int64 may not fit one. */
static int64_t elapsed(int64_t now_ns, int64_t start, int64_t preset)
{
	uint64_t since = (uint64_t)now_ns - (uint64_t)start;

	if (preset <= 0 || now_ns < start)
		return 0;
	return since < (uint64_t)preset ? (int64_t)since : preset;
}

void fb_TON_step(struct fb_TON *fb, int64_t now_ns)
{
	if (!fb->IN) {
		fb->running = fb->Q = 0;
		fb->ET = 0;
		return;
	}
	if (!fb->running) {
		fb->running = 1;
		fb->start = now_ns;
	}
	fb->ET = elapsed(now_ns, fb->start, fb->PT);
	fb->Q = fb->ET >= fb->PT;
}

void fb_TOF_step(struct fb_TOF *fb, int64_t now_ns)
{
	if (fb->IN) {
		fb->Q = 1;
		fb->running = 0;
		fb->ET = 0;
		return;
	}
	if (!fb->Q)
		return;
	if (!fb->running) {
		fb->running = 1;
		fb->start = now_ns;
	}
	fb->ET = elapsed(now_ns, fb->start, fb->PT);
	fb->Q = fb->ET < fb->PT;
}

/* `running` lasts from the edge of IN until IN is FALSE after the pulse: that is
 * what re-arms it. */
void fb_TP_step(struct fb_TP *fb, int64_t now_ns)
{
	if (!fb->running && fb->IN) {
		fb->running = fb->Q = 1;
		fb->start = now_ns;
	}
	if (fb->running && fb->Q) {
		fb->ET = elapsed(now_ns, fb->start, fb->PT);
		fb->Q = fb->ET < fb->PT;
	}
	if (!fb->Q && !fb->IN) {
		fb->running = 0;
		fb->ET = 0;
	}
}
