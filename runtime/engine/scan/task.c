/* SPDX-License-Identifier: MIT
 *
 * task - which tasks are due. The verifier has checked that there are at most LIMIT_TASKS,
 * ordered by priority, with intervals above 0.
 */
#include "engine/scan/task.h"

#include <string.h>

#define LONGEST_NS INT64_C(1000000000)

static int64_t join(const uint32_t words[2])
{
	return (int64_t)((uint64_t)words[1] << 32 | words[0]);
}

int64_t task_interval(const struct code_task *task)
{
	return join(task->interval);
}

int64_t task_watchdog(const struct code_task *task)
{
	return join(task->watchdog);
}

int64_t task_limit(const struct code_task *task, uint32_t patience,
		   int64_t period_ns)
{
	int64_t interval = task_interval(task), limit = task_watchdog(task);

	if (limit)
		return limit;
	if (!interval)
		interval = period_ns;
	return (interval < LONGEST_NS ? interval : LONGEST_NS) * patience;
}

const char *task_name(const struct program *program, uint32_t task)
{
	return program->string_bytes ?
	       program->string + program->task[task].name : "";
}

bool tasks_declared(const struct program *program)
{
	return program->task_count > 1 ||
	       (program->task_count && program->task[0].kind != TASK_CYCLE);
}

static int64_t common_divisor(int64_t a, int64_t b)
{
	while (b) {
		int64_t rest = a % b;

		a = b;
		b = rest;
	}
	return a;
}

int64_t tasks_tick(const struct program *program, int64_t period_ns,
		   int64_t preset_ns)
{
	int64_t tick = 0;

	for (uint32_t i = 0; i < program->task_count; i++)
		if (program->task[i].kind == TASK_INTERVAL)
			tick = common_divisor(task_interval(&program->task[i]),
					      tick);
		else if (!period_ns)
			period_ns = preset_ns;
	if (!tick)
		return period_ns;
	tick = common_divisor(tick, period_ns);
	return tick < LIMIT_TICK ? LIMIT_TICK : tick;
}

void tasks_start(struct tasks *tasks, const struct program *program,
		 int64_t start_ns)
{
	memset(tasks, 0, sizeof(*tasks));
	for (uint32_t i = 0; i < program->task_count; i++)
		tasks->state[i].next_ns = start_ns;
}

void tasks_skip(struct tasks *tasks, const struct program *program, int64_t now_ns)
{
	for (uint32_t i = 0; i < program->task_count; i++) {
		const int64_t interval = task_interval(&program->task[i]);
		const int64_t late = now_ns - tasks->state[i].next_ns;

		if (program->task[i].kind == TASK_INTERVAL && late > 0)
			tasks->state[i].next_ns += late / interval * interval;
	}
}

uint32_t tasks_above(const struct program *program, uint32_t task)
{
	uint32_t count = task;

	while (count > 0 && program->task[count - 1].priority >= program->task[task].priority)
		count--;
	return count;
}

bool tasks_may_begin(const struct tasks *tasks, const struct program *program, uint32_t count,
		     int64_t now_ns)
{
	for (uint32_t i = 0; i < count; i++)
		if (program->task[i].kind == TASK_EVENT ||
		    (program->task[i].kind == TASK_INTERVAL &&
		     now_ns >= tasks->state[i].next_ns))
			return true;
	return false;
}

void tasks_begin(struct tasks *tasks, const struct program *program,
		 const uint8_t *m, int64_t now_ns)
{
	tasks_begin_above(tasks, program, program->task_count, m, now_ns);
}

void tasks_begin_above(struct tasks *tasks, const struct program *program, uint32_t count,
		       const uint8_t *m, int64_t now_ns)
{
	for (uint32_t i = 0; i < count; i++) {
		struct task_state *state = &tasks->state[i];

		state->ran = false;
		switch ((enum task_kind)program->task[i].kind) {
		case TASK_CYCLE:
			state->due = true;
			break;
		case TASK_INTERVAL:
			state->due = now_ns >= state->next_ns;
			break;
		case TASK_EVENT: /* an event that still waits is kept */
			break;
		}
	}
	tasks_look(tasks, program, m);
}

void tasks_look(struct tasks *tasks, const struct program *program,
		const uint8_t *m)
{
	for (uint32_t i = 0; i < program->task_count; i++) {
		const struct code_task *task = &program->task[i];
		struct task_state *state = &tasks->state[i];

		if (task->kind != TASK_EVENT)
			continue;
		bool on = m[CODE_OFFSET(task->single)] >>
			  CODE_TYPE(task->single) & 1;

		if (on && !state->was) {
			state->overruns += state->due;
			state->due = true;
		}
		state->was = on;
	}
}

uint32_t tasks_next(const struct tasks *tasks, const struct program *program)
{
	uint32_t i = 0;

	while (i < program->task_count &&
	       (!tasks->state[i].due || tasks->state[i].ran))
		i++;
	return i;
}

void tasks_take(struct tasks *tasks, const struct program *program, uint32_t task,
		int64_t now_ns)
{
	struct task_state *state = &tasks->state[task];

	state->due = false;
	state->ran = true;
	state->runs++;
	if (program->task[task].kind != TASK_INTERVAL)
		return;
	int64_t interval = task_interval(&program->task[task]);
	int64_t missed = (now_ns - state->next_ns) / interval;

	state->next_ns += (missed + 1) * interval;
	state->overruns += (uint64_t)missed;
	state->late_row = missed ? state->late_row + 1 : 0;
}

bool tasks_must_yield(const struct tasks *tasks, const struct program *program,
		      uint32_t task, int64_t now_ns, bool late)
{
	uint32_t priority = program->task[task].priority;

	for (uint32_t i = 0; i < task; i++) {
		const struct code_task *other = &program->task[i];
		bool comes = other->kind == TASK_EVENT ? late :
			     other->kind == TASK_INTERVAL &&
			     now_ns >= tasks->state[i].next_ns;

		if (other->priority < priority && comes)
			return true;
	}
	return false;
}
