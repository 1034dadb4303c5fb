/* SPDX-License-Identifier: MIT
 *
 * test_calls - a scan makes one ioctl per input request and at most one for outputs.
 *
 * `LADDERD-count` is the same program, linked with a counter (count/). Two runs of
 * different lengths are compared, so that starting and ending do not count. Both are
 * shorter than the second after which unchanged outputs are written again.
 */
#include "tests/targets/guest/panel.h"

#include <stdio.h>
#include <string.h>

struct cost {
	long get, set, other;
	long requests; /* inputs and outputs together                        */
};

static char counting[PATH_MOST];

static struct cost run_for(const char *image, const char *map,
			   const char *scans)
{
	const char *argv[] = { counting, image, "--io", map, "--period", "1ms",
			       "--watchdog", "1000", "--scans", scans, NULL };
	struct child child;
	struct cost cost;
	const char *text;

	child_start(&child, 0, argv);
	if (child_end(&child) != 0)
		return (struct cost){ -1, -1, -1, -1 };
	text = child_err(&child);
	cost = (struct cost){ child_number(text, "ioctl get"),
			      child_number(text, "ioctl set"),
			      child_number(text, "ioctl other"), -1 };
	text = strstr(child_out(&child), " lines in ");
	if (text)
		cost.requests = text[10] - '0';
	return cost;
}

static void compare(const char *what, const char *image, const char *map,
		    long sets)
{
	struct cost few, many;
	long reads;

	panel_up(-1);
	few = run_for(image, map, "100");
	many = run_for(image, map, "300");
	reads = many.requests - 1; /* one request has all outputs           */
	check(few.get > 0 && many.get - few.get == 200 * reads,
	      "%s: one ioctl a scan for each of %ld input requests", what,
	      reads);
	check(few.set >= 0 && many.set - few.set == 200 * sets,
	      "%s: %s for outputs", what,
	      sets ? "one in each scan in which they change" : "none");
	check(few.other >= 0 && many.other == few.other, "%s: no other", what);
	if (many.get - few.get != 200 * reads ||
	    many.set - few.set != 200 * sets)
		note("100 scans: %ld get, %ld set; 300: %ld, %ld", few.get,
		     few.set, many.get, many.set);
	panel_down();
}

void test_calls(void)
{
	snprintf(counting, sizeof(counting), "%s-count", guest.ladderd);
	if (!file_is_there(counting)) {
		skip("no NAME-count beside this ladderd",
		     "ioctls of a scan are counted");
		return;
	}
	compare("inputs at rest", panel_image(),
		file_text("panel.io", PANEL_PLAIN), 0);
	compare("an output that blinks", file_case("blink.rungc"),
		file_text("panel.io", PANEL_PLAIN), 1);
	compare("inputs with two kinds of bias", panel_image(),
		file_text("bias.io",
			  "BOARD \"panel\"\n"
			  "%IX0.0 gpio line=IN0 pull-down\n"
			  "%IX0.1 gpio line=IN1 pull-up\n"
			  "%IX0.3 gpio line=IN3 pull-down\n"
			  "%QX0.0 gpio line=OUT0 safe=0\n%QX0.1 gpio line=OUT1 safe=0\n"
			  "%QX0.2 gpio line=OUT2 safe=0\n%QX0.3 gpio line=OUT3 safe=0\n"),
		0);
}
