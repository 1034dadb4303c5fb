/* SPDX-License-Identifier: MIT
 *
 * fn_math - MOVE, ADD, SUB, MUL, DIV and MOD, IEC 61131-3 tables 24 and 30.
 *
 * Integers wrap and give ENO FALSE; division by zero and MIN / -1 leave the result
 * as it was; a REAL result that is infinite or not a number does too. Nothing
 * here can trap.
 */
#include "engine/scan/value.h"
#include "engine/scan/vm.h"

#include <math.h>

/* A sum or product (@overflow: beyond even 64 bits), cut to the type. */
static enum fn_status fit(struct fn_args *args, bool overflow, int64_t value)
{
	args->out.i = value_wrap(args->type, value);
	return overflow || args->out.i != value ? FN_WRAPPED : FN_OK;
}

static enum fn_status fit_real(struct fn_args *args, double value)
{
	float single = (float)value;

	if (!isfinite(single))
		return FN_FAILED;
	args->out.r = single;
	return FN_OK;
}

enum fn_status fn_MOVE(struct fn_args *args)
{
	args->out = args->in[0];
	return FN_OK;
}

/* More than two inputs are a chain, as a row of boxes would be; a step that wraps
 * marks the whole. */
enum fn_status fn_ADD(struct fn_args *args)
{
	enum fn_status status = FN_OK;
	int64_t sum = args->in[0].i;

	if (args->type == IEC_REAL) {
		double real = args->in[0].r;

		for (uint32_t i = 1; i < args->count; i++)
			real = (float)(real + args->in[i].r);
		return fit_real(args, real);
	}
	for (uint32_t i = 1; i < args->count; i++) {
		bool over = __builtin_add_overflow(sum, args->in[i].i, &sum);

		if (fit(args, over, sum) != FN_OK)
			status = FN_WRAPPED;
		sum = args->out.i;
	}
	return status;
}

enum fn_status fn_SUB(struct fn_args *args)
{
	int64_t value;
	bool over;

	if (args->type == IEC_REAL)
		return fit_real(args, args->in[0].r - args->in[1].r);
	over = __builtin_sub_overflow(args->in[0].i, args->in[1].i, &value);
	return fit(args, over, value);
}

enum fn_status fn_MUL(struct fn_args *args)
{
	enum fn_status status = FN_OK;
	int64_t value = args->in[0].i;

	if (args->type == IEC_REAL) {
		double real = args->in[0].r;

		for (uint32_t i = 1; i < args->count; i++)
			real = (float)(real * args->in[i].r);
		return fit_real(args, real);
	}
	for (uint32_t i = 1; i < args->count; i++) {
		bool over = __builtin_mul_overflow(value, args->in[i].i, &value);

		if (fit(args, over, value) != FN_OK)
			status = FN_WRAPPED;
		value = args->out.i;
	}
	return status;
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
	if (args->type == IEC_REAL) {
		if (args->in[1].r == 0)
			return FN_FAILED;
		return fit_real(args, args->in[0].r / args->in[1].r);
	}
	if (indivisible(args))
		return FN_FAILED;
	args->out.i = args->in[0].i / args->in[1].i;
	return FN_OK;
}

enum fn_status fn_MOD(struct fn_args *args)
{
	if (args->in[1].i == 0)
		return FN_FAILED;
	/* By -1 nothing remains; the machine would trap on MIN % -1. */
	args->out.i = args->in[1].i == -1 ? 0 : args->in[0].i % args->in[1].i;
	return FN_OK;
}
