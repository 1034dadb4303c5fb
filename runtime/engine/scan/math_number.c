/* SPDX-License-Identifier: MIT
 *
 * math_number - division and power series in integers.
 */
#include "engine/scan/math_number.h"

struct number number_wide(struct wide n, int32_t power, bool negative)
{
	unsigned zeros = wide_zeros(n);

	return (struct number){
		wide_left(n, zeros).high, power - (int32_t)zeros, negative
	};
}

struct number number_divided(struct number a, struct number b)
{
	bool above = a.part >= b.part;
	struct wide n = wide_right((struct wide){ a.part, 0 }, above);

	return (struct number){
		wide_divided(n, b.part), a.power - b.power + above,
		a.negative != b.negative
	};
}

uint64_t number_fixed(struct number n, int32_t bits)
{
	int32_t drop = 64 - bits - n.power;

	if (drop >= 64)
		return 0;
	return drop > 0 ? n.part >> drop : n.part;
}

uint64_t number_series(const uint64_t *c, int first, int last, int step,
		       bool alternate, uint64_t x)
{
	uint64_t sum = c[last];

	for (int k = last - step; k >= first; k -= step) {
		uint64_t product = wide_top(sum, x);

		sum = alternate ? c[k] - product : c[k] + product;
	}
	return sum;
}
