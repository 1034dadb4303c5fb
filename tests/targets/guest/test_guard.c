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
#define MOST_KB      1536 /* resident, with glibc: 860 on arm64; with musl 192 on armhf */

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

/* Looks at the lines until they stay at these levels. Returns the time from @since until they were;
 * -1: they never stay so. */
static int64_t stays_after(int64_t since_ns, uint32_t levels)
{
	int64_t safe_ns = 0;

	for (;;) {
		const int64_t now_ns = clock_now();

		if (bank_levels(&panel, OUT0, OUTS) != levels)
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

static int64_t safe_after(int64_t since_ns)
{
	return stays_after(since_ns, PANEL_IS_SAFE);
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
		if ((i + 1) % 10 == 0)
			note("%d of %d %s", i + 1, count, what);
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

/* What the kernel counts page by page; the figure of /proc/PID/status lags behind. */
static void is_small(void)
{
	static char text[4096];
	char path[PATH_MOST];
	struct child guard;
	long kb = -1;

	start(&guard);
	check(runs(), "memory: runs");
	snprintf(path, sizeof(path), "/proc/%d/smaps_rollup", (int)guard.pid);
	if (file_take(path, text, sizeof(text)) > 0)
		kb = child_number(text, "Rss:");
	if (kb < 0)
		skip("no smaps_rollup here", "memory of the guard");
	else
		check(kb <= MOST_KB, "memory: %ld of %d kB resident", kb, MOST_KB);
	check(child_stop(&guard) == 0, "memory: ends");
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

/* ---- each way out of RUN, each safe value ---- */

/* In RUN: Q0 1, Q1 1, Q2 0, Q3 1. Safe: Q0 0, Q2 1, the others hold; Q3 is active-low. */
#define WAYS_MAP                                                              \
	"BOARD \"ways\"\n%IX0.0 gpio line=WAY0\n%IX0.2 gpio line=WAY2\n"       \
	"%IX0.3 gpio line=WAY3\n%QX0.0 gpio line=OUT0 safe=0\n"               \
	"%QX0.1 gpio line=OUT1 safe=hold\n%QX0.2 gpio line=OUT2 safe=1\n"     \
	"%QX0.3 gpio line=OUT3 active-low safe=hold\n"
#define WAYS_RUN  0x3u
#define WAYS_SAFE 0x6u
#define UNSEEN    UINT32_MAX /* no ptrace here                                */

static struct bank ways;           /* the inputs, which can be unplugged alone */

static bool is_safe_now(void *context)
{
	(void)context;
	return bank_levels(&panel, OUT0, OUTS) == WAYS_SAFE;
}

static uint32_t by_stop(struct child *guard)
{
	bank_pull(&ways, 2, true);
	check(child_says(guard, "STOP, outputs are safe"), "STOP: it is told");
	return bank_levels(&panel, OUT0, OUTS);
}

static uint32_t by_program_fault(struct child *guard)
{
	bank_pull(&ways, 3, true);
	check(child_says(guard, "FAULT, outputs are safe"), "program fault: it is told");
	return bank_levels(&panel, OUT0, OUTS);
}

/* One late scan is too many (--watchdog 1). Shorter than the limit of 10 ms and the 20 ms after which the
 * guard ends a scan that stands still. */
static uint32_t by_late_scan(struct child *guard)
{
	const pid_t pid = child_of(guard->pid);

	kill(pid, SIGSTOP);
	sleep_ms(25);
	kill(pid, SIGCONT);
	check(child_says(guard, "watchdog"), "watchdog: it is told");
	return bank_levels(&panel, OUT0, OUTS);
}

static uint32_t by_lost_inputs(struct child *guard)
{
	bank_unplug(&ways);
	check(child_says(guard, "FAULT, outputs are safe"), "I/O fault: it is told");
	return bank_levels(&panel, OUT0, OUTS);
}

/* Held before the lines are released, after which they show their pulls. */
static uint32_t by_sigterm(struct child *guard)
{
	struct child ladderd = { .pipe = -1, .pid = child_of(guard->pid) };
	uint32_t levels = WAYS_RUN;

	if (!child_hold(&ladderd, at_once, NULL))
		return UNSEEN;
	child_signal(guard, SIGTERM);
	if (child_hold(&ladderd, is_safe_now, NULL))
		levels = bank_levels(&panel, OUT0, OUTS);
	child_let_go(&ladderd);
	check(child_end(guard) == 0, "SIGTERM: both end with status 0");
	return levels;
}

static uint32_t by_sigkill(struct child *guard)
{
	const int64_t since_ns = clock_now();

	kill(child_of(guard->pid), SIGKILL);
	return stays_after(since_ns, WAYS_SAFE) >= 0 ? WAYS_SAFE : bank_levels(&panel, OUT0, OUTS);
}

static void one_way(const char *name, uint32_t (*leave)(struct child *guard))
{
	static const char *const kind[OUTS] = { "off", "hold", "on", "hold, active-low" };
	const char *names[] = { "WAY0", NULL, "WAY2", "WAY3" };
	struct child guard = { .pipe = -1 };
	const char *argv[] = { binary, "--heartbeat", "1000", "--", guest.self, "--late", LATE_MS,
			       guest.ladderd, file_case("ways.rungc"), "--io", map, "--watchdog", "1", NULL };
	uint32_t levels;

	bank_up(&ways, "ways", names, 4, -1);
	bank_pull(&ways, 0, true);
	child_start(&guard, 0, argv);
	if (!check(child_ready() && panel_shows(WAYS_RUN), "%s: runs", name)) {
		child_stop(&guard);
		bank_down(&ways);
		return;
	}
	levels = leave(&guard);
	if (levels == UNSEEN)
		skip("no ptrace here", "%s: the outputs", name);
	for (unsigned i = 0; i < OUTS && levels != UNSEEN; i++)
		check((levels >> i & 1) == (WAYS_SAFE >> i & 1), "%s: %s", name, kind[i]);
	if (leave == by_sigkill)
		check(child_ready() && panel_shows(WAYS_RUN), "%s: ladderd runs again", name);
	if (!guard.ended)
		child_stop(&guard);
	bank_down(&ways);
}

static void each_way_out(void)
{
	snprintf(map, sizeof(map), "%s", file_text("ways.io", WAYS_MAP));
	for (unsigned i = 0; i < OUTS; i++)
		bank_pull(&panel, OUT0 + i, !(WAYS_SAFE >> i & 1));
	one_way("STOP", by_stop);
	one_way("program fault", by_program_fault);
	one_way("watchdog", by_late_scan);
	one_way("I/O fault", by_lost_inputs);
	one_way("SIGTERM", by_sigterm);
	one_way("kill -9", by_sigkill);
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
	is_small();
	three_ends();
	each_way_out();
	first_of_all(false);
	panel_down();
}
