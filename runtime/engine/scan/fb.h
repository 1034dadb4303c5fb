/* SPDX-License-Identifier: MIT
 *
 * fb - edges, elapsed time and REAL results for the function blocks of fb_*.c.
 *
 * A block's memory comes from images and retained files, so every byte of it may be
 * anything: check a value before using it as an index. For fb_*.c only; vm.h calls
 * blocks.
 */
#ifndef SCAN_FB_H
#define SCAN_FB_H

#include "engine/scan/vm.h"

#include <float.h>

/** fb_rises - TRUE now and not at the previous call; @seen keeps the last value.
 * Scan-safe: yes. */
static inline bool fb_rises(uint8_t now, uint8_t *seen)
{
	bool edge = (now != 0) & (*seen == 0);

	*seen = now != 0;
	return edge;
}

/** fb_since - ns from @start to now; 0 if the clock went back. Unsigned, because the
 * difference of two int64 may not fit one.   Scan-safe: yes. */
static inline uint64_t fb_since(int64_t now_ns, int64_t start)
{
	return now_ns < start ? 0 : (uint64_t)now_ns - (uint64_t)start;
}

/** fb_elapsed - the same, held at @preset; 0 for a negative one. */
static inline int64_t fb_elapsed(int64_t now_ns, int64_t start, int64_t preset)
{
	uint64_t since = fb_since(now_ns, start);

	if (preset <= 0)
		return 0;
	return since < (uint64_t)preset ? (int64_t)since : preset;
}

/** fb_is_number - finite as a REAL. */
static inline bool fb_is_number(double value)
{
	return value >= -(double)FLT_MAX && value <= (double)FLT_MAX;
}

/** fb_give - stores @value as the REAL @out; false, and nothing is stored, if it is not
 * finite. Scan-safe: yes. */
static inline bool fb_give(float *out, double value)
{
	if (!fb_is_number(value))
		return false;
	*out = (float)value;
	return true;
}

static inline double fb_clamp(double value, double low, double high)
{
	return value < low ? low : value > high ? high : value;
}

/** fb_bound - an INT limited to 1 … @most. */
static inline int fb_bound(int value, int most)
{
	return value < 1 ? 1 : value > most ? most : value;
}
#endif
