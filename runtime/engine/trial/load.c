/* SPDX-License-Identifier: MIT
 *
 * load - the words of a run, and a schedule with a virtual clock.
 */
#include "engine/trial/load.h"

#include "engine/scan/interrupt.h"

#include <stdlib.h>
#include <string.h>

#define MS_NS UINT64_C(1000000)

/* ---- words ---- */

/* Back to EACH is no loop: each of its targets runs once at most. */
static bool goes_back(const uint32_t *base, const uint32_t *pc)
{
	const uint32_t *to = base + pc[1];

	return to <= pc && (*to & 0xff) != VM_EACH;
}

struct counted { uint64_t words; bool loops, known; };

/* Calls are at most LIMIT_CALLS deep: the verifier has seen to it. */
static struct counted count(const struct program *program, struct counted *entry, uint32_t i)
{
	const uint32_t *pc = program->text + program->entry[i].text;
	const uint32_t *end = pc + program->entry[i].text_words;
	struct counted sum = { .words = 0, .known = true };

	if (entry[i].known)
		return entry[i];
	for (; pc < end; pc += code_words(pc)) {
		const uint32_t op = *pc & 0xff;

		sum.words += code_words(pc);
		if (op == VM_CALL) {
			const struct counted called = count(program, entry, pc[1]);

			sum.words += called.words;
			sum.loops |= called.loops;
		}
		sum.loops |= (op == VM_JMP || op == VM_JMPC) && goes_back(program->text, pc);
	}
	return entry[i] = sum;
}

static bool add_point(struct load_task *task, uint64_t words)
{
	const uint32_t room = task->points ? 2 * task->points : 16;
	uint64_t *point;

	/* The room is a power of two. */
	if (!task->points || (task->points >= 16 && !(task->points & (task->points - 1)))) {
		point = realloc(task->point, room * sizeof(*point));
		if (!point)
			return false;
		task->point = point;
	}
	task->point[task->points++] = words;
	return true;
}

/* The safe points of a program of a task, and the longest way between two. A loop of the program
 * itself has a safe point in each round. @before: words of its programs before this one. */
static bool measure_way(const struct program *program, struct counted *entry, uint32_t i,
			uint64_t before, struct load_task *task)
{
	const uint32_t *pc = program->text + program->entry[i].text;
	const uint32_t *end = pc + program->entry[i].text_words;
	uint64_t way = 0;

	for (; pc < end; pc += code_words(pc)) {
		const uint32_t op = *pc & 0xff;

		if (op == VM_POINT) {
			if (!add_point(task, before))
				return false;
			way = 0;
		}
		way += code_words(pc);
		before += code_words(pc);
		if (op == VM_CALL) {
			const struct counted called = count(program, entry, pc[1]);

			way += called.words;
			before += called.words;
			task->way_loops |= called.loops;
		}
		if (way > task->way)
			task->way = way;
	}
	return true;
}

static bool measure_task(const struct program *program, struct counted *entry, uint32_t i,
			 struct load_task *out)
{
	const struct code_task *task = &program->task[i];

	for (uint32_t k = 0; k < task->count; k++) {
		const uint32_t at = program->call[task->first + k];
		const struct counted one = count(program, entry, at);

		if (interrupt_can(program, i) &&
		    !measure_way(program, entry, at, out->words, out))
			return false;
		out->words += one.words;
		out->loops |= one.loops;
	}
	return true;
}

bool load_measure(const struct program *program, int64_t tick_ns, struct load *out)
{
	struct counted *entry = calloc(program->entry_count + 1, sizeof(*entry));
	bool good = entry != NULL;

	memset(out, 0, sizeof(*out));
	out->program = program;
	out->tick_ns = tick_ns;
	for (uint32_t i = 0; good && i < program->task_count; i++)
		good = measure_task(program, entry, i, &out->task[i]);
	free(entry);
	if (!good)
		load_free(out);
	return good;
}

void load_free(struct load *load)
{
	for (int i = 0; i < LIMIT_TASKS; i++)
		free(load->task[i].point);
	memset(load, 0, sizeof(*load));
}

/* ---- a schedule ---- */

static void begin(const struct load *load, struct load_schedule *at)
{
	memset(at, 0, sizeof(*at));
	at->program = *load->program;
	for (uint32_t i = 0; i < at->program.task_count; i++) {
		at->task[i] = load->program->task[i];
		at->task[i].single = 0;
	}
	at->program.task = at->task;
	tasks_start(&at->tasks, &at->program, 0);
}

static int64_t common(int64_t a, int64_t b)
{
	while (b) {
		const int64_t rest = a % b;

		a = b;
		b = rest;
	}
	return a;
}

/* Until all intervals have met twice; LOAD_CYCLES at most. */
static int64_t cycles(const struct load *load)
{
	int64_t all = 50;

	for (uint32_t i = 0; i < load->program->task_count; i++) {
		const int64_t interval = task_interval(&load->program->task[i]);
		const int64_t steps = (interval + load->tick_ns - 1) / load->tick_ns;

		if (load->program->task[i].kind != TASK_INTERVAL)
			continue;
		all = all / common(all, steps) * steps;
		if (all > LOAD_CYCLES / 2)
			return LOAD_CYCLES;
	}
	return 2 * all;
}

static int64_t time_of(const struct load *load, uint64_t words)
{
	return (int64_t)(words * MS_NS / load->speed);
}

/* An event comes in every cycle. */
static void begin_tasks(struct load_schedule *at, uint32_t count)
{
	static const uint8_t zero;

	tasks_begin_above(&at->tasks, &at->program, count, &zero, at->now_ns);
	for (uint32_t i = 0; i < count; i++)
		if (at->task[i].kind == TASK_EVENT)
			at->tasks.state[i].due = true;
}

/* Only a task with an interval has a deadline; the others wait from the cycle on. */
static void take(struct load_task *task, struct load_schedule *at, uint32_t i, int64_t cycle_ns)
{
	int64_t from = at->due_ns;

	if (at->task[i].kind == TASK_INTERVAL)
		from = at->tasks.state[i].next_ns;
	if (at->now_ns - from > task->wait_ns)
		task->wait_ns = at->now_ns - from;
	tasks_take(&at->tasks, &at->program, i, cycle_ns);
	at->busy_ns += task->run_ns;
}

static bool is_due(const struct load *load, const struct load_schedule *at)
{
	return at->now_ns >= at->due_ns + load->tick_ns;
}

/* The ticks that have come; the last one begins a cycle, the others are left out. */
static void next_tick(const struct load *load, struct load_schedule *at)
{
	const int64_t ticks = (at->now_ns - at->due_ns) / load->tick_ns;

	at->due_ns += ticks * load->tick_ns;
	at->skipped += (uint64_t)ticks;
}

static void run_one(struct load *load, struct load_schedule *at, uint32_t i, int64_t cycle_ns,
		    uint32_t level);

/* A cycle of the tasks above @i. */
static void run_above(struct load *load, struct load_schedule *at, uint32_t i, uint32_t level)
{
	const uint32_t count = tasks_above(&at->program, i);
	const int64_t cycle_ns = at->now_ns;
	uint32_t next;

	next_tick(load, at);
	begin_tasks(at, count);
	while ((next = tasks_next(&at->tasks, &at->program)) < count)
		run_one(load, at, next, cycle_ns, level + 1);
}

static bool may_interrupt(const struct load_schedule *at, uint32_t i, uint32_t level)
{
	return level < LIMIT_LEVELS && interrupt_can(&at->program, i);
}

/* The time up to the first safe point at which a cycle is due, from @done_ns on, or behind it;
 * past the end: there is none. */
static int64_t next_point(const struct load *load, const struct load_task *task, int64_t done_ns,
			  bool behind)
{
	const int64_t wait_ns = load->at.due_ns + load->tick_ns - load->at.now_ns;
	const int64_t from_ns = done_ns + (wait_ns > behind ? wait_ns : behind);
	uint32_t low = 0, high = task->points;

	while (low < high) {
		const uint32_t middle = low + (high - low) / 2;

		if (time_of(load, task->point[middle]) < from_ns)
			low = middle + 1;
		else
			high = middle;
	}
	return low < task->points ? time_of(load, task->point[low]) : INT64_MAX;
}

/* As run_levels() of scan/resource.c. */
static void run_one(struct load *load, struct load_schedule *at, uint32_t i, int64_t cycle_ns,
		    uint32_t level)
{
	struct load_task *task = &load->task[i];
	const bool can = !at->first && may_interrupt(at, i, level);
	int64_t done_ns = 0, to_ns;

	take(task, at, i, cycle_ns);
	to_ns = next_point(load, task, 0, false);
	while (can && to_ns < INT64_MAX) {
		at->now_ns += to_ns - done_ns;
		done_ns = to_ns;
		run_above(load, at, i, level);
		to_ns = next_point(load, task, done_ns, true);
	}
	at->now_ns += task->run_ns - done_ns;
}

/* As run_due() of scan/resource.c, with a safe point before each task. */
static void run_cycle(struct load *load, struct load_schedule *at)
{
	const int64_t cycle_ns = at->now_ns;
	uint32_t i;

	begin_tasks(at, at->program.task_count);
	for (bool any = false;; any = true) {
		i = tasks_next(&at->tasks, &at->program);
		if (i == at->program.task_count)
			return;
		if (any && !at->first && may_interrupt(at, i, 0) && is_due(load, at)) {
			run_above(load, at, i, 0);
			i = tasks_next(&at->tasks, &at->program);
		}
		run_one(load, at, i, cycle_ns, 0);
	}
}

/* As count_late() of ladderd: a tick that has come meanwhile is left out. */
static void end_cycle(const struct load *load, struct load_schedule *at)
{
	at->due_ns += load->tick_ns;
	if (at->now_ns > at->due_ns) {
		const int64_t missed = (at->now_ns - at->due_ns - 1) / load->tick_ns + 1;

		at->due_ns += missed * load->tick_ns;
		at->skipped += (uint64_t)missed;
	}
	at->now_ns = at->due_ns;
}

static bool is_good(const struct load *load)
{
	for (uint32_t i = 0; i < load->program->task_count; i++)
		if (load->task[i].overruns)
			return false;
	return true;
}

bool load_run(struct load *load, uint64_t speed)
{
	const int64_t count = cycles(load);
	struct load_schedule *at = &load->at;

	load->speed = speed;
	begin(load, at);
	for (uint32_t i = 0; i < at->program.task_count; i++) {
		load->task[i].run_ns = time_of(load, load->task[i].words);
		load->task[i].wait_ns = 0;
	}
	for (int64_t i = 0; i < count; i++) {
		at->first = i == 0; /* it is not interrupted */
		run_cycle(load, at);
		end_cycle(load, at);
	}
	for (uint32_t i = 0; i < at->program.task_count; i++) {
		load->task[i].runs = at->tasks.state[i].runs;
		load->task[i].overruns = at->task[i].kind == TASK_CYCLE ?
						 at->skipped : at->tasks.state[i].overruns;
	}
	load->busy_permille = (uint32_t)(1000.0 * (double)at->busy_ns / (double)at->now_ns + 0.5);
	return is_good(load);
}

uint64_t load_enough(struct load *load)
{
	uint64_t low = 0, high = 1;

	while (!load_run(load, high)) {
		if (high == LOAD_SPEED_MOST)
			return 0;
		low = high;
		high = high * 2 > LOAD_SPEED_MOST ? LOAD_SPEED_MOST : high * 2;
	}
	while (high - low > 1) {
		const uint64_t middle = low + (high - low) / 2;

		if (load_run(load, middle))
			high = middle;
		else
			low = middle;
	}
	return high;
}
