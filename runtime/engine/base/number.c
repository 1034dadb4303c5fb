/* SPDX-License-Identifier: MIT
 *
 * number - the bits of a double (see number.h).
 */
#include "engine/base/number.h"

#include <string.h>

#define TOP_BIT ((uint64_t)1 << 63)

struct number number_of(double x)
{
	uint64_t bits, part;
	int32_t power;

	memcpy(&bits, &x, sizeof(bits));
	part = bits << 12 >> 1;
	power = (int32_t)(bits >> 52 & 0x7ff) - 1022;
	if (power > -1022) {
		part |= TOP_BIT;
	} else {
		int zeros = __builtin_clzll(part | 1);

		part <<= zeros;
		power = -1021 - zeros;
	}
	return (struct number){ part, power, bits >> 63 };
}

double number_double(struct number n)
{
	int32_t biased = n.power + 1022;
	unsigned drop = 11;
	uint64_t bits, rest, half;
	double x;

	if (biased < 1) { /* subnormal: fewer bits are kept */
		drop = 12 - (biased < -60 ? -60u : (unsigned)biased);
		biased = 1;
	}
	bits = drop < 64 ? n.part >> drop : 0;
	rest = drop < 64 ? n.part - (bits << drop) : n.part;
	half = drop <= 64 ? (uint64_t)1 << (drop - 1) : ~(uint64_t)0;
	bits += rest > half || (rest == half && (bits & 1));
	/* A leading bit adds 1 to the exponent; rounding may do the same. */
	bits += (uint64_t)(biased - 1) << 52;
	if (biased > 2046)
		bits = (uint64_t)0x7ff << 52;
	bits |= (uint64_t)n.negative << 63;
	memcpy(&x, &bits, sizeof(x));
	return x;
}
