/* SPDX-License-Identifier: MIT
 *
 * value - the walker's own arithmetic: widening, wrapping, failing.
 *
 * docs/language.md, "Arithmetic". No rungs here.
 */
#include "tests/walker/inside.h"

#include <math.h>
#include <string.h>

struct value value_bool(bool level)
{
	return (struct value){ .type = IEC_BOOL, .i = level };
}

bool value_is_true(struct value value)
{
	return value.i != 0;
}

static bool widens(enum iec_type from, enum iec_type to)
{
	static const char *const chain[] = {
		/* each type and those it widens to */
		"SINT INT DINT LINT", "USINT UINT UDINT ULINT",
		"BYTE WORD DWORD LWORD", "USINT INT DINT LINT", "UINT DINT LINT",
		"UDINT LINT", "SINT REAL LREAL", "INT REAL LREAL",
		"USINT REAL LREAL", "UINT REAL LREAL", "DINT LREAL", "UDINT LREAL",
	};
	const char *a = iec_type_row(from)->word, *b = iec_type_row(to)->word;

	if (from == to)
		return true;
	for (size_t i = 0; i < sizeof(chain) / sizeof(*chain); i++) {
		const char *at = chain[i];
		bool seen = false;

		while (*at) {
			size_t n = 0;

			while (at[n] && at[n] != ' ')
				n++;
			if (seen && strlen(b) == n && !strncmp(at, b, n))
				return true;
			if (strlen(a) == n && !strncmp(at, a, n))
				seen = true;
			at += at[n] ? n + 1 : n;
		}
	}
	return false;
}

enum iec_type wide_type(const enum iec_type *type, int count)
{
	for (int i = 0; i < count; i++) {
		bool all = type[i] != IEC_NONE;

		for (int j = 0; j < count && all; j++)
			all = type[j] == IEC_NONE || widens(type[j], type[i]);
		if (all)
			return type[i];
	}
	return IEC_NONE;
}

struct value value_widen(struct value value, enum iec_type type)
{
	if (type == IEC_REAL && value.type != IEC_REAL)
		value.r = (float)value.i;
	if (type == IEC_LREAL && value.type != IEC_LREAL)
		value.d = value.type == IEC_REAL ? (double)value.r : (double)value.i;
	value.type = type;
	return value;
}

/* The low bits of @i as a value of the type. */
static int64_t wrapped(int64_t i, enum iec_type type)
{
	switch (iec_type_row(type)->size) {
	case 1:
		return iec_type_row(type)->low < 0 ? (int8_t)i : (uint8_t)i;
	case 2:
		return iec_type_row(type)->low < 0 ? (int16_t)i : (uint16_t)i;
	case 4:
		return iec_type_row(type)->low < 0 ? (int64_t)(int32_t)i :
						     (int64_t)(uint32_t)i;
	default:
		return i;
	}
}

static enum outcome compute_lreal(enum word fn, double a, double b, double *out)
{
	volatile double c = 0;

	if (fn == FN_ADD)
		c = a + b;
	else if (fn == FN_SUB)
		c = a - b;
	else if (fn == FN_MUL)
		c = a * b;
	else if (fn == FN_DIV)
		c = a / b;
	else
		c = a;
	if (!isfinite(c))
		return OUTCOME_FAILED;
	*out = c;
	return OUTCOME_GOOD;
}

/* A double has more than twice the bits of a float, so rounding twice gives what rounding once
 * does. */
static enum outcome compute_real(enum word fn, float a, float b, float *out)
{
	double wide;
	const enum outcome outcome = compute_lreal(fn, (double)a, (double)b, &wide);
	volatile float c = outcome == OUTCOME_GOOD ? (float)wide : 0;

	if (outcome != OUTCOME_GOOD || !isfinite(c))
		return OUTCOME_FAILED;
	*out = c;
	return OUTCOME_GOOD;
}

/* ULINT: all 64 bits count. */
static enum outcome compute_unsigned(enum word fn, uint64_t a, uint64_t b, int64_t *out)
{
	uint64_t c = a;
	bool over = false;

	if ((fn == FN_DIV || fn == FN_MOD) && b == 0)
		return OUTCOME_FAILED;
	if (fn == FN_DIV) {
		c = a / b;
	} else if (fn == FN_MOD) {
		c = a % b;
	} else if (fn == FN_ADD) {
		c = a + b;
		over = c < a;
	} else if (fn == FN_SUB) {
		c = a - b;
		over = b > a;
	} else if (fn == FN_MUL) {
		c = a * b;
		over = a != 0 && c / a != b;
	}
	*out = (int64_t)c;
	return over ? OUTCOME_WRAPPED : OUTCOME_GOOD;
}

static bool is_unsigned_64(enum iec_type type)
{
	return type == IEC_ULINT || type == IEC_LWORD;
}

static enum outcome compute_whole(enum word fn, enum iec_type type, int64_t a,
				  int64_t b, int64_t *out)
{
	int64_t low = iec_type_row(type)->low, c;
	bool over = false;

	if (is_unsigned_64(type))
		return compute_unsigned(fn, (uint64_t)a, (uint64_t)b, out);
	if (fn == FN_DIV || fn == FN_MOD) {
		if (b == 0 || (fn == FN_DIV && b == -1 && a == low))
			return OUTCOME_FAILED;
		*out = b == -1 ? (fn == FN_DIV ? -a : 0) :
		       fn == FN_DIV ? a / b : a % b;
		return OUTCOME_GOOD;
	}
	if (fn == FN_ADD)
		over = __builtin_add_overflow(a, b, &c);
	else if (fn == FN_SUB)
		over = __builtin_sub_overflow(a, b, &c);
	else if (fn == FN_MUL)
		over = __builtin_mul_overflow(a, b, &c);
	else
		c = a;
	*out = wrapped(c, type);
	return over || *out != c ? OUTCOME_WRAPPED : OUTCOME_GOOD;
}

static bool related(enum word fn, int order)
{
	return fn == FN_GT ? order > 0 : fn == FN_GE ? order >= 0 :
	       fn == FN_EQ ? order == 0 : fn == FN_LE ? order <= 0 :
	       fn == FN_LT ? order < 0 : order != 0;
}

static int order_of(struct value a, struct value b)
{
	if (a.type == IEC_REAL)
		return a.r < b.r ? -1 : a.r > b.r;
	if (a.type == IEC_STRING)
		return text_order(a, b);
	if (a.type == IEC_LREAL)
		return a.d < b.d ? -1 : a.d > b.d;
	if (is_unsigned_64(a.type))
		return (uint64_t)a.i < (uint64_t)b.i ? -1 : a.i != b.i;
	return a.i < b.i ? -1 : a.i > b.i;
}

bool value_is_logic(enum word fn)
{
	return fn == FN_AND || fn == FN_OR || fn == FN_XOR || fn == FN_NOT;
}

/* Bit by bit, from the lowest on. */
static struct value logic(enum word fn, const struct value *in, int count)
{
	int bits = in[0].type == IEC_BOOL ? 1 : 8 * iec_type_row(in[0].type)->size;
	struct value out = { .type = in[0].type };

	for (int bit = 0; bit < bits; bit++) {
		int ones = 0;

		for (int i = 0; i < count; i++)
			ones += in[i].i >> bit & 1;
		if (fn == FN_AND ? ones == count : fn == FN_OR ? ones > 0 :
		    fn == FN_XOR ? ones % 2 : ones == 0)
			out.i |= (int64_t)((uint64_t)1 << bit);
	}
	return out;
}

static struct value choose(enum word fn, const struct value *in, int count)
{
	struct value best = in[0];

	for (int i = 1; i < count; i++)
		if (order_of(in[i], best) == (fn == FN_MIN ? -1 : 1))
			best = in[i];
	return best;
}

/* More than two inputs: the function of the first two, then of the result and the next;
 * a wrap anywhere wraps the whole. */
enum outcome value_compute(enum word fn, const struct value *in, int count,
			   struct value *out)
{
	enum outcome worst = OUTCOME_GOOD;
	struct value sum = in[0];

	if (word_is_test(word_row(fn))) {
		*out = value_bool(related(fn, order_of(in[0], in[1])));
		return OUTCOME_GOOD;
	}
	if (text_is_function(fn))
		return text_compute(fn, in, count, out);
	if (fn == FN_MOVE && in[0].type == IEC_STRING) {
		*out = in[0];
		return OUTCOME_GOOD;
	}
	if (value_is_logic(fn)) {
		*out = logic(fn, in, count);
		return OUTCOME_GOOD;
	}
	if (fn == FN_MIN || fn == FN_MAX) {
		*out = choose(fn, in, count);
		return OUTCOME_GOOD;
	}
	for (int i = 1; i < count || i == 1; i++) {
		struct value next = count > 1 ? in[i] : in[0];
		enum outcome now = sum.type == IEC_REAL ?
			compute_real(fn, sum.r, next.r, &sum.r) :
			sum.type == IEC_LREAL ?
			compute_lreal(fn, sum.d, next.d, &sum.d) :
			compute_whole(fn, sum.type, sum.i, next.i, &sum.i);

		if (now == OUTCOME_FAILED)
			return now;
		if (now == OUTCOME_WRAPPED)
			worst = now;
	}
	*out = sum;
	return worst;
}

#define DAY_NS INT64_C(86400000000000)

/* A time of day that wraps at midnight with an error. */
static enum outcome turn(int64_t clock, int64_t by, bool back, int64_t *out)
{
	int64_t whole = by / DAY_NS, part = by % DAY_NS;
	bool over = whole != 0;

	clock += back ? -part : part;
	if (clock < 0 || clock >= DAY_NS) {
		clock += clock < 0 ? DAY_NS : -DAY_NS;
		over = true;
	}
	*out = clock;
	return over ? OUTCOME_WRAPPED : OUTCOME_GOOD;
}

/* A time and a ULINT: multiplies sizes, then applies the sign. */
static enum outcome scale_unsigned(enum word fn, int64_t time, uint64_t by, int64_t *out)
{
	uint64_t size = time < 0 ? 0 - (uint64_t)time : (uint64_t)time;
	uint64_t most = (uint64_t)INT64_MAX + (time < 0);
	int64_t result;
	enum outcome outcome = compute_unsigned(fn, size, by, &result);

	if (outcome == OUTCOME_FAILED)
		return outcome;
	if ((uint64_t)result > most)
		outcome = OUTCOME_WRAPPED;
	*out = (int64_t)(time < 0 ? 0 - (uint64_t)result : (uint64_t)result);
	return outcome;
}

static enum outcome scale_real(enum word fn, int64_t time, double by, int64_t *out)
{
	volatile double ns = fn == FN_MUL ? (double)time * by : (double)time / by;

	ns = nearbyint(ns);
	if (!isfinite(ns) || ns < -9223372036854775808.0 || ns >= 9223372036854775808.0)
		return OUTCOME_FAILED;
	*out = (int64_t)ns;
	return OUTCOME_GOOD;
}

enum iec_type value_time_type(enum word fn, enum iec_type left, enum iec_type right)
{
	bool clock = left == IEC_TIME_OF_DAY || left == IEC_DATE_AND_TIME;
	bool sum = fn == FN_ADD || fn == FN_SUB;

	if (clock && right == IEC_TIME && sum)
		return left;
	if ((clock || left == IEC_DATE) && right == left && fn == FN_SUB)
		return IEC_TIME;
	if (left == IEC_TIME && right != IEC_TIME && (fn == FN_MUL || fn == FN_DIV))
		return IEC_TIME;
	return IEC_NONE;
}

enum outcome value_compute_time(enum word fn, struct value left, struct value right,
				struct value *out)
{
	enum outcome outcome;
	struct value result = { .type = value_time_type(fn, left.type, right.type) };

	if (left.type == IEC_TIME_OF_DAY && right.type == IEC_TIME)
		outcome = turn(left.i, right.i, fn == FN_SUB, &result.i);
	else if (right.type == IEC_REAL)
		outcome = scale_real(fn, left.i, (double)right.r, &result.i);
	else if (right.type == IEC_LREAL)
		outcome = scale_real(fn, left.i, right.d, &result.i);
	else if (right.type == IEC_ULINT)
		outcome = scale_unsigned(fn, left.i, (uint64_t)right.i, &result.i);
	else
		outcome = compute_whole(fn, IEC_TIME, left.i, right.i, &result.i);
	if (outcome != OUTCOME_FAILED)
		*out = result;
	return outcome;
}
