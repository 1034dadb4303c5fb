/* SPDX-License-Identifier: MIT
 *
 * test_fn_convert - every pair of types at the ends of both, against independent rules;
 * roundings, bits and digits by hand.
 */
#include "engine/scan/vm.h"
#include "tests/tap.h"

#include <math.h>

static struct fn_args args;

typedef enum fn_status (*fn)(struct fn_args *);

static enum fn_status run(fn f, enum iec_type from, enum iec_type to,
			  union iec_value in)
{
	args = (struct fn_args){ .type = from, .result = to, .count = 1,
		.in = { in }, .in_type = { from }, .out = { .i = 4711 } };
	return f(&args);
}

static bool whole(fn f, enum iec_type from, enum iec_type to, int64_t in,
		  enum fn_status status, int64_t out)
{
	if (run(f, from, to, (union iec_value){ .i = in }) == status &&
	    args.out.i == out)
		return true;
	printf("# %s to %s: %lld gave %lld\n", iec_type_row(from)->word,
	       iec_type_row(to)->word, (long long)in, (long long)args.out.i);
	return false;
}

static bool rounds(fn f, enum iec_type to, double in, enum fn_status status,
		   int64_t out)
{
	if (run(f, IEC_LREAL, to, (union iec_value){ .r = in }) == status &&
	    args.out.i == out)
		return true;
	printf("# %.17g to %s gave %lld\n", in, iec_type_row(to)->word,
	       (long long)args.out.i);
	return false;
}

#define OK     FN_OK
#define WRAPS  FN_WRAPPED
#define FAILS  FN_FAILED
#define UNCHANGED 4711

/* ---- whole numbers and bits ---- */

static uint16_t class_of(enum iec_type type)
{
	return iec_type_row(type)->class;
}

static unsigned bits_of(enum iec_type type)
{
	return type == IEC_BOOL ? 1 : iec_type_row(type)->size * 8u;
}

static uint64_t mask_of(enum iec_type type)
{
	return UINT64_MAX >> (64 - bits_of(type));
}

static bool has_sign(enum iec_type type)
{
	return class_of(type) & CLASS_SIGNED;
}

/* A number of 65 bits: the bits of the union, and its sign. */
struct number { uint64_t u; bool minus; };

static bool is_in(enum iec_type type, struct number in)
{
	uint64_t half = mask_of(type) / 2; /* of a signed one the largest */

	if (in.minus)
		return has_sign(type) && ~in.u <= half;
	return in.u <= (has_sign(type) ? half : mask_of(type));
}

static bool converts(enum iec_type from, enum iec_type to, struct number in)
{
	bool bits = (class_of(from) | class_of(to)) & ANY_BIT;
	struct number out;
	int64_t held = (int64_t)in.u;

	if (to == IEC_BOOL)
		return whole(fn_CONVERT, from, to, held, OK, held != 0);
	if (bits) /* filled with 0, not with signs */
		in = (struct number){ in.u & mask_of(from), false };
	out.u = in.u & mask_of(to);
	out.minus = has_sign(to) && out.u > mask_of(to) / 2;
	if (out.minus)
		out.u |= ~mask_of(to);
	return whole(fn_CONVERT, from, to, held, bits || (out.u == in.u &&
		     out.minus == in.minus) ? OK : WRAPS, (int64_t)out.u);
}

static bool is_whole(enum iec_type type)
{
	return class_of(type) & (ANY_INT | ANY_BIT);
}

static void test_whole(enum iec_type from, enum iec_type to)
{
	char what[64];
	bool good = true;

	for (int i = IEC_NONE + 1; i < IEC_TYPE_COUNT; i++) {
		enum iec_type end = (enum iec_type)i;
		uint64_t half = mask_of(end) / 2;

		if (!is_whole(end))
			continue;
		for (uint64_t step = 0; step < 3; step++) {
			struct number low = { (has_sign(end) ? ~half : 0) + step - 1,
					      true };
			struct number high = { (has_sign(end) ? half : mask_of(end)) +
					       step - 1, false };

			low.minus = (int64_t)low.u < 0;
			if (is_in(from, low))
				good &= converts(from, to, low);
			if (is_in(from, high))
				good &= converts(from, to, high);
		}
	}
	snprintf(what, sizeof(what),
		"%s to %s at the limits of both types", iec_type_row(from)->word,
		 iec_type_row(to)->word);
	CHECK_AS(good, what);
}

/* ---- REAL ---- */

static void test_rounding(void)
{
	static const struct {
		double in;
		int64_t nearest, down, up, cut;
	} rows[] = {
		{ 0.5, 0, 0, 1, 0 }, { 1.5, 2, 1, 2, 1 }, { 2.5, 2, 2, 3, 2 },
		{ -0.5, 0, -1, 0, 0 }, { -1.5, -2, -2, -1, -1 }, { -2.5, -2, -3, -2, -2 },
		{ 0.49999999999999994, 0, 0, 1, 0 }, { -3.7, -4, -4, -3, -3 },
		{ 4503599627370495.5, 4503599627370496, 4503599627370495,
		  4503599627370496, 4503599627370495 },
		{ 9007199254740993.0, 9007199254740992, 9007199254740992,
		  9007199254740992, 9007199254740992 },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(*rows); i++) {
		CHECK(rounds(fn_ROUND, IEC_LINT, rows[i].in, OK, rows[i].nearest));
		CHECK(rounds(fn_CONVERT, IEC_LINT, rows[i].in, OK, rows[i].nearest));
		CHECK(rounds(fn_FLOOR, IEC_LINT, rows[i].in, OK, rows[i].down));
		CHECK(rounds(fn_CEIL, IEC_LINT, rows[i].in, OK, rows[i].up));
		CHECK(rounds(fn_TRUNC, IEC_LINT, rows[i].in, OK, rows[i].cut));
	}
	CHECK(run(fn_FLOOR, IEC_LREAL, IEC_LREAL, (union iec_value){ .r = -1e300 }) == OK &&
	      args.out.r == -1e300);
	CHECK(run(fn_CEIL, IEC_REAL, IEC_REAL, (union iec_value){ .r = 2.25 }) == OK &&
	      args.out.r == 3);
}

static void test_range(void)
{
	const double two63 = 9223372036854775808.0, two64 = 2 * two63;

	CHECK(rounds(fn_CONVERT, IEC_LINT, two63, FAILS, UNCHANGED));
	CHECK(rounds(fn_CONVERT, IEC_LINT, -two63, OK, INT64_MIN));
	CHECK(rounds(fn_CONVERT, IEC_LINT, -two63 * (1 + 1e-15), FAILS, UNCHANGED));
	CHECK(rounds(fn_CONVERT, IEC_ULINT, two63, OK, INT64_MIN));
	CHECK(rounds(fn_CONVERT, IEC_ULINT, two64, FAILS, UNCHANGED));
	CHECK(rounds(fn_CONVERT, IEC_ULINT, two64 - 2048, OK, -2048));
	CHECK(rounds(fn_CONVERT, IEC_ULINT, -0.5, OK, 0));
	CHECK(rounds(fn_CONVERT, IEC_ULINT, -0.6, FAILS, UNCHANGED));
	CHECK(rounds(fn_CONVERT, IEC_INT, 32767.5, FAILS, UNCHANGED));
	CHECK(rounds(fn_TRUNC, IEC_INT, 32767.9, OK, 32767));
	CHECK(rounds(fn_CONVERT, IEC_WORD, 65535, OK, 65535));
	CHECK(rounds(fn_CONVERT, IEC_INT, (double)NAN, FAILS, UNCHANGED));
	CHECK(rounds(fn_CONVERT, IEC_INT, (double)INFINITY, FAILS, UNCHANGED));
	CHECK(run(fn_CONVERT, IEC_LREAL, IEC_BOOL, (union iec_value){ .r = (double)NAN }) ==
	      FAILS);
	CHECK(rounds(fn_CONVERT, IEC_BOOL, -0.5, OK, 1) &&
	      rounds(fn_CONVERT, IEC_BOOL, -0.0, OK, 0));
	CHECK(run(fn_CONVERT, IEC_LREAL, IEC_REAL, (union iec_value){ .r = 1e39 }) == FAILS);
	CHECK(run(fn_CONVERT, IEC_LREAL, IEC_REAL, (union iec_value){ .r = 0.1 }) == OK &&
	      args.out.r == (double)0.1f);
	/* Rounded once: by way of a double the result would be the lower neighbour. */
	CHECK(run(fn_CONVERT, IEC_LINT, IEC_REAL,
		  (union iec_value){ .i = INT64_C(9007199791611905) }) == OK &&
	      args.out.r == 9007200328482816.0);
	CHECK(run(fn_CONVERT, IEC_ULINT, IEC_LREAL, (union iec_value){ .i = -1 }) == OK &&
	      args.out.r == two64);
	CHECK(whole(fn_CONVERT, IEC_DWORD, IEC_LREAL, 0, OK, 0));
}

static void test_same_bits(void)
{
	CHECK(run(fn_CONVERT, IEC_REAL, IEC_DWORD, (union iec_value){ .r = 1.5 }) == OK &&
	      args.out.i == 0x3fc00000);
	CHECK(run(fn_CONVERT, IEC_DWORD, IEC_REAL,
		  (union iec_value){ .i = 0x7f800000 }) == OK && isinf(args.out.r));
	CHECK(run(fn_CONVERT, IEC_LREAL, IEC_LWORD, (union iec_value){ .r = -2 }) == OK &&
	      args.out.i == (int64_t)0xc000000000000000);
	CHECK(run(fn_CONVERT, IEC_WORD, IEC_REAL, (union iec_value){ .i = 65535 }) == OK &&
	      args.out.r == 65535);
}

/* ---- times, digits ---- */

static void test_times(void)
{
	const int64_t ms = 1000000, s = 1000 * ms, day = 86400 * s;

	CHECK(whole(fn_CONVERT, IEC_TIME, IEC_DINT, 1500 * ms, OK, 1500));
	CHECK(whole(fn_CONVERT, IEC_TIME, IEC_DINT, ms / 2, OK, 0) &&
	      whole(fn_CONVERT, IEC_TIME, IEC_DINT, ms * 3 / 2, OK, 2) &&
	      whole(fn_CONVERT, IEC_TIME, IEC_DINT, -ms / 2, OK, 0) &&
	      whole(fn_CONVERT, IEC_TIME, IEC_DINT, -ms / 2 - 1, OK, -1));
	CHECK(whole(fn_CONVERT, IEC_TIME, IEC_LINT, INT64_MIN, OK, -9223372036855));
	CHECK(whole(fn_CONVERT, IEC_TIME, IEC_INT, 40 * s, WRAPS, 40000 - 65536));
	CHECK(whole(fn_CONVERT, IEC_DINT, IEC_TIME, -7, OK, -7 * ms));
	CHECK(whole(fn_CONVERT, IEC_LINT, IEC_TIME, INT64_MAX, FAILS, UNCHANGED));
	CHECK(whole(fn_CONVERT, IEC_ULINT, IEC_TIME, -1, FAILS, UNCHANGED));
	CHECK(whole(fn_CONVERT, IEC_DINT, IEC_TIME_OF_DAY, 86399999, OK, day - ms));
	CHECK(whole(fn_CONVERT, IEC_DINT, IEC_TIME_OF_DAY, 86400000, FAILS, UNCHANGED));
	CHECK(whole(fn_CONVERT, IEC_DATE_AND_TIME, IEC_DATE, -1, OK, -day) &&
	      whole(fn_CONVERT, IEC_DATE_AND_TIME, IEC_TIME_OF_DAY, -1, OK, day - 1));
	CHECK(whole(fn_CONVERT, IEC_DATE_AND_TIME, IEC_DATE, INT64_MIN, FAILS, UNCHANGED));
	CHECK(whole(fn_CONVERT, IEC_DATE_AND_TIME, IEC_DINT, day, OK, 86400));
	CHECK(whole(fn_CONVERT, IEC_DATE, IEC_TIME_OF_DAY, 0, FAILS, UNCHANGED));
	CHECK(whole(fn_CONVERT_NS, IEC_TIME, IEC_LINT, 5, OK, 5) &&
	      whole(fn_CONVERT_NS, IEC_SINT, IEC_TIME, -5, OK, -5));
	CHECK(run(fn_CONVERT_NS, IEC_ULINT, IEC_TIME, (union iec_value){ .i = -1 }) == FAILS);
}

static void test_digits(void)
{
	CHECK(whole(fn_FROM_BCD, IEC_WORD, IEC_UINT, 0x1234, OK, 1234));
	CHECK(whole(fn_FROM_BCD, IEC_WORD, IEC_UINT, 0x123a, FAILS, UNCHANGED));
	CHECK(run(fn_FROM_BCD, IEC_WORD, IEC_SINT, (union iec_value){ .i = 0x0128 }) == FAILS);
	CHECK(whole(fn_FROM_BCD, IEC_LWORD, IEC_LINT, (int64_t)0x9999999999999999, OK,
		    INT64_C(9999999999999999)));
	CHECK(whole(fn_TO_BCD, IEC_UINT, IEC_WORD, 9999, OK, 0x9999));
	CHECK(run(fn_TO_BCD, IEC_UINT, IEC_WORD, (union iec_value){ .i = 10000 }) == FAILS);
	CHECK(run(fn_TO_BCD, IEC_INT, IEC_WORD, (union iec_value){ .i = -1 }) == FAILS);
	CHECK(run(fn_TO_BCD, IEC_ULINT, IEC_LWORD, (union iec_value){ .i = -1 }) == FAILS);
}

int main(void)
{
	for (int from = IEC_NONE + 1; from < IEC_TYPE_COUNT; from++)
		for (int to = IEC_NONE + 1; to < IEC_TYPE_COUNT; to++)
			if (is_whole((enum iec_type)from) && is_whole((enum iec_type)to))
				test_whole((enum iec_type)from, (enum iec_type)to);
	test_rounding();
	test_range();
	test_same_bits();
	test_times();
	test_digits();
	return tap_done();
}
