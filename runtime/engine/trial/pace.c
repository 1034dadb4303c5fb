/* SPDX-License-Identifier: MIT
 *
 * pace - periods of a board of a given speed.
 */
#include "engine/trial/pace.h"

#include <stddef.h>
#include <string.h>

#define MS_NS     1000000
#define MINUTE_NS INT64_C(60000000000)

uint64_t pace_read(const char *text, size_t len)
{
	uint64_t speed = 0;

	for (size_t i = 0; i < len; i++) {
		if (text[i] < '0' || text[i] > '9')
			return PACE_NO_NUMBER;
		if (speed <= PACE_SPEED_MOST)
			speed = speed * 10 + (uint64_t)(text[i] - '0');
	}
	return len ? speed : PACE_NO_NUMBER;
}

int64_t pace_at(const struct resource *resource, uint64_t words)
{
	return resource->pace.begin_ns + (int64_t)(words * MS_NS / resource->pace.speed);
}

static int64_t clock_of(const struct resource *resource)
{
	return pace_at(resource, resource->words);
}

static bool asks(struct resource *resource, int64_t *now_ns)
{
	(void)now_ns;
	return resource->words >= resource->pace.most && !resource->vm.stop;
}

static uint32_t at_most(uint64_t words)
{
	return words < UINT32_MAX ? (uint32_t)words : UINT32_MAX;
}

static void ran(struct resource *resource, uint32_t task, uint64_t from, bool whole)
{
	struct paced *pace = &resource->pace;

	if (pace->parts < PACE_PARTS)
		pace->part[pace->parts++] = (struct pace_part){
			at_most(from), at_most(resource->words), (uint8_t)task, whole };
}

/* ---- rounds of loops ---- */

static bool is_back(const uint32_t *base, const uint32_t *pc)
{
	const uint32_t op = *pc & 0xff;

	return (op == VM_JMP || op == VM_JMPC) && base + pc[1] <= pc && (base[pc[1]] & 0xff) != VM_EACH;
}

/* The program that the words at @pc are of. */
static const struct code_program *entry_of(const struct program *program, uint32_t pc, bool watch)
{
	const struct code_program *at = program->entry;

	while (pc - (watch ? at->watch : at->text) >= (watch ? at->watch_words : at->text_words))
		at++;
	return at;
}

/* The same jump in the code that is not watched: its loops are the same, in the same order. */
static const uint32_t *unwatched(const struct program *program, const uint32_t *from)
{
	const struct code_program *at = entry_of(program, (uint32_t)(from - program->watch), true);
	const uint32_t *pc = program->watch + at->watch, *text = program->text + at->text;
	uint32_t before = 0;

	for (; pc < from; pc += code_words(pc))
		before += is_back(program->watch, pc);
	while (!is_back(program->text, text) || before-- > 0)
		text += code_words(text);
	return text;
}

/* Each safe point counts the words up to the next one, also those behind the loop: so a round costs
 * the words before its first point, less those behind the loop. */
static struct pace_loop round_of(const struct resource *resource, const uint32_t *from)
{
	const struct program *program = resource->image.program;
	const struct code_program *at;
	struct pace_loop loop = { .from = from };
	const uint32_t *pc, *end;

	if (program->watch_words && from >= program->watch && from < program->watch + program->watch_words)
		from = unwatched(program, from);
	at = entry_of(program, (uint32_t)(from - program->text), false);
	for (pc = program->text + from[1]; pc <= from; pc += code_words(pc)) {
		if (resource->vm.at_point && (*pc & 0xff) == VM_POINT)
			break;
	}
	loop.words = (uint32_t)(pc - (program->text + from[1]));
	if (pc > from)
		return loop;
	end = program->text + at->text + at->text_words;
	for (pc = from + code_words(from); pc < end && (*pc & 0xff) != VM_POINT; pc += code_words(pc))
		loop.behind += code_words(pc);
	return loop;
}

static void went_back(struct vm *vm, const uint32_t *from)
{
	struct resource *resource = (struct resource *)((char *)vm - offsetof(struct resource, vm));
	struct pace_loop *known = &resource->pace.loop[(uintptr_t)from / sizeof(*from) % PACE_LOOPS];

	if (known->from != from)
		*known = round_of(resource, from);
	vm->called += known->words;
	resource->words -= known->behind;
}

static const struct interrupts by_words = { .asks = asks, .ran = ran };

/* Others have hooks of their own: a record, a board. */
static bool is_ours(const struct resource *resource)
{
	return resource->interrupts == &by_words;
}

void pace_finish(struct resource *resource)
{
	if (!resource->standing || !is_ours(resource))
		return;
	resource->pace.most = UINT64_MAX;
	resource_scan(resource, resource->asked_ns);
}

void pace_set(struct resource *resource, uint64_t speed)
{
	struct paced *pace = &resource->pace;

	if (!speed && is_ours(resource)) {
		pace_finish(resource);
		resource->interrupts = NULL;
		resource->clock_ns = NULL;
		resource->vm.run = resource->vm.stand ? vm_run_stepping : NULL;
		resource->vm.went_back = NULL;
		resource->patience = 0;
		resource->late = false;
		resource->scan_us = 0;
	}
	memset(pace, 0, sizeof(*pace));
	pace->speed = speed;
}

/* The words of a period. */
static uint64_t words_of(const struct paced *pace, int64_t period_ns)
{
	return pace->speed * (uint64_t)(period_ns < MINUTE_NS ? period_ns : MINUTE_NS) / MS_NS;
}

static void ready(struct resource *resource, int64_t now_ns, uint64_t words)
{
	struct paced *pace = &resource->pace;

	pace->begin_ns = now_ns;
	pace->most = words - pace->owed;
	if (pace->owed)
		pace->begin_ns += (int64_t)(pace->owed * MS_NS / pace->speed);
	resource->asked_ns = pace->begin_ns;
	resource->vm.ask = 1;
	resource->interrupts = &by_words;
	resource->clock_ns = clock_of;
	memset(pace->loop, 0, sizeof(pace->loop));
	resource->vm.run = resource->vm.stand ? vm_run_stepping : vm_run_counting;
	resource->vm.went_back = went_back;
	resource->patience = PACE_PATIENCE;
}

/* A scan that ends behind the next period is late, as on a board. A program without tasks has no
 * other watchdog than this. */
static void judge(struct resource *resource, uint64_t words)
{
	struct paced *pace = &resource->pace;
	const bool late = resource->standing || pace->owed;

	resource->late = late;
	if (resource->standing)
		return;
	resource->scan_us = (uint32_t)(pace->taken * 1000 / pace->speed);
	if (resource->scan_us > resource->scan_max_us)
		resource->scan_max_us = resource->scan_us;
	pace->late_row = late ? pace->late_row + 1 : 0;
	if (resource->state != STATE_RUN || tasks_declared(resource->image.program) ||
	    (pace->late_row < PACE_PATIENCE && pace->taken < PACE_PATIENCE * words))
		return;
	resource_fail(resource, FAULT_WATCHDOG);
}

/* The work of a period has ended, or the scan in it has. */
static bool finish_period(struct resource *resource, uint64_t words)
{
	struct paced *pace = &resource->pace;

	pace->taken += resource->words;
	pace->owed = resource->words > pace->most ? resource->words - pace->most : 0;
	judge(resource, words);
	return resource->state == STATE_RUN;
}

bool pace_go_on(struct resource *resource, int64_t period_ns)
{
	const bool goes_on = resource_go_on(resource);

	if (resource->stopped || !resource->pace.speed)
		return goes_on;
	return finish_period(resource, words_of(&resource->pace, period_ns));
}

bool pace_scan(struct resource *resource, int64_t now_ns, int64_t period_ns)
{
	struct paced *pace = &resource->pace;
	const uint64_t words = words_of(pace, period_ns);

	if (!pace->speed || resource->state != STATE_RUN)
		return resource_scan(resource, now_ns);
	pace->parts = 0;
	if (resource->scans == 0)
		pace->owed = 0;
	/* Still at work: a scan that stands goes on within the period, another one cannot begin. */
	if (pace->owed >= words || (pace->owed && !resource->standing)) {
		pace->owed -= pace->owed < words ? pace->owed : words;
		return true;
	}
	if (!resource->standing)
		pace->taken = 0;
	ready(resource, now_ns, words);
	resource_scan(resource, pace->begin_ns);
	return resource->stopped || finish_period(resource, words);
}
