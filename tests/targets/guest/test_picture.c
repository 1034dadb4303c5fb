/* SPDX-License-Identifier: MIT
 *
 * test_picture - `ladder io` on a real kernel: the variable and the owner of each line and,
 * if the kernel has debugfs, its level.
 */
#define _DEFAULT_SOURCE /* mount() */
#include "tests/targets/guest/panel.h"

#include <string.h>
#include <sys/mount.h>

#define LADDER "/ladder"
#define LEVELS "/sys/kernel/debug/gpio"

/* The line of the picture that begins with an address. */
static const char *row(const char *picture, const char *address)
{
	static char text[160];
	const char *line = strstr(picture, address);

	if (!line)
		return "";
	text[0] = 0;
	strncat(text, line, sizeof(text) - 1);
	text[strcspn(text, "\n")] = 0;
	return text;
}

static const char *take_picture(const char *map)
{
	const char *const argv[] = { LADDER, "io", map, "--program",
				     file_case("panel.rung"), NULL };
	struct child child;

	child_start(&child, 1, argv);
	check(child_end(&child) == 0, "ladder io answers");
	return child_out(&child);
}

/* The output has a level; the input has one if the driver of the kernel reports it. */
static bool shows(const char *picture, const char *in, const char *out)
{
	const char *text = row(picture, "%QX0.2");
	bool good = strstr(text, out) != NULL;

	text = row(picture, "%IX0.0");
	return good && (strstr(text, in) || strstr(text, "input  - "));
}

static void show_levels(void)
{
	static char text[TEXT_BYTES];

	text[0] = 0;
	if (file_take(LEVELS, text, sizeof(text)) < 0)
		note("%s cannot be read", LEVELS);
	for (const char *line = text; *line; line += *line == '\n') {
		note("%.*s", (int)strcspn(line, "\n"), line);
		line += strcspn(line, "\n");
	}
}

static void look(const char *map)
{
	const char *picture = take_picture(map), *in0, *out2;

	in0 = row(picture, "%IX0.0");
	check(strstr(in0, "IN0") && strstr(in0, "gpiochip") &&
	      strstr(in0, "ladderd"), "an input: %s", in0);
	out2 = row(picture, "%QX0.2");
	check(strstr(out2, "OUT2") && strstr(out2, "output") &&
	      strstr(out2, "ladderd"), "an output: %s", out2);
	if (!file_is_there(LEVELS)) {
		skip("this kernel has no debugfs", "levels of lines");
		return;
	}
	if (!check(shows(picture, "input  low", "output high"),
		   "levels: the input is low, its inverse high"))
		show_levels();
	bank_pull(&panel, IN0, true);
	panel_shows(9);
	picture = take_picture(map);
	check(shows(picture, "input  high", "output low"),
	      "and the other way round when the line moves");
}

void test_picture(void)
{
	struct child child;
	const char *map;

	if (!file_is_there(LADDER)) {
		skip("the command line is not on this machine", "ladder io");
		return;
	}
	mount("debug", "/sys/kernel/debug", "debugfs", 0, NULL);
	panel_up(-1);
	map = file_text("picture.io", PANEL_PLAIN);
	ladderd_start(&child, panel_image(), map, NULL);
	if (check(child_ready() != 0, "runs") && panel_shows(0xc))
		look(map);
	check(child_stop(&child) == 0, "ends");
	panel_down();
}
