/* SPDX-License-Identifier: MIT
 *
 * test_starts - no output differs from its safe value before the first scan is complete, in any
 * start; and how long a program of 10,000 elements takes to its first scan.
 *
 * A held ladderd is looked at after each of its system calls. A line that nobody holds shows its
 * pull, which is the safe level: so each level that is not safe was written by ladderd.
 */
#include "tests/targets/guest/panel.h"

#include <stdio.h>
#include <string.h>

#define ALL       ((1u << OUTS) - 1)
#define LARGE     3    /* starts of the large program                         */
#define LARGE_MS  1000
#define LINE_MOST 96

struct start {
	uint32_t safe, run;    /* levels, one bit for each output             */
	unsigned looks;
	uint32_t first;        /* the first levels that are not safe          */
};

static uint32_t chance(void)
{
	static uint32_t state = 0x9e3779b9;

	state ^= state << 13;
	state ^= state >> 17;
	state ^= state << 5;
	return state >> 8;
}

/* A map with safe values and active-low by chance. In RUN the outputs are I0, I1, not I0 and 1, and
 * I0 is 1: the first scan changes the last one at least. */
static const char *any_map(struct start *start, bool second_input)
{
	static char text[(OUTS + 5) * LINE_MOST];
	const uint32_t low = chance() & ALL, safe = chance() & ALL & ~8u;
	const uint32_t run = 1u | (uint32_t)second_input << 1 | 8u;
	size_t len = (size_t)snprintf(text, sizeof(text), "BOARD \"panel\"\n");

	for (int i = 0; i < 4; i++)
		len += (size_t)snprintf(text + len, sizeof(text) - len, "%%IX0.%d gpio line=IN%d\n", i, i);
	for (int i = 0; i < OUTS; i++)
		len += (size_t)snprintf(text + len, sizeof(text) - len,
					"%%QX0.%d gpio line=OUT%d %s safe=%d\n", i, i,
					low >> i & 1 ? "active-low" : "", (int)(safe >> i & 1));
	start->safe = safe ^ low;
	start->run = run ^ low;
	return file_text("starts.io", text);
}

static bool is_not_safe(void *context)
{
	struct start *start = context;

	start->looks++;
	start->first = bank_levels(&panel, OUT0, OUTS);
	return start->first != start->safe;
}

/* One start. Returns whether the first levels that are not safe are those of a whole scan; -1: it
 * cannot be held here. */
static int one_start(unsigned *looks)
{
	struct start start = { .looks = 0 };
	const bool second_input = chance() & 1;
	const char *argv[] = { guest.ladderd, panel_image(), "--io", any_map(&start, second_input), NULL };
	struct child child;
	int good;

	bank_pull(&panel, IN0, true);
	bank_pull(&panel, IN0 + 1, second_input);
	for (unsigned i = 0; i < OUTS; i++)
		bank_pull(&panel, OUT0 + i, start.safe >> i & 1);
	if (!child_start_held(&child, argv)) {
		child_stop(&child);
		return -1;
	}
	good = child_hold(&child, is_not_safe, &start) && start.first == start.run && !child_is_ready();
	child_let_go(&child);
	good = good && child_ready() && panel_shows(start.run);
	good = child_stop(&child) == 0 && good;
	*looks += start.looks;
	return good;
}

static void safe_until_scanned(void)
{
	unsigned looks = 0;
	int good = 0, one = 0;

	panel_up(-1);
	for (int i = 0; i < guest.starts && one >= 0; i++) {
		one = one_start(&looks);
		good += one > 0;
		if ((i + 1) % 50 == 0)
			note("%d of %d starts", i + 1, guest.starts);
	}
	panel_down();
	if (one < 0) {
		skip("no ptrace here", "starts, held");
		return;
	}
	note("%d starts: the outputs were looked at %u times before the first scan", guest.starts, looks);
	check(good == guest.starts, "in %d of %d starts no output differs from its safe value before the "
	      "first scan is complete", good, guest.starts);
}

/* @file is `ten-thousand.rung` or its image. */
static void large(const char *file)
{
	int64_t longest_ns = 0;
	int good = 0;

	for (int i = 0; i < LARGE; i++) {
		const int64_t since_ns = clock_now();
		struct child child;
		int64_t ready_ns;

		ladderd_start(&child, file_case(file), file_text("large.io", "BOARD \"large\"\n%QX0.0 sim safe=0\n"),
			      NULL);
		ready_ns = child_ready();
		good += ready_ns && child_stop(&child) == 0;
		if (ready_ns - since_ns > longest_ns)
			longest_ns = ready_ns - since_ns;
	}
	note("%s, 10,000 elements: %ld us at most until its first scan", file, (long)(longest_ns / 1000));
	check(good == LARGE && longest_ns < LARGE_MS * MS, "%s runs within %d ms", file, LARGE_MS);
}

void test_starts(void)
{
	safe_until_scanned();
	if (guest.small) {
		skip("tier small", "a program of 10,000 elements");
		return;
	}
	large("ten-thousand.rungc");
	large("ten-thousand.rung");
}
