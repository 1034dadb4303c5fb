/* SPDX-License-Identifier: MIT
 *
 * fb_counter - CTU, CTD and CTUD of each type, IEC 61131-3 table 36.
 *
 * They count rising edges, beyond PV and below 0, up to the limits of their type. An
 * edge that comes while R or LD is TRUE is consumed; both edges of a CTUD in one call
 * cancel out. The types differ only in their limits.
 */
#include "engine/scan/fb.h"

#define STEP_UP(id, high) \
void fb_##id##_step(struct fb_##id *fb, int64_t now_ns) \
{ \
	bool edge = fb_rises(fb->CU, &fb->seen); \
\
	(void)now_ns; \
	/* No branch on an input: a CPU cannot predict one. */ \
	fb->CV += edge & (fb->CV < (high)); \
	fb->CV = fb->R ? 0 : fb->CV; \
	fb->Q = fb->CV >= fb->PV; \
}

#define STEP_DOWN(id, low) \
void fb_##id##_step(struct fb_##id *fb, int64_t now_ns) \
{ \
	bool edge = fb_rises(fb->CD, &fb->seen); \
\
	(void)now_ns; \
	fb->CV -= edge & (fb->CV > (low)); \
	fb->CV = fb->LD ? fb->PV : fb->CV; \
	fb->Q = fb->CV <= 0; \
}

#define STEP_BOTH(id, low, high) \
void fb_##id##_step(struct fb_##id *fb, int64_t now_ns) \
{ \
	bool up = fb_rises(fb->CU, &fb->seen_up); \
	bool down = fb_rises(fb->CD, &fb->seen_down); \
\
	(void)now_ns; \
	if (fb->R) \
		fb->CV = 0; \
	else if (fb->LD) \
		fb->CV = fb->PV; \
	else if (up && !down && fb->CV < (high)) \
		fb->CV++; \
	else if (down && !up && fb->CV > (low)) \
		fb->CV--; \
	fb->QU = fb->CV >= fb->PV; \
	fb->QD = fb->CV <= 0; \
}

#define COUNTERS(type, low, high) \
	STEP_UP(CTU##type, high) \
	STEP_DOWN(CTD##type, low) \
	STEP_BOTH(CTUD##type, low, high)

COUNTERS(, INT16_MIN, INT16_MAX)
#ifndef RUNGBOARD_CORE_WORDS
COUNTERS(_DINT, INT32_MIN, INT32_MAX)
COUNTERS(_LINT, INT64_MIN, INT64_MAX)
COUNTERS(_UDINT, 0, UINT32_MAX)
COUNTERS(_ULINT, 0, UINT64_MAX)
#endif
