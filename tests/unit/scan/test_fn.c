/* SPDX-License-Identifier: MIT
 *
 * test_fn - every function at the limits of every type: wrapped, failed and exact
 * results.
 */
#include "engine/scan/vm.h"
#include "tests/tap.h"

#include <math.h>

static struct fn_args args;

typedef enum fn_status (*fn)(struct fn_args *);

/* Runs @f and checks status and result. */
static bool gives(fn f, enum iec_type type, int64_t a, int64_t b,
		  enum fn_status status, int64_t out)
{
	args = (struct fn_args){ .type = type, .count = 2,
		.in = { { .i = a }, { .i = b } }, .out = { .i = 4711 } };
	if (f(&args) == status && args.out.i == out)
		return true;
	printf("# %s: %lld, %lld gave %lld\n", iec_type_row(type)->word,
	       (long long)a, (long long)b, (long long)args.out.i);
	return false;
}

static bool real(fn f, double a, double b, enum fn_status status, double out)
{
	args = (struct fn_args){ .type = IEC_REAL, .count = 2,
		.in = { { .r = a }, { .r = b } }, .out = { .r = 4711 } };
	return f(&args) == status && args.out.r == out;
}

#define OK     FN_OK
#define WRAPS  FN_WRAPPED
#define FAILS  FN_FAILED
#define UNCHANGED 4711

static bool is_integer(enum iec_type type)
{
	return iec_type_row(type)->class & (ANY_INT | CLASS_TIME);
}

/* Tests for every integer type, and for TIME. */
static void keeps_to_its_type(enum iec_type type)
{
	const struct iec_type_row *row = iec_type_row(type);
	int64_t low = row->low, high = row->high;

	CHECK_AS(gives(fn_ADD, type, high, 0, OK, high), row->word);
	CHECK(gives(fn_ADD, type, high, 1, WRAPS, low));
	CHECK(gives(fn_ADD, type, low, high, OK, low ? -1 : high));
	CHECK(gives(fn_SUB, type, low, 1, WRAPS, high));
	CHECK(gives(fn_SUB, type, high, high, OK, 0));
	CHECK(gives(fn_SUB, type, low, low, OK, 0));
	CHECK(gives(fn_MOVE, type, low, 0, OK, low));
	CHECK(gives(fn_GT, type, high, low, OK, 1) &&
	      gives(fn_LT, type, high, low, OK, 0));
	CHECK(gives(fn_GE, type, low, low, OK, 1) &&
	      gives(fn_LE, type, high, low, OK, 0));
	CHECK(gives(fn_EQ, type, high, high, OK, 1) &&
	      gives(fn_NE, type, high, low, OK, 1));
}

static void multiplies_and_divides(enum iec_type type)
{
	const struct iec_type_row *row = iec_type_row(type);
	int64_t low = row->low, high = row->high;

	CHECK_AS(gives(fn_MUL, type, high, 1, OK, high), row->word);
	CHECK(gives(fn_MUL, type, high, 2, WRAPS, low ? -2 : high - 1));
	CHECK(gives(fn_MUL, type, high, high, WRAPS, 1));
	CHECK(gives(fn_MUL, type, 0, high, OK, 0));
	CHECK(gives(fn_DIV, type, high, 0, FAILS, UNCHANGED));
	CHECK(gives(fn_MOD, type, high, 0, FAILS, UNCHANGED));
	CHECK(gives(fn_DIV, type, 0, 0, FAILS, UNCHANGED));
	CHECK(gives(fn_DIV, type, high, high, OK, 1));
	CHECK(gives(fn_MOD, type, high, high, OK, 0));
	CHECK(gives(fn_DIV, type, 7, 2, OK, 3) && gives(fn_MOD, type, 7, 2, OK, 1));
	if (!low)
		return;
	CHECK(gives(fn_MUL, type, low, -1, WRAPS, low));
	CHECK(gives(fn_DIV, type, low, -1, FAILS, UNCHANGED));
	CHECK(gives(fn_MOD, type, low, -1, OK, 0));
	CHECK(gives(fn_DIV, type, low, 1, OK, low));
	CHECK(gives(fn_DIV, type, -7, 2, OK, -3));
	CHECK(gives(fn_MOD, type, -7, 2, OK, -1));
	CHECK(gives(fn_MOD, type, 7, -2, OK, 1));
}

static void chains_inputs(void)
{
	const int64_t in[] = { 100, 27, -1, 1, 1, -100, 0, 5 };

	args = (struct fn_args){ .type = IEC_SINT, .count = 8 };
	for (int i = 0; i < 8; i++)
		args.in[i].i = in[i];
	CHECK_AS(fn_ADD(&args) == WRAPS && args.out.i == 33,
		 "ADD reports a wrap of a partial sum");
	args.count = 3;
	CHECK(fn_ADD(&args) == OK && args.out.i == 126);
	args.in[0].i = 64, args.in[1].i = 4, args.in[2].i = 0;
	CHECK(fn_MUL(&args) == WRAPS && args.out.i == 0);
	args.type = IEC_REAL;
	args.count = 4;
	for (int i = 0; i < 4; i++)
		args.in[i].r = 0.1f;
	CHECK(fn_ADD(&args) == OK && args.out.r == (double)(0.1f + 0.1f + 0.1f + 0.1f));
	CHECK(fn_MUL(&args) == OK && args.out.r > 0.99e-4 && args.out.r < 1.01e-4);
}

static void computes_reals(void)
{
	const double most = 3.4028234663852886e38;

	CHECK(real(fn_ADD, 1.5, 2.25, OK, 3.75) && real(fn_SUB, 1.5, 2.25, OK, -0.75));
	CHECK(real(fn_MUL, 1.5, -2, OK, -3) && real(fn_DIV, 1, 4, OK, 0.25));
	CHECK(real(fn_ADD, most, most, FAILS, UNCHANGED));
	CHECK(real(fn_SUB, -most, most, FAILS, UNCHANGED));
	CHECK(real(fn_MUL, most, 2, FAILS, UNCHANGED));
	CHECK(real(fn_DIV, most, 0.25, FAILS, UNCHANGED));
	CHECK(real(fn_DIV, 1, 0, FAILS, UNCHANGED));
	CHECK(real(fn_DIV, 0, 0, FAILS, UNCHANGED));
	CHECK(real(fn_DIV, 1, -0.0, FAILS, UNCHANGED));
	CHECK(real(fn_ADD, INFINITY, 1, FAILS, UNCHANGED));
	CHECK(real(fn_SUB, INFINITY, INFINITY, FAILS, UNCHANGED));
	CHECK(real(fn_MUL, NAN, 0, FAILS, UNCHANGED));
	CHECK(real(fn_DIV, 1, INFINITY, OK, 0));
	CHECK(real(fn_ADD, most, 1, OK, most));
	CHECK(real(fn_MUL, 1e-30f, 1e-30f, OK, 0));
	CHECK_AS(real(fn_ADD, 16777216, 1, OK, 16777216),
		 "a sum of REAL is rounded to 24 bits");
	CHECK(real(fn_MOVE, most, 0, OK, most));
}

static int64_t compared(fn f, double a, double b)
{
	args = (struct fn_args){ .type = IEC_REAL, .count = 2,
				 .in = { { .r = a }, { .r = b } } };
	return f(&args) == FN_OK ? args.out.i : -1;
}

static void compares_reals(void)
{
	CHECK(compared(fn_GT, 0.2, 0.1) == 1 && compared(fn_LT, -1, -2) == 0);
	CHECK(compared(fn_EQ, 0.0, -0.0) == 1 && compared(fn_NE, 0.5, 0.5) == 0);
	CHECK(compared(fn_GE, INFINITY, 3e38) == 1);
	CHECK(compared(fn_EQ, NAN, NAN) == 0 && compared(fn_NE, NAN, NAN) == 1);
	CHECK(compared(fn_LE, NAN, 0) == 0 && compared(fn_GE, NAN, 0) == 0);
	CHECK(compared(fn_GT, NAN, 0) == 0 && compared(fn_LT, NAN, 0) == 0);
}

/* Products of UDINT may exceed 64 signed bits: their low 32 bits are still right. */
static void multiplies_beyond_64_bits(void)
{
	CHECK(gives(fn_MUL, IEC_UDINT, UINT32_MAX, UINT32_MAX, WRAPS, 1));
	CHECK(gives(fn_MUL, IEC_UDINT, UINT32_MAX, 0x80000001, WRAPS, 0x7fffffff));
	CHECK(gives(fn_ADD, IEC_TIME, INT64_MAX, INT64_MAX, WRAPS, -2));
	CHECK(gives(fn_SUB, IEC_TIME, INT64_MIN, INT64_MAX, WRAPS, 1));
	CHECK(gives(fn_SUB, IEC_TIME, 0, INT64_MIN, WRAPS, INT64_MIN));
}

static void unsigned_64_bits(void)
{
	const int64_t high = -1, top = INT64_MIN; /* 2^64 - 1 and 2^63 as bits */

	CHECK(gives(fn_ADD, IEC_ULINT, INT64_MAX, 1, OK, top));
	CHECK(gives(fn_ADD, IEC_ULINT, high, 1, WRAPS, 0));
	CHECK(gives(fn_SUB, IEC_ULINT, 0, 1, WRAPS, high));
	CHECK(gives(fn_SUB, IEC_ULINT, high, top, OK, INT64_MAX));
	CHECK(gives(fn_MUL, IEC_ULINT, top, 1, OK, top));
	CHECK(gives(fn_MUL, IEC_ULINT, top, 2, WRAPS, 0));
	CHECK(gives(fn_DIV, IEC_ULINT, high, 2, OK, INT64_MAX));
	CHECK(gives(fn_DIV, IEC_ULINT, top, high, OK, 0));
	CHECK(gives(fn_DIV, IEC_ULINT, top, 0, FAILS, UNCHANGED));
	CHECK(gives(fn_MOD, IEC_ULINT, high, 10, OK, 5));
	CHECK(gives(fn_MOD, IEC_ULINT, high, high, OK, 0));
	CHECK(gives(fn_GT, IEC_ULINT, high, 1, OK, 1));
	CHECK(gives(fn_LT, IEC_LWORD, 1, top, OK, 1));
	CHECK(gives(fn_DIV, IEC_LINT, INT64_MIN, -1, FAILS, UNCHANGED));
	CHECK(gives(fn_ADD, IEC_LINT, INT64_MAX, 1, WRAPS, INT64_MIN));
}

int main(void)
{
	for (int type = IEC_NONE + 1; type < IEC_TYPE_COUNT; type++) {
		if (iec_is_wide((enum iec_type)type))
			continue;
		if (is_integer((enum iec_type)type))
			keeps_to_its_type((enum iec_type)type);
		if (iec_type_row((enum iec_type)type)->class & ANY_INT)
			multiplies_and_divides((enum iec_type)type);
	}
	CHECK(gives(fn_MOVE, IEC_BOOL, 1, 0, OK, 1));
	CHECK(gives(fn_EQ, IEC_BOOL, 1, 1, OK, 1) && gives(fn_GT, IEC_BOOL, 1, 0, OK, 1));
	CHECK(gives(fn_MOVE, IEC_DWORD, UINT32_MAX, 0, OK, UINT32_MAX));
	CHECK(gives(fn_GT, IEC_DWORD, UINT32_MAX, 0, OK, 1));
	chains_inputs();
	computes_reals();
	compares_reals();
	multiplies_beyond_64_bits();
	unsigned_64_bits();
	return tap_done();
}
