/* SPDX-License-Identifier: MIT
 *
 * test_board_time - the text of a date and time, and the fields on the wire.
 */
#include "online/board_time.h"

#include "tests/tap.h"

#include <string.h>

#define SECOND INT64_C(1000000000)

static void test_a_time_is_printed_as_it_is_read(void)
{
	static const int64_t at_s[] = { -1, 0, 951782399, 951782400, 1780297200, 2147483647, 2147483648,
					4102444799 };
	char text[20];
	int64_t back_ns;
	bool utc;

	for (size_t i = 0; i < sizeof(at_s) / sizeof(at_s[0]); i++) {
		board_time_print(at_s[i] * SECOND, 0, text);
		CHECK(board_time_parse(text, &back_ns, &utc) && back_ns == at_s[i] * SECOND && !utc);
	}
	board_time_print(2147483648 * SECOND, 3600, text);
	CHECK_TEXT(text, "2038-01-19 04:14:08");
	board_time_print(-1, 0, text);
	CHECK_TEXT(text, "1969-12-31 23:59:59");
	CHECK(board_time_parse("2026-06-01T07:00Z", &back_ns, &utc) && utc &&
	   back_ns == 1780297200 * SECOND);
}

static void test_what_is_no_time(void)
{
	static const char *const wrong[] = { "", "2026", "2026-06-01", "2026-06-01 ", "2026-06-01 7:00",
		"2026-6-1 07:00", "2026-02-30 07:00", "2026-06-01 24:00", "2026-06-01 07:60",
		"2026-06-01 07:00:60", "2026-06-01 07:00:", "2026-06-01 07:00Zx", "2026-06-01 07:00 ",
		"-026-06-01 07:00", "2026-06-01x07:00" };
	int64_t ns;
	bool utc;

	for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++)
		CHECK(!board_time_parse(wrong[i], &ns, &utc));
}

static void test_the_fields(void)
{
	const struct board_time time = { .time_ns = INT64_MIN, .zone_s = -12600, .sync = SYNC_UNKNOWN,
					 .zone = "-0330" };
	uint8_t bytes[64];
	struct wire_writer out = wire_write(bytes, sizeof(bytes));
	struct wire_reader in;
	struct board_time back;

	board_time_put(&out, &time);
	in = wire_read(bytes, (size_t)(out.at - bytes));
	board_time_take(&in, &back);
	CHECK(wire_done(&in) && back.time_ns == time.time_ns && back.zone_s == time.zone_s &&
	   back.sync == time.sync && strcmp(back.zone, time.zone) == 0);
	in = wire_read(bytes, (size_t)(out.at - bytes) - 1);
	board_time_take(&in, &back);
	CHECK(in.failed);
}

int main(void)
{
	test_a_time_is_printed_as_it_is_read();
	test_what_is_no_time();
	test_the_fields();
	return tap_done();
}
