/* SPDX-License-Identifier: MIT
 *
 * test_task - when tasks run: exact deadlines, missed periods, events, priorities,
 * delays by slow tasks. Time and durations are virtual.
 */
#include "tests/unit/rig.h"

#define MS INT64_C(1000000)

static const char source[] =
	"VAR\n"
	"  Go AT %IX0.0 : BOOL;\n"
	"  Ring, Chain : BOOL;\n"
	"  Fast, Slow, Bell, Late, Rest, Firsts, Order : DINT;\n"
	"END_VAR\n"
	"CONFIGURATION Plant\n"
	"  RESOURCE Cpu\n"
	"    TASK TSlow (INTERVAL := T#10ms, PRIORITY := 5);\n"
	"    TASK TLate (INTERVAL := T#10ms, PRIORITY := 5);\n"
	"    TASK TFast (INTERVAL := T#2ms, PRIORITY := 1, WATCHDOG := T#1ms);\n"
	"    TASK TBell (SINGLE := Ring, PRIORITY := 0);\n"
	"    PROGRAM A WITH TSlow : PSlow;\n"
	"    PROGRAM B WITH TFast : PFast;\n"
	"    PROGRAM C WITH TBell : PBell;\n"
	"    PROGRAM D WITH TLate : PLate;\n"
	"    PROGRAM E : PRest;\n"
	"  END_RESOURCE\n"
	"END_CONFIGURATION\n"
	"PROGRAM PSlow LD\n"
	"RUNG\n  | [ Slow := Slow + 1 ] |\n"
	"RUNG\n  | [ Order := Order * 10 + 1 ] |\n"
	"RUNG\n  | NO Go | COIL Ring |\n"
	"RUNG\n  | NO SYS_FIRST_SCAN | [ Firsts := Firsts + 1 ] |\nEND_PROGRAM\n"
	"PROGRAM PLate LD\n"
	"RUNG\n  | [ Late := Late + 1 ] |\n"
	"RUNG\n  | [ Order := Order * 10 + 2 ] |\n"
	"RUNG\n  | NO SYS_FIRST_SCAN | [ Firsts := Firsts + 1 ] |\nEND_PROGRAM\n"
	"PROGRAM PFast LD\n"
	"RUNG\n  | [ Fast := Fast + 1 ] |\n"
	"RUNG\n  | [ Order := Order * 10 + 3 ] |\nEND_PROGRAM\n"
	"PROGRAM PBell LD\n"
	"RUNG\n  | [ Bell := Bell + 1 ] |\n"
	"RUNG\n  | NO Chain | R Ring |\n"
	"RUNG\n  | [ Order := Order * 10 + 4 ] |\nEND_PROGRAM\n"
	"PROGRAM PRest LD\n"
	"RUNG\n  | [ Rest := Rest + 1 ] |\n"
	"RUNG\n  | [ Order := Order * 10 + 5 ] |\nEND_PROGRAM\n";

/* Of the image: by priority, ties as in the file. */
enum { BELL, FAST, SLOW, LATE, REST };

static struct rig rig;

static bool scan_at(int64_t ms)
{
	rig_set(&rig, "Order", 0);
	return resource_scan(&rig.resource, ms * MS);
}

static const struct task_state *task(int index)
{
	return &rig.resource.tasks.state[index];
}

static void start(void)
{
	resource_start(&rig.resource);
	rig.resource.due_ns = 0;
	rig.resource.clock_ns = NULL;
	rig.resource.patience = 0;
}

static void has_order(void)
{
	const struct program *p = rig.resource.image.program;

	CHECK(p->task_count == 5 && tasks_declared(p));
	CHECK_TEXT(task_name(p, BELL), "TBell");
	CHECK_TEXT(task_name(p, FAST), "TFast");
	CHECK_TEXT(task_name(p, SLOW), "TSlow");
	CHECK_TEXT(task_name(p, LATE), "TLate");
	CHECK_TEXT(task_name(p, REST), "");
	CHECK(task_interval(&p->task[FAST]) == 2 * MS);
	CHECK(task_watchdog(&p->task[FAST]) == MS);
	CHECK(task_limit(&p->task[FAST], 10, 7) == MS);
	CHECK(task_limit(&p->task[SLOW], 10, 7) == 100 * MS);
	CHECK(task_limit(&p->task[SLOW], 0, 7) == 0);
	CHECK(task_limit(&p->task[REST], 10, 7) == 70);
	CHECK(task_limit(&p->task[REST], 10, 3600000 * MS) == 10000 * MS);
	CHECK(tasks_tick(p, 0, 10 * MS) == 2 * MS);
	CHECK(tasks_tick(p, 0, 5 * MS) == MS);
	CHECK(tasks_tick(p, 3 * MS, 10 * MS) == MS);
	CHECK_AS(tasks_tick(p, MS / 1000, 7) == LIMIT_TICK,
		 "a tick is not below LIMIT_TICK");
}

/* Deadlines are start + k * interval, also after a late scan. */
static void keeps_deadlines(void)
{
	start();
	CHECK(scan_at(100) && rig_get(&rig, "Order") == 3125);
	CHECK_AS(rig_get(&rig, "Firsts") == 2, "each task sees SYS_FIRST_SCAN");
	CHECK(scan_at(101) && rig_get(&rig, "Order") == 5);
	CHECK(scan_at(103) && rig_get(&rig, "Order") == 35);
	CHECK_AS(task(FAST)->next_ns == 104 * MS,
		 "one late scan does not move the next deadline");
	CHECK(scan_at(104) && rig_get(&rig, "Order") == 35);
	CHECK(scan_at(105) && rig_get(&rig, "Order") == 5);
	CHECK(task(FAST)->runs == 3 && task(FAST)->overruns == 0);
	for (int64_t ms = 106; ms <= 1100; ms++)
		if (!scan_at(ms))
			break;
	CHECK_AS(task(FAST)->runs == 501 && task(SLOW)->runs == 101,
		 "tasks run as often as planned in a second");
	CHECK(task(FAST)->overruns == 0 && task(SLOW)->overruns == 0);
	CHECK(task(REST)->runs == 1000);
}

static void leaves_periods_out(void)
{
	start();
	CHECK(scan_at(0) && scan_at(7));
	CHECK_AS(task(FAST)->runs == 2 && task(FAST)->overruns == 2,
		 "a scan at 7 ms counts the deadlines 4 and 6 as overruns");
	CHECK_AS(task(FAST)->next_ns == 8 * MS,
		 "the next deadline is a multiple of the interval again");
	CHECK(scan_at(8) && task(FAST)->runs == 3);
	CHECK(scan_at(1000) && task(FAST)->runs == 4);
	CHECK_AS(task(FAST)->overruns == 497,
		 "a task that missed 497 deadlines runs once");
	CHECK(task(SLOW)->runs == 2 && task(SLOW)->overruns == 99);
	CHECK(task(FAST)->late_row == 1 && task(SLOW)->late_row == 1);
	CHECK(scan_at(1002) && task(FAST)->late_row == 0);
}

/* Deadlines count from the planned time of the first scan. */
static void has_own_start(void)
{
	start();
	rig.resource.due_ns = 99 * MS;
	CHECK(scan_at(100) && task(FAST)->next_ns == 101 * MS);
	rig.resource.due_ns = 0;
}

static void sees_events(void)
{
	start();
	CHECK(scan_at(1) && task(BELL)->runs == 0);
	rig_set(&rig, "Ring", 1);
	CHECK(scan_at(2) && rig_get(&rig, "Order") == 45);
	CHECK_AS(scan_at(3) && task(BELL)->runs == 1,
		 "an event task does not run again while its variable stays TRUE");
	rig_set(&rig, "Ring", 0);
	CHECK(scan_at(4) && task(BELL)->runs == 1);
	rig_set(&rig, "Go", 1);
	CHECK(scan_at(5) && task(BELL)->runs == 1);
	CHECK_AS(scan_at(11) && rig_get(&rig, "Order") == 31425,
		 "an event task runs in the cycle in which another task makes the edge");
	CHECK(task(BELL)->overruns == 0);
	start();
	rig_set(&rig, "Ring", 1);
	CHECK(scan_at(1) && task(BELL)->runs == 1);
}

/* An edge while the task has run already in this cycle waits for the next one. */
static void keeps_an_event(void)
{
	start();
	rig_set(&rig, "Chain", 1);
	rig_set(&rig, "Ring", 1);
	rig_set(&rig, "Go", 1);
	CHECK_AS(scan_at(0) && rig_get(&rig, "Order") == 43125,
		 "an event task runs once in a cycle with two edges");
	CHECK(task(BELL)->due && task(BELL)->runs == 1);
	CHECK(scan_at(1) && rig_get(&rig, "Order") == 45);
	CHECK(task(BELL)->runs == 2 && task(BELL)->overruns == 0);
}

/* Each read of this clock advances it by the test's number. */
static int64_t clock_ns, clock_step;

static int64_t slow_clock(const struct resource *resource)
{
	(void)resource;
	return clock_ns += clock_step;
}

static bool timed_scan(int64_t ms, int64_t step_ns)
{
	clock_ns = ms * MS;
	clock_step = step_ns;
	return scan_at(ms);
}

static void is_timed(void)
{
	start();
	rig.resource.clock_ns = slow_clock;
	CHECK(timed_scan(0, 1000) && task(FAST)->last_ns == 1000);
	CHECK(timed_scan(2, 5000) && task(FAST)->last_ns == 5000);
	CHECK(timed_scan(4, 1000) && task(FAST)->last_ns == 1000);
	CHECK(task(FAST)->max_ns == 5000 && task(SLOW)->max_ns == 1000);
}

/* A task waits for at most one slower task: the cycle ends between two tasks when its
 * deadline has come. The others are due in the next cycle. */
static void yields(void)
{
	start();
	rig.resource.clock_ns = slow_clock;
	CHECK_AS(timed_scan(0, 900000) && rig_get(&rig, "Order") == 3125,
		 "all tasks run in the first scan");
	for (int64_t ms = 2; ms < 10; ms += 2)
		CHECK(timed_scan(ms, 1000) && rig_get(&rig, "Order") == 35);
	CHECK(timed_scan(10, 400000) && rig_get(&rig, "Order") == 31);
	CHECK(task(LATE)->runs == 1 && task(LATE)->next_ns == 10 * MS);
	CHECK(timed_scan(12, 1000) && rig_get(&rig, "Order") == 325);
	CHECK(task(LATE)->overruns == 0 && task(LATE)->next_ns == 20 * MS);
}

/* An event may have come while a slow task ran: the next cycle checks. */
static void yields_to_events(void)
{
	start();
	rig.resource.clock_ns = slow_clock;
	rig.resource.tick_ns = 2 * MS;
	CHECK(timed_scan(0, 900000) && rig_get(&rig, "Order") == 3125);
	rig.resource.due_ns = 1 * MS;
	CHECK_AS(timed_scan(1, 900000) && rig_get(&rig, "Order") == 5,
		 "one task runs in a cycle whose deadline has passed");
	rig.resource.due_ns = 8 * MS;
	CHECK(timed_scan(8, 1000) && rig_get(&rig, "Order") == 35);
	CHECK(task(FAST)->overruns == 3);
	rig.resource.due_ns = 10 * MS - 1;
	CHECK_AS(timed_scan(10, 200000) && rig_get(&rig, "Order") == 3125,
		 "all due tasks run in a cycle before its deadline");
	rig.resource.due_ns = 18 * MS;
	CHECK_AS(timed_scan(20, 1000) && rig_get(&rig, "Order") == 3,
		 "the cycle ends after TFast: TBell may be due");
	rig.resource.tick_ns = 0;
}

static void told(const char *want)
{
	char text[96];

	resource_fault_print(&rig.resource, text, sizeof(text));
	CHECK_TEXT(text, want);
	CHECK(rig.resource.state == STATE_FAULT);
}

static void has_watchdogs(void)
{
	start();
	rig.resource.clock_ns = slow_clock;
	CHECK(timed_scan(0, 1000) && !timed_scan(2, MS));
	told("task TFast: watchdog: too late or too long");
	CHECK_AS(rig_get(&rig, "Order") == 3, "no task runs after a watchdog fault");
	start();
	rig.resource.clock_ns = slow_clock;
	CHECK(timed_scan(0, 1000));
	CHECK_AS(timed_scan(10, 900000),
		 "with patience 0, only WATCHDOG of the task is a fault");
	start();
	rig.resource.clock_ns = slow_clock;
	rig.resource.patience = 3;
	CHECK(timed_scan(0, 1) && timed_scan(4, 1) && timed_scan(8, 1));
	CHECK_AS(!timed_scan(12, 1),
		 "with patience 3, being late three times in a row is a fault");
	told("task TFast: watchdog: too late or too long");
	start();
	CHECK_AS(scan_at(0) && rig.resource.fault == FAULT_NONE,
		 "a start ends the fault");
}

/* An endless loop is a fault of its own task; each task has its own budget. */
static void has_budgets(void)
{
	static const char loop[] =
		"VAR\n  Go AT %IX0.0 : BOOL;\n  N : DINT;\nEND_VAR\n"
		"CONFIGURATION C\n"
		"  TASK Calm (INTERVAL := T#1s);\n"
		"  TASK Wild (INTERVAL := T#1ms, PRIORITY := 3);\n"
		"  PROGRAM A WITH Wild : Main;\n  PROGRAM B WITH Calm : Other;\n"
		"END_CONFIGURATION\n"
		"PROGRAM Main IL\nAgain:\n  LD Go\n  JMPC Again\nEND_PROGRAM\n"
		"PROGRAM Other IL\n  LD N\n  ADD 1\n  ST N\nEND_PROGRAM\n";

	rig_close(&rig);
	if (!rig_open(&rig, loop, false))
		return;
	CHECK(resource_scan(&rig.resource, 0) && rig_set(&rig, "Go", 1));
	CHECK(!resource_scan(&rig.resource, MS));
	told("task Wild: instruction budget exceeded: Main line 15");
	CHECK_TEXT(rig.resource.fault_at.pou, "Main");
}

static void needs_no_names(void)
{
	size_t len;
	const void *image = ladder_image(rig.ladder, &len);
	uint64_t *bare = calloc(1, len);
	struct program program;
	struct arena scratch;
	enum diag_id why;
	uint8_t before[32], after[32];

	arena_init(&scratch);
	len = code_strip(image, bare);
	CHECK(code_open(bare, len, &scratch, &program, &why, &len));
	CHECK(program.task_count == 2 && tasks_declared(&program));
	CHECK_TEXT(task_name(&program, 1), "");
	code_identity(&program, after);
	code_identity(ladder_program(rig.ladder), before);
	CHECK_AS(memcmp(before, after, 32) == 0,
		 "an image without names has the same identity");
	arena_free(&scratch);
	free(bare);
}

/* After a while in which no task of this program ran, nothing counts as missed. */
static void skips_a_break(void)
{
	int64_t slow, fast;

	resource_start(&rig.resource);
	scan_at(0);
	scan_at(2);
	slow = task(SLOW)->next_ns;
	fast = task(FAST)->next_ns;
	tasks_skip(&rig.resource.tasks, rig.resource.image.program, 1001 * MS);
	CHECK(task(SLOW)->next_ns == slow + 990 * MS);
	CHECK(task(FAST)->next_ns == fast + 996 * MS);
	scan_at(1001);
	CHECK(task(SLOW)->runs == 2 && task(SLOW)->overruns == 0 && task(FAST)->overruns == 0);
	tasks_skip(&rig.resource.tasks, rig.resource.image.program, 1001 * MS);
	CHECK(task(SLOW)->next_ns == 1010 * MS);
}

int main(void)
{
	if (!rig_open(&rig, source, false))
		return tap_done();
	has_order();
	keeps_deadlines();
	leaves_periods_out();
	skips_a_break();
	has_own_start();
	sees_events();
	keeps_an_event();
	is_timed();
	yields();
	yields_to_events();
	has_watchdogs();
	has_budgets();
	needs_no_names();
	rig_close(&rig);
	return tap_done();
}
