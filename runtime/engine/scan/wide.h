/* SPDX-License-Identifier: MIT
 *
 * wide - unsigned integers of 128 bits out of two of 64, for math.
 *
 * Overflow is defined: high bits are lost, as with uint64_t.
 */
#ifndef SCAN_WIDE_H
#define SCAN_WIDE_H

#include <stdbool.h>
#include <stdint.h>

struct wide {
	uint64_t high, low;
};

/* Where a compiler has the type, the product is one instruction and EXP takes a third
 * of the time; otherwise four products are added. The result is the same. */
#ifdef __SIZEOF_INT128__
/** wide_times - the whole product. Scan-safe: yes. */
static inline struct wide wide_times(uint64_t a, uint64_t b)
{
	unsigned __int128 product = (unsigned __int128)a * b;

	return (struct wide){ (uint64_t)(product >> 64), (uint64_t)product };
}
#else
static inline struct wide wide_times(uint64_t a, uint64_t b)
{
	uint64_t a1 = a >> 32, a0 = (uint32_t)a, b1 = b >> 32, b0 = (uint32_t)b;
	uint64_t low = a0 * b0, left = a1 * b0, right = a0 * b1;
	uint64_t middle = (low >> 32) + (uint32_t)left + (uint32_t)right;

	return (struct wide){
		a1 * b1 + (left >> 32) + (right >> 32) + (middle >> 32),
		middle << 32 | (uint32_t)low,
	};
}
#endif

/** wide_top - the upper half of a product: two fractions multiplied. Scan-safe: yes. */
static inline uint64_t wide_top(uint64_t a, uint64_t b)
{
	return wide_times(a, b).high;
}

static inline struct wide wide_add(struct wide a, struct wide b)
{
	uint64_t low = a.low + b.low;

	return (struct wide){ a.high + b.high + (low < b.low), low };
}

static inline struct wide wide_subtract(struct wide a, struct wide b)
{
	return (struct wide){ a.high - b.high - (a.low < b.low), a.low - b.low };
}

/** wide_right - @a / 2^@bits, for any number of bits. Scan-safe: yes. */
struct wide wide_right(struct wide a, unsigned bits);

/** wide_left - @a * 2^@bits, @bits < 128. Scan-safe: yes. */
struct wide wide_left(struct wide a, unsigned bits);

/** wide_zeros - how many bits above the highest that is set; 127 if none is.
 * Scan-safe: yes. */
unsigned wide_zeros(struct wide a);

/** wide_divided - @n / @by for a @by with its top bit set and greater than n.high.
 * Scan-safe: yes. */
uint64_t wide_divided(struct wide n, uint64_t by);
#endif
