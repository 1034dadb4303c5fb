/* SPDX-License-Identifier: MIT
 *
 * test_times - the one form of a time: its units, that it can be typed, and how far a timer is.
 * No display.
 */
#include "editor-gtk/sim/live_map.h"

#include "tests/tap.h"

#include <stdio.h>
#include <string.h>

#define MS INT64_C(1000000)
#define S (1000 * MS)

static bool is_shown(int64_t ns, const char *whole, const char *brief)
{
	char text[2][32];

	live_time_print(ns, text[0], sizeof(text[0]));
	live_time_print_short(ns, text[1], sizeof(text[1]));
	if (strcmp(text[0], whole) == 0 && strcmp(text[1], brief) == 0)
		return true;
	printf("# %s, %s\n", text[0], text[1]);
	return false;
}

static void test_units(void)
{
	CHECK(is_shown(0, "0 s", "0 s"));
	CHECK(is_shown(1, "0.000001 ms", "0.000001 ms"));
	CHECK(is_shown(250 * MS + 500000, "250.5 ms", "250 ms"));
	CHECK(is_shown(999 * MS, "999 ms", "999 ms"));
	CHECK(is_shown(S, "1 s", "1 s"));
	CHECK(is_shown(3257 * MS, "3.257 s", "3.2 s"));
	CHECK(is_shown(3050 * MS, "3.05 s", "3 s"));
	CHECK(is_shown(60 * S - 1, "59.999999999 s", "59.9 s"));
	CHECK(is_shown(125 * S, "2:05 min", "2:05 min"));
	CHECK(is_shown(3599 * S + 500 * MS, "59:59.5 min", "59:59 min"));
	CHECK(is_shown(3723 * S, "1:02:03 h", "1:02:03 h"));
	CHECK(is_shown(26 * 3600 * S, "26:00:00 h", "26:00:00 h"));
	CHECK(is_shown(-125 * S, "-2:05 min", "-2:05 min"));
	CHECK(is_shown(-5 * MS, "-5 ms", "-5 ms"));
}

/* True: @text is the form of a time, and reads as @ns. */
static bool reads(const char *text, int64_t ns)
{
	union iec_value back = { .i = 0 };
	struct iec_text room;
	enum diag_id why;

	return live_value_parse(FORMAT_AUTO, IEC_TIME, text, &room, &back, &why) &&
	       back.i == ns;
}

static bool has_unit(const char *text)
{
	static const char *const units[] = { " ms", " s", " min", " h" };
	int found = 0;

	for (gsize i = 0; i < G_N_ELEMENTS(units); i++)
		found += g_str_has_suffix(text, units[i]);
	return found == 1 && !strpbrk(text, "T#_e");
}

/* Times of every size, of both signs: what is shown has one unit and can be typed; so can the
 * literal; status chart, sheet, panel and timing chart agree. */
static void test_sweep(void)
{
	guint64 seed = 1;
	int bad = 0;

	for (int n = 0; n < 50000; n++) {
		char text[32], brief[32], chart[64], sheet[32], curve[32], *literal;
		int64_t ns;

		seed = seed * 6364136223846793005u + 1442695040888963407u;
		ns = (int64_t)seed >> (seed >> 3) % 62;
		if (n % 3 == 0)
			ns -= ns % MS;
		if (n == 1 || n == 2)
			ns = n == 1 ? INT64_MAX : INT64_MIN + 1;
		live_time_print(ns, text, sizeof(text));
		live_time_print_short(ns, brief, sizeof(brief));
		live_value_format(FORMAT_AUTO, IEC_TIME, (union iec_value){ .i = ns }, chart,
				  sizeof(chart));
		live_value_print(IEC_TIME, (union iec_value){ .i = ns }, sheet, sizeof(sheet));
		literal = live_value_literal(IEC_TIME, (union iec_value){ .i = ns });
		live_number_print(IEC_TIME, (double)(ns % (9 * S) / MS), curve, sizeof(curve));
		if (!has_unit(text) || !has_unit(brief) || !has_unit(curve) ||
		    strcmp(text, chart) != 0 || strcmp(brief, sheet) != 0 ||
		    strlen(brief) > strlen(text) || !reads(text, ns) || !reads(literal, ns) ||
		    !g_str_has_prefix(literal, "T#")) {
			printf("# %lld: %s, %s, %s\n", (long long)ns, text, brief, literal);
			bad++;
		}
		g_free(literal);
	}
	CHECK(bad == 0);
}

static bool counts(int64_t ns, int64_t goal, const char *expected)
{
	char text[48];

	live_count_print(IEC_TIME, (union iec_value){ .i = ns },
			 (union iec_value){ .i = goal }, text, sizeof(text));
	if (strcmp(text, expected) == 0)
		return true;
	printf("# %s\n", text);
	return false;
}

static void test_counts(void)
{
	CHECK(counts(0, 5 * S, "0.0 s / 5 s"));
	CHECK(counts(3257 * MS, 5 * S, "3.2 s / 5 s"));
	CHECK(counts(5 * S, 5 * S, "5.0 s / 5 s"));
	CHECK(counts(30 * MS, 100 * MS, "30 ms / 100 ms"));
	CHECK(counts(300 * MS, 2550 * MS, "0.3 s / 2.55 s"));
	CHECK(counts(65 * S, 150 * S, "1:05 / 2:30 min"));
	CHECK(counts(65 * S, 7200 * S, "0:01:05 / 2:00:00 h"));
	CHECK(counts(0, 0, "0 s / 0 s"));
}

/* The texts of @count marks from @from on, with blanks between them. */
static bool are_ticks(int64_t from, int64_t step, int count, const char *expected)
{
	char all[256] = "", text[32];

	for (int i = 0; i < count; i++) {
		live_time_print_tick(from + i * step, step, text, sizeof(text));
		g_strlcat(all, i ? ", " : "", sizeof(all));
		g_strlcat(all, text, sizeof(all));
	}
	if (strcmp(all, expected) == 0)
		return true;
	printf("# %s\n", all);
	return false;
}

static void test_ticks(void)
{
	CHECK(are_ticks(0, 2 * S, 3, "0 s, 2 s, 4 s"));
	CHECK(are_ticks(1985 * MS, 5 * MS, 4, "1.985 s, 1.990 s, 1.995 s, 2.000 s"));
	CHECK(are_ticks(980 * MS, 10 * MS, 3, "980 ms, 990 ms, 1.00 s"));
	CHECK(are_ticks(MS / 2, MS / 2, 3, "0.5 ms, 1.0 ms, 1.5 ms"));
	CHECK(are_ticks(59 * S, S / 2, 4, "59.0 s, 59.5 s, 1:00.0 min, 1:00.5 min"));
	CHECK(are_ticks(3590 * S, 20 * S, 2, "59:50 min, 1:00:10 h"));
}

/* What counts in a box: the pins of the standard and those of ClassicLadder. */
static void test_pins(void)
{
	static const struct { const char *word, *now, *goal; } counting[] = {
		{ "TON", "ET", "PT" }, { "CTU", "CV", "PV" }, { "CTUD_DINT", "CV", "PV" },
		{ "CL_TON", "V", "P" }, { "CL_TIMER", "V", "P" }, { "CL_COUNTER", "V", "P" },
	};
	const char *now, *goal;

	for (gsize i = 0; i < G_N_ELEMENTS(counting); i++)
		CHECK_AS(live_word_counts(word_row(word_find(counting[i].word,
				strlen(counting[i].word))), &now, &goal) &&
			 strcmp(now, counting[i].now) == 0 && strcmp(goal, counting[i].goal) == 0,
			 counting[i].word);
	CHECK(!live_word_counts(word_row(word_find("SR", 2)), &now, &goal));
}

int main(void)
{
	test_units();
	test_sweep();
	test_counts();
	test_ticks();
	test_pins();
	return tap_done();
}
