/* SPDX-License-Identifier: MIT
 *
 * fb_edge - R_TRIG and F_TRIG, IEC 61131-3 table 35.
 *
 * At the first call CLK TRUE is a rising edge; CLK FALSE is not a falling edge.
 */
#include "engine/scan/vm.h"

void fb_R_TRIG_step(struct fb_R_TRIG *fb, int64_t now_ns)
{
	(void)now_ns;
	fb->Q = fb->CLK & !fb->seen;
	fb->seen = fb->CLK;
}

void fb_F_TRIG_step(struct fb_F_TRIG *fb, int64_t now_ns)
{
	(void)now_ns;
	fb->Q = fb->seen & !fb->CLK;
	fb->seen = fb->CLK;
}
