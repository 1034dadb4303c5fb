/* SPDX-License-Identifier: MIT
 *
 * resource - the states of a controller, and its scan.
 */
#include "engine/scan/resource.h"

#include "engine/base/name.h"
#include "engine/scan/interrupt.h"
#include "engine/scan/still.h"

#include <stddef.h>
#include <string.h>

#define MS_NS     INT64_C(1000000)
#define SECOND_NS INT64_C(1000000000)
#define DAY_NS    (86400 * SECOND_NS)

/* ---- leaving out what has not changed ---- */

#ifndef RUNGBOARD_SMALL
/* In virtual time with a speed each safe point counts the words up to the next one. */
static bool counts_points(const struct resource *resource)
{
	return resource->vm.at_point && resource->interrupts && resource->interrupts->ran;
}

static void begin_image(struct resource *resource, int64_t now_ns, bool watch)
{
	struct still *still = HAS_STILL ? resource->still : NULL;

	if (!still || !still_begin(still, &resource->image, now_ns + resource->timers_ns,
				   !watch && !resource->pace.speed))
		image_begin(&resource->image);
}

static void end_image(struct resource *resource)
{
	struct still *still = HAS_STILL ? resource->still : NULL;

	if (!still || !still_end(still, &resource->image))
		image_end(&resource->image);
}

static enum fault run_program(struct resource *resource, uint32_t entry, bool watch)
{
	if (resource->vm.run)
		return resource->vm.run(&resource->vm, entry, watch);
	if (HAS_STILL && resource->still && !watch)
		return still_run(resource->still, &resource->vm, entry);
	return vm_run(&resource->vm, entry, watch);
}

static void reset_still(struct resource *resource)
{
	if (HAS_STILL)
		still_reset(resource->still);
}

/* Does a program stand where nobody has asked for another task? */
static bool is_stopped(struct resource *resource)
{
	const struct vm *vm = &resource->vm;

	resource->stopped = vm->stand && vm->stand->stands;
	return resource->stopped;
}

static void drop_stop(struct resource *resource)
{
	resource->stopped = resource->stopped_late = false;
}

static bool is_late_stopped(struct resource *resource)
{
	resource->stopped_late = resource->stopped;
	return resource->stopped_late;
}
#else
#define is_stopped(resource) false
#define is_late_stopped(resource) false
#define drop_stop(resource)
#define counts_points(resource) false
#define begin_image(resource, now_ns, watch) ((void)(watch), image_begin(&(resource)->image))
#define end_image(resource) image_end(&(resource)->image)
#define run_program(resource, entry, watch) vm_run(&(resource)->vm, entry, watch)
#define reset_still(resource)
#endif

static void begin_cold(struct resource *resource)
{
	const struct program *program = resource->image.program;

	image_init(&resource->image, program, resource->image.memory);
	memset(&resource->vm, 0, sizeof(resource->vm));
	resource->vm.memory = resource->image.memory;
	resource->vm.program = program;
	resource->scans = 0;
	resource->start_ns = 0;
	resource->errors_before = 0;
	resource->fault = FAULT_NONE;
	memset(&resource->fault_at, 0, sizeof(resource->fault_at));
	memset(&resource->error_at, 0, sizeof(resource->error_at));
	resource->halted = false;
	memset(&resource->halt_at, 0, sizeof(resource->halt_at));
	resource->late = false;
	resource->warm = false;
	resource->retain_lost = resource->retain_old_copy = false;
	resource->scan_us = resource->scan_max_us = 0;
	resource->second_ns = INT64_MIN;
	resource->level = 0;
	resource->standing = false;
	drop_stop(resource);
	tasks_start(&resource->tasks, program, 0);
	reset_still(resource);
}

void resource_init(struct resource *resource, const struct program *program,
		   void *memory)
{
	memset(resource, 0, sizeof(*resource));
	resource->image.program = program;
	resource->image.memory = memory;
	resource->wall_offset_ns = RESOURCE_WALL;
	begin_cold(resource);
	resource->state = STATE_STOP;
}

void resource_start(struct resource *resource)
{
	begin_cold(resource);
	resource->io_fault = false;
	resource->state = STATE_RUN;
}

void resource_stop(struct resource *resource)
{
	if (resource->state == STATE_RUN)
		resource->state = STATE_STOP;
}

void resource_fail(struct resource *resource, enum fault fault)
{
	if (resource->fault == FAULT_NONE)
		resource->fault = fault;
	resource->state = STATE_FAULT;
}

/* TRUE in the first half of each period since the start. */
static bool clock_bit(int64_t since_ns, int64_t period_ms)
{
	return since_ns % (period_ms * MS_NS) < period_ms * MS_NS / 2;
}

static void store32(uint8_t *at, uint32_t value)
{
	memcpy(at, &value, sizeof(value));
}

static void store64(uint8_t *at, int64_t value)
{
	memcpy(at, &value, sizeof(value));
}

void resource_zone(struct resource *resource, int64_t zone_ns)
{
	store64(image_area(&resource->image, AREA_SM) + RESOURCE_ZONE, zone_ns);
}

void resource_disk(struct resource *resource, bool fault)
{
	image_area(&resource->image, AREA_SM)[RESOURCE_DISK] = fault;
}

/* System words that change once a second: SMD24 … SMB47 without the time of day. */
static void write_calendar(struct resource *resource, uint8_t *sm, int64_t wall_ns)
{
	int64_t day = wall_ns / DAY_NS - (wall_ns % DAY_NS < 0);
	int64_t second;
	int year, month, of_month;

	iec_civil(day, &year, &month, &of_month);
	resource->day_ns = day * DAY_NS;
	second = (wall_ns - resource->day_ns) / SECOND_NS;
	resource->second_ns = resource->day_ns + second * SECOND_NS;
	store64(sm + 24, resource->day_ns);
	sm[40] = (uint8_t)year, sm[41] = (uint8_t)(year >> 8);
	sm[42] = (uint8_t)month;
	sm[43] = (uint8_t)of_month;
	sm[44] = (uint8_t)(second / 3600);
	sm[45] = (uint8_t)(second / 60 % 60);
	sm[46] = (uint8_t)(second % 60);
	/* 1970-01-01 was a Thursday. */
	sm[47] = (uint8_t)((day % 7 + 10) % 7 + 1);
}

static void write_wall(struct resource *resource, uint8_t *sm, int64_t now_ns)
{
	uint64_t wall = (uint64_t)now_ns + (uint64_t)resource->wall_offset_ns;
	int64_t wall_ns = (int64_t)wall;

	/* Near the limits of 64 bits a whole day would overflow. */
	if (wall_ns < -INT64_MAX + DAY_NS || wall_ns > INT64_MAX - DAY_NS)
		wall_ns = 0;
	store64(sm + 16, wall_ns);
	if ((uint64_t)wall_ns - (uint64_t)resource->second_ns >= SECOND_NS)
		write_calendar(resource, sm, wall_ns);
	store64(sm + 32, wall_ns - resource->day_ns);
}

/* What depends on the time: SMX0.x and the calendar. */
static void write_times(struct resource *resource, int64_t now_ns)
{
	uint8_t *sm = image_area(&resource->image, AREA_SM);
	int64_t since = now_ns - resource->start_ns;

	sm[0] = (uint8_t)(1u << 0 | (resource->scans == 0) << 1 |
			  resource->retain_lost << 2 |
			  resource->retain_old_copy << 3 |
			  clock_bit(since, 60000) << 4 |
			  clock_bit(since, 1000) << 5 |
			  clock_bit(since, 100) << 6 | resource->warm << 7);
	write_wall(resource, sm, now_ns);
}

/* System bits and words, rules R5 of the reliability design. Addresses are rows
 * of catalog.def: SMX0.x, SMX1.x, SMD4, SMD8, SMD12, and the calendar above. */
static void write_system(struct resource *resource, int64_t now_ns)
{
	uint8_t *sm = image_area(&resource->image, AREA_SM);
	bool failed = resource->vm.errors != resource->errors_before;

	write_times(resource, now_ns);
	sm[1] = (uint8_t)((resource->image.force_count > 0) << 0 |
			  resource->late << 1 | resource->io_fault << 2 |
			  failed << 3);
	store32(sm + 4, resource->scan_us);
	store32(sm + 8, resource->scan_max_us);
	store32(sm + 12, resource->vm.errors);
	resource->errors_before = resource->vm.errors;
}

/* The POU, rung and cell of a word of the section that ran. */
static struct fault_place place_in(const struct resource *resource, uint32_t text,
				   bool watch)
{
	const struct program *program = resource->image.program;

	return resource_place(program, watch ? program->text_words + text : text);
}

struct fault_place resource_place(const struct program *program, uint32_t text)
{
	struct fault_place out = { .pou = "" };
	uint32_t low = 0, high = program->place_count;

	while (low < high) {
		uint32_t middle = low + (high - low) / 2;

		if (program->place[middle].text > text)
			high = middle;
		else
			low = middle + 1;
	}
	if (low == 0)
		return out;
	const struct code_place *place = &program->place[low - 1];

	if (program->string_bytes)
		out.pou = program->string + program->entry[place->pou].name;
	if (place->col == CODE_LINE) {
		out.line = place->rung;
		return out;
	}
	out.rung = place->rung;
	out.row = place->row;
	out.col = place->col;
	return out;
}

/* Whether a task was too slow, or late too often. Only possible with a clock. */
static bool is_too_slow(const struct resource *resource, uint32_t index,
			int64_t took_ns)
{
	int64_t limit = task_limit(&resource->image.program->task[index],
				   resource->patience, resource->period_ns);

	return (limit && took_ns >= limit) ||
	       (resource->patience &&
		resource->tasks.state[index].late_row >= resource->patience);
}

/* SYS_CYCLE: the time since the task's last run. A first run counts as regular. */
static void write_cycle(struct resource *resource, uint32_t index)
{
	struct task_state *state = &resource->tasks.state[index];
	int64_t cycle_ns = task_interval(&resource->image.program->task[index]);

	if (state->began)
		cycle_ns = resource->vm.now_ns - state->began_ns;
	else if (!cycle_ns)
		cycle_ns = resource->period_ns;
	state->began = true;
	state->began_ns = resource->vm.now_ns;
	store64(image_area(&resource->image, AREA_SM) + RESOURCE_CYCLE, cycle_ns);
}

/* ---- words, and safe points ---- */

static struct level_run *run_of(struct resource *resource)
{
	return &resource->run[resource->level];
}

static void count_called(struct resource *resource)
{
	resource->words += resource->vm.called;
	resource->vm.called = 0;
}

static void count_program(struct resource *resource, uint32_t entry)
{
	const struct program *program = resource->image.program;
	const struct code_program *at = &program->entry[entry];
	const bool points = counts_points(resource) && (program->text[at->text] & 0xff) == VM_POINT;

	count_called(resource);
	resource->words += points ? 0 : at->text_words;
}

/* Shall tasks above the one that runs, or is about to, run here? */
static bool asks(struct resource *resource)
{
	const struct program *program = resource->image.program;
	const uint32_t count = tasks_above(program, run_of(resource)->task);
	const struct interrupts *interrupts = resource->interrupts;

	return count && resource->level < LIMIT_LEVELS &&
	       interrupts->asks(resource, &resource->asked_ns) &&
	       (!interrupts->begin ||
		tasks_may_begin(&resource->tasks, program, count, resource->asked_ns));
}

/* @words: of code up to the next safe point. */
static bool at_point(struct vm *vm, uint32_t words)
{
	struct resource *resource =
		(struct resource *)((char *)vm - offsetof(struct resource, vm));

	if (!counts_points(resource))
		words = 0;
	count_called(resource);
	if (asks(resource)) {
		run_of(resource)->ahead = words;
		return true;
	}
	resource->words += words;
	return false;
}

/* A safe point before a task or a program. */
static bool asks_before(struct resource *resource)
{
	struct vm *vm = &resource->vm;

	if (!vm->at_point)
		return false;
	vm->points++;
	return vm->ask && asks(resource);
}

/* ---- one task ---- */

/* @due_ns: its deadline; 0: it has none. */
static void begin_task(struct resource *resource, uint32_t index, int64_t due_ns)
{
	struct task_state *state = &resource->tasks.state[index];
	struct level_run *run = run_of(resource);

	run->task = index;
	run->call = 0;
	run->begun = true;
	run->passed = false;
	if (resource->clock_ns) {
		run->begin_ns = resource->clock_ns(resource);
		/* In the first scan all of them begin. */
		if (due_ns && resource->scans && run->begin_ns - due_ns > state->wait_ns)
			state->wait_ns = run->begin_ns - due_ns;
	}
	write_cycle(resource, index);
	resource->vm.budget = resource->image.program->header->budget;
}

static void time_task(struct resource *resource)
{
	const struct level_run *run = run_of(resource);
	struct task_state *state = &resource->tasks.state[run->task];

	if (!resource->clock_ns)
		return;
	state->last_ns = resource->clock_ns(resource) - run->begin_ns;
	if (state->last_ns > state->max_ns)
		state->max_ns = state->last_ns;
	if (resource->state != STATE_RUN ||
	    !is_too_slow(resource, run->task, state->last_ns))
		return;
	resource_fail(resource, FAULT_WATCHDOG);
	resource->fault_at.task = task_name(resource->image.program, run->task);
}

static void fail_task(struct resource *resource, enum fault fault, bool watch)
{
	const struct program *program = resource->image.program;

	resource_fail(resource, fault);
	resource->fault_at = place_in(resource, resource->vm.fault_text, watch);
	if (tasks_declared(program))
		resource->fault_at.task = task_name(program, run_of(resource)->task);
}

/* Runs the programs of a task, or goes on with them; each task has its own budget. False: it
 * stands at a safe point. */
static bool run_programs(struct resource *resource, bool watch)
{
	const struct program *program = resource->image.program;
	struct level_run *run = run_of(resource);
	const struct code_task *task = &program->task[run->task];
	struct vm *vm = &resource->vm;
	enum fault fault = FAULT_NONE;

	for (; run->call < task->count && fault == FAULT_NONE; run->call++) {
		const uint32_t entry = program->call[task->first + run->call];

		if (run->call > 0 && !run->passed && !run->resume && asks_before(resource)) {
			run->passed = true;
			return false;
		}
		run->passed = false;
		vm->resume = run->resume;
		resource->words += run->ahead;
		run->ahead = 0;
		fault = run_program(resource, entry, watch);
		run->resume = vm->resume;
		if (fault == FAULT_PAUSED)
			return false;
		count_program(resource, entry);
	}
	if (fault != FAULT_NONE)
		fail_task(resource, fault, watch);
	return true;
}

static bool run_task(struct resource *resource, bool watch)
{
	const struct interrupts *interrupts = resource->interrupts;
	const uint64_t from = resource->words;
	const bool whole = run_programs(resource, watch);

	if (interrupts && interrupts->ran)
		interrupts->ran(resource, run_of(resource)->task, from, whole);
	return whole;
}

/* ---- the tasks of a cycle ---- */

/* All tasks run in the first scan, so that they see SYS_FIRST_SCAN. */
static bool must_yield(const struct resource *resource, uint32_t task)
{
	int64_t now_ns;
	bool late;

	if (resource->tasks_most)
		return resource->tasks_ran >= resource->tasks_most;
	if (!resource->clock_ns || resource->scans == 0 || resource->vm.at_point)
		return false;
	now_ns = resource->clock_ns(resource);
	late = resource->tick_ns &&
	       now_ns - resource->due_ns >= resource->tick_ns;
	return tasks_must_yield(&resource->tasks, resource->image.program, task,
				now_ns, late);
}

/* The task that is due next; its number is @end or above: none. */
static uint32_t next_task(struct resource *resource, uint32_t *end)
{
	const struct program *program = resource->image.program;
	const uint32_t task = tasks_next(&resource->tasks, program);

	*end = resource->level == 0 ? program->task_count :
	       tasks_above(program, resource->run[resource->level - 1].task);
	if (resource->level == 0 && task < *end && resource->tasks_ran &&
	    must_yield(resource, task))
		*end = task;
	return task;
}

/* Begins the next task of this level. @none: there is none. False: the scan stands before it. */
static bool begin_next(struct resource *resource, bool *none)
{
	const struct program *program = resource->image.program;
	struct tasks *tasks = &resource->tasks;
	struct level_run *run = run_of(resource);
	uint32_t end, task = next_task(resource, &end);
	int64_t due_ns = 0;

	/* What interrupted may have made another task due. */
	if (run->passed && task != run->task)
		run->passed = false;
	*none = task >= end && !run->passed;
	if (*none)
		return true;
	if (!run->passed && resource->level == 0 && resource->tasks_ran) {
		run->task = task;
		run->passed = true;
		if (asks_before(resource))
			return false;
	}
	if (program->task[task].kind == TASK_INTERVAL)
		due_ns = tasks->state[task].next_ns;
	tasks_take(tasks, program, task, run->now_ns);
	begin_task(resource, task, due_ns);
	return true;
}

static void end_task(struct resource *resource)
{
	time_task(resource);
	run_of(resource)->begun = false;
	tasks_look(&resource->tasks, resource->image.program, resource->image.memory);
	resource->tasks_ran += resource->level == 0;
}

/* The tasks of this level that are due, until there are no more. False: one of them stands at a
 * safe point. */
static bool run_tasks(struct resource *resource, bool watch)
{
	bool none = false;

	while (resource->state == STATE_RUN) {
		if (!run_of(resource)->begun && !begin_next(resource, &none))
			return false;
		if (none)
			return true;
		if (!run_task(resource, watch))
			return false;
		end_task(resource);
	}
	return true;
}

/* ---- tasks that interrupt others ---- */

static void put_aside(struct resource *resource)
{
	struct level_run *run = run_of(resource);

	run->budget = resource->vm.budget;
	run->second_ns = resource->second_ns;
	run->day_ns = resource->day_ns;
	interrupt_begin(&resource->image, resource->level++);
	memset(run_of(resource), 0, sizeof(*run));
}

/* Afterwards the interrupted task finds its time, inputs and outputs as they were. */
static void go_back(struct resource *resource)
{
	const struct level_run *run;

	interrupt_end(&resource->image, --resource->level);
	run = run_of(resource);
	resource->vm.budget = run->budget;
	resource->vm.now_ns = run->now_ns + resource->timers_ns;
	resource->second_ns = run->second_ns;
	resource->day_ns = run->day_ns;
}

static uint32_t tasks_over(const struct resource *resource)
{
	return tasks_above(resource->image.program, resource->run[resource->level - 1].task);
}

/* A cycle of the tasks above the one that was put aside. */
static void begin_inner(struct resource *resource, int64_t now_ns)
{
	const struct level_run *under = &resource->run[resource->level - 1];
	const struct interrupts *interrupts = resource->interrupts;
	struct image *image = &resource->image;

	run_of(resource)->now_ns = now_ns;
	resource->tasks.state[under->task].interrupted += under->resume != 0;
	if (interrupts->begin && !interrupts->begin(resource, now_ns)) {
		resource_fail(resource, FAULT_IO);
		return;
	}
	write_times(resource, now_ns);
	image_begin(image);
	resource->vm.now_ns = now_ns + resource->timers_ns;
	tasks_begin_above(&resource->tasks, image->program, tasks_over(resource), image->memory,
			  now_ns);
}

static void end_inner(struct resource *resource)
{
	const struct interrupts *interrupts = resource->interrupts;
	const int64_t now_ns = run_of(resource)->now_ns;

	image_end(&resource->image);
	if (resource->state == STATE_RUN && !resource->vm.stop && interrupts->end &&
	    !interrupts->end(resource, now_ns))
		resource_fail(resource, FAULT_IO);
	go_back(resource);
}

/* Runs the levels from the highest one down. False: the scan stands. */
static bool run_levels(struct resource *resource, bool watch)
{
	for (;;) {
		if (!run_tasks(resource, watch)) {
			if (is_stopped(resource))
				return false;
			put_aside(resource);
			resource->standing = !resource->interrupts->begin;
			if (resource->standing)
				return false;
			begin_inner(resource, resource->asked_ns);
		} else if (resource->level > 0) {
			end_inner(resource);
		} else {
			return true;
		}
	}
}

/* No task interrupts another in the first scan, in which all of them run. */
static void ready_points(struct resource *resource)
{
	const bool on = resource->interrupts && resource->scans > 0 &&
			interrupt_levels(resource->image.program) > 0;

	resource->vm.at_point = on ? at_point : NULL;
	resource->vm.points = 0;
	resource->vm.called = 0;
	if (on)
		interrupt_written(&resource->image);
	else if (!resource->interrupts || resource->interrupts->begin)
		resource->vm.ask = 0;
}

static bool run_due(struct resource *resource, int64_t now_ns, bool watch)
{
	const struct program *program = resource->image.program;
	const bool declared = tasks_declared(program);

	resource->tasks_ran = 0;
	memset(run_of(resource), 0, sizeof(struct level_run));
	run_of(resource)->now_ns = now_ns;
	if (declared)
		tasks_begin(&resource->tasks, program, resource->image.memory, now_ns);
	if (declared || !program->task_count)
		return !declared || run_levels(resource, watch);
	begin_task(resource, 0, 0);
	return run_task(resource, watch) || !is_stopped(resource);
}

/* Of a scan that stood before. */
static bool end_late(struct resource *resource, bool whole)
{
	if (!whole && is_late_stopped(resource))
		return false;
	interrupt_give_inputs(&resource->image);
	resource->second_ns = INT64_MIN; /* the calendar is that of the begin */
	return whole;
}

/* Goes on with a scan that stands. False: it stands again. Inputs that came from outside
 * meanwhile stay in the image for the next one. */
static bool go_on(struct resource *resource, int64_t now_ns, bool watch)
{
	resource->standing = false;
	interrupt_keep_inputs(&resource->image);
	if (tasks_may_begin(&resource->tasks, resource->image.program, tasks_over(resource),
			    now_ns))
		begin_inner(resource, now_ns);
	else
		go_back(resource);
	return end_late(resource, run_levels(resource, watch));
}

static void clear_area(struct resource *resource, enum iec_area area)
{
	const struct program *program = resource->image.program;

	memset(image_area(&resource->image, area), 0, program->areas.bytes[area]);
	for (uint32_t i = 0; i < program->bits_count; i++) {
		const struct code_bits *bits = &program->bits[i];

		if (bits->area == area)
			memset(resource->image.memory + bits->slot, 0,
			       bits->count);
	}
}

/* A STOP completes the scan, but its outputs must not be used. */
static void halt(struct resource *resource, bool watch)
{
	resource->state = STATE_STOP;
	resource->halted = true;
	resource->halt_at = place_in(resource, resource->vm.stop_text, watch);
	clear_area(resource, AREA_Q);
	clear_area(resource, AREA_AQ);
	clear_area(resource, AREA_XQ);
	clear_area(resource, AREA_XAQ);
}

static void begin_scan(struct resource *resource, int64_t now_ns, bool watch)
{
	if (resource->scans == 0) {
		resource->start_ns = now_ns;
		tasks_start(&resource->tasks, resource->image.program, resource->due_ns ?
			    resource->due_ns : now_ns);
	}
	write_system(resource, now_ns);
	begin_image(resource, now_ns, watch);
	ready_points(resource);
	resource->vm.now_ns = now_ns + resource->timers_ns;
}

static bool end_scan(struct resource *resource, bool whole, uint32_t errors, bool watch)
{
	const struct vm *vm = &resource->vm;

	if (errors == 0 && vm->errors)
		resource->error_at = place_in(resource, vm->error_text, watch);
	if (!whole)
		return true;
	end_image(resource);
	resource->scans++;
	if (vm->stop && resource->state == STATE_RUN)
		halt(resource, watch);
	return resource->state == STATE_RUN;
}

static bool watches(const struct resource *resource)
{
	return resource->watch && resource->image.program->watch_words;
}

#ifndef RUNGBOARD_SMALL
/* A program without tasks has one that is run alone. */
bool resource_go_on(struct resource *resource)
{
	const struct program *program = resource->image.program;
	const uint32_t errors = resource->vm.errors;
	const bool watch = watches(resource), late = resource->stopped_late;
	bool whole;

	resource->stopped = resource->stopped_late = false;
	if (tasks_declared(program))
		whole = run_levels(resource, watch);
	else
		whole = run_task(resource, watch) || !is_stopped(resource);
	if (late)
		whole = end_late(resource, whole);
	return end_scan(resource, whole, errors, watch);
}
#endif

bool resource_scan(struct resource *resource, int64_t now_ns)
{
	const bool watch = watches(resource);
	const uint32_t errors = resource->vm.errors;
	bool whole;

	if (resource->state != STATE_RUN)
		return false;
	resource->words = 0;
	if (resource->standing) {
		whole = go_on(resource, now_ns, watch);
	} else {
		begin_scan(resource, now_ns, watch);
		whole = run_due(resource, now_ns, watch);
	}
	return end_scan(resource, whole, errors, watch);
}

static size_t append(char *out, size_t at, size_t end, const char *text)
{
	while (*text && at + 1 < end)
		out[at++] = *text++;
	out[at] = '\0';
	return at;
}

static size_t append_number(char *out, size_t at, size_t end, uint32_t number)
{
	char digits[12];
	size_t i = sizeof(digits);

	digits[--i] = '\0';
	do
		digits[--i] = (char)('0' + number % 10);
	while (number /= 10);
	return append(out, at, end, digits + i);
}

/* ": Main rung 3", ": Main line 12" */
static void append_place(const struct fault_place *at, bool rung, char *out,
			 size_t from, size_t end)
{
	uint32_t number = at->line ? at->line : at->rung;

	if (!at->pou || !*at->pou || !number || (!rung && !at->line))
		return;
	from = append(out, from, end, ": ");
	from = append(out, from, end - 18, at->pou);
	from = append(out, from, end, at->line ? " line " : " rung ");
	append_number(out, from, end, number);
}

void resource_fault_print(const struct resource *resource, char *out, size_t size)
{
	const char *task = resource->fault_at.task;
	const char *text = fault_text(resource->fault);
	size_t at = 0;

	if (task && resource->fault == FAULT_BUDGET)
		text = "instruction budget exceeded";
	if (task && resource->fault == FAULT_WATCHDOG)
		text = "watchdog: too late or too long";
	if (task) {
		at = append(out, at, size, "task ");
		at = append(out, at, size / 2, task);
		at = append(out, at, size, ": ");
	}
	at = append(out, at, size, text);
	append_place(&resource->fault_at, false, out, at, size);
}

void resource_halt_print(const struct resource *resource, char *out, size_t size)
{
	size_t at = append(out, 0, size,
			   "STOP, outputs are safe: the program says so");

	append_place(&resource->halt_at, true, out, at, size);
}

/* Orders places. Row and column are small; POUs and rungs have limits. CODE_LINE, with row 0, lies
 * before the cells of its rung. */
static uint64_t place_key(uint64_t pou, uint64_t rung, uint32_t row,
			  uint32_t col)
{
	return pou << 48 | (rung & 0x3fffff) << 26 | row << 13 | (col & 0x1fff);
}

static const struct code_power *find_power(const struct program *program,
					   uint32_t pou, uint32_t rung,
					   uint32_t row, uint32_t col)
{
	uint64_t want = place_key(pou, rung, row, col);
	uint32_t low = 0, high = program->power_count;

	if (row > LIMIT_ROWS || col > LIMIT_COLS || row == 0 || col == 0)
		return NULL;
	while (low < high) {
		uint32_t middle = low + (high - low) / 2;
		const struct code_power *at = &program->power[middle];
		uint64_t have = place_key(at->pou, at->rung, at->row, at->col);

		if (have == want)
			return at;
		if (have > want)
			high = middle;
		else
			low = middle + 1;
	}
	return NULL;
}

bool resource_power(const struct resource *resource, uint32_t pou, uint32_t rung,
		    uint32_t row, uint32_t col, bool *in, bool *out)
{
	const struct code_power *at = find_power(resource->image.program, pou,
						 rung, row, col);

	if (!at)
		return false;
	*in = resource->image.memory[at->in];
	*out = resource->image.memory[at->out];
	return true;
}

/* The instance's own byte of power, if it has one; the rail is shared. */
static bool power_at(const struct resource *resource,
		     const struct code_watched *watched, uint32_t offset)
{
	if (offset - watched->from < watched->size)
		offset = watched->to + (offset - watched->from);
	return resource->image.memory[offset];
}

bool resource_power_in(const struct resource *resource, const char *instance,
		       size_t len, uint32_t rung, uint32_t row, uint32_t col,
		       bool *in, bool *out)
{
	const struct program *program = resource->image.program;

	for (uint32_t i = 0; i < program->watched_count; i++) {
		const struct code_watched *watched = &program->watched[i];
		const struct code_power *at;

		if (!name_is(program->string + watched->name, instance, len))
			continue;
		at = find_power(program, watched->pou, rung, row, col);
		if (!at)
			return false;
		*in = power_at(resource, watched, at->in);
		*out = power_at(resource, watched, at->out);
		return true;
	}
	return false;
}
