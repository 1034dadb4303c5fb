/* SPDX-License-Identifier: MIT
 *
 * test_ways_out - outputs have their safe values before the first scan and after each way
 * out of RUN.
 *
 * To see short states of a line, ladderd is held at this moment (hold.c): when the kernel
 * reports a requested line, or when a traced output comes through the pipe. RUN, safe and
 * released lines have different levels.
 */
#include "tests/targets/guest/panel.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>

#define SAFE  PANEL_IS_SAFE
#define RUN   PANEL_RUNS
#define PULLS 0xcu /* of outputs that are not driven                         */

static const char *safe_map(void)
{
	return file_text("safe.io", PANEL_SAFE);
}

static void set_up(void)
{
	panel_up(-1);
	bank_pull(&panel, IN0, true);
	for (unsigned i = 0; i < OUTS; i++)
		bank_pull(&panel, OUT0 + i, PULLS >> i & 1);
}

/* Every change of an output goes to the pipe. */
static void start_traced(struct child *child)
{
	const char *argv[] = { guest.ladderd, panel_image(), "--io",
			       safe_map(), "--trace-io", NULL };

	child_start_pipe(child, argv);
	child_ready();
}

static bool outputs_taken(void *context)
{
	(void)context;
	return bank_was_taken(&panel, OUT0 + OUTS - 1);
}

static void before_first_scan(void)
{
	const char *argv[] = { guest.ladderd, panel_image(), "--io",
			       safe_map(), NULL };
	struct child child;
	bool held;

	set_up();
	bank_watch(&panel);
	if (!child_start_held(&child, argv)) {
		const int status = child_stop(&child);

		if (status == NO_PTRACE)
			skip("no ptrace here", "safe values before the first scan");
		else
			check(false, "safe values before the first scan: ladderd cannot be held, status %d",
			      status);
		panel_down();
		return;
	}
	held = child_hold(&child, outputs_taken, NULL);
	sleep_ms(50);
	if (child_is_ready())
		skip("this kernel tells too late who takes a line",
		     "safe values before the first scan");
	else
		check(held && bank_levels(&panel, OUT0, OUTS) == SAFE,
		      "safe values before the first scan");
	child_let_go(&child);
	check(panel_shows(RUN), "then those of the program");
	check(child_stop(&child) == 0, "ends");
	panel_down();
}

static struct child *traced;

static bool at_once(void *context)
{
	(void)context;
	return true;
}

static bool q1_is_safe(void *context)
{
	(void)context;
	return child_line(traced, "%QX0.1 1");
}

static bool q0_is_on(void *context)
{
	(void)context;
	return child_line(traced, "%QX0.0 1");
}

/* Held after the safe values were written and before the lines are released. */
static void by_signal(int signal_number, const char *name)
{
	struct child child;
	uint32_t levels;

	set_up();
	start_traced(&child);
	traced = &child;
	check(panel_shows(RUN), "%s: runs", name);
	q1_is_safe(NULL); /* reads the trace so far         */
	child_hold(&child, at_once, NULL);
	child_signal(&child, signal_number);
	if (child.traced && child_hold(&child, q1_is_safe, NULL)) {
		levels = bank_levels(&panel, OUT0, OUTS);
		check(levels == SAFE, "%s: safe values (%x)", name,
		      (unsigned)levels);
		child_let_go(&child);
	} else if (child.ended) {
		check(false, "%s: safe values before the end", name);
	} else {
		skip("no ptrace here", "%s: safe values", name);
	}
	check(child_end(&child) == 0, "%s: exit status 0", name);
	note("after %s a line of gpio-sim shows its pull: %x, pulls %x", name,
	     (unsigned)bank_levels(&panel, OUT0, OUTS), PULLS);
	panel_down();
}

static void by_fault(void)
{
	struct child child;

	set_up();
	ladderd_start(&child, panel_image(), safe_map(), NULL);
	check(child_ready() && panel_shows(RUN), "fault of the program: runs");
	bank_pull(&panel, IN0 + 3, true);
	check(child_says(&child, "FAULT, outputs are safe"),
	      "a scan that never ends is a FAULT");
	check(bank_levels(&panel, OUT0, OUTS) == SAFE, "with safe values");
	check(strstr(child_status(&child), "state: FAULT\n") != NULL,
	      "which the status shows");
	bank_pull(&panel, IN0 + 3, false);
	bank_pull(&panel, IN0, false);
	bank_pull(&panel, IN0, true);
	sleep_ms(300);
	check(bank_levels(&panel, OUT0, OUTS) == SAFE,
	      "it is latched, whatever the inputs do");
	child_signal(&child, SIGHUP);
	check(panel_shows(RUN), "SIGHUP resets it");
	check(child_stop(&child) == 0, "ends");
	panel_down();
}

/* Held in the middle of a scan, after an output was written, for longer than the
 * watchdog allows. */
static void by_watchdog(void)
{
	struct child child;

	set_up();
	bank_pull(&panel, IN0, false);
	start_traced(&child);
	traced = &child;
	if (!child_hold(&child, at_once, NULL)) {
		skip("no ptrace here", "watchdog");
		child_stop(&child);
		panel_down();
		return;
	}
	bank_pull(&panel, IN0, true);
	child_hold(&child, q0_is_on, NULL);
	check(bank_levels(&panel, OUT0, OUTS) == RUN,
	      "watchdog: a scan is held up");
	sleep_ms(500);
	child_let_go(&child);
	check(panel_shows(SAFE), "watchdog: safe values");
	check(strstr(child_status(&child), "fault: watchdog") != NULL,
	      "watchdog: the status says so");
	child_signal(&child, SIGHUP);
	check(panel_shows(RUN), "watchdog: SIGHUP resets it");
	check(child_stop(&child) == 0, "ends");
	panel_down();
}

static void by_kill(void)
{
	struct child child;
	uint32_t levels;

	set_up();
	ladderd_start(&child, panel_image(), safe_map(), NULL);
	check(child_ready() && panel_shows(RUN), "kill -9: runs");
	child_signal(&child, SIGKILL);
	check(child_end(&child) == CHILD_SIGNAL + SIGKILL, "kill -9: ends");
	levels = bank_levels(&panel, OUT0, OUTS);
	note("after kill -9 the outputs show %x; RUN is %x, safe is %x, the "
	     "pulls are %x", (unsigned)levels, RUN, SAFE, PULLS);
	check(levels == PULLS,
	      "kill -9: a line of gpio-sim shows its pull, as documented");
	ladderd_start(&child, panel_image(), safe_map(), NULL);
	check(child_ready() && panel_shows(RUN),
	      "kill -9: the lines can be had again");
	check(child_stop(&child) == 0, "ends");
	panel_down();
}

void test_ways_out(void)
{
	before_first_scan();
	by_signal(SIGTERM, "SIGTERM");
	by_signal(SIGINT, "SIGINT");
	by_fault();
	by_watchdog();
	by_kill();
}
