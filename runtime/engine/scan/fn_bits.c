/* SPDX-License-Identifier: MIT
 *
 * fn_bits - AND OR XOR NOT on words, shifts, rotations and single bits by number: IEC
 * 61131-3 tables 25 and 26.
 *
 * A negative number of places fails; a shift by the width or more gives 0. Contacts and
 * the IL operators on BOOL use truth tables instead.
 */
#include "engine/scan/value.h"
#include "engine/scan/vm.h"

static unsigned width(const struct fn_args *args)
{
	return args->type == IEC_BOOL ? 1 : 64 - value_spare_bits(args->type);
}

static enum fn_status give(struct fn_args *args, uint64_t bits)
{
	if (args->type == IEC_BOOL)
		bits &= 1;
	args->out.i = value_wrap(args->type, (int64_t)bits);
	return FN_OK;
}

/* An integer input as a number of places: false if negative. Large unsigned numbers
 * stay large. */
static bool places(const struct fn_args *args, uint64_t *out)
{
	*out = (uint64_t)args->in[1].i;
	return args->in[1].i >= 0 || iec_is_wide(args->in_type[1]);
}

#define LOGIC(id, op) \
enum fn_status fn_##id(struct fn_args *args) \
{ \
	uint64_t bits = (uint64_t)args->in[0].i; \
\
	for (uint32_t i = 1; i < args->count; i++) \
		bits op (uint64_t)args->in[i].i; \
	return give(args, bits); \
}

LOGIC(AND, &=)
LOGIC(OR, |=)
LOGIC(XOR, ^=)

enum fn_status fn_NOT(struct fn_args *args)
{
	return give(args, ~(uint64_t)args->in[0].i);
}

enum fn_status fn_SHL(struct fn_args *args)
{
	uint64_t n;

	if (!places(args, &n))
		return FN_FAILED;
	return give(args, n < width(args) ? (uint64_t)args->in[0].i << n : 0);
}

enum fn_status fn_SHR(struct fn_args *args)
{
	uint64_t n;

	if (!places(args, &n))
		return FN_FAILED;
	return give(args, n < width(args) ? (uint64_t)args->in[0].i >> n : 0);
}

static enum fn_status rotate(struct fn_args *args, bool right)
{
	uint64_t bits = (uint64_t)args->in[0].i, n;
	unsigned wide = width(args);

	if (!places(args, &n))
		return FN_FAILED;
	n %= wide;
	if (right)
		n = (wide - n) % wide;
	return give(args, n ? bits << n | bits >> (wide - n) : bits);
}

enum fn_status fn_ROL(struct fn_args *args)
{
	return rotate(args, false);
}

enum fn_status fn_ROR(struct fn_args *args)
{
	return rotate(args, true);
}

/* The bit of that number; 0: there is no such bit. */
static uint64_t mask(const struct fn_args *args)
{
	uint64_t n;

	return places(args, &n) && n < width(args) ? UINT64_C(1) << n : 0;
}

enum fn_status fn_BIT_TEST(struct fn_args *args)
{
	uint64_t bit = mask(args);

	args->out.i = ((uint64_t)args->in[0].i & bit) != 0;
	return bit ? FN_OK : FN_FAILED;
}

enum fn_status fn_BIT_SET(struct fn_args *args)
{
	uint64_t bit = mask(args);

	return bit ? give(args, (uint64_t)args->in[0].i | bit) : FN_FAILED;
}

enum fn_status fn_BIT_RESET(struct fn_args *args)
{
	uint64_t bit = mask(args);

	return bit ? give(args, (uint64_t)args->in[0].i & ~bit) : FN_FAILED;
}
