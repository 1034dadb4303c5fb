/* SPDX-License-Identifier: MIT
 *
 * pace - periods of a board of a given speed.
 */
#include "engine/trial/pace.h"

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
	pace->taken += resource->words;
	pace->owed = resource->words > pace->most ? resource->words - pace->most : 0;
	judge(resource, words);
	return resource->state == STATE_RUN;
}
