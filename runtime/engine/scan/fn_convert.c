/* SPDX-License-Identifier: MIT
 *
 * fn_convert - values of one type as values of another, IEC 61131-3 table 22.
 *
 * Both types are in the instruction, so that one function does all conversions. Whole
 * numbers go through 64 bits. Texts are read and written by fn_text.
 *
 * REAL to a whole number: ENO FALSE and nothing stored if it has none. A whole number
 * that does not fit another: wrapped, ENO FALSE. Bit strings: the bits, cut or filled
 * with 0; to REAL and LREAL of the same width likewise, of another width as a number.
 * BOOL: anything but 0. TIME and TIME_OF_DAY count as milliseconds, DATE and
 * DATE_AND_TIME as seconds since 1970.
 */
#include "engine/scan/fn_text.h"
#include "engine/scan/value.h"
#include "engine/scan/vm.h"

#include <math.h>
#include <string.h>

#define MS_NS  INT64_C(1000000)
#define S_NS   INT64_C(1000000000)
#define DAY_NS (86400 * S_NS)

#define TWO_63 9223372036854775808.0 /* both have REALs as neighbours */
#define TWO_64 18446744073709551616.0

enum way { NEAREST, DOWN, UP, TO_ZERO };

static uint16_t class_of(enum iec_type type)
{
	return iec_type_row(type)->class;
}

/* ---- REAL to whole ---- */

/* The whole number nearest to a REAL; @part is the fraction that truncation leaves. */
static int64_t adjust(int64_t whole, double part, enum way way)
{
	bool odd = whole & 1;

	switch (way) {
	case NEAREST:
		whole += part > 0.5 || (part == 0.5 && odd);
		return whole - (part < -0.5 || (part == -0.5 && odd));
	case DOWN:
		return whole - (part < 0);
	case UP:
		return whole + (part > 0);
	case TO_ZERO:
		break;
	}
	return whole;
}

/* False: there is none. Without libm, so that it is the same everywhere. From 2^52 on
 * there are no fractions. */
static bool whole_of(double real, enum way way, bool wide, int64_t *out)
{
	if (wide && real >= TWO_63 && real < TWO_64) {
		*out = (int64_t)(uint64_t)real;
		return true;
	}
	if (!(real >= -TWO_63 && real < TWO_63))
		return false;
	*out = (int64_t)real;
	*out = adjust(*out, real - (double)*out, way);
	return !wide || *out >= 0;
}

static bool has(enum iec_type type, int64_t whole)
{
	const struct iec_type_row *row = iec_type_row(type);

	return iec_is_wide(type) || (whole >= row->low && whole <= row->high);
}

static enum fn_status give_real(struct fn_args *args, double real)
{
	if (args->result == IEC_REAL)
		real = (double)(float)real;
	if (!isfinite(real))
		return FN_FAILED;
	args->out.r = real;
	return FN_OK;
}

static enum fn_status round_real(struct fn_args *args, enum way way)
{
	double real = args->in[0].r;
	int64_t whole = 0;

	if (value_is_real(args->result)) {
		if (fabs(real) < TWO_63 / 2) {
			whole_of(real, way, false, &whole);
			real = (double)whole;
		}
		return give_real(args, real);
	}
	if (!whole_of(real, way, iec_is_wide(args->result), &whole) ||
	    !has(args->result, whole))
		return FN_FAILED;
	args->out.i = whole;
	return FN_OK;
}

enum fn_status fn_TRUNC(struct fn_args *args)
{
	return round_real(args, TO_ZERO);
}

enum fn_status fn_ROUND(struct fn_args *args)
{
	return round_real(args, NEAREST);
}

enum fn_status fn_FLOOR(struct fn_args *args)
{
	return round_real(args, DOWN);
}

enum fn_status fn_CEIL(struct fn_args *args)
{
	return round_real(args, UP);
}

/* ---- times ---- */

/* Nanoseconds that a type of CLASS_TIME or ANY_DATE counts as 1. */
static int64_t unit_of(enum iec_type type)
{
	return class_of(type) & (CLASS_TIME | CLASS_TOD) ? MS_NS : S_NS;
}

/* To the nearest unit, ties to even. */
static int64_t units_of(int64_t ns, int64_t unit)
{
	int64_t whole = ns / unit, rest = ns % unit;

	if (rest < 0) {
		whole--;
		rest += unit;
	}
	return whole + (rest > unit / 2 || (rest == unit / 2 && whole & 1));
}

/* Since the last midnight. */
static int64_t ns_of_day(int64_t ns)
{
	return (ns % DAY_NS + DAY_NS) % DAY_NS;
}

/* Nanoseconds as a value of a time or date: a DATE begins at midnight. */
static enum fn_status give_time(struct fn_args *args, int64_t ns)
{
	if (args->result == IEC_DATE &&
	    __builtin_sub_overflow(ns, ns_of_day(ns), &ns))
		return FN_FAILED;
	if (!has(args->result, ns))
		return FN_FAILED;
	args->out.i = ns;
	return FN_OK;
}

static enum fn_status number_to_time(struct fn_args *args)
{
	int64_t unit = unit_of(args->result), ns;

	if (value_is_real(args->type)) {
		if (!whole_of(args->in[0].r * (double)unit, NEAREST, false, &ns))
			return FN_FAILED;
	} else if ((iec_is_wide(args->type) && args->in[0].i < 0) ||
		   __builtin_mul_overflow(args->in[0].i, unit, &ns)) {
		return FN_FAILED;
	}
	return give_time(args, ns);
}

/* DT to its DATE or time of day; a DATE to DT, a TIME_OF_DAY to TIME and back. */
static enum fn_status time_to_time(struct fn_args *args)
{
	uint16_t from = class_of(args->type), to = class_of(args->result);
	const uint16_t clock = CLASS_TIME | CLASS_TOD, day = CLASS_DATE | CLASS_DT;
	int64_t ns = args->in[0].i;

	if (from == CLASS_DT && to == CLASS_TOD)
		return give_time(args, ns_of_day(ns));
	if (!(from & clock && to & clock) && !(from & day && to & day))
		return FN_FAILED;
	return give_time(args, ns);
}

/* ---- numbers and bits ---- */

/* Gives @whole, of type @from, as a value of the result's type. */
static enum fn_status give_whole(struct fn_args *args, enum iec_type from, int64_t whole)
{
	bool bits = (class_of(from) | class_of(args->result)) & ANY_BIT;
	bool minus = whole < 0 && !iec_is_wide(from);

	if (bits) /* no sign to extend */
		whole = (int64_t)((uint64_t)whole << value_spare_bits(from) >>
				  value_spare_bits(from));
	args->out.i = value_wrap(args->result, whole);
	if (bits || (args->out.i == whole &&
		     (iec_is_wide(args->result) ? !minus :
		      minus || whole >= 0)))
		return FN_OK;
	return FN_WRAPPED;
}

/* REAL and DWORD, LREAL and LWORD: the same bits. */
static bool same_bits(const struct fn_args *args)
{
	const struct iec_type_row *from = iec_type_row(args->type);
	const struct iec_type_row *to = iec_type_row(args->result);

	return from->size == to->size && (from->class | to->class) ==
					 (CLASS_BITS | CLASS_REAL);
}

static enum fn_status copy_bits(struct fn_args *args)
{
	uint8_t bytes[8] = { 0 };

	value_put(bytes, args->type, args->in[0]);
	if (value_is_real(args->result))
		args->out.r = value_real(bytes, args->result);
	else
		args->out.i = value_integer(bytes, args->result);
	return FN_OK;
}

static enum fn_status from_real(struct fn_args *args)
{
	if (args->result == IEC_BOOL) {
		args->out.i = args->in[0].r != 0;
		return isnan(args->in[0].r) ? FN_FAILED : FN_OK;
	}
	if (value_is_real(args->result))
		return give_real(args, args->in[0].r);
	return round_real(args, NEAREST);
}

static enum fn_status from_time(struct fn_args *args)
{
	int64_t unit = unit_of(args->type), ns = args->in[0].i;

	if (value_is_real(args->result))
		return give_real(args, (double)ns / (double)unit);
	return give_whole(args, IEC_LINT, units_of(ns, unit));
}

static enum fn_status from_whole(struct fn_args *args)
{
	int64_t whole = args->in[0].i;

	if (!value_is_real(args->result))
		return give_whole(args, args->type, whole);
	if (args->result == IEC_REAL) { /* rounded once, not twice */
		args->out.r = iec_is_wide(args->type) ?
			(double)(float)(uint64_t)whole : (double)(float)whole;
		return FN_OK;
	}
	args->out.r = iec_is_wide(args->type) ? (double)(uint64_t)whole
					      : (double)whole;
	return FN_OK;
}

static enum fn_status from_text(struct fn_args *args)
{
	const struct iec_string *s = args->in[0].s;

	args->out = args->in[0];
	if (args->result == IEC_STRING)
		return FN_OK;
	return fn_text_to(args->result, s->text, s->length, &args->out) ? FN_OK
								      : FN_FAILED;
}

static enum fn_status to_text(struct fn_args *args)
{
	args->room->length = (uint16_t)fn_text_from(args->type, args->in[0],
						    args->room->text);
	args->out.s = args->room;
	return FN_OK;
}

enum fn_status fn_CONVERT(struct fn_args *args)
{
	const uint16_t times = CLASS_TIME | ANY_DATE;
	bool from = class_of(args->type) & times, to = class_of(args->result) & times;

	if (args->type == IEC_STRING)
		return from_text(args);
	if (args->result == IEC_STRING)
		return to_text(args);
	if (same_bits(args))
		return copy_bits(args);
	if (args->result == IEC_BOOL && !value_is_real(args->type)) {
		args->out.i = args->in[0].i != 0;
		return FN_OK;
	}
	if (from && to)
		return time_to_time(args);
	if (to)
		return number_to_time(args);
	if (from)
		return from_time(args);
	return value_is_real(args->type) ? from_real(args) : from_whole(args);
}

/* Times and dates as numbers of nanoseconds. */
enum fn_status fn_CONVERT_NS(struct fn_args *args)
{
	const uint16_t times = CLASS_TIME | ANY_DATE;
	bool from = class_of(args->type) & times, to = class_of(args->result) & times;
	enum iec_type result = args->result;
	enum fn_status status;

	if (from == to)
		return fn_CONVERT(args);
	if (from)
		args->type = IEC_LINT;
	else
		args->result = IEC_LINT;
	status = fn_CONVERT(args);
	args->result = result;
	if (from || status != FN_OK)
		return from ? status : FN_FAILED;
	return give_time(args, args->out.i);
}

/* ---- decimal digits ---- */

enum fn_status fn_FROM_BCD(struct fn_args *args)
{
	uint64_t digits = (uint64_t)args->in[0].i, number = 0;

	for (int shift = 60; shift >= 0; shift -= 4) {
		uint64_t digit = digits >> shift & 15u;

		if (digit > 9)
			return FN_FAILED;
		number = number * 10 + digit;
	}
	args->out.i = (int64_t)number;
	return has(args->result, args->out.i) ? FN_OK : FN_FAILED;
}

enum fn_status fn_TO_BCD(struct fn_args *args)
{
	uint64_t number = (uint64_t)args->in[0].i, digits = 0;
	unsigned width = 64 - value_spare_bits(args->result);

	if (args->in[0].i < 0 && !iec_is_wide(args->type))
		return FN_FAILED;
	for (unsigned shift = 0; shift < width; shift += 4, number /= 10)
		digits |= number % 10 << shift;
	args->out.i = (int64_t)digits;
	return number ? FN_FAILED : FN_OK;
}

/* ---- bytes the other way round ---- */

static enum fn_status turn_bytes(struct fn_args *args)
{
	const unsigned int spare = value_spare_bits(args->type);

	args->out.i = value_wrap(args->type, (int64_t)(__builtin_bswap64((uint64_t)args->in[0].i) >> spare));
	return FN_OK;
}

static enum fn_status same_bytes(struct fn_args *args)
{
	args->out = args->in[0];
	return FN_OK;
}

enum fn_status fn_TO_BIG_ENDIAN(struct fn_args *args)
{
	return turn_bytes(args);
}

enum fn_status fn_TO_LITTLE_ENDIAN(struct fn_args *args)
{
	return same_bytes(args);
}

enum fn_status fn_BIG_ENDIAN_TO(struct fn_args *args)
{
	return turn_bytes(args);
}

enum fn_status fn_LITTLE_ENDIAN_TO(struct fn_args *args)
{
	return same_bytes(args);
}

/* ---- is it one? ---- */

enum fn_status fn_IS_VALID(struct fn_args *args)
{
	args->out.i = isfinite(args->in[0].r);
	return FN_OK;
}

enum fn_status fn_IS_VALID_BCD(struct fn_args *args)
{
	args->out.i = 1;
	for (uint64_t digits = (uint64_t)args->in[0].i; digits; digits >>= 4)
		if ((digits & 15u) > 9)
			args->out.i = 0;
	return FN_OK;
}
