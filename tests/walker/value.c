/* SPDX-License-Identifier: MIT
 *
 * value - the walker's own arithmetic: widening, wrapping, failing.
 *
 * docs/language.md, "Arithmetic". It knows nothing of rungs.
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
		/* from each word to those behind it */
		"SINT INT DINT", "USINT UINT UDINT", "BYTE WORD DWORD",
		"USINT INT DINT", "UINT DINT", "SINT REAL", "INT REAL",
		"USINT REAL", "UINT REAL",
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

static enum outcome compute_real(enum word fn, float a, float b, float *out)
{
	volatile float c = 0;

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

static enum outcome compute_whole(enum word fn, enum iec_type type, int64_t a,
				  int64_t b, int64_t *out)
{
	int64_t low = iec_type_row(type)->low, c;
	bool over = false;

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
			out.i |= (int64_t)1 << bit;
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

/* More than two inputs: the function of the first two, then of that and the
 * next; a wrap anywhere is a wrap. */
enum outcome value_compute(enum word fn, const struct value *in, int count,
			   struct value *out)
{
	enum outcome worst = OUTCOME_GOOD;
	struct value sum = in[0];

	if (word_is_test(word_row(fn))) {
		*out = value_bool(related(fn, order_of(in[0], in[1])));
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
			compute_whole(fn, sum.type, sum.i, next.i, &sum.i);

		if (now == OUTCOME_FAILED)
			return now;
		if (now == OUTCOME_WRAPPED)
			worst = now;
	}
	*out = sum;
	return worst;
}
