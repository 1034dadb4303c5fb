/* SPDX-License-Identifier: MIT
 *
 * fn_time - times, times of day and dates added, taken apart and put together, IEC
 * 61131-3 tables 30 and 35.
 *
 * All of them are nanoseconds in 64 bits. A result beyond 64 bits, or a time of day
 * beyond midnight, wraps with ENO FALSE. A date or time that the calendar does not have
 * stores nothing. No clock is read.
 */
#include "engine/scan/value.h"
#include "engine/scan/vm.h"

#include <math.h>

#define SECOND_NS INT64_C(1000000000)
#define DAY_NS    (86400 * SECOND_NS)

static enum fn_status give(struct fn_args *args, int64_t ns, bool over)
{
	args->out.i = ns;
	return over ? FN_WRAPPED : FN_OK;
}

static enum fn_status add(struct fn_args *args)
{
	int64_t sum;
	bool over = __builtin_add_overflow(args->in[0].i, args->in[1].i, &sum);

	return give(args, sum, over);
}

static enum fn_status subtract(struct fn_args *args)
{
	int64_t rest;
	bool over = __builtin_sub_overflow(args->in[0].i, args->in[1].i, &rest);

	return give(args, rest, over);
}

/* Nanoseconds since midnight; a damaged TIME_OF_DAY is reduced to one day. */
static int64_t of_day(int64_t ns)
{
	int64_t rest = ns % DAY_NS;

	return rest < 0 ? rest + DAY_NS : rest;
}

/* The time of day @shift later (less than a day); @days: the shift has whole days, too. */
static enum fn_status turn_clock(struct fn_args *args, int64_t shift, bool days)
{
	int64_t ns = of_day(args->in[0].i) + shift;

	return give(args, of_day(ns), days || ns < 0 || ns >= DAY_NS);
}

enum fn_status fn_ADD_TIME(struct fn_args *args)
{
	return add(args);
}

enum fn_status fn_ADD_TOD_TIME(struct fn_args *args)
{
	int64_t time = args->in[1].i;

	return turn_clock(args, time % DAY_NS, time / DAY_NS != 0);
}

enum fn_status fn_ADD_DT_TIME(struct fn_args *args)
{
	return add(args);
}

enum fn_status fn_SUB_TIME(struct fn_args *args)
{
	return subtract(args);
}

enum fn_status fn_SUB_DATE_DATE(struct fn_args *args)
{
	return subtract(args);
}

enum fn_status fn_SUB_TOD_TIME(struct fn_args *args)
{
	int64_t time = args->in[1].i;

	return turn_clock(args, -(time % DAY_NS), time / DAY_NS != 0);
}

enum fn_status fn_SUB_TOD_TOD(struct fn_args *args)
{
	return subtract(args);
}

enum fn_status fn_SUB_DT_TIME(struct fn_args *args)
{
	return subtract(args);
}

enum fn_status fn_SUB_DT_DT(struct fn_args *args)
{
	return subtract(args);
}

/* ---- a time and a number ---- */

/* To the nearest nanosecond, ties to even; NaN has no result. */
static enum fn_status give_real(struct fn_args *args, double ns)
{
	const double limit = 9223372036854775808.0; /* 2^63 */

	ns = rint(ns);
	if (!(ns >= -limit && ns < limit))
		return FN_FAILED;
	args->out.i = (int64_t)ns;
	return FN_OK;
}

enum fn_status fn_MULTIME(struct fn_args *args)
{
	int64_t time = args->in[0].i, by = args->in[1].i, product;
	bool over;

	if (value_is_real(args->in_type[1]))
		return give_real(args, (double)time * args->in[1].r);
	over = __builtin_mul_overflow(time, by, &product);
	if (iec_is_wide(args->in_type[1]) && by < 0) /* 2^63 and more */
		over = time != 0 && !(time == -1 && by == INT64_MIN);
	return give(args, product, over);
}

enum fn_status fn_DIVTIME(struct fn_args *args)
{
	int64_t time = args->in[0].i, by = args->in[1].i;

	if (value_is_real(args->in_type[1]))
		return args->in[1].r == 0 ? FN_FAILED :
		       give_real(args, (double)time / args->in[1].r);
	if (by == 0)
		return FN_FAILED;
	if (iec_is_wide(args->in_type[1]) && by < 0) {
		args->out.i = time == INT64_MIN && by == INT64_MIN ? -1 : 0;
		return FN_OK;
	}
	if (time == INT64_MIN && by == -1)
		return FN_FAILED;
	args->out.i = time / by;
	return FN_OK;
}

/* ---- dates put together ---- */

enum fn_status fn_CONCAT_DATE_TOD(struct fn_args *args)
{
	return add(args);
}

static bool take_day(const struct fn_args *args, int64_t *ns)
{
	return iec_date(args->in[0].i, args->in[1].i, args->in[2].i, ns);
}

/* Hours, minutes, seconds, milliseconds from pin @first on; false: no such time. */
static bool take_clock(const struct fn_args *args, int first, int64_t *ns)
{
	static const int most[] = { 23, 59, 59, 999 };
	static const int parts[] = { 60, 60, 1000, 1 };
	int64_t ms = 0;

	for (int i = 0; i < 4; i++) {
		int64_t part = args->in[first + i].i;

		if (part < 0 || part > most[i])
			return false;
		ms = (ms + part) * parts[i];
	}
	*ns = ms * INT64_C(1000000);
	return true;
}

enum fn_status fn_CONCAT_DATE(struct fn_args *args)
{
	return take_day(args, &args->out.i) ? FN_OK : FN_FAILED;
}

enum fn_status fn_CONCAT_TOD(struct fn_args *args)
{
	return take_clock(args, 0, &args->out.i) ? FN_OK : FN_FAILED;
}

enum fn_status fn_CONCAT_DT(struct fn_args *args)
{
	int64_t day, clock;

	if (!take_day(args, &day) || !take_clock(args, 3, &clock) ||
	    __builtin_add_overflow(day, clock, &args->out.i))
		return FN_FAILED;
	return FN_OK;
}

/* ---- dates taken apart ---- */

static int64_t day_number(const struct fn_args *args)
{
	int64_t ns = args->in[0].i;

	return ns / DAY_NS - (ns % DAY_NS < 0);
}

enum fn_status fn_DAY_OF_WEEK(struct fn_args *args)
{
	/* 1970-01-01 was a Thursday. */
	args->out.i = ((day_number(args) + 4) % 7 + 7) % 7;
	return FN_OK;
}

enum fn_status fn_YEAR_OF(struct fn_args *args)
{
	int year, month, day;

	iec_civil(day_number(args), &year, &month, &day);
	args->out.i = year;
	return FN_OK;
}

enum fn_status fn_MONTH_OF(struct fn_args *args)
{
	int year, month, day;

	iec_civil(day_number(args), &year, &month, &day);
	args->out.i = month;
	return FN_OK;
}

enum fn_status fn_DAY_OF(struct fn_args *args)
{
	int year, month, day;

	iec_civil(day_number(args), &year, &month, &day);
	args->out.i = day;
	return FN_OK;
}

enum fn_status fn_HOUR_OF(struct fn_args *args)
{
	args->out.i = of_day(args->in[0].i) / (3600 * SECOND_NS);
	return FN_OK;
}

enum fn_status fn_MINUTE_OF(struct fn_args *args)
{
	args->out.i = of_day(args->in[0].i) / (60 * SECOND_NS) % 60;
	return FN_OK;
}

enum fn_status fn_SECOND_OF(struct fn_args *args)
{
	args->out.i = of_day(args->in[0].i) / SECOND_NS % 60;
	return FN_OK;
}

enum fn_status fn_MILLISECOND_OF(struct fn_args *args)
{
	args->out.i = of_day(args->in[0].i) / 1000000 % 1000;
	return FN_OK;
}
