/* SPDX-License-Identifier: MIT
 *
 * test_steady - 10,000 scans of 1 ms: no page fault and no more memory after the start. It
 * prints the wake-up times and, for comparison, those of cyclictest, if the guest has it,
 * and of a plain sleep, which is the loop of cyclictest without its thread. They never fail
 * a test.
 */
#include "tests/targets/guest/panel.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SCANS 10000
#define CYCLICTEST "/cyclictest"
#define WAKES 5000
#define WAIT_MOST 2000 /* us; longer ones count as this                   */

static uint16_t waits[WAIT_MOST + 1]; /* number of wake-ups by delay      */

struct memory {
	unsigned long faults; /* minor and major                             */
	char pages[64];       /* /proc/PID/statm                             */
	bool known;
};

/* Number @at (1-based) of /proc/PID/stat, counted after the name, which may contain
 * blanks. */
static unsigned long stat_number(const char *text, int at)
{
	const char *field = strrchr(text, ')');

	for (int i = 2; field && i < at; i++)
		field = strchr(field + 1, ' ');
	return field ? strtoul(field + 1, NULL, 10) : 0;
}

static struct memory look(const struct child *child)
{
	struct memory now = { .known = false };
	char path[64], text[512];

	snprintf(path, sizeof(path), "/proc/%d/stat", (int)child->pid);
	if (file_take(path, text, sizeof(text)) <= 0)
		return now;
	now.faults = stat_number(text, 10) + stat_number(text, 12);
	snprintf(path, sizeof(path), "/proc/%d/statm", (int)child->pid);
	now.known = file_take(path, now.pages, sizeof(now.pages)) > 0;
	now.pages[strcspn(now.pages, "\n")] = 0;
	return now;
}

static void press(int times)
{
	for (int i = 0; i < times; i++) {
		bank_pull(&panel, IN0, i % 2 == 0);
		sleep_ms(20);
	}
}

static void show(const char *status, const char *word)
{
	const char *line = strstr(status, word);

	if (line)
		note("%.*s", (int)strcspn(line, "\n"), line);
}

static void run_for(struct child *child)
{
	struct memory before, after;
	long first, scans = 0;
	const char *status;

	press(10);
	child_status(child);
	sleep_ms(500);
	first = child_number(child_status(child), "scans:");
	before = look(child);
	for (int i = 0; i < 100 && scans < SCANS; i++) {
		sleep_ms(1000);
		press(2);
		scans = child_number(child_status(child), "scans:") - first;
	}
	after = look(child);
	check(scans >= SCANS, "10,000 scans of 1 ms were done");
	if (!before.known || !after.known) {
		skip("no /proc here", "page faults and memory");
		return;
	}
	check(before.faults == after.faults,
	      "no page fault in %ld scans (%lu, then %lu)", scans,
	      before.faults, after.faults);
	check(strcmp(before.pages, after.pages) == 0,
	      "memory is constant (pages %s, then %s)", before.pages,
	      after.pages);
	status = child_status(child);
	show(status, "scan: ");
	show(status, "wake-up: ");
	show(status, "late: ");
}

/* The delay that a @share of the wake-ups did not exceed; -1: beyond the histogram. */
static long within(double share)
{
	long sum = 0;

	for (long wait = 0; wait <= WAIT_MOST; wait++) {
		sum += waits[wait];
		if ((double)sum >= share * WAKES)
			return wait;
	}
	return -1;
}

static void show_waits(const char *of)
{
	note("%s: wake-up p50 %ld us, p99 %ld us, p99.9 %ld us", of,
	     within(0.5), within(0.99), within(0.999));
}

/* The lines `MICROSECONDS COUNT` of a histogram. */
static void take_waits(const char *lines)
{
	memset(waits, 0, sizeof(waits));
	for (; *lines; lines += strcspn(lines, "\n"), lines += *lines == '\n') {
		char *count;
		long wait;

		if (*lines < '0' || *lines > '9')
			continue;
		wait = strtol(lines, &count, 10);
		if (wait <= WAIT_MOST)
			waits[wait] += (uint16_t)strtoul(count, NULL, 10);
	}
}

static void *no_work(void *nothing)
{
	return nothing;
}

/* The kind of cyclictest decides what can be compared. */
static void why_no_cyclictest(void)
{
	pthread_t thread;
	int error = pthread_create(&thread, NULL, no_work, NULL);

	if (!error)
		pthread_join(thread, NULL);
	if (error)
		note("no cyclictest: it measures in a thread, and here "
		     "pthread_create says: %s", strerror(error));
	else
		note("no cyclictest: threads work here, but %s",
		     guest.small ? "the one to be had is linked with shared "
		     "libraries, which want an MMU" : "it was not brought along");
}

/* The same period and priority as ladderd. */
static void beside_cyclictest(void)
{
	static const char *const argv[] = {
		CYCLICTEST, "-q", "-t", "1", "-i", "1000", "-l", "5000", "-h",
		"800", NULL
	};
	struct child child;

	if (!file_is_there(CYCLICTEST)) {
		why_no_cyclictest();
		return;
	}
	child_start(&child, 1, argv);
	check(child_end(&child) == 0, "cyclictest of the same guest ran");
	take_waits(child_out(&child));
	show_waits("cyclictest (-1: over 800)");
}

/* A program that only sleeps until its next deadline. */
static void beside_bare_sleep(void)
{
	int64_t deadline_ns = clock_now();

	memset(waits, 0, sizeof(waits));
	for (int i = 0; i < WAKES; i++) {
		int64_t late_ns;

		deadline_ns += MS;
		sleep_until(deadline_ns);
		late_ns = clock_now() - deadline_ns;
		waits[late_ns < WAIT_MOST * 1000 ? late_ns / 1000 :
						   WAIT_MOST]++;
		/* Missed deadlines are skipped, as by cyclictest. */
		deadline_ns += late_ns / MS * MS;
	}
	show_waits("bare sleep of this guest");
}

void test_steady(void)
{
	struct child child;

	panel_up(-1);
	ladderd_start(&child, panel_image(), file_text("panel.io", PANEL_PLAIN),
		      "--period", "1ms", "--watchdog", "1000", NULL);
	if (check(child_ready() != 0, "runs"))
		run_for(&child);
	check(child_stop(&child) == 0, "ends");
	beside_cyclictest();
	beside_bare_sleep();
	panel_down();
}
