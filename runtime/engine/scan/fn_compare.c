/* SPDX-License-Identifier: MIT
 *
 * fn_compare - GT GE EQ LE LT NE as functions with EN and a stored result,
 * IEC 61131-3 table 28. Contacts and expressions use the instruction CMP.
 *
 * A REAL that is not a number compares FALSE with everything, but for NE.
 */
#include "engine/scan/vm.h"

#define COMPARISON(id, rel) \
enum fn_status fn_##id(struct fn_args *args) \
{ \
	if (args->type == IEC_REAL) \
		args->out.i = args->in[0].r rel args->in[1].r; \
	else \
		args->out.i = args->in[0].i rel args->in[1].i; \
	return FN_OK; \
}

COMPARISON(GT, >)
COMPARISON(GE, >=)
COMPARISON(EQ, ==)
COMPARISON(LE, <=)
COMPARISON(LT, <)
COMPARISON(NE, !=)
