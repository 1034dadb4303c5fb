/* SPDX-License-Identifier: MIT
 *
 * test_guard - ladder-guard with a ladderd that dies or freezes at random moments.
 *
 * A line that nobody holds shows its pull. The pulls are the levels of RUN, as on a chip that
 * keeps the level when its process dies: only a guard that holds the lines makes them safe. Times
 * are those of this guest, from the signal to the last moment at which a line was not safe, as
 * the kernel's own files of the lines show them. Each ladderd begins LATE_MS late, so that the
 * guard's levels are seen also where computing takes no time.
 */
#define _GNU_SOURCE /* __WALL */
#include "tests/targets/guest/panel.h"

#include <dirent.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#define HEARTBEAT_MS 100
#define BOUND_MS     100  /* from a death until the outputs are safe          */
#define LATE_MS      "40"
#define LOOK_NS      (MS / 10)
#define STAYS_NS     (20 * MS) /* safe for so long: the guard holds them      */
#define GIVE_UP_NS   (5000 * MS)
#define TIMES        1000

static char map[PATH_MOST], binary[PATH_MOST];
static int64_t took_ns[TIMES];
static int took;

static uint32_t chance(uint32_t below)
{
	static uint32_t state = 0x2545f491;

	state ^= state << 13;
	state ^= state >> 17;
	state ^= state << 5;
	return state % below;
}

static void set_up(void)
{
	panel_up(-1);
	bank_pull(&panel, IN0, true);
	for (unsigned i = 0; i < OUTS; i++)
		bank_pull(&panel, OUT0 + i, PANEL_RUNS >> i & 1);
	snprintf(map, sizeof(map), "%s", file_text("guard.io", PANEL_SAFE));
}

static void start(struct child *guard)
{
	const char *argv[] = { binary, "--heartbeat", "100", "--", guest.self, "--late", LATE_MS,
			       guest.ladderd, panel_image(), "--io", map, NULL };

	child_start(guard, 0, argv);
}

/* The process that @parent has started; 0: none. */
static pid_t child_of(pid_t parent)
{
	DIR *all = opendir("/proc");
	const struct dirent *each;
	char path[PATH_MOST], text[512];
	pid_t found = 0;

	while (all && !found && (each = readdir(all)) != NULL) {
		const char *end;

		if (each->d_name[0] < '0' || each->d_name[0] > '9')
			continue;
		snprintf(path, sizeof(path), "/proc/%.20s/stat", each->d_name);
		if (file_take(path, text, sizeof(text)) <= 0 || !(end = strrchr(text, ')')))
			continue;
		if (strtol(end + 4, NULL, 10) == parent && end[2] != 'Z')
			found = (pid_t)strtol(each->d_name, NULL, 10);
	}
	if (all)
		closedir(all);
	return found;
}

static bool runs(void)
{
	return child_ready() && panel_shows(PANEL_RUNS);
}

/* Looks at the lines until they stay safe. Returns the time from @since until they were; -1: they
 * never stay so. */
static int64_t safe_after(int64_t since_ns)
{
	int64_t safe_ns = 0;

	for (;;) {
		const int64_t now_ns = clock_now();

		if (bank_levels(&panel, OUT0, OUTS) != PANEL_IS_SAFE)
			safe_ns = 0;
		else if (!safe_ns)
			safe_ns = now_ns;
		if (safe_ns && now_ns - safe_ns >= STAYS_NS)
			return safe_ns - since_ns;
		if (now_ns - since_ns > GIVE_UP_NS)
			return -1;
		sleep_until(now_ns + LOOK_NS);
	}
}

static void keep(int64_t ns)
{
	if (took < TIMES)
		took_ns[took++] = ns;
}

static int compare(const void *a, const void *b)
{
	const int64_t first = *(const int64_t *)a, second = *(const int64_t *)b;

	return (first > second) - (first < second);
}

/* Prints how long it took; whether all were within @bound_ms. */
static bool figures(const char *what, int64_t bound_ms)
{
	if (!took)
		return false;
	qsort(took_ns, (size_t)took, sizeof(took_ns[0]), compare);
	note("%s: safe after p50 %ld us, max %ld us", what, (long)(took_ns[(took - 1) / 2] / 1000),
	     (long)(took_ns[took - 1] / 1000));
	return took_ns[0] >= 0 && took_ns[took - 1] <= bound_ms * MS;
}

/* @count ends by @signals in turn. A third one within a minute begins in STOP, so each guard sees
 * two. */
static void ends(const char *what, int count, const int *signals, int kinds, int64_t bound_ms)
{
	int again = 0, safe = 0, orderly = 0, guards = 0;
	struct child guard = { .pipe = -1 };

	took = 0;
	for (int i = 0; i < count; i++) {
		int64_t since_ns, ns;
		pid_t pid;

		if (i % 2 == 0) {
			start(&guard);
			guards++;
			if (!runs())
				break;
		}
		pid = child_of(guard.pid);
		sleep_until(clock_now() + chance(20000) * INT64_C(1000));
		since_ns = clock_now();
		if (pid <= 1 || kill(pid, signals[i % kinds]) != 0)
			break;
		ns = safe_after(since_ns);
		keep(ns);
		safe += ns >= 0;
		again += runs() && child_of(guard.pid) != pid;
		if (i % 2 || i + 1 == count)
			orderly += child_stop(&guard) == 0;
	}
	check(safe == count, "%d %s: the outputs are safe %d times", count, what, safe);
	check(figures(what, bound_ms), "%s: within %ld ms", what, (long)bound_ms);
	check(strstr(child_err(&guard), "; the outputs are safe\n") != NULL, "%s: it is told", what);
	check(again == count, "%s: ladderd runs again %d times", what, again);
	check(orderly == guards, "%s: SIGTERM ends both, %d of %d times", what, orderly, guards);
}

static bool at_once(void *context)
{
	(void)context;
	return true;
}

/* It stands still in a system call, as with a driver that does not come back. */
static void hangs_in_a_call(void)
{
	struct child guard, ladderd = { .pipe = -1 };
	int64_t since_ns, ns;

	start(&guard);
	if (!check(runs(), "a system call that hangs: runs"))
		return;
	ladderd.pid = child_of(guard.pid);
	sleep_ms(3);
	if (!child_hold(&ladderd, at_once, NULL)) {
		skip("no ptrace here", "a system call that hangs");
		child_stop(&guard);
		return;
	}
	since_ns = clock_now();
	waitpid(ladderd.pid, NULL, __WALL); /* the parent of what is traced learns its end afterwards */
	ns = safe_after(since_ns);
	note("a system call that hangs: safe after %ld us", (long)(ns / 1000));
	check(ns >= 0 && ns <= (HEARTBEAT_MS + BOUND_MS) * MS,
	      "a system call that hangs: the guard kills ladderd and holds the lines");
	check(runs(), "a system call that hangs: ladderd runs again");
	check(child_stop(&guard) == 0, "a system call that hangs: ends");
}

static void three_ends(void)
{
	struct child guard;

	start(&guard);
	for (int i = 0; i < 3; i++) {
		if (!runs())
			break;
		kill(child_of(guard.pid), SIGKILL);
		if (i < 2)
			continue;
		check(child_says(&guard, "3 times within 60 s: it begins in STOP"),
		      "three deaths: the guard tells it");
	}
	check(safe_after(clock_now()) >= 0, "three deaths: the outputs are safe");
	check(child_ready() && strstr(child_status(&guard), "state: STOP\n") != NULL,
	      "three deaths: ladderd lives, in STOP");
	check(bank_levels(&panel, OUT0, OUTS) == PANEL_IS_SAFE, "three deaths: they stay safe");
	check(child_stop(&guard) == 0, "three deaths: ends");
}

static void first_of_all(bool first)
{
	struct sched_param wanted = { .sched_priority = first ? 60 : 0 };

	sched_setscheduler(0, first ? SCHED_FIFO : SCHED_OTHER, &wanted);
}

void test_guard(void)
{
	static const int deaths[] = { SIGSEGV, SIGFPE, SIGBUS, SIGABRT, SIGKILL };
	static const int freezes[] = { SIGSTOP };
	const char *folder = strrchr(guest.ladderd, '/');

	snprintf(binary, sizeof(binary), "%.*s/ladder-guard",
		 folder ? (int)(folder - guest.ladderd) : 1, folder ? guest.ladderd : ".");
	if (!file_is_there(binary)) {
		skip("no ladder-guard here", "the guard");
		return;
	}
	set_up();
	first_of_all(true); /* that looks at the lines, also while others compute */
	ends("deaths", guest.kills, deaths, 5, BOUND_MS);
	ends("freezes", guest.stops, freezes, 1, HEARTBEAT_MS + BOUND_MS);
	hangs_in_a_call();
	three_ends();
	first_of_all(false);
	panel_down();
}
