/* SPDX-License-Identifier: MIT
 *
 * test_fn_real - SQRT to ATAN2 and EXPT as the VM calls them: domains, NaN, infinity,
 * rounding to REAL, exponents of every type. The functions themselves: test_math.
 */
#include "engine/scan/vm.h"
#include "tests/tap.h"

#include <math.h>

typedef enum fn_status (*fn)(struct fn_args *);

#define UNCHANGED 4711.0

static bool gives(fn f, enum iec_type type, double x, double y,
		  enum fn_status status, double out)
{
	struct fn_args args = { .type = type, .result = type, .count = 2,
		.in_type = { type, type }, .in = { { .r = x }, { .r = y } },
		.out = { .r = UNCHANGED } };

	if (f(&args) == status && args.out.r == out)
		return true;
	printf("# %a, %a: %a\n", x, y, args.out.r);
	return false;
}

static bool fails(fn f, double x, double y)
{
	return gives(f, IEC_REAL, x, y, FN_FAILED, UNCHANGED) &&
	       gives(f, IEC_LREAL, x, y, FN_FAILED, UNCHANGED);
}

static bool works(fn f, double x, double y, double out)
{
	return gives(f, IEC_REAL, x, y, FN_OK, (double)(float)out) &&
	       gives(f, IEC_LREAL, x, y, FN_OK, out);
}

static bool power(double x, enum iec_type type, int64_t n, enum fn_status status,
		  double out)
{
	struct fn_args args = { .type = IEC_LREAL, .result = IEC_LREAL, .count = 2,
		.in_type = { IEC_LREAL, type }, .in = { { .r = x }, { .i = n } },
		.out = { .r = UNCHANGED } };

	return fn_EXPT(&args) == status && args.out.r == out;
}

static void test_domains(void)
{
	const fn all[] = { fn_SQRT, fn_LN, fn_LOG, fn_EXP, fn_EXPT, fn_SIN, fn_COS,
			   fn_TAN, fn_ASIN, fn_ACOS, fn_ATAN, fn_ATAN2 };

	for (size_t i = 0; i < sizeof(all) / sizeof(all[0]); i++)
		CHECK_AS(fails(all[i], NAN, 2) && fails(all[i], -NAN, 2), "NaN fails");
	CHECK(fails(fn_EXPT, 2, NAN) && fails(fn_ATAN2, 2, NAN));
	CHECK(fails(fn_SQRT, -1e-40, 0) && fails(fn_SQRT, INFINITY, 0));
	CHECK(fails(fn_LN, 0, 0) && fails(fn_LN, -0.0, 0) && fails(fn_LN, -1, 0));
	CHECK(fails(fn_LOG, 0, 0) && fails(fn_LOG, -INFINITY, 0) && fails(fn_LN, INFINITY, 0));
	CHECK(fails(fn_EXP, 710, 0) && fails(fn_EXP, INFINITY, 0));
	CHECK(fails(fn_SIN, INFINITY, 0) && fails(fn_COS, INFINITY, 0));
	CHECK(fails(fn_TAN, -INFINITY, 0) && fails(fn_ASIN, 1.5, 0) && fails(fn_ACOS, -1.5, 0));
	CHECK(fails(fn_EXPT, 0, -1) && fails(fn_EXPT, -2, 0.5) && fails(fn_EXPT, 1e30, 30));
	CHECK(gives(fn_EXP, IEC_REAL, 89, 0, FN_FAILED, UNCHANGED));
	CHECK(gives(fn_EXP, IEC_LREAL, 1, 0, FN_OK, 0x1.5bf0a8b145769p+1));
	CHECK(gives(fn_EXP, IEC_REAL, 1, 0, FN_OK, (double)0x1.5bf0a8b145769p+1f));
}

static void test_values(void)
{
	CHECK(works(fn_SQRT, 2, 0, 0x1.6a09e667f3bcdp+0) && works(fn_SQRT, 0, 0, 0));
	CHECK(works(fn_LN, 1, 0, 0) && works(fn_LOG, 1000, 0, 3));
	CHECK(works(fn_EXP, 0, 0, 1) && works(fn_EXP, -1000, 0, 0));
	CHECK(works(fn_SIN, 0, 0, 0) && works(fn_COS, 0, 0, 1) && works(fn_TAN, 0, 0, 0));
	CHECK(works(fn_ASIN, 1, 0, 0x1.921fb54442d18p+0) && works(fn_ACOS, 1, 0, 0));
	CHECK(works(fn_ATAN, INFINITY, 0, 0x1.921fb54442d18p+0));
	CHECK(works(fn_ATAN2, 1, -1, 0x1.2d97c7f3321d2p+1) && works(fn_ATAN2, 0, 0, 0));
	CHECK(works(fn_EXPT, -2, 3, -8) && works(fn_EXPT, 0, 0, 1));
	CHECK(works(fn_EXPT, 4, 0.5, 2));
}

static void test_exponents(void)
{
	CHECK(power(-2, IEC_SINT, -3, FN_OK, -0.125) && power(2, IEC_USINT, 200, FN_OK, 0x1p200));
	CHECK(power(-1, IEC_LINT, INT64_MIN, FN_OK, 1));
	CHECK(power(-1, IEC_LINT, INT64_MAX, FN_OK, -1));
	CHECK(power(-1, IEC_ULINT, -1, FN_OK, -1)); /* 2^64 - 1: odd and large */
	CHECK(power(2, IEC_ULINT, -1, FN_FAILED, UNCHANGED));
	CHECK(power(2, IEC_LINT, INT64_MIN, FN_OK, 0));
	CHECK(power(0, IEC_LINT, -1, FN_FAILED, UNCHANGED) && power(0, IEC_INT, 0, FN_OK, 1));
}

int main(void)
{
	test_domains();
	test_values();
	test_exponents();
	return tap_done();
}
