/* SPDX-License-Identifier: MIT
 *
 * fn_compare - GT GE EQ LE LT NE as functions with EN and a stored result,
 * IEC 61131-3 table 28. Contacts and expressions use the instruction CMP.
 *
 * A REAL that is not a number compares FALSE with everything, but for NE.
 */
#include "engine/scan/value.h"
#include "engine/scan/vm.h"

/* The two sides as a comparison with 0; REAL is compared directly. */
static int order(const struct fn_args *args)
{
	int64_t a = args->in[0].i, b = args->in[1].i;

	if (args->type == IEC_STRING)
		return value_order(args->in[0].s, args->in[1].s);
	if (iec_is_wide(args->type))
		return ((uint64_t)a > (uint64_t)b) - ((uint64_t)a < (uint64_t)b);
	return (a > b) - (a < b);
}

#define COMPARISON(id, rel) \
enum fn_status fn_##id(struct fn_args *args) \
{ \
	args->out.i = value_is_real(args->type) ? \
		      args->in[0].r rel args->in[1].r : order(args) rel 0; \
	return FN_OK; \
}

COMPARISON(GT, >)
COMPARISON(GE, >=)
COMPARISON(EQ, ==)
COMPARISON(LE, <=)
COMPARISON(LT, <)
COMPARISON(NE, !=)
