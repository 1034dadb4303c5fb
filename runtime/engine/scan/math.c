/* SPDX-License-Identifier: MIT
 *
 * math - powers and logarithms; angles are in math_angle.c.
 *
 * Both use base 2: exp(x) = 2^(x log2 e) and pow(x, y) = 2^(y log2 x), ln x = log2 x *
 * ln 2. An error in the exponent of 2 becomes a relative one of the result, and
 * exponents reach 1074, so that log2 has some 10 bits more than the rest.
 */
#include "engine/scan/math.h"
#include "engine/scan/math_table.h"
#include "engine/scan/math_number.h"

/* A positive or negative number of 128 bits: part / 2^128 * 2^power. */
struct logarithm {
	struct wide part;
	int32_t power;
	bool negative;
};

/* log2(e), that is 1.44..., and its half as a fraction. */
static const struct logarithm log2_e = {
	{ MATH_LOG2_E_HIGH, MATH_LOG2_E_LOW }, 1, false
};

/* Upper 128 bits of a product of 192. */
static struct wide scaled(uint64_t factor, struct wide by)
{
	return wide_add(wide_times(factor, by.high),
			(struct wide){ 0, wide_top(factor, by.low) });
}

/*
 * the absolute value of log2(1 ± w), in units of 2^-128, times 2^-@shift
 * @w: of 2^64, not 0 and below 2^-4; it is shifted left until its top bit is set
 *
 * log(1 - w) = -(w + w²/2 + w³/3 + ...) and log(1 + w) = w - w²/2 + w³/3 - ... The
 * first two terms are exact; from the third on 64 bits do.
 */
static struct wide log2_near_1(uint64_t w, bool below, unsigned *shift)
{
	unsigned zeros = (unsigned)__builtin_clzll(w);
	uint64_t whole = w << zeros;
	struct wide square = wide_times(whole, whole);
	uint64_t rest = number_series(number_inverse, 3, 15, 1, !below, w);
	uint64_t cube = wide_top(wide_top(square.high, whole), rest);
	struct wide sum = wide_right((struct wide){ whole, 0 }, 1);
	struct wide half = wide_right(square, zeros + 2);

	sum = below ? wide_add(sum, half) : wide_subtract(sum, half);
	sum = wide_add(sum, wide_right((struct wide){ cube, 0 }, 2 * zeros + 1));
	*shift = zeros - 2;
	return wide_add(scaled(sum.high, log2_e.part),
			(struct wide){ 0, wide_top(sum.low, log2_e.part.high) });
}

/*
 * log2(@x), @x > 0; false: it is 0
 *
 * x = 2^e m with m in 1 .. 2, and a c of 8 bits near 1/m, so that m c is near 1 and
 * exact: log2 x = e + log2(1/c) + log2(m c). Next to 1, where the first two would
 * eat up the third, c is 1 or 1/2 and both of them are integers that cancel.
 */
static bool log2_of(struct number x, struct logarithm *log)
{
	unsigned index = x.part >> 58 & 31, shift = 0, zeros;
	uint64_t product = (x.part >> 11) * (math_log_factor[index] + 1u);
	bool below = product >> 60 == 0;
	uint64_t w = below ? -(product << 4) : product << 4;
	struct wide near = w ? log2_near_1(w, below, &shift) : (struct wide){ 0, 0 };
	int32_t whole = x.power - 1 + (index == 31);
	struct wide sum = wide_right(math_log_table[index], 12);

	if (whole == 0 && (index == 0 || index == 31)) {
		zeros = wide_zeros(near);
		*log = (struct logarithm){
			wide_left(near, zeros), -(int32_t)(shift + zeros), below
		};
		return w != 0;
	}
	/* Two's complement, 12 bits before the point. */
	sum.high += (uint64_t)whole << 52;
	near = wide_right(near, 12 + shift);
	sum = below ? wide_subtract(sum, near) : wide_add(sum, near);
	log->negative = sum.high >> 63;
	if (log->negative)
		sum = wide_subtract((struct wide){ 0, 0 }, sum);
	zeros = wide_zeros(sum);
	log->part = wide_left(sum, zeros);
	log->power = 12 - (int32_t)zeros;
	return true;
}

/* 2^(@whole + @part / 2^64): sixteenths from a table, the rest as a series of e^u. */
static struct number exp2_of(int32_t whole, uint64_t part)
{
	uint64_t root = math_exp_table[part >> 60];
	uint64_t u = wide_top(part << 4 >> 4, MATH_LN_2);
	uint64_t rest = number_series(number_factorial, 2, 10, 1, false, u);
	uint64_t sum = root + wide_top(root, u + wide_top(wide_top(u, u), rest));

	/* Just below 2, the last bit must not carry it there. */
	return (struct number){ sum < root ? ~(uint64_t)0 : sum, whole + 1, false };
}

/* 2^(@y @log). */
static struct number exp2_product(struct number y, const struct logarithm *log)
{
	struct wide product = scaled(y.part, log->part);
	int32_t power = y.power + log->power, whole = 0;
	bool negative = y.negative != log->negative;
	uint64_t part;

	if (power > 12) /* 2048 and more */
		return exp2_of(negative ? -4096 : 4096, 0);
	if (power < -63)
		return exp2_of(0, 0);
	if (power > 0) {
		whole = (int32_t)(product.high >> (64 - power));
		part = wide_left(product, (unsigned)power).high;
	} else {
		part = product.high >> -power;
	}
	if (!negative)
		return exp2_of(whole, part);
	return exp2_of(-whole - (part != 0), -part);
}

double math_exp(double x)
{
	if (bits_is_nan(x))
		return bits_nan();
	if (bits_is_zero(x))
		return 1;
	if (bits_is_infinite(x))
		return bits_is_negative(x) ? 0 : x;
	return number_double(exp2_product(number_of(x), &log2_e));
}

/* log2(@x) times @factor / 2^64 * 2^@power. */
static double log_scaled(double x, uint64_t factor, int32_t power)
{
	struct logarithm log;

	if (bits_is_nan(x))
		return bits_nan();
	if (bits_is_zero(x))
		return bits_infinity(true);
	if (bits_is_negative(x))
		return bits_nan();
	if (bits_is_infinite(x))
		return x;
	if (!log2_of(number_of(x), &log))
		return 0;
	return number_double(number_wide(scaled(factor, log.part), log.power + power,
					 log.negative));
}

double math_log(double x)
{
	return log_scaled(x, MATH_LN_2, 0);
}

double math_log10(double x)
{
	return log_scaled(x, MATH_LOG10_2, -1);
}

/* The square or cube of a double may lie exactly halfway between two doubles. A result
 * that is that close is treated as exact, so that ties round to even. */
static struct number snapped(struct number n)
{
	const uint64_t tie = 0x400, reach = 4;

	if ((n.part - tie + reach) % 0x800 <= 2 * reach)
		n.part = n.part >> 11 << 11 | tie;
	return n;
}

/* |@x| to a power that is neither 0 nor infinite. */
static double positive_power(double x, struct number y)
{
	struct logarithm log;
	struct number n;

	if (bits_is_zero(x) || bits_is_infinite(x))
		return bits_is_zero(x) == y.negative ? bits_infinity(false) : 0;
	n = number_of(x);
	n.negative = false;
	if (!log2_of(n, &log))
		return 1;
	return number_double(snapped(exp2_product(y, &log)));
}

/* Whether an integer is even: 0 no bit below the point is set, 1 it is an odd integer. */
enum parity { EVEN, ODD, FRACTION };

static enum parity parity_of(struct number y)
{
	if (y.power > 64)
		return EVEN;
	if (y.power < 1)
		return FRACTION;
	if (y.power < 64 && y.part << y.power)
		return FRACTION;
	return y.part >> (64 - y.power) & 1 ? ODD : EVEN;
}

static double power_of(double x, struct number y)
{
	enum parity parity = parity_of(y);
	double result;

	if (bits_is_nan(x))
		return bits_nan();
	if (bits_is_negative(x) && parity == FRACTION && !bits_is_zero(x) &&
	    !bits_is_infinite(x))
		return bits_nan();
	result = positive_power(x, y);
	return bits_is_negative(x) && parity == ODD ? -result : result;
}

/* x to the power of ±inf. */
static double infinite_power(double x, bool negative)
{
	double size = bits_is_negative(x) ? -x : x;

	if (size == 1)
		return 1;
	return (size > 1) != negative ? bits_infinity(false) : 0;
}

double math_pow(double x, double y)
{
	if (x == 1 || bits_is_zero(y))
		return 1;
	if (bits_is_nan(x) || bits_is_nan(y))
		return bits_nan();
	if (bits_is_infinite(y))
		return infinite_power(x, bits_is_negative(y));
	return power_of(x, number_of(y));
}

double math_pow_integer(double x, bool negative, uint64_t magnitude)
{
	if (magnitude == 0 || x == 1)
		return 1;
	return power_of(x, number_wide((struct wide){ 0, magnitude }, 128, negative));
}
