/* SPDX-License-Identifier: MIT
 *
 * fn_math - MOVE, ADD, SUB, MUL, DIV, MOD, NEG, ABS, INC and DEC, IEC 61131-3 tables
 * 23, 24 and 30.
 *
 * Integers wrap and give ENO FALSE; division by zero and MIN / -1 leave the result as
 * it was; a REAL result that is infinite or not a number does too. No operation can
 * trap.
 */
#include "engine/scan/value.h"
#include "engine/scan/vm.h"

#include <math.h>

/* A step of ADD, SUB or MUL in 64 bits; true: it did not fit even those. */
typedef bool step64(int64_t a, int64_t b, bool wide, int64_t *out);

static bool add64(int64_t a, int64_t b, bool wide, int64_t *out)
{
	uint64_t sum = (uint64_t)a + (uint64_t)b;

	if (!wide)
		return __builtin_add_overflow(a, b, out);
	*out = (int64_t)sum;
	return sum < (uint64_t)a;
}

static bool sub64(int64_t a, int64_t b, bool wide, int64_t *out)
{
	if (!wide)
		return __builtin_sub_overflow(a, b, out);
	*out = (int64_t)((uint64_t)a - (uint64_t)b);
	return (uint64_t)a < (uint64_t)b;
}

static bool mul64(int64_t a, int64_t b, bool wide, int64_t *out)
{
	uint64_t product;
	bool over;

	if (!wide)
		return __builtin_mul_overflow(a, b, out);
	over = __builtin_mul_overflow((uint64_t)a, (uint64_t)b, &product);
	*out = (int64_t)product;
	return over;
}

/* More than two inputs are a chain, as a row of boxes would be; a step that wraps makes
 * ENO FALSE. */
static enum fn_status chain(struct fn_args *args, step64 *step)
{
	enum fn_status status = FN_OK;
	bool wide = iec_is_wide(args->type);
	int64_t value = args->in[0].i;

	for (uint32_t i = 1; i < args->count; i++) {
		bool over = step(value, args->in[i].i, wide, &value);
		int64_t cut = value_wrap(args->type, value);

		if (over || cut != value)
			status = FN_WRAPPED;
		value = cut;
	}
	args->out.i = value;
	return status;
}

static double rounded(const struct fn_args *args, double value)
{
	return args->type == IEC_REAL ? (double)(float)value : value;
}

static enum fn_status fit_real(struct fn_args *args, double value)
{
	value = rounded(args, value);
	if (!isfinite(value))
		return FN_FAILED;
	args->out.r = value;
	return FN_OK;
}

enum fn_status fn_MOVE(struct fn_args *args)
{
	args->out = args->in[0];
	return FN_OK;
}

enum fn_status fn_ADD(struct fn_args *args)
{
	double sum = args->in[0].r;

	if (!value_is_real(args->type))
		return chain(args, add64);
	for (uint32_t i = 1; i < args->count; i++)
		sum = rounded(args, sum + args->in[i].r);
	return fit_real(args, sum);
}

enum fn_status fn_SUB(struct fn_args *args)
{
	if (!value_is_real(args->type))
		return chain(args, sub64);
	return fit_real(args, args->in[0].r - args->in[1].r);
}

enum fn_status fn_MUL(struct fn_args *args)
{
	double product = args->in[0].r;

	if (!value_is_real(args->type))
		return chain(args, mul64);
	for (uint32_t i = 1; i < args->count; i++)
		product = rounded(args, product * args->in[i].r);
	return fit_real(args, product);
}

/* True when a / b has no value of the type. */
static bool indivisible(const struct fn_args *args)
{
	int64_t low = iec_type_row(args->type)->low;

	return args->in[1].i == 0 ||
	       (args->in[1].i == -1 && low < 0 && args->in[0].i == low);
}

enum fn_status fn_DIV(struct fn_args *args)
{
	int64_t a = args->in[0].i, b = args->in[1].i;

	if (value_is_real(args->type)) {
		if (args->in[1].r == 0)
			return FN_FAILED;
		return fit_real(args, args->in[0].r / args->in[1].r);
	}
	if (indivisible(args))
		return FN_FAILED;
	args->out.i = iec_is_wide(args->type) ?
		      (int64_t)((uint64_t)a / (uint64_t)b) : a / b;
	return FN_OK;
}

enum fn_status fn_MOD(struct fn_args *args)
{
	int64_t a = args->in[0].i, b = args->in[1].i;

	if (b == 0)
		return FN_FAILED;
	/* By -1 nothing remains; the machine would trap on MIN % -1. */
	if (iec_is_wide(args->type))
		args->out.i = (int64_t)((uint64_t)a % (uint64_t)b);
	else
		args->out.i = b == -1 ? 0 : a % b;
	return FN_OK;
}

/* One step, perhaps with a constant as the second operand. */
static enum fn_status step_by(struct fn_args *args, step64 *step, int64_t a, int64_t b)
{
	bool over = step(a, b, iec_is_wide(args->type), &a);

	args->out.i = value_wrap(args->type, a);
	return over || args->out.i != a ? FN_WRAPPED : FN_OK;
}

enum fn_status fn_NEG(struct fn_args *args)
{
	if (value_is_real(args->type))
		return fit_real(args, -args->in[0].r);
	return step_by(args, sub64, 0, args->in[0].i);
}

enum fn_status fn_ABS(struct fn_args *args)
{
	if (value_is_real(args->type))
		return fit_real(args, fabs(args->in[0].r));
	if (args->in[0].i < 0 && !iec_is_wide(args->type))
		return step_by(args, sub64, 0, args->in[0].i);
	args->out.i = args->in[0].i;
	return FN_OK;
}

enum fn_status fn_INC(struct fn_args *args)
{
	return step_by(args, add64, args->in[0].i, 1);
}

enum fn_status fn_DEC(struct fn_args *args)
{
	return step_by(args, sub64, args->in[0].i, 1);
}
