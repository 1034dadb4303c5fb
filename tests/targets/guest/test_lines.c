/* SPDX-License-Identifier: MIT
 *
 * test_lines - lines are found by name, and by chip label and offset; the map of the
 * S3C44B0X board; 16 inputs and 16 outputs.
 */
#include "tests/targets/guest/panel.h"

#include <stdio.h>
#include <string.h>

#define WIDE 16

struct bank panel;

void panel_up(int hog)
{
	static const char *const names[] = {
		"IN0", "IN1", "IN2", "IN3", "OUT0", "OUT1", "OUT2", "OUT3",
	};

	bank_up(&panel, "panel", names, 8, hog);
}

void panel_down(void)
{
	bank_down(&panel);
}

bool panel_shows(uint32_t want)
{
	return bank_shows(&panel, OUT0, OUTS, want, LIMIT_MS);
}

const char *panel_image(void)
{
	return file_case("panel.rungc");
}

/* Q0 and Q1 follow the inputs, Q2 is Q0 inverted, Q3 is on. */
static bool follows(void)
{
	bool good = true;

	for (unsigned pattern = 0; pattern < 4; pattern++) {
		uint32_t want = pattern | (~pattern & 1) << 2 | 8;

		bank_pull(&panel, IN0, pattern & 1);
		bank_pull(&panel, IN0 + 1, pattern & 2);
		good = panel_shows(want) && good;
	}
	return good;
}

static void found_by(const char *how, const char *map)
{
	struct child child;

	panel_up(-1);
	ladderd_start(&child, panel_image(), file_text("panel.io", map), NULL);
	check(child_ready() != 0 && follows(), "lines found by %s", how);
	check(child_stop(&child) == 0, "and given back");
	panel_down();
}

/* Keys and LEDs are active low; keys have a debounce. */
static void board_44b0x(void)
{
	static const char *const names[] = {
		"KEY1", "KEY2", "KEY3", "LED1", "LED2", "LED3", "LED4",
	};
	struct bank board;
	struct child child;
	bool good;

	bank_up(&board, "s3c44b0x", names, 7, -1);
	for (unsigned i = 0; i < 3; i++)
		bank_pull(&board, i, true);
	ladderd_start(&child, panel_image(), file_case("s3c44b0x.io"), NULL);
	good = child_ready() && bank_shows(&board, 3, 4, 0x3, LIMIT_MS);
	check(good, "S3C44B0X map: keys at rest, LEDs 1 and 2 off");
	bank_pull(&board, 0, false);
	good = bank_shows(&board, 3, 4, 0x6, LIMIT_MS);
	bank_pull(&board, 1, false);
	good = bank_shows(&board, 3, 4, 0x4, LIMIT_MS) && good;
	bank_pull(&board, 0, true);
	good = bank_shows(&board, 3, 4, 0x1, LIMIT_MS) && good;
	check(good, "S3C44B0X map: LEDs follow the keys");
	check(child_stop(&child) == 0, "and ends");
	bank_down(&board);
}

static void wide_levels(struct bank *bank, uint32_t levels)
{
	for (unsigned i = 0; i < WIDE; i++)
		bank_pull(bank, i, levels >> i & 1);
}

static void wide(void)
{
	static const uint32_t patterns[] = { 0, 0xffff, 0x5555, 0xaaaa,
					     0x00ff };
	struct bank bank;
	struct child child;
	unsigned good = 0;

	bank_up(&bank, "wide", NULL, 2 * WIDE, -1);
	ladderd_start(&child, file_case("copy16.rungc"),
		      file_case("copy16.io"), "--period", "1ms", NULL);
	check(child_ready() != 0, "16 inputs, 16 outputs");
	for (unsigned i = 0; i < WIDE; i++) {
		wide_levels(&bank, UINT32_C(1) << i);
		good += bank_shows(&bank, WIDE, WIDE, UINT32_C(1) << i,
				   LIMIT_MS);
	}
	check(good == WIDE, "each input moves its own output: %u of 16", good);
	good = 0;
	for (unsigned i = 0; i < 5; i++) {
		wide_levels(&bank, patterns[i]);
		good += bank_shows(&bank, WIDE, WIDE, patterns[i], LIMIT_MS);
	}
	check(good == 5, "and all of them together");
	check(strstr(child_status(&child), "32 lines in 2 requests") != NULL,
	      "one request for inputs, one for outputs");
	check(child_stop(&child) == 0, "and ends");
	bank_down(&bank);
}

void test_lines(void)
{
	found_by("name", PANEL_PLAIN);
	found_by("label of the chip and offset",
		 "BOARD \"panel\"\n"
		 "%IX0.0 gpio chip=panel offset=0\n"
		 "%IX0.1 gpio chip=panel offset=1\n"
		 "%IX0.3 gpio chip=panel offset=3\n"
		 "%QX0.0 gpio chip=panel offset=4 safe=0\n"
		 "%QX0.1 gpio chip=panel offset=5 safe=0\n"
		 "%QX0.2 gpio chip=panel offset=6 safe=0\n"
		 "%QX0.3 gpio chip=panel offset=7 safe=0\n");
	found_by("both in one map",
		 "BOARD \"panel\"\n"
		 "%IX0.0 gpio line=IN0\n"
		 "%IX0.1 gpio chip=panel offset=1\n"
		 "%IX0.3 gpio line=IN3\n"
		 "%QX0.0 gpio chip=panel offset=4 safe=0\n"
		 "%QX0.1 gpio line=OUT1 safe=0\n"
		 "%QX0.2 gpio chip=panel offset=6 safe=0\n"
		 "%QX0.3 gpio line=OUT3 safe=0\n");
	board_44b0x();
	wide();
}
