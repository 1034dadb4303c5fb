/* SPDX-License-Identifier: MIT
 *
 * decimal - converts REAL and LREAL to decimal digits and back, with big integers. Only
 * the last step rounds.
 */
#include "engine/base/decimal.h"
#include "engine/base/ascii.h"
#include "engine/base/big.h"
#include "engine/base/number.h"

#include <string.h>

/* A value between its two neighbours, as fractions of `whole`: rest / whole is the
 * value, step / whole is half the distance to the next lower number, and `up` times
 * that is half the distance to the next higher one. */
struct between {
	struct big rest, whole, step;
	int up;       /* 2 above a power of 2, else 1                         */
	bool even;    /* a text exactly half way reads back, too              */
};

/* Sets the three, in units that make them whole; @part * 2^@power is the value. */
static void place(struct between *b, uint64_t part, int power, bool lowest)
{
	bool edge = (part & (part - 1)) == 0 && !lowest;
	int below = (power < 0 ? -power : 0) + 1 + edge;

	b->up = edge ? 2 : 1;
	b->even = !(part & 1);
	big_set(&b->rest, part);
	big_shift(&b->rest, (power > 0 ? power : 0) + 1 + edge);
	big_set(&b->whole, 1);
	big_shift(&b->whole, below);
	big_set(&b->step, 1);
	big_shift(&b->step, power > 0 ? power : 0);
}

/* The value as an odd-sized integer times a power of 2; a single has 24 bits. */
static void take_value(struct between *b, double value, bool single)
{
	int bits = single ? 24 : 53, lowest = single ? -149 : -1074;
	struct number n = number_of(value);
	int power = n.power - bits;

	if (power < lowest)
		power = lowest;
	place(b, n.part >> (64 - (n.power - power)), power, power == lowest);
}

static bool reaches(const struct between *b)
{
	int order = big_order(&b->rest, b->up, &b->step, &b->whole);

	return b->even ? order >= 0 : order > 0;
}

/* Scales to 0.1 <= value < 1, as the text will round; returns the power of 10. */
static int scale(struct between *b, double value)
{
	/* 1233 / 4096 is just below log10(2): a step too low at most. */
	int power = number_of(value).power - 1;
	int tens = (power * 1233 - (power < 0 ? 4095 : 0)) / 4096;

	if (tens > 0)
		big_power(&b->whole, tens);
	big_power(&b->rest, tens < 0 ? -tens : 0);
	big_power(&b->step, tens < 0 ? -tens : 0);
	while (reaches(b)) {
		big_scale(&b->whole, 10, 0);
		tens++;
	}
	return tens;
}

/* Takes one digit off and leaves the remainder in `rest`. */
static int next_digit(struct between *b)
{
	int digit = 0;

	big_scale(&b->rest, 10, 0);
	big_scale(&b->step, 10, 0);
	while (big_order(&b->rest, 0, &b->step, &b->whole) >= 0) {
		big_subtract(&b->rest, &b->whole);
		digit++;
	}
	return digit;
}

/* At the last digit: is the value nearer to the next one? */
static bool rounds_up(const struct between *b, int digit)
{
	int order = big_order(&b->rest, 1, &b->rest, &b->whole);

	return order > 0 || (order == 0 && (digit & 1));
}

void decimal_of(double value, bool single, struct decimal *out)
{
	struct between b;
	bool low = false, high = false;

	take_value(&b, value, single);
	out->exponent = scale(&b, value) - 1;
	for (out->count = 0; out->count < DECIMAL_DIGITS && !low && !high;) {
		int digit = next_digit(&b), order;

		order = big_order(&b.rest, 0, &b.step, &b.step);
		low = b.even ? order <= 0 : order < 0;
		high = reaches(&b);
		if (high && (!low || rounds_up(&b, digit)))
			digit++;
		out->digit[out->count++] = (char)('0' + digit);
	}
}

/* ---- digits to a value ---- */

/* Powers of 10 beyond these are infinite or 0 whatever the digits are. */
#define TENS_MOST 310
#define TENS_LEAST (-330)

static void take_digits(struct big *big, const char *digit, int count)
{
	big_set(big, 0);
	for (int i = 0; i < count; i++)
		big_scale(big, 10, (uint32_t)(digit[i] - '0'));
}

/* The top 64 bits of @over / @under, which is 1 to 2; the lowest bit is set if more
 * follow. */
static uint64_t divide(struct big *over, const struct big *under)
{
	uint64_t bits = 0;

	for (int i = 0; i < 64; i++) {
		bool one = big_order(over, 0, over, under) >= 0;

		if (one)
			big_subtract(over, under);
		bits = bits << 1 | one;
		big_shift(over, 1);
	}
	return bits | (over->count > 0);
}

/* Rounded to odd, an LREAL rounds to the right REAL. */
static double to_single(struct number n)
{
	n.part = (n.part >> 11 | ((n.part & 0x7ff) != 0)) << 11;
	return (double)(float)number_double(n);
}

double decimal_value(const char *digit, int count, int64_t exponent, bool single)
{
	struct big over, under;
	struct number n = { 0, 1, false };
	int shift;

	if (exponent > TENS_MOST)
		return number_double((struct number){ ~(uint64_t)0, 2000, false });
	if (exponent < TENS_LEAST)
		return 0;
	take_digits(&over, digit, count);
	big_set(&under, 1);
	big_power(exponent >= count ? &over : &under,
		  (int)(exponent >= count ? exponent - count : count - exponent));
	shift = big_bits(&over) - big_bits(&under);
	big_shift(shift < 0 ? &over : &under, shift < 0 ? -shift : shift);
	if (big_order(&over, 0, &over, &under) < 0) {
		big_shift(&over, 1);
		shift--;
	}
	n.part = divide(&over, &under);
	n.power += shift;
	return single ? to_single(n) : number_double(n);
}

/* ---- from a text ---- */

static void add_digit(struct decimal_text *out, char digit, bool behind)
{
	if (out->count == 0 && digit == '0') {
		out->exponent -= behind;
		return;
	}
	out->exponent += !behind;
	if (out->count < DECIMAL_MOST)
		out->digit[out->count++] = digit;
	else
		out->more |= digit != '0';
}

/* The digits before the point, or those behind it. */
static const char *take_part(const char *at, const char *end, bool behind,
			     struct decimal_text *out)
{
	if (at == end || !ascii_digit(*at))
		return NULL;
	for (;;) {
		add_digit(out, *at++, behind);
		if (at < end && *at == '_' && (++at == end || !ascii_digit(*at)))
			return NULL;
		if (at == end || !ascii_digit(*at))
			return at;
	}
}

const char *decimal_take(const char *at, const char *end, struct decimal_text *out)
{
	out->count = 0;
	out->more = false;
	out->exponent = 0;
	at = take_part(at, end, false, out);
	return at && at < end && *at == '.' ? take_part(at + 1, end, true, out) : at;
}
