/* SPDX-License-Identifier: MIT
 *
 * fn_select - SEL MUX MIN MAX LIMIT on values of any one type, IEC 61131-3 table 27.
 *
 * NaN cannot be ordered: MIN, MAX and LIMIT fail on it.
 */
#include "engine/scan/value.h"
#include "engine/scan/vm.h"

static bool is_less(const struct fn_args *args, union iec_value a, union iec_value b)
{
	if (args->type == IEC_STRING)
		return value_order(a.s, b.s) < 0;
	if (value_is_real(args->type))
		return a.r < b.r;
	if (iec_is_wide(args->type))
		return (uint64_t)a.i < (uint64_t)b.i;
	return a.i < b.i;
}

static bool has_order(const struct fn_args *args)
{
	if (!value_is_real(args->type))
		return true;
	for (uint32_t i = 0; i < args->count; i++)
		if (args->in[i].r != args->in[i].r)
			return false;
	return true;
}

enum fn_status fn_SEL(struct fn_args *args)
{
	args->out = args->in[args->in[0].i ? 2 : 1];
	return FN_OK;
}

enum fn_status fn_MUX(struct fn_args *args)
{
	uint64_t k = (uint64_t)args->in[0].i; /* a negative one is large */

	if (k >= args->count - 1u)
		return FN_FAILED;
	args->out = args->in[k + 1];
	return FN_OK;
}

enum fn_status fn_MIN(struct fn_args *args)
{
	if (!has_order(args))
		return FN_FAILED;
	args->out = args->in[0];
	for (uint32_t i = 1; i < args->count; i++)
		if (is_less(args, args->in[i], args->out))
			args->out = args->in[i];
	return FN_OK;
}

enum fn_status fn_MAX(struct fn_args *args)
{
	if (!has_order(args))
		return FN_FAILED;
	args->out = args->in[0];
	for (uint32_t i = 1; i < args->count; i++)
		if (is_less(args, args->out, args->in[i]))
			args->out = args->in[i];
	return FN_OK;
}

/* MIN(MAX(IN, MN), MX), as in the standard: if the bounds cross, MX wins. */
enum fn_status fn_LIMIT(struct fn_args *args)
{
	union iec_value low = args->in[0], high = args->in[2];

	if (!has_order(args))
		return FN_FAILED;
	args->out = args->in[1];
	if (is_less(args, args->out, low))
		args->out = low;
	if (is_less(args, high, args->out))
		args->out = high;
	return FN_OK;
}
