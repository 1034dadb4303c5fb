/* SPDX-License-Identifier: MIT
 *
 * suite - the tests of every gpio driver, with fake chips that count calls.
 *
 * It is built once for each version of libgpiod and for the uAPI. It checks what the kernel
 * would see: which calls, in which order, how many, with which flags.
 */
#include "tests/hal/bench.h"

#include <sys/mman.h>

static void test_order(void)
{
	struct bench b;

	chips();
	CHECK(bench_open(&b, "BOARD \"x\"\n%QX0.0 gpio line=OUT0 safe=1\n"
			 "%IX0.0 gpio line=IN0\n%IX0.1 gpio line=IN1\n"
			 "%QX0.1 gpio chip=panel offset=101\n"));
	CHECK(b.hal.request_count == 2);
	CHECK(fake.takes == 2 && fake.reads == 1 && fake.writes == 0);
	CHECK_AS(strchr(fake.calls, 'I') < strchr(fake.calls, 'O'),
		 "inputs are requested before outputs");
	CHECK_AS(strchr(fake.calls, 'r') < strchr(fake.calls, 'O'),
		 "inputs are read before an output is requested");
	CHECK_AS(level("OUT0") == 1 && level("OUT1") == 0,
		 "outputs begin with their safe values");
	fake_clear_calls();
	fake.chip[0].line[1].level = 1;
	CHECK(scan(&b, 0));
	CHECK(!input(&b, 0) && input(&b, 1));
	CHECK_TEXT(fake.calls, "rw");
	CHECK(fake.reads == 1 && fake.writes == 1);
	CHECK_AS(level("OUT0") == 0, "an output has the program's value after a scan");
	fake_clear_calls();
	hal_close(&b.hal);
	CHECK_AS(level("OUT0") == 1 && level("OUT1") == 0,
		 "safe values are written before lines are given back");
	CHECK(strchr(fake.calls, 'w') < strchr(fake.calls, 'x'));
	CHECK(fake.releases == 2 && fake.opens == fake.closes);
	CHECK_AS(fake.settings == 0, "all objects of libgpiod are freed");
	bench_end(&b);
}

static void test_changes(void)
{
	struct bench b;

	chips();
	CHECK(bench_open(&b, "BOARD \"x\"\n%QX0.0 gpio line=OUT0\n"
			 "%QX0.1 gpio line=OUT1\n%QX9.0 gpio line=FAR0\n"));
	CHECK(b.hal.request_count == 2);
	scan(&b, 0);
	CHECK_AS(fake.writes == 0, "unchanged outputs are not written");
	output(&b, 1, true);
	scan(&b, 10 * MS);
	CHECK_AS(fake.writes == 1, "only the request with a changed output is written");
	CHECK(level("OUT0") == 0 && level("OUT1") == 1);
	for (int i = 2; i < 100; i++)
		scan(&b, i * 10 * MS);
	CHECK_AS(fake.writes == 1, "unchanged outputs are not written");
	scan(&b, 1000 * MS);
	CHECK_AS(fake.writes == 2, "a request that was never written is refreshed");
	scan(&b, 1009 * MS);
	CHECK(fake.writes == 2);
	scan(&b, 1010 * MS);
	CHECK_AS(fake.writes == 3, "a request is refreshed a second after its last write");
	output(&b, 72, true);
	fake.chip[0].line[101].level = 0;
	scan(&b, 2010 * MS);
	CHECK_AS(level("OUT1") == 1, "a refresh corrects a disturbed line");
	CHECK(level("FAR0") == 1);
	bench_end(&b);
}

static void test_failed_reads(void)
{
	struct bench b;

	chips();
	CHECK(bench_open(&b, "BOARD \"x\"\n%IX0.0 gpio line=IN0\n"
			 "%QX0.0 gpio line=OUT0 safe=1\n"));
	fake.chip[0].line[0].level = 1;
	CHECK(scan(&b, 0) && input(&b, 0));
	fake.read_error = EIO;
	fake.chip[0].line[0].level = 0;
	CHECK_AS(scan(&b, 1) && input(&b, 0), "a failed read keeps the value");
	CHECK(hal_quality(&b.hal) == QUALITY_STALE);
	CHECK(scan(&b, 2));
	fake.read_error = 0;
	CHECK_AS(scan(&b, 3) && !input(&b, 0), "a good read ends the count");
	CHECK(hal_quality(&b.hal) == QUALITY_GOOD);
	fake.read_error = EIO;
	CHECK(scan(&b, 4) && scan(&b, 5));
	CHECK_AS(!scan(&b, 6), "the third failure in a row is a fault");
	CHECK(hal_quality(&b.hal) == QUALITY_FAULT && b.hal.failed == 5);
	fake_clear_calls();
	CHECK(!scan(&b, 7));
	CHECK_AS(fake.reads == 0, "a line in fault is not read again");
	CHECK_AS(!hal_reopen(&b.hal), "reopening fails while the line fails");
	fake.read_error = 0;
	CHECK_AS(!scan(&b, 8), "a line in fault does not come back by itself");
	CHECK_AS(hal_reopen(&b.hal) && b.hal.reopened == 1, "hal_reopen() ends the fault");
	CHECK(scan(&b, 9) && hal_quality(&b.hal) == QUALITY_GOOD);
	bench_end(&b);
}

static void test_failed_writes(void)
{
	struct bench b;

	chips();
	CHECK(bench_open(&b, "BOARD \"x\"\n%QX0.0 gpio line=OUT0\n"));
	output(&b, 0, true);
	fake.write_error = EIO;
	CHECK(scan(&b, 0) && scan(&b, 1));
	CHECK_AS(fake.writes == 2, "a failed write is repeated");
	fake.write_error = 0;
	CHECK(scan(&b, 2) && level("OUT0") == 1);
	output(&b, 0, false);
	fake.write_error = EIO;
	scan(&b, 2);
	fake.write_error = 0;
	output(&b, 0, true);
	fake_clear_calls();
	CHECK(scan(&b, 2));
	CHECK_AS(fake.writes == 1,
		 "after a failed write the line is written again, also with the old value");
	output(&b, 0, false);
	fake.write_error = EIO;
	CHECK(scan(&b, 3) && scan(&b, 4) && !scan(&b, 5));
	CHECK(!hal_write_safe(&b.hal));
	fake.write_error = 0;
	CHECK_AS(hal_write_safe(&b.hal) && level("OUT0") == 0,
		 "safe values are tried on a line in fault too");
	CHECK_AS(hal_quality(&b.hal) == QUALITY_FAULT, "the request stays in fault");
	CHECK(hal_reopen(&b.hal));
	bench_end(&b);
}

static void test_unplug(void)
{
	struct bench b;

	chips();
	CHECK(bench_open(&b, "BOARD \"x\"\n%IX0.0 gpio line=IN0\n"
			 "%QX0.0 gpio line=OUT0 safe=1\n"));
	output(&b, 0, true);
	scan(&b, 0);
	fake_unplug(0);
	for (int i = 1; i < 4; i++)
		scan(&b, i);
	CHECK(hal_quality(&b.hal) == QUALITY_FAULT);
	hal_write_safe(&b.hal);
	CHECK_AS(!hal_reopen(&b.hal), "hal_reopen() fails while the chip is missing");
	/* The chip comes back with another number, and its lines with the level of a
	 * reset. */
	fake.chip[2] = fake.chip[0];
	fake.chip[2].present = true;
	fake.chip[2].line[100].level = 0;
	hal_write_safe(&b.hal);
	hal_write_safe(&b.hal);
	CHECK_AS(hal_reopen(&b.hal), "a chip with another number is found again");
	CHECK_AS(fake.chip[2].line[100].level == 1, "a reopened output has its safe value");
	CHECK_AS(b.hal.held, "reopened outputs are held");
	output(&b, 0, false);
	scan(&b, 5);
	CHECK(fake.chip[2].line[100].level == 1);
	hal_release(&b.hal);
	scan(&b, 6);
	CHECK(fake.chip[2].line[100].level == 0);
	bench_end(&b);
}

static void test_hold(void)
{
	struct bench b;

	chips();
	CHECK(bench_open(&b, "BOARD \"x\"\n%QX0.0 gpio line=OUT0\n"
			 "%QX0.1 gpio line=OUT1 active-low safe=1\n"
			 "%QX0.2 gpio line=OUT2 active-low\n"));
	CHECK_AS(level("OUT1") == 0 && level("OUT2") == 1,
		 "an active-low line shows its safe value inverted");
	output(&b, 0, true);
	output(&b, 2, true);
	scan(&b, 0);
	CHECK(level("OUT0") == 1 && level("OUT1") == 1 && level("OUT2") == 0);
	CHECK(hal_write_safe(&b.hal));
	CHECK(level("OUT0") == 0 && level("OUT1") == 0 && level("OUT2") == 1);
	fake_clear_calls();
	scan(&b, 2000 * MS);
	CHECK_AS(fake.writes == 0, "held outputs are not written by a scan");
	hal_release(&b.hal);
	scan(&b, 2001 * MS);
	CHECK(level("OUT0") == 1 && level("OUT1") == 1 && level("OUT2") == 0);
	bench_end(&b);
}

/* safe=hold: the last value stays, also after the line was lost. */
static void test_keeps(void)
{
	struct bench b;

	chips();
	CHECK(bench_open(&b, "BOARD \"x\"\n%QX0.0 gpio line=OUT0 safe=hold\n"
			 "%QX0.1 gpio line=OUT1 active-low safe=hold\n%QX0.2 gpio line=OUT2 safe=1\n"));
	CHECK_AS(level("OUT0") == 0 && level("OUT1") == 1 && level("OUT2") == 1,
		 "before the first scan an output that holds is 0");
	output(&b, 0, true);
	output(&b, 1, true);
	scan(&b, 0);
	CHECK(level("OUT0") == 1 && level("OUT1") == 0 && level("OUT2") == 0);
	CHECK(hal_write_safe(&b.hal));
	CHECK_AS(level("OUT0") == 1 && level("OUT1") == 0 && level("OUT2") == 1,
		 "in STOP it has its last value");
	hal_release(&b.hal);
	output(&b, 0, false);
	scan(&b, 1);
	output(&b, 0, true);
	fake.write_error = EIO;
	scan(&b, 2), scan(&b, 3), scan(&b, 4);
	fake.write_error = 0;
	fake.chip[0].line[100].level = 1;
	CHECK(hal_quality(&b.hal) == QUALITY_FAULT && hal_reopen(&b.hal));
	CHECK_AS(level("OUT0") == 0 && level("OUT1") == 0,
		 "a line that comes back gets the value that was written last");
	bench_end(&b);
}

static void test_flags(void)
{
	struct bench b;
	const struct fake_line *line = fake.chip[0].line;

	chips();
	CHECK(bench_open(&b, "BOARD \"x\"\n"
			 "%IX0.0 gpio line=IN0 pull-up active-low\n"
			 "%IX0.1 gpio line=IN1 pull-down\n"
			 "%IX0.2 gpio line=IN2 no-pull\n"
			 "%IX0.3 gpio line=IN3\n"
			 "%QX0.0 gpio line=OUT0 open-drain pull-up\n"
			 "%QX0.1 gpio line=OUT1 open-source\n"
			 "%QX0.2 gpio line=OUT2 push-pull\n"));
	CHECK(line[0].bias == 'u' && line[1].bias == 'd');
	CHECK(line[2].bias == 'n' && line[3].bias == '-');
	CHECK(line[100].drive == 'o' && line[100].bias == 'u');
	CHECK(line[101].drive == 's' && line[102].drive == '-');
	CHECK_TEXT(line[0].owner, "ladderd");
	CHECK(b.hal.request_count == (driver_gpio.same_flags ? 7 : 2));
	fake_clear_calls();
	fake.chip[0].line[1].level = 1;
	scan(&b, 0);
	CHECK_AS(input(&b, 0) && input(&b, 1) && !input(&b, 2),
		 "active low: the low level is TRUE");
	CHECK(fake.reads == (driver_gpio.same_flags ? 4 : 1));
	bench_end(&b);
}

static void test_many(void)
{
	struct bench b;
	char text[8192];
	size_t len = (size_t)snprintf(text, sizeof(text), "BOARD \"x\"\n");

	for (int i = 0; i < 70; i++) {
		len += (size_t)snprintf(text + len, sizeof(text) - len,
			"%%IX%d.%d gpio line=IN%d\n", i / 8, i % 8, i);
		len += (size_t)snprintf(text + len, sizeof(text) - len,
			"%%QX%d.%d gpio line=OUT%d\n", i / 8, i % 8, i);
	}
	chips();
	CHECK(bench_open(&b, text));
	CHECK_AS(b.hal.request_count == 4, "a request has at most 64 lines");
	fake_clear_calls();
	fake.chip[0].line[63].level = fake.chip[0].line[69].level = 1;
	output(&b, 0, true);
	output(&b, 63, true);
	output(&b, 64, true);
	CHECK(scan(&b, 0));
	CHECK(fake.reads == 2 && fake.writes == 2);
	CHECK(input(&b, 63) && input(&b, 69) && !input(&b, 62) &&
	      !input(&b, 64));
	CHECK(level("OUT0") == 1 && level("OUT63") == 1 &&
	      level("OUT64") == 1 && level("OUT62") == 0);
	CHECK(b.hal.bytes > 0 && b.hal.bytes <= hal_memory(&b.map));
	bench_end(&b);
}

static void test_debounce(void)
{
	struct bench b;
	int *key = &fake.chip[0].line[0].level;

	chips();
	*key = 1;
	CHECK(bench_open(&b, "BOARD \"x\"\n%IX0.0 gpio line=IN0 debounce=5ms\n"
			 "%IX0.1 gpio line=IN1\n"));
	scan(&b, 100 * MS);
	CHECK_AS(input(&b, 0), "the first value has no debounce");
	*key = 0;
	scan(&b, 101 * MS);
	fake.chip[0].line[1].level = 1;
	scan(&b, 105 * MS);
	CHECK_AS(input(&b, 0) && input(&b, 1), "a change does not count after 4 ms of 5");
	*key = 1;
	scan(&b, 106 * MS);
	*key = 0;
	scan(&b, 107 * MS);
	scan(&b, 112 * MS - 1);
	CHECK_AS(input(&b, 0), "a bounce restarts the debounce time");
	scan(&b, 112 * MS);
	CHECK_AS(!input(&b, 0), "a change counts after exactly 5 ms");
	*key = 1;
	scan(&b, 113 * MS);
	CHECK_AS(!input(&b, 0), "the next change has its own debounce time");
	scan(&b, 118 * MS);
	CHECK_AS(input(&b, 0), "the next change counts after its debounce time");
	bench_end(&b);
}

static void test_places(void)
{
	struct bench b;

	chips();
	fake.chip[1].line[3].name = "IN0";
	CHECK(refused(&b, "%IX0.0 gpio line=IN0",
		      "LD509: \"IN0\": two lines have this name, on gpiochip0, 1; "
		      "give chip= and offset="));
	CHECK(refused(&b, "%IX0.0 gpio line=NOPE",
		      "LD508: \"NOPE\": this machine has no such line; `ladder io` lists those that it has"));
	CHECK(refused(&b, "%IX0.0 gpio chip=nope offset=1",
		      "LD512: \"nope\": this machine has no such GPIO chip; `ladder io` lists the lines of all chips"));
	CHECK(refused(&b, "%IX0.0 gpio chip=panel offset=200",
		      "LD525: \"panel\" has no line 200: it has 200 lines, from 0 on"));
	CHECK(refused(&b, "%IX0.0 gpio chip=gpiochip7 offset=1",
		      "LD512: \"gpiochip7\": this machine has no such GPIO chip; `ladder io` lists the lines of all chips"));
	fake.chip[1].label = "panel";
	CHECK(refused(&b, "%IX0.0 gpio chip=panel offset=1",
		      "LD521: \"panel\": two chips have this label; use line names"));
	CHECK(refused(&b, "%IX0.0 gpio line=IN1\n"
			  "%IX0.1 gpio chip=gpiochip0 offset=1",
		      "LD507: \"gpiochip0 1\" is used twice in the map, first for "
		      "%IX0.0; remove one of the two lines"));
	CHECK(refused(&b, "%QX0.0 gpio line=IN1\n"
			  "%IX0.1 gpio chip=/dev/gpiochip0 offset=1",
		      "LD518: \"/dev/gpiochip0 1\" is used as an input and as an "
		      "output, first for %QX0.0; remove one of the two lines"));
	CHECK_AS(fake.takes == 0 && fake.opens == fake.closes,
		 "a refused map requests no line");
}

static void test_owners(void)
{
	struct bench b;

	chips();
	fake.chip[0].line[1].used = true;
	fake.chip[0].line[1].owner = "spi0 CS0";
	CHECK(refused(&b, "%IX0.0 gpio line=IN1",
		      "LD510: \"IN1\" is in use by spi0 CS0; end what uses it, or take another line"));
	fake.chip[0].line[1].owner = NULL;
	CHECK(refused(&b, "%QX0.0 gpio line=IN1",
		      "LD510: \"IN1\" is in use by the kernel; end what uses it, or take another line"));
	CHECK(fake.takes == 0);
	fake.take_error = EINVAL;
	CHECK(refused(&b, "%QX0.0 gpio line=OUT0",
		      "LD513: \"OUT0\": the kernel refuses access: gpiochip0: "
		      "Invalid argument; the end of `dmesg` may say why"));
	fake.take_error = 0;
	fake.read_error = EIO;
	CHECK(refused(&b, "%IX0.0 gpio line=IN0\n%QX0.0 gpio line=OUT0 safe=1",
		      "LD522: \"IN0\" does not answer: Input/output error; look at its wires and its supply"));
	CHECK_AS(level("OUT0") == 0,
		 "a map with an input that does not answer requests no output");
	fake.read_error = 0;
	CHECK(bench_deny(0, 0600, 0));
	CHECK(refused_like(&b, "%IX0.0 gpio line=IN0",
		"LD511: no permission to use a GPIO chip; add the user to its "
		"group: gpiochip0 (no group)"));
	CHECK(bench_deny(0, 0660, (long)getegid()));
	CHECK(refused_like(&b, "%IX0.0 gpio chip=panel offset=0",
		"its group: gpiochip0 ("));
	CHECK_AS(!strstr(b.text, "no group"), "the message names the group of the chip");
	CHECK(fake.opens == fake.closes && fake.settings == 0);
}

/* All groups are named, so that no user joins the wrong one. */
static void test_denied(void)
{
	const char *nope = "%IX0.0 gpio line=NOPE";
	struct bench b;

	chips();
	CHECK(bench_deny(0, 0600, 0) && bench_deny(1, 0640, 0));
	CHECK(refused(&b, nope, "its group: gpiochip0, 1 (no group)"));
	CHECK(refused(&b, "%IX0.0 gpio chip=gpiochip1 offset=0",
		      "its group: gpiochip1 (no group)"));
	CHECK(bench_deny(2, 0600, 0) && bench_deny(3, 0600, 0));
	CHECK(refused(&b, nope, "its group: gpiochip0, 1, 2, ... (no group)"));
	fake.chip[0].open_error = EIO;
	CHECK_AS(refused(&b, nope, "its group: gpiochip1, 2, 3 (no group)"),
		 "a missing permission is reported before a read error");
	fake.chip[1].open_error = EPERM;
	CHECK(refused(&b, nope, "its group: gpiochip1, 2, 3 (no group)"));
}

/* ---- another map beside it ---- */

static const char map_a[] = "BOARD \"a\"\n%QX0.0 gpio line=OUT0 safe=1\n%QX0.1 gpio line=OUT1\n"
	"%QX0.2 gpio line=OUT2 safe=1\n%IX0.0 gpio line=IN0\n%IX0.1 gpio line=IN1\n";
static const char map_b[] = "BOARD \"b\"\n%QX0.0 gpio line=OUT0 safe=1\n"
	"%QX1.0 gpio chip=panel offset=101 active-low\n%QX0.2 gpio line=OUT5 safe=1\n"
	"%QX0.3 gpio line=FAR0\n%IX2.1 gpio chip=panel offset=1\n%IX0.7 gpio line=IN7\n";

/* OUT0 is 0 and OUT1 is 1, in each step. */
static int disturbed;
static void watch_levels(void)
{
	disturbed += level("OUT0") != 0 || level("OUT1") != 1;
}

static struct iomap other_map;
static char needs[LIMIT_ARG];

static enum hal_beside beside(struct bench *b, struct hal *next, const char *text)
{
	diag_init(&b->diags);
	needs[0] = '\0';
	if (!iomap_read(&other_map, &b->arena, "other.io", text, strlen(text), &b->diags))
		return BESIDE_REFUSED;
	other_map.dev = bench_dev();
	return hal_beside(next, &b->hal, &other_map, &b->arena, &b->diags, needs);
}

static bool open_watched(struct bench *b)
{
	chips();
	if (!bench_open(b, map_a))
		return false;
	output(b, 1, true);
	scan(b, 0);
	disturbed = 0;
	fake_at_write = fake_at_read = watch_levels;
	return level("OUT0") == 0 && level("OUT1") == 1 && level("OUT2") == 0;
}

static void close_watched(struct bench *b)
{
	fake_at_write = fake_at_read = NULL;
	bench_end(b);
	CHECK(fake.takes == fake.releases && fake.opens == fake.closes && fake.settings == 0);
}

static void test_another_map(void)
{
	struct bench b;
	struct hal next;
	int takes;

	CHECK(open_watched(&b));
	takes = fake.takes;
	CHECK(beside(&b, &next, map_b) == BESIDE_GOOD && fake.takes == takes);
	CHECK(hal_open_new(&next, &b.diags));
	CHECK_AS(fake.takes == takes + 3 && fake.releases == 0, "only new lines are requested");
	CHECK(level("OUT5") == 1 && level("FAR0") == 0);
	scan(&b, 10 * MS);
	hal_exchange(&b.hal, &next);
	CHECK_AS(level("OUT2") == 1, "an output that goes gets its safe value");
	CHECK(fake.takes == takes + 3 && fake.releases == 0 && disturbed == 0);
	hal_close_rest(&next);
	CHECK_AS(fake.releases == 0, "a line stays requested with another one of its request");
	output(&b, 1, false);
	output(&b, 8, false); /* OUT1 is active low now */
	output(&b, 2, false);
	output(&b, 3, true);
	fake.chip[0].line[0].level = fake.chip[0].line[1].level = fake.chip[0].line[7].level = 1;
	image_area(&b.image, AREA_I)[0] = 0;
	scan(&b, 20 * MS);
	CHECK(disturbed == 0 && level("OUT0") == 0 && level("OUT1") == 1);
	CHECK(level("OUT5") == 0 && level("FAR0") == 1 && level("OUT2") == 1);
	CHECK(!input(&b, 0) && !input(&b, 1) && input(&b, 17) && input(&b, 7));
	CHECK(hal_write_safe(&b.hal) && level("OUT2") == 1 && level("OUT0") == 1 &&
	      level("OUT1") == 1 && level("OUT5") == 1);
	close_watched(&b);
}

static void test_another_map_and_back(void)
{
	struct bench b;
	struct hal next;

	CHECK(open_watched(&b));
	CHECK(beside(&b, &next, map_b) == BESIDE_GOOD && hal_open_new(&next, &b.diags));
	hal_exchange(&b.hal, &next);
	output(&b, 3, true);
	output(&b, 2, false);
	scan(&b, 10 * MS);
	CHECK(level("FAR0") == 1 && level("OUT5") == 0);
	output(&b, 1, true);
	hal_exchange(&b.hal, &next);
	CHECK_AS(level("FAR0") == 0 && level("OUT5") == 1, "what only the new map had is safe");
	hal_close_rest(&next);
	CHECK_AS(fake.releases == 3, "and is released");
	scan(&b, 20 * MS);
	CHECK(disturbed == 0 && level("OUT2") == 0);
	close_watched(&b);
}

/* OUT0 goes, and its request stays for OUT1; a scan does not write it. */
static void test_another_map_keeps(void)
{
	struct bench b;
	struct hal next;

	chips();
	CHECK(bench_open(&b, "BOARD \"a\"\n%QX0.0 gpio line=OUT0 safe=hold\n%QX0.1 gpio line=OUT1\n"));
	output(&b, 0, true);
	scan(&b, 0);
	CHECK(beside(&b, &next, "BOARD \"b\"\n%QX0.1 gpio line=OUT1\n") == BESIDE_GOOD &&
	      hal_open_new(&next, &b.diags));
	hal_exchange(&b.hal, &next);
	hal_close_rest(&next);
	output(&b, 1, true);
	scan(&b, 10 * MS);
	CHECK_AS(level("OUT0") == 1 && level("OUT1") == 1, "an output that holds and goes keeps its level");
	bench_end(&b);
}

static void test_a_map_without_lines(void)
{
	struct bench b;
	struct hal next;

	CHECK(open_watched(&b));
	fake_at_write = NULL;
	CHECK(beside(&b, &next, "BOARD \"c\"\n%IX0.0 gpio line=IN0\n%QX0.0 gpio line=FAR0\n") ==
	      BESIDE_GOOD && hal_open_new(&next, &b.diags));
	hal_exchange(&b.hal, &next);
	CHECK_AS(level("OUT0") == 1 && level("OUT1") == 0 && level("OUT2") == 1,
		 "all of a request goes: its outputs are safe");
	CHECK(fake.releases == 0);
	hal_close_rest(&next);
	CHECK_AS(fake.releases == 1, "it is released after that");
	scan(&b, 10 * MS);
	/* A line of the request of IN0 comes back; it was never given back. */
	CHECK(beside(&b, &next, "BOARD \"d\"\n%IX0.5 gpio line=IN1\n%IX0.6 gpio line=IN3\n") ==
	      BESIDE_GOOD && hal_open_new(&next, &b.diags));
	hal_exchange(&b.hal, &next);
	hal_close_rest(&next);
	CHECK(fake.releases == 2);
	fake.chip[0].line[1].level = 1;
	scan(&b, 20 * MS);
	CHECK(input(&b, 5) && !input(&b, 6));
	close_watched(&b);
}

static void test_maps_that_cannot_be_exchanged(void)
{
	static const struct { const char *text, *name; enum hal_beside why; } cases[] = {
		{ "%QX0.0 gpio line=OUT0 open-drain", "OUT0", BESIDE_RESTART },
		{ "%IX0.0 gpio line=IN0 pull-up", "IN0", BESIDE_RESTART },
		{ "%IX0.3 gpio line=OUT1", "OUT1", BESIDE_RESTART },
		{ "%QX0.7 gpio chip=panel offset=1", "panel 1", BESIDE_RESTART },
		{ "%QX0.0 gpio line=OUT99999", "", BESIDE_REFUSED },
		{ "%QX0.0 gpio line=OUT9", "", BESIDE_REFUSED },
		{ "%QX0.0 gpio line=OUT0\n%QX0.1 gpio chip=panel offset=100", "", BESIDE_REFUSED },
	};
	struct bench b;
	struct hal next;

	CHECK(open_watched(&b));
	fake.chip[0].line[109].used = true;
	fake.chip[0].line[109].owner = "spi";
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		char text[200];

		snprintf(text, sizeof(text), "BOARD \"x\"\n%s\n", cases[i].text);
		CHECK(beside(&b, &next, text) == cases[i].why);
		CHECK_TEXT(needs, cases[i].name);
		CHECK((b.diags.errors > 0) == (cases[i].why == BESIDE_REFUSED));
	}
	CHECK(fake.takes == 2 && fake.releases == 0 && disturbed == 0);
	CHECK(beside(&b, &next, map_b) == BESIDE_GOOD);
	fake.take_error = EBUSY;
	CHECK(!hal_open_new(&next, &b.diags) && b.diags.errors == 1);
	diag_print(&b.diags.diag[0], b.text, sizeof(b.text));
	CHECK_AS(strstr(b.text, "IN7") || strstr(b.text, "OUT5"), "the line is named");
	fake.take_error = 0;
	fake.takes = 2; /* those that failed took nothing */
	scan(&b, 10 * MS);
	CHECK(disturbed == 0 && level("OUT1") == 1);
	close_watched(&b);
}

/* Groups that are not in /etc/group. */
static void test_groups(void)
{
	const char *nope = "%IX0.0 gpio line=NOPE";
	struct bench b;

	if (geteuid() != 0) {
		printf("ok %d # SKIP only root gives a file to any group\n",
		       ++tap_count);
		return;
	}
	chips();
	CHECK(bench_deny(0, 0600, 0) && bench_deny(1, 0660, 54321));
	CHECK_AS(refused(&b, nope, "its group: gpiochip1 (54321); 0 (no group)"),
		 "a chip with a group is named before chips without one");
	CHECK(bench_deny(0, 0660, 54321) && bench_deny(2, 0660, 54320));
	CHECK_AS(refused(&b, nope, "its group: gpiochip2 (54320); 0, 1 (54321)"),
		 "the message names every group");
	CHECK(bench_deny(3, 0660, 1234567890) && bench_deny(0, 0660, 123456789));
	CHECK(bench_deny(1, 0660, 123456788) && bench_deny(2, 0660, 123456780));
	CHECK_AS(refused(&b, nope, "its group: gpiochip2 (123456780); 1 (123456788); "
			 "0 (123456789); others"),
		 "a message without room for all groups ends with others");
}

/* Raspberry Pi OS has links from old numbers to new ones. */
static void test_links(void)
{
	struct bench b;
	char path[250];

	chips();
	snprintf(path, sizeof(path), "%s/gpiochip9", bench_dev());
	CHECK(symlink("gpiochip0", path) == 0);
	CHECK_AS(bench_open(&b, "BOARD \"x\"\n%IX0.0 gpio line=IN0\n"
			    "%IX0.1 gpio chip=gpiochip9 offset=5\n"),
		 "a link is not a second chip, and may be named");
	CHECK(b.hal.request_count == 1);
	unlink(path);
	bench_end(&b);
}

static int seen_lines, seen_used;
static void visit(void *context, const struct line_seen *line)
{
	(void)context;
	seen_lines++;
	seen_used += line->used;
	if (line->offset == 1 && strcmp(line->chip, "gpiochip0") == 0) {
		CHECK_TEXT(line->label, "panel");
		CHECK_TEXT(line->name, "IN1");
		CHECK_TEXT(line->owner, "spi");
	}
}

static void test_list(void)
{
	struct bench b;

	chips();
	fake.chip[0].line[1].used = true;
	fake.chip[0].line[1].owner = "spi";
	bench_begin(&b);
	CHECK(hal_list(bench_dev(), visit, NULL, &b.diags));
	CHECK(seen_lines == 208 && seen_used == 1);
	fake.chip[0].open_error = EACCES;
	CHECK(!hal_list(bench_dev(), visit, NULL, &b.diags));
	CHECK_AS(seen_lines == 216,
		 "a chip that can be opened is listed beside one that cannot");
	CHECK(b.diags.diag[0].id == DIAG_IO_PERMISSION);
	bench_end(&b);
	bench_begin(&b);
	CHECK(bench_deny(0, 0600, 0) && bench_deny(1, 0600, 0));
	CHECK(!hal_list(bench_dev(), visit, NULL, &b.diags));
	CHECK_AS(strcmp(b.diags.diag[0].arg, "gpiochip0, 1 (no group)") == 0,
		 "the message names every chip without permission");
	bench_end(&b);
}

static void test_check(void)
{
	struct bench b;

	chips();
	bench_begin(&b);
	CHECK(bench_map(&b, "BOARD \"x\"\n%IX0.0 gpio line=IN0\n"
			"%QX0.0 gpio line=NOPE\n%QX0.1 gpio line=NOPE2\n"));
	CHECK(!hal_check(&b.map, &b.arena, &b.diags));
	CHECK_AS(b.diags.errors == 2, "every error of the map is reported");
	CHECK(b.diags.diag[1].line == 4 && b.diags.diag[1].column == 1);
	CHECK(fake.takes == 0 && fake.opens == fake.closes);
	bench_end(&b);
}

/* ---- what fails ---- */

static bool nothing_is_open(void)
{
	bool none = fake.opens == fake.closes && fake.settings == 0;

	for (int chip = 0; chip < FAKE_CHIPS; chip++)
		for (int i = 0; i < FAKE_LINES; i++)
			none = none && !fake.chip[chip].line[i].used;
	return none;
}

/* Four lines, so that a map makes few calls: IN0, IN1, IN2, OUT0. */
static void few_lines(void)
{
	chips();
	fake.chip[0].lines = 4;
	fake.chip[0].line[3].name = "OUT0";
	fake.chip[1].present = false;
}

static const char few_points[] = "BOARD \"x\"\n%IX0.0 gpio line=IN0\n%IX0.1 gpio chip=panel offset=2 pull-up\n"
	"%QX0.0 gpio line=OUT0\n";

/* Each call of the library or the kernel fails once. @error: its errno. */
static void each_call_fails(int error, const char *as)
{
	int silent = 0, open = 0, dead = 0, count = 0;

	for (bool failed = true; failed; count++) {
		struct bench b;
		bool good;

		few_lines();
		fake.good_calls = count + 1;
		fake.call_error = error;
		bench_begin(&b);
		good = bench_map(&b, few_points) && hal_open(&b.hal, &b.map, &b.arena, &b.diags);
		failed = fake.call_failed;
		diag_print(&b.diags.diag[0], b.text, sizeof(b.text));
		silent += good ? b.diags.errors != 0 :
				 b.diags.errors != 1 || !strstr(b.text, "error LD5");
		dead += good && !scan(&b, 0);
		bench_end(&b);
		open += !nothing_is_open();
	}
	CHECK_AS(silent == 0 && dead == 0, as);
	CHECK_AS(open == 0, "after a call that failed nothing stays open");
	CHECK_AS(count > 20, "there are calls that can fail");
}

static void test_calls_that_fail(void)
{
	each_call_fails(EIO, "a call fails with EIO: one message");
	each_call_fails(EACCES, "a call fails with EACCES: one message");
	each_call_fails(ENODEV, "a call fails with ENODEV: one message");
	each_call_fails(EBUSY, "a call fails with EBUSY: one message");
	if (strncmp(gpio_version(), "2.", 2) == 0)
		each_call_fails(0, "a call fails without an errno: one message");
}

/* A reopened line whose calls fail stays in fault; the next try may succeed. */
static void test_reopening_fails(void)
{
	int wrong = 0, count = 0;

	for (bool failed = true; failed; count++) {
		struct bench b;
		bool good;

		few_lines();
		if (!CHECK(bench_open(&b, few_points)))
			return;
		fake.read_error = fake.write_error = EIO;
		for (int i = 0; i < HAL_FAILURES; i++) {
			output(&b, 0, i % 2 == 0);
			scan(&b, i);
		}
		fake.read_error = fake.write_error = 0;
		fake.good_calls = count + 1;
		fake.call_error = EIO;
		fake.call_failed = false;
		good = hal_reopen(&b.hal);
		failed = fake.call_failed;
		wrong += good != (hal_quality(&b.hal) == QUALITY_GOOD) || (!good && !failed);
		fake.good_calls = 0;
		wrong += !hal_reopen(&b.hal) || hal_quality(&b.hal) != QUALITY_GOOD;
		bench_end(&b);
		wrong += !nothing_is_open();
	}
	CHECK_AS(wrong == 0 && count > 10, "a line that cannot be reopened is in fault until it can");
}

static int listed, listed_biases;
static void see_bias(void *context, const struct line_seen *line)
{
	static const enum io_bias want[] = { BIAS_UP, BIAS_DOWN, BIAS_NONE, BIAS_AS_IS };

	(void)context;
	listed++;
	listed_biases += line->bias == want[line->offset];
}

static void test_list_what_answers(void)
{
	int count = 0, wrong = 0;

	for (bool failed = true; failed; count++) {
		struct bench b;
		bool good;

		few_lines();
		for (int i = 0; i < 4; i++)
			fake.chip[0].line[i].bias = "udn-"[i];
		fake.good_calls = count + 1;
		fake.call_error = EIO;
		listed = listed_biases = 0;
		bench_begin(&b);
		good = hal_list(bench_dev(), see_bias, NULL, &b.diags);
		failed = fake.call_failed;
		wrong += listed != listed_biases ||
			 (good ? listed != (failed ? 3 : 4) : !failed || (listed != 0 && listed != 4));
		wrong += good != (b.diags.errors == 0) || !nothing_is_open();
		bench_end(&b);
	}
	CHECK_AS(wrong == 0 && count > 4, "lines that answer are listed with their bias, one that fails is left out");
}

/* Another program takes or removes something between the search and the request. */
static int opens_left, meanwhile;
static void meanwhile_at_open(void)
{
	char path[250];

	if (opens_left-- != 0)
		return;
	if (meanwhile) {
		snprintf(path, sizeof(path), "%s/gpiochip0", bench_dev());
		unlink(path);
		fake.chip[0].open_error = EACCES;
	} else {
		fake.chip[0].line[0].used = true;
		fake.chip[0].line[0].owner = fake.chip[0].label ? "other" : NULL;
	}
}

static bool meanwhile_says(const char *lines, int opens, int what, const char *label, const char *want)
{
	struct bench b;
	FILE *file;
	char path[250];
	bool good;

	few_lines();
	fake.chip[0].label = label;
	opens_left = opens;
	meanwhile = what;
	fake_at_open = meanwhile_at_open;
	good = refused_like(&b, lines, want);
	fake_at_open = NULL;
	snprintf(path, sizeof(path), "%s/gpiochip0", bench_dev());
	file = fopen(path, "w");
	if (file)
		fclose(file);
	return good;
}

static void test_meanwhile(void)
{
	struct bench b;

	CHECK(meanwhile_says("%IX0.0 gpio line=IN0", 1, 0, "panel", "LD510: \"IN0\" is in use by other; end what uses it, or take another line"));
	CHECK(meanwhile_says("%IX0.0 gpio line=IN0", 1, 0, NULL, "LD510: \"IN0\" is in use by the kernel; end what uses it, or take another line"));
	CHECK(meanwhile_says("%IX0.1 gpio line=IN1\n%IX0.0 gpio line=IN0", 2, 0, "panel",
			     "LD510: \"IN0\" is in use by other; end what uses it, or take another line"));
	CHECK(meanwhile_says("%IX0.0 gpio line=IN0", 0, 1, "panel", "gpiochip0 (?)"));
	few_lines();
	fake.take_error = EPERM;
	CHECK(bench_deny(0, 0600, 0));
	fake.chip[0].open_error = 0;
	CHECK(refused_like(&b, "%IX0.0 gpio line=IN0", "LD511"));
	few_lines();
	fake.take_error = EBUSY;
	CHECK_AS(refused_like(&b, "%IX0.0 gpio line=IN0", "LD513"), "no line of the request is in use");
	few_lines();
	fake.chip[0].open_error = EIO;
	CHECK(refused(&b, "%IX0.0 gpio line=IN0",
		      "LD513: \"gpiochip0\": the kernel refuses access: Input/output error; the end of `dmesg` may say why"));
	bench_begin(&b);
	CHECK(!hal_list(bench_dev(), see_bias, NULL, &b.diags) && b.diags.errors == 1);
	diag_print(&b.diags.diag[0], b.text, sizeof(b.text));
	CHECK_AS(strstr(b.text, "gpiochip0") && strstr(b.text, "Input/output error"), "a list names the chip that fails");
	bench_end(&b);
	bench_begin(&b);
	listed = 0;
	CHECK_AS(hal_list("/nowhere", see_bias, NULL, &b.diags) && listed == 0, "a machine without chips has no lines");
	bench_end(&b);
}

/* Files in /dev that only look like chips, and a chip that is named by its path. */
static void test_names_of_chips(void)
{
	static const char *const odd[] = { "gpiochip", "gpiochipx", "gpiochip1x", "gpiochip99999999999", "gpio0" };
	struct bench b;
	char path[250], text[400];

	few_lines();
	for (size_t i = 0; i < sizeof(odd) / sizeof(odd[0]); i++) {
		snprintf(path, sizeof(path), "%s/%s", bench_dev(), odd[i]);
		fclose(fopen(path, "w"));
	}
	snprintf(text, sizeof(text), "BOARD \"x\"\n%%IX0.0 gpio chip=\"%s/gpiochip0\" offset=1\n", bench_dev());
	CHECK_AS(bench_open(&b, text), "a chip may be named by its path");
	bench_end(&b);
	snprintf(text, sizeof(text), "%%IX0.0 gpio chip=\"%sx/gpiochip0\" offset=1", bench_dev());
	CHECK_AS(refused_like(&b, text, "LD512"), "a path into another folder is no chip");
	CHECK(refused_like(&b, "%IX0.0 gpio chip=gpiochip1x offset=1", "LD512"));
	CHECK(refused_like(&b, "%IX0.0 gpio chip=gpiochip99999999999 offset=1", "LD512"));
	CHECK(fake.opens == fake.closes);
	for (size_t i = 0; i < sizeof(odd) / sizeof(odd[0]); i++) {
		snprintf(path, sizeof(path), "%s/%s", bench_dev(), odd[i]);
		unlink(path);
	}
	few_lines();
	fake.chip[0].line[1].name = fake.chip[0].line[2].name = "IN0";
	CHECK_AS(refused(&b, "%IX0.0 gpio line=IN0", "on gpiochip0, 0; give chip= and offset="),
		 "three lines of a name: the first two are told");
}

/* Each line of a request has another bias and drive. The kernel takes ten kinds in one request. */
static void test_kinds_of_lines(void)
{
	static const char *const bias[] = { "", "no-pull", "pull-up", "pull-down" };
	static const char *const drive[] = { "", "open-drain", "open-source" };
	const bool uapi = strcmp(gpio_library(), "uAPI") == 0;

	for (int kinds = 1; kinds <= 12; kinds++) {
		struct bench b;
		char text[2000];
		size_t len = (size_t)snprintf(text, sizeof(text), "BOARD \"x\"\n");
		bool good;

		for (int i = 0; i < 2 * kinds; i++)
			len += (size_t)snprintf(text + len, sizeof(text) - len, "%%QX%d.%d gpio line=OUT%d %s %s\n",
						i / 8, i % 8, i, bias[i / 2 % 4], drive[i / 2 / 4]);
		chips();
		bench_begin(&b);
		good = bench_map(&b, text) && hal_open(&b.hal, &b.map, &b.arena, &b.diags);
		CHECK_AS(good == (!uapi || kinds <= 10), "lines of several kinds");
		if (good)
			for (int i = 0; i < 2 * kinds; i++) {
				const struct fake_line *line = &fake.chip[0].line[100 + i];

				if (line->bias != "-nud"[i / 2 % 4] || line->drive != "-os"[i / 2 / 4])
					CHECK_AS(false, "each line has its own bias and drive");
			}
		else
			CHECK(b.diags.errors == 1 && b.diags.diag[0].id == DIAG_IO_REQUEST);
		bench_end(&b);
		CHECK(nothing_is_open());
	}
}

/* ---- memory runs out ---- */

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_mmap64(void *at, size_t size, int prot, int flags, int file, off_t offset);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_mmap64(void *at, size_t size, int prot, int flags, int file, off_t offset);

static int blocks_left = -1; /* -1: all that one wants */
static bool has_refused;

static bool may_have_block(void)
{
	if (blocks_left == 0) {
		has_refused = true;
		errno = ENOMEM;
		return false;
	}
	blocks_left -= blocks_left > 0;
	return true;
}

void *__wrap_malloc(size_t size)
{
	return may_have_block() ? __real_malloc(size) : NULL;
}

void *__wrap_calloc(size_t count, size_t size)
{
	return may_have_block() ? __real_calloc(count, size) : NULL;
}

void *__wrap_mmap64(void *at, size_t size, int prot, int flags, int file, off_t offset)
{
	return may_have_block() ? __real_mmap64(at, size, prot, flags, file, offset) : MAP_FAILED;
}

static bool told_no_memory(const struct bench *b)
{
	for (int i = 0; i < b->diags.count; i++)
		if (b->diags.diag[i].id == DIAG_NO_MEMORY)
			return true;
	return false;
}

/* The first chunk of an arena has 4000 bytes. */
static void leave_room(struct arena *arena, size_t room)
{
	arena_alloc(arena, 8);
	arena_alloc(arena, 4000 - 8 - room);
}

static const char roomy_map[] = "BOARD \"x\"\nBUS plant modbus-tcp host=10.0.0.20\n%IX0.0 gpio line=IN0\n"
	"%IX0.1 gpio chip=panel offset=1\n%QX0.0 gpio line=OUT0 safe=1\n%QX9.0 gpio line=FAR0\n"
	"%IW10 modbus bus=plant unit=1 input-register=5\n%QW10 modbus bus=plant unit=1 holding-register=7\n"
	"%IX200.0 quality of=%IW10\n";

/* Behind each eight bytes of an arena, and at each block. @room: of the arena; -1: as much as it wants. */
static bool opens_with(int room, int blocks)
{
	struct bench b;
	struct arena arena;
	bool good;

	chips();
	bench_begin(&b);
	arena_init(&arena);
	if (!bench_map(&b, roomy_map))
		return CHECK(false);
	if (room >= 0)
		leave_room(&arena, (size_t)room);
	has_refused = false;
	blocks_left = blocks;
	good = hal_open(&b.hal, &b.map, &arena, &b.diags);
	blocks_left = -1;
	if (good ? has_refused : !told_no_memory(&b))
		CHECK_AS(false, "without memory a map is refused, and that is told");
	bench_end(&b);
	arena_free(&arena);
	if (!nothing_is_open())
		CHECK_AS(false, "without memory nothing stays open");
	return good;
}

static bool exchanges_with(int room, int blocks)
{
	struct bench b;
	struct arena arena;
	struct hal next;
	enum hal_beside result;

	chips();
	arena_init(&arena);
	if (!CHECK(bench_open(&b, map_a) && iomap_read(&other_map, &b.arena, "other.io", roomy_map,
							     strlen(roomy_map), &b.diags)))
		return true;
	other_map.dev = bench_dev();
	scan(&b, 0);
	if (room >= 0)
		leave_room(&arena, (size_t)room);
	has_refused = false;
	blocks_left = blocks;
	result = hal_beside(&next, &b.hal, &other_map, &arena, &b.diags, needs);
	blocks_left = -1;
	if (result == BESIDE_GOOD ? has_refused : !told_no_memory(&b) || result != BESIDE_REFUSED)
		CHECK_AS(false, "without memory another map is refused, and that is told");
	if (result == BESIDE_GOOD && hal_open_new(&next, &b.diags)) {
		hal_exchange(&b.hal, &next);
		hal_close_rest(&next);
	}
	output(&b, 0, true);
	if (!scan(&b, 10 * MS) || level("OUT0") != 1)
		CHECK_AS(false, "without memory the old map goes on, with it the new one");
	bench_end(&b);
	arena_free(&arena);
	if (!nothing_is_open())
		CHECK_AS(false, "without memory nothing stays open");
	return result == BESIDE_GOOD;
}

static const char rich_map[] = "BOARD \"x\"\nBUS a modbus-rtu port=/dev/ttyS1 baud=9600\nBUS t modbus-tcp host=[::1]:502\n"
	"SERVE s modbus-tcp listen=[::1]:1502\nWINDOW s coil=0..7 %QX0.0 read-write\n"
	"BUS p peer interface=lo group=239.1.1.1:5\nPUBLISH me A,B, C every=1s bus=p\n"
	"DEVICE a unit=1 read-registers=9 gap=0\nMODULE M di=3 discrete-input=7\n%XIB0..2 module bus=a unit=2 type=M substitute=hold\n"
	"%AIW0 iio device=\"d e\" channel=voltage0 range=-5..5 at -10V..10mV limits=-11V..1V\n"
	"%IX20.0..1 modbus bus=a unit=1 input-register=3 bit=0 ask=Drive\n%ID8 peer bus=p from=x name=y\n"
	"%IX30.0 gpio line=IN0\n%IX30.1 gpio chip=panel offset=1\n%IB32 quality of=%ID8\n";

static bool reads_with(int room, int blocks)
{
	struct bench b;
	bool good;

	bench_begin(&b);
	if (room >= 0)
		leave_room(&b.arena, (size_t)room);
	has_refused = false;
	blocks_left = blocks;
	good = bench_map(&b, rich_map);
	blocks_left = -1;
	if (good ? has_refused : !told_no_memory(&b))
		CHECK_AS(false, "without memory a map is not read, and that is told");
	diag_print(&b.diags.diag[0], b.text, sizeof(b.text));
	arena_free(&b.arena);
	return good;
}

/* The blocks that it takes until there are enough of them; then with one less, wherever the arena needs it. */
static void each_block_is_missing(bool (*try)(int room, int blocks), const char *as)
{
	int blocks = 0;

	while (blocks < 100 && !try(-1, blocks))
		blocks++;
	CHECK_AS(blocks > 0 && blocks < 100, as);
	for (int most = blocks; blocks >= 0 && most - blocks < 8; blocks--)
		for (int room = 0; room < 3900 && !try(room, blocks); room += 8)
			;
}

static void test_no_memory(void)
{
	each_block_is_missing(reads_with, "a map is read as soon as there is memory");
	each_block_is_missing(opens_with, "a map opens as soon as there is memory");
	each_block_is_missing(exchanges_with, "another map is taken as soon as there is memory");
}

int main(void)
{
	if (!bench_dev())
		return 1;
	test_order();
	test_changes();
	test_failed_reads();
	test_failed_writes();
	test_unplug();
	test_hold();
	test_keeps();
	test_flags();
	test_many();
	test_debounce();
	test_places();
	test_owners();
	test_denied();
	test_groups();
	test_links();
	test_list();
	test_check();
	test_another_map();
	test_another_map_and_back();
	test_another_map_keeps();
	test_a_map_without_lines();
	test_maps_that_cannot_be_exchanged();
	test_calls_that_fail();
	test_reopening_fails();
	test_list_what_answers();
	test_meanwhile();
	test_names_of_chips();
	test_kinds_of_lines();
	test_no_memory();
	bench_remove_dev();
	return tap_done();
}
