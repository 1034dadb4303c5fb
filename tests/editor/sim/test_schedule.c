/* SPDX-License-Identifier: MIT
 *
 * test_schedule - the schedule has the runs that a scan in virtual time has.
 */
#include "editor-gtk/sim/schedule.h"
#include "engine/ladder.h"
#include "tests/tap.h"

#include <stdlib.h>

#define PERIOD G_GINT64_CONSTANT(10000000)

/* Caller: ladder_free. */
static struct ladder *built(const char *tasks)
{
	struct ladder *ladder = ladder_new();
	char *text = g_strdup_printf("RUNGBOARD 1\n\nCONFIGURATION Plant\n%sEND_CONFIGURATION\n\n"
		"PROGRAM A LD\nRUNG\n  | NO %%IX0.0 | COIL %%QX0.0 |\nEND_PROGRAM\n\n"
		"PROGRAM B LD\nRUNG\n  | NO %%IX0.1 | COIL %%QX0.1 |\nEND_PROGRAM\n\n"
		"PROGRAM C LD\nRUNG\n  | NO %%IX0.2 | COIL %%QX0.2 |\nEND_PROGRAM\n", tasks);

	CHECK(ladder_load_text(ladder, "plant", text, strlen(text)) && ladder_build(ladder));
	g_free(text);
	return ladder;
}

/* Does the schedule have the runs of a cycle? */
static bool has_runs(const struct schedule *schedule, const struct resource *resource,
		     const guint64 *before, gint64 now)
{
	for (int lane = 0; lane < schedule->lane_count; lane++) {
		guint64 runs = 0;

		for (guint i = 0; i < schedule->run->len; i++) {
			const struct schedule_run *run = &g_array_index(schedule->run,
				struct schedule_run, i);

			runs += run->at_ns == now && run->lane == lane;
		}
		if (runs != resource->tasks.state[lane].runs - before[lane])
			return false;
	}
	return true;
}

/* Caller: schedule_free. */
static struct schedule *compared(const struct ladder *ladder)
{
	const struct program *program = ladder_program(ladder);
	struct schedule *schedule = schedule_new(program, PERIOD);
	void *memory = malloc(image_memory_size(program));
	struct resource *resource = calloc(1, sizeof(*resource));
	bool good = true;

	resource_init(resource, program, memory);
	resource_start(resource);
	for (gint64 now = 0; now < schedule->span_ns; now += schedule->tick_ns) {
		guint64 before[LIMIT_TASKS];

		for (int i = 0; i < schedule->lane_count; i++)
			before[i] = resource->tasks.state[i].runs;
		resource_scan(resource, now);
		if (!tasks_declared(program)) /* the resource does not count them */
			resource->tasks.state[0].runs++;
		good = good && has_runs(schedule, resource, before, now);
	}
	CHECK_AS(good, "each cycle runs the tasks of the schedule");
	free(resource);
	free(memory);
	return schedule;
}

static void check_text(char *got, const char *want)
{
	CHECK_TEXT(got, want);
	g_free(got);
}

static void test_mixed(void)
{
	struct ladder *ladder = built(
		"  TASK Slow (INTERVAL := T#20ms, PRIORITY := 2);\n"
		"  TASK Fast (INTERVAL := T#5ms, PRIORITY := 1);\n"
		"  TASK Alarm (SINGLE := %IX0.7, PRIORITY := 0);\n"
		"  PROGRAM P WITH Fast : A;\n  PROGRAM Q WITH Slow : B;\n  PROGRAM R : C;\n");
	struct schedule *schedule = compared(ladder);

	CHECK(schedule->lane_count == 4 && schedule->whole);
	CHECK(schedule->tick_ns == 5000000 && schedule->span_ns == 40000000);
	check_text(schedule_lane_text(schedule, 0),
		   "Alarm: priority 0, when its variable becomes TRUE");
	check_text(schedule_lane_text(schedule, 1),
		   "Fast: priority 1, every 5 ms, at 0 s, 5 ms, 10 ms …");
	check_text(schedule_lane_text(schedule, 2),
		   "Slow: priority 2, every 20 ms, at 0 s, 20 ms …");
	check_text(schedule_lane_text(schedule, 3),
		   "Each scan: behind all tasks, every 5 ms, at 0 s, 5 ms, 10 ms …");
	check_text(schedule_at_text(schedule, 0), "At 0 s: Fast, then Slow, then Each scan");
	check_text(schedule_at_text(schedule, 7000000), "At 5 ms: Fast, then Each scan");
	schedule_free(schedule);
	ladder_free(ladder);
}

/* Periods far apart, and periods whose common round is long. */
static void test_long(void)
{
	static const char *const tasks[] = {
		"  TASK X (INTERVAL := T#1ms);\n  TASK Y (INTERVAL := T#1h);\n"
		"  PROGRAM P WITH X : A;\n  PROGRAM Q WITH Y : B;\n",
		"  TASK X (INTERVAL := T#700us);\n  TASK Y (INTERVAL := T#1300us);\n"
		"  TASK Z (INTERVAL := T#23h);\n"
		"  PROGRAM P WITH X : A;\n  PROGRAM Q WITH Y : B;\n  PROGRAM R WITH Z : C;\n",
		"  TASK X (INTERVAL := T#130us);\n  PROGRAM P WITH X : A;\n",
		"  TASK X (SINGLE := %IX0.0);\n  PROGRAM P WITH X : A;\n",
		"",
	};

	for (gsize i = 0; i < G_N_ELEMENTS(tasks); i++) {
		struct ladder *ladder = built(tasks[i]);
		struct schedule *schedule = compared(ladder);

		CHECK(schedule->span_ns / schedule->tick_ns <= SCHEDULE_CYCLES);
		CHECK(schedule->whole == (i >= 2));
		schedule_free(schedule);
		ladder_free(ladder);
	}
}

int main(void)
{
	test_mixed();
	test_long();
	return tap_done();
}
