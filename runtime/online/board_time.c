/* SPDX-License-Identifier: MIT
 *
 * board_time - fields, and the text of a date and time.
 */
#include "online/board_time.h"

#include "engine/base/iec.h"

#include <stdio.h>
#include <string.h>

#define SECOND INT64_C(1000000000)
#define DAY_S  86400

void board_time_put(struct wire_writer *out, const struct board_time *time)
{
	wire_put_i64(out, time->time_ns);
	wire_put_u32(out, (uint32_t)time->zone_s);
	wire_put_u8(out, time->sync);
	wire_put_string(out, time->zone);
}

void board_time_take(struct wire_reader *in, struct board_time *time)
{
	time->time_ns = wire_i64(in);
	time->zone_s = (int32_t)wire_u32(in);
	time->sync = wire_u8(in);
	wire_copy_text(in, time->zone, sizeof(time->zone));
}

void board_time_print(int64_t time_ns, int32_t zone_s, char out[20])
{
	int64_t second = time_ns / SECOND - (time_ns % SECOND < 0) + zone_s;
	int64_t day = second / DAY_S - (second % DAY_S < 0);
	int year, month, day_of_month;
	const int of_day = (int)(second - day * DAY_S);

	iec_civil(day, &year, &month, &day_of_month);
	if (snprintf(out, 20, "%04d-%02d-%02d %02d:%02d:%02d", year, month, day_of_month,
		     of_day / 3600, of_day / 60 % 60, of_day % 60) > 19)
		out[19] = '\0';
}

/* @count digits at *@at, which moves behind them and @end. Fails: -1. */
static int digits(const char **at, int count, char end)
{
	int value = 0;

	for (; count; count--, (*at)++) {
		if (**at < '0' || **at > '9')
			return -1;
		value = value * 10 + (**at - '0');
	}
	if (!end)
		return value;
	return *(*at)++ == end ? value : -1;
}

bool board_time_parse(const char *text, int64_t *time_ns, bool *utc)
{
	const int year = digits(&text, 4, '-');
	const int month = year < 0 ? -1 : digits(&text, 2, '-');
	const int day = month < 0 ? -1 : digits(&text, 2, *text && text[1] && text[2] == 'T' ? 'T' : ' ');
	const int hour = day < 0 ? -1 : digits(&text, 2, ':');
	const int minute = hour < 0 ? -1 : digits(&text, 2, '\0');
	int second = 0;

	if (minute >= 0 && *text == ':') {
		text++;
		second = digits(&text, 2, '\0');
	}
	if (minute < 0 || second < 0 || hour > 23 || minute > 59 || second > 59)
		return false;
	*utc = *text == 'Z';
	if (text[*utc] || !iec_date(year, month, day, time_ns))
		return false;
	*time_ns += (hour * INT64_C(3600) + minute * INT64_C(60) + second) * SECOND;
	return true;
}
