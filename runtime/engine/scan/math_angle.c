/* SPDX-License-Identifier: MIT
 *
 * math - sine to arc tangent; powers and logarithms are in math.c.
 *
 * An angle is brought into -pi/4 .. pi/4 with as many bits of 2/pi as it needs, then a
 * power series is used. The inverse functions all use one arc tangent of a quotient,
 * which keeps the precision of small numerators and denominators.
 */
#include "engine/scan/math.h"
#include "engine/scan/math_table.h"
#include "engine/scan/math_number.h"

#include <math.h>

/*
 * Leaves in @x its distance from the nearest multiple of pi/2; which one, modulo 4.
 *
 * Of the product x * 2/pi only the two bits before the point and those after it
 * count. Bits of 2/pi that make multiples of 4 are left out, and 192 of those that
 * follow are enough: no double comes nearer to a multiple than 2^-62.
 */
static unsigned to_quadrant(struct number *x)
{
	unsigned at, shift, quadrant;
	uint64_t bits[3];
	struct wide low, middle, part;
	bool above;

	if (x->power < 0) /* below 1/2 */
		return 0;
	at = (unsigned)x->power + 62; /* 128 zeros stand before the point */
	shift = at % 64;
	for (unsigned i = 0; i < 3; i++)
		bits[i] = wide_left((struct wide){ math_2_pi[at / 64 + i],
				    math_2_pi[at / 64 + i + 1] }, shift).high;
	low = wide_times(x->part, bits[2]);
	middle = wide_times(x->part, bits[1]);
	part = wide_add((struct wide){ middle.high + x->part * bits[0], middle.low },
			(struct wide){ 0, low.high });
	quadrant = part.high >> 62;
	part = wide_left(part, 2);
	part.low |= low.low >> 62;
	above = part.high >> 63;
	if (above)
		part = wide_subtract((struct wide){ 0, 0 }, part);
	*x = number_wide(part, 0, above);
	*x = number_wide(wide_times(x->part, MATH_PI_4), x->power + 1, above);
	return quadrant + above;
}

/* sin x = x (1 - x² (1/3! - x² (1/5! - ...))), |x| <= pi/4. */
static struct number sine(struct number x)
{
	uint64_t fixed = number_fixed(x, 64), square = wide_top(fixed, fixed);
	uint64_t less = wide_top(square, number_series(number_factorial, 3, 19, 2,
						       true, square));
	struct wide part = wide_subtract((struct wide){ x.part, 0 },
					 wide_times(x.part, less));

	return number_wide(part, x.power, x.negative);
}

/* cos x = 1 - x² (1/2! - x² (1/4! - ...)), |x| <= pi/4. */
static struct number cosine(struct number x)
{
	uint64_t fixed = number_fixed(x, 64), square = wide_top(fixed, fixed);
	uint64_t less = wide_top(square, number_series(number_factorial, 2, 20, 2,
						       true, square));

	if (less == 0)
		return (struct number){ (uint64_t)1 << 63, 1, false };
	return number_wide((struct wide){ -less, 0 }, 0, false);
}

static struct number sine_in(unsigned quadrant, struct number x)
{
	struct number n = quadrant & 1 ? cosine(x) : sine(x);

	n.negative ^= quadrant >> 1 & 1;
	return n;
}

/* The sine, or the tangent if @tangent. Both are odd functions. */
static double odd_of(double x, bool tangent)
{
	struct number n;
	unsigned quadrant;

	if (bits_is_special(x))
		return bits_is_zero(x) ? x : bits_nan();
	n = number_of(x);
	n.negative = false;
	quadrant = to_quadrant(&n);
	n = tangent ? number_divided(sine_in(quadrant, n), sine_in(quadrant + 1, n)) :
	    sine_in(quadrant, n);
	n.negative ^= bits_is_negative(x);
	return number_double(n);
}

double math_sin(double x)
{
	return odd_of(x, false);
}

double math_cos(double x)
{
	struct number n;
	unsigned quadrant;

	if (bits_is_special(x))
		return bits_is_zero(x) ? 1 : bits_nan();
	n = number_of(x);
	n.negative = false;
	quadrant = to_quadrant(&n);
	return number_double(sine_in(quadrant + 1, n));
}

double math_tan(double x)
{
	return odd_of(x, true);
}

/* atan d = d (1 - d² (1/3 - d² (1/5 - ...))), d <= 1/15. */
static struct number arc_small(struct number d)
{
	uint64_t fixed = number_fixed(d, 64), square = wide_top(fixed, fixed);
	uint64_t less = wide_top(square, number_series(number_inverse, 3, 17, 2,
						       true, square));

	return number_wide(wide_subtract((struct wide){ d.part, 0 },
					 wide_times(d.part, less)),
			   d.power, d.negative);
}

/*
 * atan(@y / @x), 0 < y <= x
 *
 * With i the nearest to 8 y / x, atan(y/x) = atan(i/8) + atan(d), where d =
 * (8 y - i x) / (8 x + i y) is at most 1/15: one division, whatever i.
 */
static struct number arc(struct number y, struct number x)
{
	int32_t apart = x.power - y.power;
	uint64_t below = x.part >> 1, less, sum;
	uint32_t near = 0;
	struct number d;
	bool negative;

	if (apart <= 5) {
		uint32_t coarse = (uint32_t)(x.part >> 48);

		near = ((uint32_t)(y.part >> (45 + apart)) + coarse / 2) / coarse;
	}
	if (near == 0)
		return arc_small(number_divided(y, x));
	/* The difference fits, because it is less than x, although its terms may not. */
	less = (apart < 2 ? y.part << (2 - apart) : y.part >> (apart - 2)) - near * below;
	negative = less >> 63;
	if (less == 0)
		return number_wide((struct wide){ math_atan_table[near], 0 }, 0, false);
	d = number_wide((struct wide){ negative ? -less : less, 0 }, -2, negative);
	sum = below + wide_top(y.part >> 1 >> apart, (uint64_t)near << 60) * 2;
	d = arc_small(number_divided(d, number_wide((struct wide){ sum, 0 }, 1, false)));
	sum = number_fixed(d, 64);
	return number_wide((struct wide){ math_atan_table[near] + (negative ? -sum : sum),
					  0 }, 0, false);
}

/* The direction of a point, neither of whose coordinates is 0; fixed point of 62 bits
 * when multiples of a quarter turn are added. */
static struct number direction(struct number y, struct number x)
{
	bool steep = y.power > x.power || (y.power == x.power && y.part > x.part);
	struct number n = steep ? arc(x, y) : arc(y, x);
	uint64_t angle;

	n.negative = y.negative;
	if (!steep && !x.negative)
		return n;
	angle = number_fixed(n, 62);
	if (steep)
		angle = MATH_PI_4 / 2 + (x.negative ? angle : -angle);
	else
		angle = MATH_PI_4 - angle;
	return number_wide((struct wide){ angle, 0 }, 2, y.negative);
}

static struct number with_sign(uint64_t part, int32_t power, bool negative)
{
	return number_wide((struct wide){ part, 0 }, power, negative);
}

double math_atan2(double y, double x)
{
	bool up = !bits_is_negative(y), left = bits_is_negative(x);

	if (bits_is_nan(x) || bits_is_nan(y))
		return bits_nan();
	if (bits_is_zero(y) || (bits_is_infinite(x) && !bits_is_infinite(y)))
		return left ? number_double(with_sign(MATH_PI_4, 2, !up)) : up ? 0.0 : -0.0;
	if (bits_is_zero(x) || (bits_is_infinite(y) && !bits_is_infinite(x)))
		return number_double(with_sign(MATH_PI_4, 1, !up));
	if (bits_is_infinite(x))
		return number_double(left ? with_sign(MATH_PI_4 / 4 * 3, 2, !up)
					  : with_sign(MATH_PI_4, 0, !up));
	return number_double(direction(number_of(y), number_of(x)));
}

double math_atan(double x)
{
	return math_atan2(x, 1);
}

/* Square root of @n / 2^128, which is 1/4 at least, of 2^64: the machine's square root
 * has 53 correct bits, and one Newton step doubles them. */
static uint64_t root_of(struct wide n)
{
	uint64_t root, other;

	if (n.high >> 32 == 0xffffffff) /* 1 - e: 1 - e/2, as e² is nothing */
		return n.high >> 1 | (uint64_t)1 << 63;
	root = (uint64_t)(sqrt((double)n.high) * 4294967296.0);
	other = wide_divided(n, root);
	return root / 2 + other / 2 + (root & other & 1);
}

/* sqrt(1 - x²), 0 < |x| < 1. The square is exact. */
static struct number root_beside(struct number x)
{
	struct wide square = wide_right(wide_times(x.part, x.part),
					(unsigned)(-2 * x.power));
	struct wide rest = wide_subtract((struct wide){ 0, 0 }, square);
	unsigned pairs = wide_zeros(rest) / 2;

	if (x.power < -40) /* within 2^-80 of 1 */
		return (struct number){ (uint64_t)1 << 63, 1, false };
	return (struct number){
		root_of(wide_left(rest, 2 * pairs)), -(int32_t)pairs, false
	};
}

double math_asin(double x)
{
	struct number n;

	if (bits_is_zero(x))
		return x;
	if (x == 1 || x == -1)
		return math_atan2(x, 0);
	if (!(x > -1 && x < 1))
		return bits_nan();
	n = number_of(x);
	return number_double(direction(n, root_beside(n)));
}

double math_acos(double x)
{
	struct number n;

	if (bits_is_zero(x))
		return math_atan2(1, x);
	if (x == 1 || x == -1)
		return math_atan2(0, x);
	if (!(x > -1 && x < 1))
		return bits_nan();
	n = number_of(x);
	return number_double(direction(root_beside(n), n));
}
