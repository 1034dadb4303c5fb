/* SPDX-License-Identifier: MIT
 *
 * test_options - the options of a line on real lines: active-low, bias, drive, debounce.
 */
#include "tests/targets/guest/panel.h"

#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>

static void run_with(struct child *child, const char *map)
{
	panel_up(-1);
	ladderd_start(child, panel_image(), file_text("panel.io", map),
		      "--period", "1ms", "--watchdog", "1000", NULL);
	if (!child_ready())
		check(false, "runs with the map:\n%s", map);
}

static void done_with(struct child *child, const char *what)
{
	check(child_stop(child) == 0, "%s: ends", what);
	panel_down();
}

static void active_low(void)
{
	struct child child;

	/* Without a wire all inputs except I3 are TRUE: Q0 and Q1 on, Q2 off, Q3 on. */
	panel_up(-1);
	bank_pull(&panel, IN0 + 3, true);
	ladderd_start(&child, panel_image(),
		      file_text("panel.io",
				PANEL_OFF("active-low", "active-low",
					  "active-low", "active-low", "")),
		      NULL);
	check(child_ready() && panel_shows(0x4 | 0x8),
	      "active-low: low inputs are TRUE, TRUE outputs are low");
	bank_pull(&panel, IN0, true);
	check(panel_shows(0x1 | 0x8), "active-low: a high input is FALSE");
	done_with(&child, "active-low");
}

static void bias(void)
{
	static const char *const maps[] = {
		PANEL_OFF("no-pull", "", "", "", ""),
		PANEL_OFF("", "push-pull", "push-pull", "push-pull",
			  "push-pull"),
	};
	struct child child;

	/* The driver of the kernel sets the pull, which moves the line. */
	run_with(&child, PANEL_OFF("pull-down", "", "", "", ""));
	check(panel_shows(0xc), "pull-down: inputs are FALSE");
	done_with(&child, "pull-down");
	run_with(&child,
		 "BOARD \"panel\"\n"
		 "%IX0.0 gpio line=IN0 pull-up\n%IX0.1 gpio line=IN1 pull-up\n"
		 "%IX0.3 gpio line=IN3 pull-up active-low\n"
		 "%QX0.0 gpio line=OUT0 safe=0\n%QX0.1 gpio line=OUT1 safe=0\n"
		 "%QX0.2 gpio line=OUT2 safe=0\n%QX0.3 gpio line=OUT3 safe=0\n");
	check(panel_shows(0xb), "pull-up: inputs are TRUE");
	done_with(&child, "pull-up");
	for (unsigned i = 0; i < 2; i++) {
		run_with(&child, maps[i]);
		bank_pull(&panel, IN0, true);
		check(panel_shows(0x9), "%s: accepted",
		      i ? "push-pull" : "no-pull");
		done_with(&child, "and");
	}
	/* An open drain pulls down or releases; then the line has the level of its pull. */
	run_with(&child, PANEL_OFF("", "open-drain", "", "", "open-drain"));
	check(panel_shows(0x4), "open-drain: without a pull-up all is low");
	bank_pull(&panel, OUT0 + 3, true);
	bank_pull(&panel, OUT0, true);
	check(panel_shows(0xc), "open-drain: 1 lets go, 0 pulls down");
	done_with(&child, "open-drain");
}

/* Makes pulses of 1 ms on IN0 for @ms. Returns the longest one in ms: if the guest was
 * not scheduled, they are longer. Pulses must not be in step with scans, so their period
 * is odd and the kernel must not wake both programs together, as it does with timers
 * that are near. */
static int64_t bounce(int64_t ms, bool *moved, bool rest)
{
	int64_t end_ns = clock_now() + ms * MS, longest_ns = 0;

	*moved = false;
	prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
	while (clock_now() < end_ns) {
		int64_t begin_ns = clock_now();

		bank_pull(&panel, IN0, !rest);
		sleep_until(begin_ns + MS);
		bank_pull(&panel, IN0, rest);
		if (clock_now() - begin_ns > longest_ns)
			longest_ns = clock_now() - begin_ns;
		sleep_until(begin_ns + 2 * MS + 370000);
		*moved = *moved || bank_level(&panel, OUT0) != rest;
	}
	prctl(PR_SET_TIMERSLACK, 0UL, 0UL, 0UL, 0UL);
	return longest_ns / MS;
}

static void bounces(bool rest)
{
	int64_t longest = 0;
	bool moved = false;

	for (int attempt = 0; attempt < 5; attempt++) {
		longest = bounce(300, &moved, rest);
		if (longest < 15)
			break;
	}
	check(longest < 15 && !moved,
	      "debounce=20ms: 1 ms pulses from %d are not seen "
	      "(longest %ld ms)", rest, (long)longest);
}

static void debounce(void)
{
	struct child child;
	int64_t begin_ns, seen_ns;
	bool up;

	run_with(&child, PANEL_OFF("debounce=20ms", "", "", "", ""));
	panel_shows(0xc);
	bounces(false);
	begin_ns = clock_now();
	bank_pull(&panel, IN0, true);
	up = panel_shows(0x9);
	seen_ns = clock_now() - begin_ns;
	check(up && seen_ns >= 19 * MS,
	      "debounce=20ms: a clean level is seen, not before its time");
	note("a level was seen after %ld.%ld ms, debounce 20 ms, period 1 ms",
	     (long)(seen_ns / MS), (long)(seen_ns % MS * 10 / MS));
	bounces(true);
	bank_pull(&panel, IN0, false);
	check(panel_shows(0xc), "debounce=20ms: and the way back");
	done_with(&child, "debounce");
}

void test_options(void)
{
	active_low();
	bias();
	debounce();
}
