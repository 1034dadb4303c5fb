/* SPDX-License-Identifier: MIT
 *
 * vm_steps - finds the next TRUE BOOL of many and adds to the times of all TRUE ones,
 * so that the cost of a chart depends on its active steps only.
 *
 * Private to vm.c.
 */
#ifndef SCAN_VM_STEPS_H
#define SCAN_VM_STEPS_H

#include "engine/scan/value.h"

#include <string.h>

/* The first TRUE one of eight BOOLs, not all FALSE. */
static inline uint32_t first_of_eight(uint64_t eight)
{
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
	return (uint32_t)__builtin_ctzll(eight) / 8;
#else
	return (uint32_t)__builtin_clzll(eight) / 8;
#endif
}

static inline uint64_t eight_at(const uint8_t *bits)
{
	uint64_t eight;

	memcpy(&eight, bits, sizeof(eight));
	return eight;
}

/* Skips BOOLs that are FALSE, 32 at a time: most steps of a large chart. */
static inline uint32_t skip_false(const uint8_t *bits, uint32_t from, uint32_t n)
{
	while (from < n && n - from >= 32 &&
	       !(eight_at(bits + from) | eight_at(bits + from + 8) |
		 eight_at(bits + from + 16) | eight_at(bits + from + 24)))
		from += 32;
	return from;
}

/* The number of the first of @n BOOLs that is TRUE, from @from on; @n: none. */
static inline uint32_t next_true(const uint8_t *bits, uint32_t from, uint32_t n)
{
	uint64_t eight;

	from = skip_false(bits, from, n);
	for (; from < n && n - from >= sizeof(eight); from += sizeof(eight)) {
		eight = eight_at(bits + from);
		if (eight)
			return from + first_of_eight(eight);
	}
	while (from < n && !bits[from])
		from++;
	return from < n ? from : n;
}

/* EACH: true if one is TRUE; *@found is its number. */
static inline bool find_step(uint8_t *m, const uint32_t *at, uint32_t n, uint32_t *found)
{
	uint32_t cursor;

	memcpy(&cursor, m + at[0], sizeof(cursor));
	*found = next_true(m + at[1], cursor, n);
	cursor = *found < n ? *found + 1 : 0;
	memcpy(m + at[0], &cursor, sizeof(cursor));
	return *found < n;
}

/* Operands of TICK. */
enum { TICK_HOLD, TICK_LAST, TICK_DT, TICK_X, TICK_T, TICK_WORDS };

static inline void add_time(uint8_t *at, int64_t dt)
{
	int64_t value;

	memcpy(&value, at, sizeof(value));
	value = (int64_t)((uint64_t)value + (uint64_t)dt);
	memcpy(at, &value, sizeof(value));
}

static inline void tick(uint8_t *m, const uint32_t *at, uint32_t n, int64_t now_ns)
{
	const uint8_t *x = m + at[TICK_X];
	uint8_t *t = m + at[TICK_T];
	int64_t last, dt;

	memcpy(&last, m + at[TICK_LAST], sizeof(last));
	memcpy(m + at[TICK_LAST], &now_ns, sizeof(now_ns));
	dt = m[at[TICK_HOLD]] ? 0 : (int64_t)((uint64_t)now_ns - (uint64_t)last);
	memcpy(m + at[TICK_DT], &dt, sizeof(dt));
	for (uint32_t i = next_true(x, 0, n); i < n; i = next_true(x, i + 1, n))
		add_time(t + i * sizeof(dt), dt);
}
#endif
