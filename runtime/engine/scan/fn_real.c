/* SPDX-License-Identifier: MIT
 *
 * fn_real - SQRT to ATAN2 and EXPT, the functions of IEC 61131-3 tables 23 and 24 that
 * only REAL and LREAL have.
 *
 * An argument outside a function's domain, and a result that is infinite, fail; a
 * result that is too small becomes 0. A REAL is the rounded LREAL result. math.h
 * describes the algorithms.
 */
#include "engine/scan/math.h"
#include "engine/scan/value.h"
#include "engine/scan/vm.h"

#include <math.h>

static enum fn_status give(struct fn_args *args, double value)
{
	/* Beyond the largest REAL it becomes infinite. */
	if (args->type == IEC_REAL)
		value = (double)(float)value;
	if (!isfinite(value))
		return FN_FAILED;
	args->out.r = value;
	return FN_OK;
}

enum fn_status fn_SQRT(struct fn_args *args)
{
	if (!(args->in[0].r >= 0))
		return FN_FAILED;
	return give(args, sqrt(args->in[0].r));
}

enum fn_status fn_LN(struct fn_args *args)
{
	return give(args, math_log(args->in[0].r));
}

enum fn_status fn_LOG(struct fn_args *args)
{
	return give(args, math_log10(args->in[0].r));
}

enum fn_status fn_EXP(struct fn_args *args)
{
	return give(args, math_exp(args->in[0].r));
}

/* An integer exponent may have more bits than an LREAL. */
enum fn_status fn_EXPT(struct fn_args *args)
{
	double base = args->in[0].r;
	int64_t exponent = args->in[1].i;
	bool negative;

	if (value_is_real(args->in_type[1]))
		return give(args, math_pow(base, args->in[1].r));
	negative = exponent < 0 && !iec_is_wide(args->in_type[1]);
	return give(args, math_pow_integer(base, negative, negative ?
					   -(uint64_t)exponent : (uint64_t)exponent));
}

enum fn_status fn_SIN(struct fn_args *args)
{
	return give(args, math_sin(args->in[0].r));
}

enum fn_status fn_COS(struct fn_args *args)
{
	return give(args, math_cos(args->in[0].r));
}

enum fn_status fn_TAN(struct fn_args *args)
{
	return give(args, math_tan(args->in[0].r));
}

enum fn_status fn_ASIN(struct fn_args *args)
{
	return give(args, math_asin(args->in[0].r));
}

enum fn_status fn_ACOS(struct fn_args *args)
{
	return give(args, math_acos(args->in[0].r));
}

enum fn_status fn_ATAN(struct fn_args *args)
{
	return give(args, math_atan(args->in[0].r));
}

enum fn_status fn_ATAN2(struct fn_args *args)
{
	return give(args, math_atan2(args->in[0].r, args->in[1].r));
}
