/* SPDX-License-Identifier: MIT
 *
 * channel_scale - what a device delivers as a value of the process image, and back.
 */
#include "hal/channel_cell.h"

#include <math.h>

static double value_double(enum iec_type type, union iec_value value)
{
	if (iec_type_row(type)->class & CLASS_REAL)
		return value.r;
	return iec_is_wide(type) ? (double)(uint64_t)value.i : (double)value.i;
}

double channel_round(double x)
{
	double whole;

	if (!(fabs(x) < 4503599627370496.0)) /* 2^52: it has no fraction */
		return x;
	whole = (double)(int64_t)x;
	if (x - whole >= 0.5)
		return whole + 1;
	return whole - x >= 0.5 ? whole - 1 : whole;
}

/* The nearest value that the type has. Both ends of 64 bits are compared as doubles, which have
 * fewer digits: at or beyond them is the end. */
static union iec_value nearest(enum iec_type type, double x)
{
	const struct iec_type_row *row = iec_type_row(type);
	union iec_value value = { .i = 0 };

	if (row->class & CLASS_REAL) {
		value.r = type == IEC_REAL ? (double)(float)x : x;
		return value;
	}
	if (isnan(x))
		return value;
	x = channel_round(x);
	if (iec_is_wide(type))
		value.i = x <= 0 ? 0 : x >= 18446744073709551616.0 ? -1 : (int64_t)(uint64_t)x;
	else if (x <= (double)row->low)
		value.i = row->low;
	else
		value.i = x >= (double)row->high ? row->high : (int64_t)x;
	return value;
}

bool channel_value(const struct io_channel *channel, double raw, union iec_value *out)
{
	const double span = channel->at_high - channel->at_low;
	double x = raw;

	if (channel->scaled)
		x = channel->value_low + (raw - channel->at_low) / span *
		    (channel->value_high - channel->value_low);
	if (channel->type == IEC_BOOL)
		out->i = channel->switches ? raw >= channel->on_at : x != 0;
	else
		*out = nearest(channel->type, x);
	return !isnan(raw) && (!channel->limited || (raw >= channel->least && raw <= channel->most));
}

static union iec_value typed(enum iec_type type, double x)
{
	if (type == IEC_BOOL)
		return (union iec_value){ .i = x != 0 };
	return nearest(type, x);
}

double channel_raw(const struct io_channel *channel, union iec_value value)
{
	const double span = channel->value_high - channel->value_low;
	const double x = value_double(channel->type, value);

	if (!channel->scaled)
		return x;
	return channel->at_low + (x - channel->value_low) / span *
	       (channel->at_high - channel->at_low);
}

union iec_value channel_wanted(const struct io_channel *channel, union iec_value value)
{
	return channel->raw != channel->type || channel->scaled ?
	       typed(channel->raw, channel_raw(channel, value)) : value;
}

double channel_number(enum iec_type type, union iec_value value)
{
	return value_double(type, value);
}

