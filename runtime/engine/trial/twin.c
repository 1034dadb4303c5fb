/* SPDX-License-Identifier: MIT
 *
 * twin - the scans of a program and its plant, and the acts between them.
 */
#include "engine/trial/twin.h"

#include "engine/scan/carry.h"
#include "engine/scan/still.h"
#include "engine/scan/retain.h"
#include "engine/trial/pace.h"
#include "engine/trial/plant.h"

#include <stdlib.h>
#include <string.h>

static bool has_plant(const struct twin *twin)
{
	return twin->plant.image.program != NULL;
}

/* Bits of inputs of the program, area by area, as offset in its memory. */
static size_t mask_size(const struct program *program)
{
	return program->areas.size;
}

static bool take_memory(struct twin *twin, const struct program *program,
			const struct program *plant)
{
	uint8_t *memory;

	twin->memory_size = image_memory_size(program);
	twin->plant_size = plant ? image_memory_size(plant) : 0;
	/* One block: program, plant, mask; each aligned to 8. */
	twin->memory_size = (twin->memory_size + 7) & ~(size_t)7;
	twin->plant_size = (twin->plant_size + 7) & ~(size_t)7;
	memory = calloc(1, twin->memory_size + twin->plant_size + mask_size(program));
	if (!memory)
		return false;
	resource_init(&twin->resource, program, memory);
	if (plant)
		resource_init(&twin->plant, plant, memory + twin->memory_size);
	twin->plant_drives = memory + twin->memory_size + twin->plant_size;
	return true;
}

bool twin_init(struct twin *twin, const struct program *program,
	      const struct program *plant, int64_t period_ns)
{
	memset(twin, 0, sizeof(*twin));
	if (!take_memory(twin, program, plant))
		return false;
	twin->resource.watch = true;
	twin->period_ns = period_ns;
	if (plant)
		plant_find(&twin->plant.image, &program->areas, twin->plant_drives);
	return true;
}

void twin_free(struct twin *twin)
{
	free(twin->resource.image.memory);
	memset(twin, 0, sizeof(*twin));
}

bool twin_clone(struct twin *twin, const struct twin *from)
{
	const size_t mask = mask_size(from->resource.image.program);

	memset(twin, 0, sizeof(*twin));
	if (!take_memory(twin, from->resource.image.program, from->plant.image.program))
		return false;
	memcpy(twin->plant_drives, from->plant_drives, mask);
	twin->safe = from->safe;
	twin_copy(twin, from);
	return true;
}

static void resource_copy(struct resource *to, const struct resource *from, size_t size)
{
	uint8_t *memory = to->image.memory;
	struct still *still = to->still;

	if (!size)
		return;
	*to = *from;
	to->still = still;
	still_reset(still);
	to->image.memory = to->vm.memory = memory;
	if (to->vm.stand)
		to->vm.run = NULL;
	to->vm.stand = NULL;
	memcpy(memory, from->image.memory, size);
}

void twin_copy(struct twin *twin, const struct twin *from)
{
	resource_copy(&twin->resource, &from->resource, twin->memory_size);
	resource_copy(&twin->plant, &from->plant, twin->plant_size);
	twin->now_ns = from->now_ns;
	twin->period_ns = from->period_ns;
	twin->scan = from->scan;
}

/* A new plant starts when the program does. */
static bool change(struct twin *twin, const struct twin *from, struct arena *arena)
{
	if (!carry(&twin->resource, &from->resource, arena))
		return false;
	if (has_plant(twin) && has_plant(from))
		return carry(&twin->plant, &from->plant, arena);
	if (has_plant(twin) && twin->resource.state == STATE_RUN)
		resource_start(&twin->plant);
	return true;
}

/* The state of @from after the scan that stands. */
static bool change_finished(struct twin *twin, const struct twin *from, struct arena *arena)
{
	struct twin *finished = malloc(sizeof(*finished));
	bool good = finished && twin_clone(finished, from);

	if (good) {
		pace_finish(&finished->resource);
		good = change(twin, finished, arena);
		twin_free(finished);
	}
	free(finished);
	return good;
}

bool twin_change(struct twin *twin, const struct twin *from)
{
	struct arena arena;
	bool good;

	arena_init(&arena);
	good = from->resource.standing ? change_finished(twin, from, &arena) :
					 change(twin, from, &arena);
	arena_free(&arena);
	pace_set(&twin->resource, from->resource.pace.speed);
	twin->resource.watch = from->resource.watch;
	twin->now_ns = from->now_ns;
	twin->period_ns = from->period_ns;
	twin->scan = from->scan;
	return good;
}

/* ---- acts ---- */

static bool is_on(const uint8_t *bits, enum iec_area area, uint32_t bit)
{
	return area == AREA_Q && bits && (bits[bit / 8] >> bit % 8 & 1);
}

/* @bits: as of twin_set_safe(). */
static void put_outputs(struct image *image, const uint8_t *bits)
{
	for (size_t i = 0; i < PLANT_PAIRS; i++) {
		const enum iec_area area = plant_pairs[i].out;

		const uint32_t count = 8 * image->program->areas.bytes[area];

		for (uint32_t bit = 0; bit < count; bit++)
			if (!is_on(bits, area, count + bit))
				image_set_bit(image, area, bit, is_on(bits, area, bit));
	}
}

void twin_outputs_safe(struct twin *twin)
{
	put_outputs(&twin->resource.image, twin->safe);
}

void twin_set_safe(struct twin *twin, const uint8_t *safe)
{
	twin->safe = safe;
	if (twin->resource.state != STATE_RUN)
		twin_outputs_safe(twin);
}

static void stop(struct twin *twin)
{
	resource_stop(&twin->resource);
	twin_outputs_safe(twin);
	resource_stop(&twin->plant);
}

/* Safe outputs are not retained. */
static bool start_program(struct resource *resource, bool warm)
{
	if (warm && resource->state != STATE_RUN)
		put_outputs(&resource->image, NULL);
	if (warm)
		return retain_start(resource);
	resource_start(resource);
	return true;
}

static void copy_inputs(struct image *to, const struct image *from)
{
	const struct areas *areas = &from->program->areas;

	for (size_t i = 0; i < PLANT_PAIRS; i++) {
		const enum iec_area in = plant_pairs[i].in;

		for (uint32_t bit = 0; bit < 8 * areas->bytes[in]; bit++)
			image_set_bit(to, in, bit, image_get_bit(from, in, bit));
	}
}

bool twin_restart(struct resource *resource, bool warm)
{
	struct image *image = &resource->image;
	const size_t size = image_memory_size(image->program);
	struct image *before = malloc(sizeof(*before));
	uint8_t *memory = malloc(size);
	bool good = before && memory;

	if (good) {
		*before = *image;
		before->memory = memcpy(memory, image->memory, size);
		good = start_program(resource, warm);
	}
	if (good)
		copy_inputs(image, before);
	for (int i = 0; good && i < before->force_count; i++)
		image_force(image, before->force[i].at, before->force[i].value);
	free(memory);
	free(before);
	return good;
}

/* A plant that never ran, or has stopped, cannot go on. */
static bool start_plant(struct twin *twin, bool warm)
{
	if (warm && twin->plant.state == STATE_STOP && twin->plant.scans &&
	    !twin->plant.halted)
		twin->plant.state = STATE_RUN;
	return (warm && twin->plant.state == STATE_RUN) ||
	       twin_restart(&twin->plant, false);
}

/* The plant first: if that fails, nothing has changed. */
static bool start(struct twin *twin, bool warm)
{
	return (!has_plant(twin) || start_plant(twin, warm)) &&
	       twin_restart(&twin->resource, warm);
}

static void release_all(struct image *image)
{
	while (image->force_count)
		image_unforce(image, image->force[image->force_count - 1].at);
}

static bool set_period(struct twin *twin, int64_t ns)
{
	if (ns <= 0)
		return false;
	twin->period_ns = ns;
	return true;
}

static bool set_speed(struct twin *twin, int64_t speed)
{
	if (speed < 0 || (uint64_t)speed > PACE_SPEED_MOST)
		return false;
	pace_set(&twin->resource, (uint64_t)speed);
	return true;
}

bool twin_act(struct twin *twin, const struct act *act)
{
	struct image *image = act->plant ? &twin->plant.image : &twin->resource.image;

	if (!image->program)
		return false;
	switch (act->kind) {
	case ACT_SET: return image_set(image, act->at, act->value);
	case ACT_FORCE: return image_force(image, act->at, act->value);
	case ACT_RELEASE: return image_unforce(image, act->at);
	case ACT_RELEASE_ALL: release_all(image); return true;
	case ACT_START: return start(twin, false);
	case ACT_WARM: return start(twin, true);
	case ACT_STOP: stop(twin); return true;
	case ACT_PERIOD: return set_period(twin, act->value.i);
	case ACT_SPEED: return !act->plant && set_speed(twin, act->value.i);
	}
	return false;
}

/* ---- scans ---- */

static bool is_running(struct twin *twin)
{
	if (twin->resource.state == STATE_FAULT)
		twin_outputs_safe(twin);
	return twin->resource.state == STATE_RUN;
}

/* The plant first: it has a period to react to the last outputs before the program
 * reads inputs again, and the first scan sees its inputs. */
bool twin_scan(struct twin *twin)
{
	struct resource *resource = &twin->resource;

	if (resource->state != STATE_RUN)
		return false;
	twin->now_ns += twin->period_ns;
	twin->scan++;
	resource->period_ns = twin->period_ns;
	if (has_plant(twin)) {
		twin->plant.period_ns = twin->period_ns;
		plant_turn(&twin->plant, twin->plant_drives, &resource->image,
			   twin->now_ns);
	}
	pace_scan(resource, twin->now_ns, twin->period_ns);
	return is_running(twin);
}

bool twin_go_on(struct twin *twin)
{
	if (!twin->resource.stopped)
		return false;
	pace_go_on(&twin->resource, twin->period_ns);
	return is_running(twin);
}
