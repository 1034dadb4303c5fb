/* SPDX-License-Identifier: MIT
 *
 * fb_counter - CTU, CTD and CTUD, IEC 61131-3 table 36.
 *
 * They count at rising edges, beyond PV and below 0, up to the limits of INT. An
 * edge that comes while R or LD is TRUE is consumed.
 */
#include "engine/scan/vm.h"

static int16_t up(int16_t count, bool edge)
{
	return (int16_t)(count + (edge && count < INT16_MAX));
}

static int16_t down(int16_t count, bool edge)
{
	return (int16_t)(count - (edge && count > INT16_MIN));
}

void fb_CTU_step(struct fb_CTU *fb, int64_t now_ns)
{
	bool edge = fb->CU & !fb->seen;

	(void)now_ns;
	fb->seen = fb->CU;
	fb->CV = fb->R ? 0 : up(fb->CV, edge);
	fb->Q = fb->CV >= fb->PV;
}

void fb_CTD_step(struct fb_CTD *fb, int64_t now_ns)
{
	bool edge = fb->CD & !fb->seen;

	(void)now_ns;
	fb->seen = fb->CD;
	fb->CV = fb->LD ? fb->PV : down(fb->CV, edge);
	fb->Q = fb->CV <= 0;
}

/* Both edges in one call cancel out. */
void fb_CTUD_step(struct fb_CTUD *fb, int64_t now_ns)
{
	bool count_up = fb->CU & !fb->seen_up;
	bool count_down = fb->CD & !fb->seen_down;

	(void)now_ns;
	fb->seen_up = fb->CU;
	fb->seen_down = fb->CD;
	if (fb->R)
		fb->CV = 0;
	else if (fb->LD)
		fb->CV = fb->PV;
	else if (count_up != count_down)
		fb->CV = count_up ? up(fb->CV, true) : down(fb->CV, true);
	fb->QU = fb->CV >= fb->PV;
	fb->QD = fb->CV <= 0;
}
