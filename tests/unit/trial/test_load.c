/* SPDX-License-Identifier: MIT
 *
 * test_load - the words of a run, and the schedule: it is that of a resource whose clock
 * moves by these words.
 */
#include "engine/trial/load.h"
#include "tests/unit/rig.h"

#define MS INT64_C(1000000)

static const char source[] =
	"VAR\n  Fast, Slow, Idle, Rest, N : DINT;\nEND_VAR\n"
	"CONFIGURATION Plant\n  RESOURCE Cpu\n"
	"    TASK TSlow (INTERVAL := T#20ms, PRIORITY := 5);\n"
	"    TASK TFast (INTERVAL := T#5ms, PRIORITY := 1);\n"
	"    TASK TIdle (INTERVAL := T#40ms, PRIORITY := 9);\n"
	"    PROGRAM A1 WITH TSlow : PSlow;\n"
	"    PROGRAM B1 WITH TFast : PFast;\n"
	"    PROGRAM C1 WITH TIdle : PIdle;\n"
	"    PROGRAM D1 : PRest;\n"
	"  END_RESOURCE\nEND_CONFIGURATION\n"
	"PROGRAM PSlow IL\n"
	"  LD Slow\n  ADD 1\n  ST Slow\n  ADD 2\n  ST N\n  ADD 3\n  ST N\n  CAL More\nEND_PROGRAM\n"
	"PROGRAM PFast IL\n  LD Fast\n  ADD 1\n  ST Fast\nEND_PROGRAM\n"
	"PROGRAM PIdle IL\nAgain:\n  LD Idle\n  ADD 1\n  ST Idle\n  GE 10\n  JMPCN Again\nEND_PROGRAM\n"
	"PROGRAM PRest IL\n  CAL More\n  CAL More\nEND_PROGRAM\n"
	"SUBROUTINE More IL\n  LD Rest\n  ADD 1\n  ST Rest\nEND_SUBROUTINE\n";

enum { FAST, SLOW, IDLE, REST, TASKS };

static struct rig rig;
static struct load load;
static int64_t idle_ns;

/* Each run took its time when it is taken. */
static int64_t clock_of_runs(const struct resource *resource)
{
	int64_t now_ns = idle_ns;

	for (int i = 0; i < TASKS; i++)
		now_ns += (int64_t)resource->tasks.state[i].runs * load.task[i].run_ns;
	return now_ns;
}

/* The cycles of a board, until its clock is at @end_ns; @skipped: cycles left out. */
static void run_board(int64_t end_ns, uint64_t *skipped)
{
	struct resource *resource = &rig.resource;
	int64_t due_ns = 0, missed;

	idle_ns = 0;
	*skipped = 0;
	resource_start(resource);
	resource->tick_ns = load.tick_ns;
	resource->clock_ns = clock_of_runs;
	while (due_ns < end_ns) {
		idle_ns += due_ns - clock_of_runs(resource);
		resource->due_ns = due_ns;
		rig_set(&rig, "Idle", 100); /* one round of its loop */
		resource_scan(resource, due_ns);
		due_ns += load.tick_ns;
		if (clock_of_runs(resource) < due_ns)
			continue;
		missed = (clock_of_runs(resource) - due_ns) / load.tick_ns + 1;
		due_ns += missed * load.tick_ns;
		*skipped += (uint64_t)missed;
	}
}

static void words(void)
{
	const struct program *program = ladder_program(rig.ladder);
	uint32_t text[TASKS], more = 0;

	for (uint32_t i = 0; i < program->entry_count; i++) {
		const char *name = program->string + program->entry[i].name;

		if (strcmp(name, "More") == 0)
			more = program->entry[i].text_words;
	}
	for (uint32_t i = 0; i < TASKS; i++)
		text[i] = program->entry[program->call[program->task[i].first]].text_words;
	CHECK(more > 0 && load.task[FAST].words == text[FAST] && !load.task[FAST].loops);
	CHECK(load.task[SLOW].words == text[SLOW] + more && !load.task[SLOW].loops);
	CHECK(load.task[REST].words == text[REST] + 2 * more && !load.task[REST].loops);
	CHECK(load.task[IDLE].words == text[IDLE] && load.task[IDLE].loops);
	/* The highest task is not interrupted. A block that is called has no safe point; a loop
	 * has one in each round. */
	CHECK(load.task[FAST].way == 0 && load.task[SLOW].way == text[SLOW] + more);
	CHECK(load.task[REST].way == text[REST] + 2 * more && !load.task[REST].way_loops);
	CHECK(load.task[IDLE].way > 0 && load.task[IDLE].way == text[IDLE] - 1);
}

/* From far too slow to fast enough. */
static void schedules(void)
{
	uint64_t skipped, enough = load_enough(&load);
	int slow = 0, fast = 0;

	for (uint64_t speed = 1; speed <= 2 * enough; speed++) {
		const bool good = load_run(&load, speed);

		run_board(load.at.now_ns, &skipped);
		for (int i = 0; i < TASKS; i++) {
			const struct task_state *state = &rig.resource.tasks.state[i];

			CHECK(state->runs == load.task[i].runs);
			CHECK(load.task[i].overruns == (i == REST ? skipped : state->overruns));
		}
		CHECK(rig.resource.state == STATE_RUN);
		slow += !good;
		fast += good;
	}
	CHECK(slow > 0 && fast > 0);
	CHECK(load_run(&load, enough) && load.task[FAST].wait_ns == 0);
	CHECK(load.task[SLOW].wait_ns == load.task[FAST].run_ns);
	CHECK(load.task[IDLE].wait_ns == load.task[FAST].run_ns + load.task[SLOW].run_ns);
	CHECK(!load_run(&load, enough - 1));
	CHECK(load_run(&load, LOAD_SPEED_MOST) && load.busy_permille == 0);
}

int main(void)
{
	if (!rig_open(&rig, source, false))
		return tap_done();
	CHECK(load_measure(ladder_program(rig.ladder), 5 * MS, &load));
	words();
	schedules();
	rig_close(&rig);
	return tap_done();
}
