/* SPDX-License-Identifier: MIT
 *
 * fb_bistable - SR and RS, IEC 61131-3 table 34, and SEMA of the second edition's
 * table 34. Nothing else is stored.
 */
#include "engine/scan/vm.h"

void fb_SR_step(struct fb_SR *fb, int64_t now_ns)
{
	(void)now_ns;
	fb->Q1 = fb->S1 | (fb->Q1 & !fb->R);
}

void fb_RS_step(struct fb_RS *fb, int64_t now_ns)
{
	(void)now_ns;
	fb->Q1 = (fb->S | fb->Q1) & !fb->R1;
}

/* BUSY is the state before the call: FALSE with CLAIM TRUE means that the caller has it
 * now. */
void fb_SEMA_step(struct fb_SEMA *fb, int64_t now_ns)
{
	(void)now_ns;
	fb->BUSY = fb->taken != 0;
	if (fb->CLAIM) {
		fb->taken = 1;
	} else if (fb->RELEASE) {
		fb->BUSY = 0;
		fb->taken = 0;
	}
}
