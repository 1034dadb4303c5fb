/* SPDX-License-Identifier: MIT
 *
 * test_load - the words of a run, and the schedule: it is that of a resource whose clock
 * moves by these words.
 */
#include "engine/trial/load.h"
#include "engine/trial/pace.h"
#include "tests/unit/rig.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

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

/* ---- random sets of tasks ---- */

/* Sets of 2 to 5 tasks, with programs in no task; statements, structures that are copied, calls, and
 * loops of one round, as the schedule counts each loop once. LOAD_COUNT is how many (60). */
struct maker {
	char text[32 * 1024];
	size_t used;
	uint32_t seed, tasks;
	bool rest;            /* a program without a task */
};

struct compared { int boards, sets, interrupted, slow, failed; };

static uint32_t any(struct maker *maker, uint32_t below)
{
	maker->seed = maker->seed * 1664525 + 1013904223;
	return (maker->seed >> 8) % below;
}

static void say(struct maker *maker, const char *format, ...)
{
	va_list args;

	va_start(args, format);
	maker->used += (size_t)vsnprintf(maker->text + maker->used, sizeof(maker->text) - maker->used, format, args);
	va_end(args);
	if (maker->used >= sizeof(maker->text))
		abort();
}

static void make_program(struct maker *maker, const char *name)
{
	say(maker, "PROGRAM %s IL\nVAR\n  B : Block;\n  K, N : DINT;\n  X, Y : Large;\nEND_VAR\n  LD 0\n  ST K\n", name);
	for (uint32_t i = 0, parts = 1 + any(maker, 30); i < parts; i++)
		switch (any(maker, 8)) {
		case 0: say(maker, "  CAL B()\n"); break;
		case 1: say(maker, "  LD X\n  ST Y\n"); break;
		case 2: say(maker, "  LD 0\n  ST K\nL%u:\n  LD K\n  ADD 1\n  ST K\n  LT 1\n  JMPC L%u\n", (unsigned)i, (unsigned)i);
			break;
		default: say(maker, "  LD N\n  ADD %u\n  ST N\n", (unsigned)any(maker, 99));
		}
	say(maker, "END_PROGRAM\n");
}

static void make_set(struct maker *maker, uint32_t seed)
{
	static const uint32_t ms[] = { 5, 5, 10, 15, 20, 30, 40 };

	maker->used = 0;
	maker->seed = seed;
	maker->tasks = 2 + any(maker, 4);
	maker->rest = any(maker, 2);
	say(maker, "TYPE\n  Large : STRUCT\n    V : ARRAY[0..99] OF LINT;\n  END_STRUCT;\nEND_TYPE\nCONFIGURATION Plant\n");
	for (uint32_t i = 0; i < maker->tasks; i++)
		say(maker, "  TASK T%u (INTERVAL := T#%ums, PRIORITY := %u);\n", i, ms[any(maker, 7)], any(maker, 4));
	for (uint32_t i = 0; i < maker->tasks; i++)
		say(maker, "  PROGRAM A%u WITH T%u : P%u;\n", i, i, i);
	say(maker, "%sEND_CONFIGURATION\n", maker->rest ? "  PROGRAM R : Rest;\n" : "");
	say(maker, "FUNCTION_BLOCK Block IL\nVAR\n  N : DINT;\n  X, Y : Large;\nEND_VAR\n  LD N\n  ADD 1\n  ST N\n"
	    "  LD X\n  ST Y\nEND_FUNCTION_BLOCK\n");
	for (uint32_t i = 0; i < maker->tasks; i++) {
		char name[12];

		snprintf(name, sizeof(name), "P%u", (unsigned)i);
		make_program(maker, name);
	}
	if (maker->rest)
		make_program(maker, "Rest");
}

/* The first scan runs each task once: the words of each are those of the table. */
static bool same_words(uint32_t count)
{
	struct resource *resource = &rig.resource;
	const struct paced *pace = &resource->pace;
	uint64_t words[LIMIT_TASKS] = { 0 };
	bool same = true;

	pace_set(resource, 0);
	resource_start(resource);
	pace_set(resource, PACE_SPEED_MOST);
	pace_scan(resource, 0, load.tick_ns);
	for (uint32_t i = 0; i < pace->parts; i++)
		words[pace->part[i].task] += pace->part[i].to - pace->part[i].from;
	for (uint32_t i = 0; i < count; i++)
		same &= words[i] == load.task[i].words;
	if (!same)
		for (uint32_t i = 0; i < count; i++)
			printf("# task %u: %llu words, told %llu\n", (unsigned)i, (unsigned long long)words[i],
			       (unsigned long long)load.task[i].words);
	return same;
}

/* A board in virtual time, at this speed: what the schedule told of it is so. */
static bool same_runs(uint32_t count, uint64_t speed, struct compared *all)
{
	struct resource *resource = &rig.resource;
	const bool good = load_run(&load, speed);
	uint64_t cycles = 0, left = 0;
	bool same = true;

	pace_set(resource, 0);
	resource_start(resource);
	pace_set(resource, speed);
	for (int64_t now_ns = 0; now_ns < load.at.now_ns && resource->state == STATE_RUN; now_ns += load.tick_ns, cycles++)
		pace_scan(resource, now_ns, load.tick_ns);
	if (resource->state != STATE_RUN) {
		all->failed++;
		return !good; /* a watchdog: tasks that leave nothing out have none */
	}
	all->boards++;
	all->slow += !good;
	for (uint32_t i = 0; i < count; i++) {
		const struct task_state *state = &resource->tasks.state[i];
		const bool cycle = load.program->task[i].kind == TASK_CYCLE;

		left = cycles - state->runs;
		all->interrupted += state->interrupted > 0;
		same &= state->runs == load.task[i].runs && (cycle ? left : state->overruns) == load.task[i].overruns;
		same &= cycle || state->wait_ns == load.task[i].wait_ns;
		if (!same)
			printf("# speed %llu, task %u: %llu runs, %llu left out, waits %lld; told %llu, %llu, %lld\n",
			       (unsigned long long)speed, (unsigned)i, (unsigned long long)state->runs,
			       (unsigned long long)(cycle ? left : state->overruns), (long long)state->wait_ns,
			       (unsigned long long)load.task[i].runs, (unsigned long long)load.task[i].overruns,
			       (long long)load.task[i].wait_ns);
	}
	return same;
}

/* At speeds of which a word takes whole ns, from far too slow to fast enough. */
static bool is_as_board(uint32_t seed, struct compared *all)
{
	static struct maker maker;
	uint64_t enough;
	uint32_t count;
	bool same;

	make_set(&maker, seed);
	if (!rig_open(&rig, maker.text, false) ||
	    !CHECK(load_measure(ladder_program(rig.ladder), 5 * MS, &load)))
		return false;
	count = maker.tasks + maker.rest;
	same = same_words(count);
	enough = load_enough(&load);
	for (uint64_t speed = enough / 4; same && speed < 2 * enough; speed++)
		if (speed && 1000000 % speed == 0)
			same = same_runs(count, speed, all);
	if (same)
		all->sets++;
	else
		printf("# set %u:\n%s", (unsigned)seed, getenv("LOAD_TEXT") ? maker.text : "");
	load_free(&load);
	rig_close(&rig);
	return same;
}

static void sets(void)
{
	const char *wanted = getenv("LOAD_COUNT");
	const uint32_t most = wanted ? (uint32_t)strtoul(wanted, NULL, 10) : (uint32_t)tap_rounds(60);
	struct compared all = { 0, 0, 0, 0, 0 };

	for (uint32_t seed = 0; seed < most; seed++)
		is_as_board(seed, &all);
	printf("# %d of %u sets; %d boards, %d too slow, %d more ended in FAULT, %d tasks interrupted\n", all.sets,
	       (unsigned)most, all.boards, all.slow, all.failed, all.interrupted);
	CHECK_AS(all.sets == (int)most, "random sets of tasks have the words, runs and waits that the schedule tells");
	CHECK(all.slow > 0 && all.interrupted > 0 && all.boards > all.slow);
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
	sets();
	return tap_done();
}
