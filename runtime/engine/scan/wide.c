/* SPDX-License-Identifier: MIT
 *
 * wide - unsigned integers of 128 bits: shifts and quotient.
 *
 * Not inline like the product: each call would cost a hundred bytes on a small board.
 */
#include "engine/scan/wide.h"

struct wide wide_right(struct wide a, unsigned bits)
{
	if (bits >= 128)
		return (struct wide){ 0, 0 };
	if (bits >= 64)
		return (struct wide){ 0, a.high >> (bits - 64) };
	if (bits == 0)
		return a;
	return (struct wide){ a.high >> bits, a.low >> bits | a.high << (64 - bits) };
}

struct wide wide_left(struct wide a, unsigned bits)
{
	if (bits >= 64)
		return (struct wide){ a.low << (bits - 64), 0 };
	if (bits == 0)
		return a;
	return (struct wide){ a.high << bits | a.low >> (64 - bits), a.low << bits };
}

unsigned wide_zeros(struct wide a)
{
	if (a.high)
		return (unsigned)__builtin_clzll(a.high);
	return 64 + (unsigned)__builtin_clzll(a.low | 1);
}

/* Two digits of 32 bits, each estimated with the upper half of the divisor: the
 * estimate is never too small and at most 2 too large. */
uint64_t wide_divided(struct wide n, uint64_t by)
{
	uint64_t result = 0, rest = n.high;

	for (int shift = 32; shift >= 0; shift -= 32) {
		uint64_t next = n.low >> shift & 0xffffffff;
		uint64_t digit = rest / (by >> 32);
		uint64_t left;

		if (digit > 0xffffffff)
			digit = 0xffffffff;
		left = rest - digit * (by >> 32);
		while (left <= 0xffffffff && digit * (uint32_t)by > (left << 32 | next)) {
			digit--;
			left += by >> 32;
		}
		rest = (rest << 32 | next) - digit * by;
		result = result << 32 | digit;
	}
	return result;
}
