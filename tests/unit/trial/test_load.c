/* SPDX-License-Identifier: MIT
 *
 * test_load - the words of a run, and the schedule: it is that of a resource whose clock
 * moves by these words.
 */
#include "engine/trial/load.h"
#include "engine/trial/pace.h"
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

/* Periods of a board of the same speed, until @end_ns. False: it ended in FAULT. @left: cycles
 * without the program that has no task. */
static bool run_board(uint64_t speed, int64_t end_ns, uint64_t *left)
{
	struct resource *resource = &rig.resource;
	uint64_t cycles = 0;

	pace_set(resource, 0);
	resource_start(resource);
	pace_set(resource, speed);
	for (int64_t now_ns = 0; now_ns < end_ns && resource->state == STATE_RUN;
	     now_ns += load.tick_ns, cycles++) {
		rig_set(&rig, "Idle", 100); /* one round of its loop */
		pace_scan(resource, now_ns, load.tick_ns);
	}
	*left = cycles - resource->tasks.state[REST].runs;
	return resource->state == STATE_RUN;
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

/* From far too slow to fast enough, at speeds of which a word takes whole ns. A board ends in FAULT where tasks are late again and again. */
static void schedules(void)
{
	uint64_t left, enough = load_enough(&load);
	int slow = 0, fast = 0, interrupted = 0;

	for (uint64_t speed = 1; speed <= 8 * enough; speed++) {
		const bool good = load_run(&load, speed);

		if (1000000 % speed || !run_board(speed, load.at.now_ns, &left))
			continue;
		for (int i = 0; i < TASKS; i++) {
			const struct task_state *state = &rig.resource.tasks.state[i];

			CHECK(state->runs == load.task[i].runs);
			CHECK(load.task[i].overruns == (i == REST ? left : state->overruns));
			interrupted += state->interrupted > 0;
		}
		slow += !good;
		fast += good;
	}
	printf("# %d too slow, %d fast enough, %d tasks interrupted\n", slow, fast, interrupted);
	CHECK(slow > 0 && fast > 0 && interrupted > 0);
	CHECK(load_run(&load, enough) && load.task[FAST].wait_ns <= load.task[SLOW].run_ns);
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
	load_free(&load);
	rig_close(&rig);
	return tap_done();
}
