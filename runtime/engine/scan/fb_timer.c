/* SPDX-License-Identifier: MIT
 *
 * fb_timer - TON, TOF and TP, IEC 61131-3 table 38 and figure 15; TONR.
 *
 * All measure against the start time on the scan's monotonic clock, so a late scan
 * causes no drift. ET = PT counts as elapsed. PT may change while the timer runs.
 */
#include "engine/scan/fb.h"

/* No branch on an input, as a CPU cannot predict inputs. Without power no
 * byte changes; otherwise a retained timer would be stored in every scan. */
void fb_TON_step(struct fb_TON *fb, int64_t now_ns)
{
	uint8_t in = fb->IN;
	int64_t goes_on = -(int64_t)(in & fb->running); /* all bits, or none */
	int64_t elapsed = fb_elapsed(now_ns, fb->start, fb->PT) & goes_on;

	fb->start = in > fb->running ? now_ns : fb->start;
	fb->running = in;
	fb->ET = elapsed;
	fb->Q = in & (elapsed >= fb->PT);
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
	fb->ET = fb_elapsed(now_ns, fb->start, fb->PT);
	fb->Q = fb->ET < fb->PT;
}

/* `running` is TRUE from the edge of IN until IN is FALSE after the pulse; then the
 * next edge starts a pulse. */
void fb_TP_step(struct fb_TP *fb, int64_t now_ns)
{
	if (!fb->running && fb->IN) {
		fb->running = fb->Q = 1;
		fb->start = now_ns;
	}
	if (fb->running && fb->Q) {
		fb->ET = fb_elapsed(now_ns, fb->start, fb->PT);
		fb->Q = fb->ET < fb->PT;
	}
	if (!fb->Q && !fb->IN) {
		fb->running = 0;
		fb->ET = 0;
	}
}

/* Time counts from the call that sees IN TRUE to the call that sees it FALSE. The sum
 * is kept in ET only, so that it is retained if ET is. */
void fb_TONR_step(struct fb_TONR *fb, int64_t now_ns)
{
	bool counts = fb->running;
	int64_t had = fb->ET > 0 ? fb->ET : 0;

	if (counts || fb->IN) {
		if (fb->PT <= had)
			fb->ET = fb->PT > 0 ? fb->PT : 0;
		else
			fb->ET = had + (counts ? fb_elapsed(now_ns, fb->last,
							    fb->PT - had) : 0);
		fb->Q = fb->ET >= fb->PT;
	}
	fb->running = fb->IN != 0;
	fb->last = now_ns;
	if (fb->R) {
		fb->ET = 0;
		fb->Q = 0;
	}
}
