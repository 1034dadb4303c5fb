/* SPDX-License-Identifier: MIT
 *
 * test_loop - the text behind FOR is taken apart; any other form is refused whole.
 */
#include "engine/model/loop.h"
#include "tests/tap.h"

static bool is(struct loop_part part, const char *want)
{
	return part.len == strlen(want) && memcmp(part.text, want, part.len) == 0;
}

static void takes_apart(void)
{
	static const struct { const char *text, *variable, *from, *to; int64_t step; } rows[] = {
		{ "i := 0 TO 10", "i", "0", "10", 1 },
		{ "i := -5 TO +5 BY 2", "i", "-5", "+5", 2 },
		{ "i := last TO first BY -3", "i", "last", "first", -3 },
		{ "Tank[2].Level := Low TO Tank[i + 1].High", "Tank[2].Level", "Low", "Tank[i + 1].High", 1 },
		{ "i := 16#A TO 2#11 BY 16#10", "i", "16#A", "2#11", 16 },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		struct loop loop;

		CHECK_AS(loop_parse(rows[i].text, strlen(rows[i].text), &loop), rows[i].text);
		CHECK(is(loop.variable, rows[i].variable) && is(loop.from, rows[i].from) && is(loop.to, rows[i].to));
		CHECK(loop.step == rows[i].step);
	}
}

static void refuses_the_rest(void)
{
	static const char *const bad[] = {
		"", "i", "i :=", "i := 0", "i := 0 TO", "i := 0 TO 10 BY", "i := 0 TO 10 BY x", "i := 0 TO 10 BY 1.5",
		"i := 0 TO 10 BY TRUE", "i := 0 TO 10 BY 99999999999999999999", "i := 0 TO 10 BY 1 2", "i := 0 TO 10 20",
		"i := - TO 10", "i := 0 TO -x", "i := + 5", "5 := 0 TO 10", "i = 0 TO 10", "a[1 := 0 TO 10", "a[ := 0 TO 10", "a. := 0 TO 10",
		"a[b[1]] := 0 TO 10", "a[1].5 := 0 TO 10", "a[1]. := 0 TO 10", "a [1] := 0 TO 10", "i := 0 TO 18446744073709551615 BY 18446744073709551615", "i := \"x\" TO 10",
	};

	for (size_t i = 0; i < sizeof(bad) / sizeof(bad[0]); i++) {
		struct loop loop;

		CHECK_AS(!loop_parse(bad[i], strlen(bad[i]), &loop), bad[i]);
	}
}

/* Any beginning of a text, and any without one of its characters, is taken or refused, and never read beyond. */
static void reads_pieces(void)
{
	static const char whole[] = "Tank[i + 1].Level := -5 TO Tank[2].High BY -16#10";
	int good = 0;

	for (size_t len = 0; len < sizeof(whole); len++)
		for (size_t without = 0; without <= len; without++) {
			char text[sizeof(whole)], room[sizeof(whole)];
			struct loop loop;
			size_t at = 0;

			for (size_t i = 0; i < len; i++)
				if (i != without)
					text[at++] = whole[i];
			memcpy(room, text, at);
			if (at < sizeof(room))
				room[at] = '\0';
			if (!loop_parse(room, at, &loop))
				continue;
			good++;
			CHECK(loop.variable.text >= room && loop.to.text + loop.to.len <= room + at && loop.step != 0);
		}
	CHECK(good > 100 && good < 1000);
}

int main(void)
{
	takes_apart();
	refuses_the_rest();
	reads_pieces();
	return tap_done();
}
