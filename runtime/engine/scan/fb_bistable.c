/* SPDX-License-Identifier: MIT
 *
 * fb_bistable - SR and RS, IEC 61131-3 table 34. Nothing else is stored.
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
