/* SPDX-License-Identifier: MIT
 *
 * test_math - the functions of scan/math against correctly rounded results, and one
 * sum over a million of them that must be the same on every machine.
 *
 * tests/math/points.txt was made by other means (tests/math/points.py). This file is
 * run from the top folder; another path of the points may be given.
 */
#include "engine/scan/math.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

#include "tests/tap.h"

/* A result may be the other of two doubles only if the true value is this near to their
 * middle: millionths of a unit of the last place. */
#define REACH 4000

struct function {
	const char *name;
	double (*one)(double x);
	double (*two)(double x, double y);
};
static const struct function functions[] = {
	{ "exp", math_exp, NULL },     { "log", math_log, NULL },
	{ "log10", math_log10, NULL }, { "sin", math_sin, NULL },
	{ "cos", math_cos, NULL },     { "tan", math_tan, NULL },
	{ "asin", math_asin, NULL },   { "acos", math_acos, NULL },
	{ "atan", math_atan, NULL },   { "pow", NULL, math_pow },
	{ "atan2", NULL, math_atan2 },
};
#define FUNCTIONS (sizeof(functions) / sizeof(functions[0]))

static uint64_t bits_of(double x)
{
	uint64_t bits;

	memcpy(&bits, &x, sizeof(bits));
	return bits;
}

static double double_of(uint64_t bits)
{
	double x;

	memcpy(&x, &bits, sizeof(x));
	return x;
}

static double call(const struct function *f, double x, double y)
{
	return f->one ? f->one(x) : f->two(x, y);
}

/* Orders doubles as integers: the difference is the number of doubles between two. */
static int64_t place(double x)
{
	uint64_t size = bits_of(x) << 1 >> 1;

	return bits_of(x) >> 63 ? -(int64_t)size : (int64_t)size;
}

static double after(double x)
{
	int64_t next = place(x) + 1;

	return next < 0 ? double_of((uint64_t)-next | (uint64_t)1 << 63)
			: double_of((uint64_t)next);
}

static bool same(double a, double b)
{
	return bits_of(a) == bits_of(b);
}

static uint64_t state;

/* splitmix64's step is a multiplication and shifts: the same everywhere. */
static uint64_t random_bits(void)
{
	uint64_t z = state += UINT64_C(0x9e3779b97f4a7c15);

	z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
	z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
	return z ^ z >> 31;
}

/* A double of either sign whose exponent is low .. low + count - 1, a power of 2. */
static double random_double(int low, uint64_t count)
{
	uint64_t bits = random_bits();
	uint64_t exponent = (uint64_t)(1023 + low) + random_bits() % count;

	return double_of(bits << 12 >> 12 | exponent << 52 | bits >> 63 << 63);
}

/* ---- points ---- */

struct score {
	int points, misrounded, wrong;
};

static void score_point(struct score *score, const struct function *f,
			const double *point, int away)
{
	double x = point[0], y = point[1], want = point[2], got = call(f, x, y);
	int64_t apart = place(got) - place(want);

	score->points++;
	if (same(got, want))
		return;
	score->misrounded++;
	if (apart < -1 || apart > 1 || isnan(got) || away > REACH) {
		score->wrong++;
		printf("# %s(%a, %a): %a, not %a\n", f->name, x, y, got, want);
	}
}

static bool read_points(const char *path, struct score *scores)
{
	char line[128], *at;
	FILE *file = fopen(path, "r");
	double point[3];

	if (!file)
		return false;
	while (fgets(line, sizeof(line), file)) {
		at = strchr(line, ' ');
		if (line[0] == '#' || !at)
			continue;
		*at++ = '\0';
		for (int i = 0; i < 3; i++)
			point[i] = double_of(strtoull(at, &at, 16));
		for (size_t i = 0; i < FUNCTIONS; i++)
			if (strcmp(line, functions[i].name) == 0)
				score_point(&scores[i], &functions[i], point, atoi(at));
	}
	fclose(file);
	return true;
}

static void test_points(const char *path)
{
	struct score scores[FUNCTIONS] = { { 0, 0, 0 } };

	CHECK(read_points(path, scores));
	for (size_t i = 0; i < FUNCTIONS; i++) {
		const struct score *s = &scores[i];
		char text[80];

		snprintf(text, sizeof(text),
			"%s: %d points, %d not rounded to the nearest value",
			 functions[i].name, s->points, s->misrounded);
		CHECK_AS(s->points > 100 && s->wrong == 0, text);
	}
}

/* ---- exact and special values ---- */

static void test_exact(void)
{
	int wrong = 0;
	double power = 1;

	for (int k = 0; k <= 22; k++, power *= 10)
		wrong += !same(math_log10(power), k) || !same(math_pow(10, k), power);
	CHECK_AS(wrong == 0, "LOG of a power of 10 and the power are exact");
	wrong = 0;
	for (int k = -1074; k < 1024; k++)
		wrong += !same(math_pow(2, k), ldexp(1, k));
	CHECK_AS(wrong == 0, "powers of 2 are exact, also subnormal ones");
	wrong = 0;
	state = 1;
	for (int k = 0; k < 20000; k++) {
		double x = random_double(-500, 1000);

		/* The machine's product is rounded correctly. */
		wrong += llabs(place(math_pow(x, 2)) - place(x * x)) > 1;
		wrong += !same(math_pow(x, 1), x);
		x = (double)((random_bits() & 0x7ffffff) | 0x4000001);
		wrong += !same(math_pow(x, 2), x * x); /* 53 or 54 bits: ties */
		x = (double)(random_bits() & 0xffff);
		wrong += !same(math_pow(x, 3), x * x * x);
	}
	CHECK_AS(wrong == 0, "squares and cubes are exact, ties are rounded to even");
	CHECK(same(math_exp(0.0), 1) && same(math_exp(-0.0), 1));
	CHECK(same(math_log(1), 0.0) && same(math_log10(1), 0.0));
	CHECK(same(math_cos(0.0), 1) && same(math_cos(-0.0), 1));
	CHECK(same(math_acos(1), 0.0));
	CHECK(same(math_pow(-8, 3), -512) && same(math_pow(-2, -1), -0.5));
	CHECK(same(math_pow(9, 0.5), 3) && same(math_pow(32, 0.2), 2));
}

static void test_signs(void)
{
	double (*const odd[])(double) = { math_sin, math_tan, math_asin, math_atan };
	int wrong = 0;

	for (size_t i = 0; i < 4; i++)
		wrong += !same(odd[i](0.0), 0.0) || !same(odd[i](-0.0), -0.0);
	CHECK_AS(wrong == 0, "odd functions keep the sign of 0");
	wrong = 0;
	state = 2;
	for (int k = 0; k < 20000; k++) {
		double x = random_double(-70, 1000), y = random_double(-70, 70);

		wrong += !same(math_sin(-x), -math_sin(x));
		wrong += !same(math_tan(-x), -math_tan(x));
		wrong += !same(math_atan(-x), -math_atan(x));
		wrong += !same(math_cos(-x), math_cos(x));
		wrong += !same(math_atan2(-y, x), -math_atan2(y, x));
		wrong += !(fabs(math_sin(x)) <= 1) || !(fabs(math_cos(x)) <= 1);
		if (fabs(x) < 1)
			wrong += !same(math_asin(-x), -math_asin(x));
	}
	CHECK_AS(wrong == 0,
		 "sine, tangent, arcs are odd, cosine is even; both within -1 … 1");
	wrong = 0;
	for (int k = -1074; k < -30; k++) {
		double x = ldexp(1.5, k);

		for (size_t i = 0; i < 4; i++)
			wrong += llabs(place(odd[i](x)) - place(x)) > 0;
		wrong += !same(math_exp(2 * ldexp(x, -30)), 1);
	}
	CHECK_AS(wrong == 0, "the sine of a small angle is the angle");
}

static void test_special(void)
{
	const double inf = INFINITY;

	CHECK(same(math_exp(inf), inf) && same(math_exp(-inf), 0.0));
	CHECK(same(math_exp(710), inf) && same(math_exp(-746), 0.0));
	CHECK(same(math_exp(1e300), inf) && same(math_exp(-1e300), 0.0));
	CHECK(same(math_log(0.0), -inf) && same(math_log(-0.0), -inf));
	CHECK(same(math_log10(0.0), -inf) && same(math_log(inf), inf));
	CHECK(isnan(math_log(-1)) && isnan(math_log(-inf)) && isnan(math_log10(-1)));
	CHECK(isnan(math_sin(inf)) && isnan(math_cos(-inf)) && isnan(math_tan(inf)));
	CHECK(isnan(math_asin(1.0000000000000002)) && isnan(math_acos(-1.0000000000000002)));
	CHECK(isnan(math_asin(inf)) && isnan(math_acos(-inf)));
	CHECK(same(math_atan(inf), 0x1.921fb54442d18p+0));
	CHECK(same(math_atan(-inf), -0x1.921fb54442d18p+0));
	for (size_t i = 0; i < FUNCTIONS; i++)
		CHECK_AS(same(call(&functions[i], -(double)NAN, 2),
			      double_of((uint64_t)0xfff << 51)), functions[i].name);
}

/* C11 F.10.4.4. */
static void test_special_pow(void)
{
	const double inf = INFINITY;

	CHECK(same(math_pow(0.0, -3), inf) && same(math_pow(-0.0, -3), -inf));
	CHECK(same(math_pow(-0.0, -2), inf) && same(math_pow(-0.0, -2.5), inf));
	CHECK(same(math_pow(0.0, -inf), inf) && same(math_pow(-0.0, -inf), inf));
	CHECK(same(math_pow(0.0, 3), 0.0) && same(math_pow(-0.0, 3), -0.0));
	CHECK(same(math_pow(-0.0, 2), 0.0) && same(math_pow(-0.0, 0.5), 0.0));
	CHECK(same(math_pow(-1, inf), 1) && same(math_pow(-1, -inf), 1));
	CHECK(same(math_pow(1, NAN), 1) && same(math_pow(1, inf), 1));
	CHECK(same(math_pow(NAN, 0.0), 1) && same(math_pow(0.0, -0.0), 1));
	CHECK(same(math_pow(inf, -0.0), 1) && isnan(math_pow(NAN, 1)));
	CHECK(isnan(math_pow(-8, 1.0 / 3)) && isnan(math_pow(-1, 0.5)));
	CHECK(same(math_pow(0.5, -inf), inf) && same(math_pow(-0.5, inf), 0.0));
	CHECK(same(math_pow(-2, -inf), 0.0) && same(math_pow(2, inf), inf));
	CHECK(same(math_pow(-inf, -3), -0.0) && same(math_pow(-inf, -2), 0.0));
	CHECK(same(math_pow(-inf, 3), -inf) && same(math_pow(-inf, 2.5), inf));
	CHECK(same(math_pow(inf, -0.5), 0.0) && same(math_pow(inf, 0.5), inf));
	CHECK(same(math_pow(-2, 1e300), inf) && same(math_pow(-2, -1e300), 0.0));
	CHECK(same(math_pow(-2, 1025), -inf) && same(math_pow(-2, -1077), -0.0));
	/* 2^53 + 1 is odd, but no double. */
	CHECK(same(math_pow_integer(-1, false, ((uint64_t)1 << 53) + 1), -1));
	CHECK(same(math_pow_integer(-1, true, UINT64_MAX), -1));
	CHECK(same(math_pow_integer(-0.0, true, 3), -inf));
	CHECK(same(math_pow_integer(NAN, false, 0), 1));
	CHECK(same(math_pow_integer(-3, true, 2), math_pow(9, -1)));
}

/* C11 F.10.1.4. */
static void test_special_atan2(void)
{
	const double inf = INFINITY, pi = 0x1.921fb54442d18p+1;

	CHECK(same(math_atan2(0.0, -0.0), pi) && same(math_atan2(-0.0, -0.0), -pi));
	CHECK(same(math_atan2(0.0, 0.0), 0.0) && same(math_atan2(-0.0, 0.0), -0.0));
	CHECK(same(math_atan2(0.0, -5), pi) && same(math_atan2(-0.0, -5), -pi));
	CHECK(same(math_atan2(0.0, 5), 0.0) && same(math_atan2(-0.0, 5), -0.0));
	CHECK(same(math_atan2(-5, 0.0), -pi / 2) && same(math_atan2(-5, -0.0), -pi / 2));
	CHECK(same(math_atan2(5, 0.0), pi / 2) && same(math_atan2(5, -0.0), pi / 2));
	CHECK(same(math_atan2(5, -inf), pi) && same(math_atan2(-5, -inf), -pi));
	CHECK(same(math_atan2(5, inf), 0.0) && same(math_atan2(-5, inf), -0.0));
	CHECK(same(math_atan2(inf, 5), pi / 2) && same(math_atan2(-inf, -5), -pi / 2));
	CHECK(same(math_atan2(inf, -inf), 0x1.2d97c7f3321d2p+1));
	CHECK(same(math_atan2(-inf, -inf), -0x1.2d97c7f3321d2p+1));
	CHECK(same(math_atan2(inf, inf), pi / 4) && same(math_atan2(-inf, inf), -pi / 4));
	CHECK(same(math_atan2(1, 1), pi / 4) && same(math_atan2(1, -1), 3 * pi / 4));
	CHECK(same(math_atan2(5e-324, 1), 5e-324) && same(math_atan2(5e-324, 4), 0.0));
	CHECK(isnan(math_atan2(NAN, 0)) && isnan(math_atan2(0, NAN)));
}

/* ---- neighbours ---- */

static double square(double x)
{
	return math_pow(x, 2.0);
}

static double root(double x)
{
	return math_pow(x, 0.5);
}

/* @rises is 1, or -1 for functions that fall; |x| from 2^low, @count exponents. */
struct slope {
	const char *name;
	double (*function)(double x);
	int rises, low;
	uint64_t count;
	bool positive;
};
static const struct slope slopes[] = {
	{ "exp", math_exp, 1, -60, 69, false },
	{ "log", math_log, 1, -1000, 2000, true },
	{ "log near 1", math_log, 1, -2, 4, true },
	{ "log10", math_log10, 1, -4, 12, true },
	{ "sin", math_sin, 1, -60, 60, false },
	{ "tan", math_tan, 1, -60, 60, false },
	{ "cos", math_cos, -1, -30, 31, true },
	{ "asin", math_asin, 1, -60, 60, false },
	{ "acos", math_acos, -1, -60, 60, false },
	{ "atan", math_atan, 1, -60, 120, false },
	{ "pow(x, 2)", square, 1, -500, 1000, true },
	{ "pow(x, 0.5)", root, 1, -500, 1000, true },
};

static void test_neighbours(void)
{
	state = 3;
	for (size_t i = 0; i < sizeof(slopes) / sizeof(slopes[0]); i++) {
		const struct slope *s = &slopes[i];
		int wrong = 0;

		for (int k = 0; k < 400; k++) {
			double x = random_double(s->low, s->count);
			double before;

			x = s->positive ? fabs(x) : x;
			before = s->function(x);
			for (int n = 0; n < 16; n++) {
				double now = s->function(x = after(x));

				wrong += s->rises * (now - before) < 0;
				before = now;
			}
		}
		CHECK_AS(wrong == 0, s->name);
	}
}

/* ---- the same on every processor ---- */

static uint64_t mixed(uint64_t sum, double x)
{
	sum = (sum ^ bits_of(x)) * UINT64_C(0x9fb21c651e98df25);
	return sum ^ sum >> 29;
}

/* What it is on x86-64, and so on arm64, armhf, Cortex-M3 and RISC-V. */
#define SUM UINT64_C(0xdd787f3457c707f7)

static void test_sum(void)
{
	uint64_t sum = 0;

	state = 4;
	for (int k = 0; k < 1000000 / (int)FUNCTIONS; k++) {
		/* In turn: numbers of usual size, of all sizes, near 1. */
		int low = k % 3 == 0 ? -8 : k % 3 == 1 ? -1022 : -2;
		uint64_t count = k % 3 == 0 ? 16 : k % 3 == 1 ? 2046 : 2;

		for (size_t i = 0; i < FUNCTIONS; i++) {
			double x = random_double(low, count);
			double y = random_double(low, count);

			sum = mixed(sum, call(&functions[i], x, y));
		}
	}
	printf("# sum of a million results: %016" PRIx64 "\n", sum);
	CHECK_AS(sum == SUM,
		 "a million results have the same bits as on every other processor");
}

int main(int argc, char **argv)
{
	test_points(argc > 1 ? argv[1] : "tests/math/points.txt");
	test_exact();
	test_signs();
	test_special();
	test_special_pow();
	test_special_atan2();
	test_neighbours();
	test_sum();
	return tap_done();
}
