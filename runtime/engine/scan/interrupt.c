/* SPDX-License-Identifier: MIT
 *
 * interrupt - inputs and outputs of interrupted tasks, byte by byte: the packed areas, then the
 * bits that live a byte each.
 */
#include "engine/scan/interrupt.h"

#include <string.h>

enum side { INPUTS, OUTPUTS };

static bool is_of(enum iec_area area, enum side side)
{
	if (side == INPUTS)
		return iec_area_row(area)->access == ACCESS_READ;
	return area == AREA_Q || area == AREA_AQ || area == AREA_XQ || area == AREA_XAQ;
}

/* A part of memory that belongs to one side. */
struct part { uint32_t at, size; };

/* Part number @i: an area, or one of the runs of bits behind all areas. False: there are no
 * more. A part of another side has size 0. */
static bool part_at(const struct program *program, enum side side, uint32_t i, struct part *out)
{
	const struct code_bits *bits;

	if (i >= AREA_COUNT + program->bits_count)
		return false;
	*out = (struct part){ 0, 0 };
	if (i < AREA_COUNT) {
		if (i > AREA_NONE && is_of((enum iec_area)i, side))
			*out = (struct part){ program->areas.at[i], program->areas.bytes[i] };
		return true;
	}
	bits = &program->bits[i - AREA_COUNT];
	if (is_of((enum iec_area)bits->area, side))
		*out = (struct part){ bits->slot, bits->count };
	return true;
}

static size_t side_bytes(const struct program *program, enum side side)
{
	struct part part;
	size_t bytes = 0;

	for (uint32_t i = 0; part_at(program, side, i, &part); i++)
		bytes += part.size;
	return bytes;
}

static void save(const struct image *image, enum side side, uint8_t *to)
{
	struct part part;

	for (uint32_t i = 0; part_at(image->program, side, i, &part); i++) {
		memcpy(to, image->memory + part.at, part.size);
		to += part.size;
	}
}

static void restore(struct image *image, enum side side, const uint8_t *from)
{
	struct part part;

	for (uint32_t i = 0; part_at(image->program, side, i, &part); i++) {
		memcpy(image->memory + part.at, from, part.size);
		from += part.size;
	}
}

bool interrupt_can(const struct program *program, uint32_t task)
{
	for (uint32_t i = 0; i < task; i++)
		if (program->task[i].kind != TASK_CYCLE &&
		    program->task[i].priority < program->task[task].priority)
			return true;
	return false;
}

uint32_t interrupt_levels(const struct program *program)
{
	uint32_t levels = 0, last = 0;

	for (uint32_t i = 0; i < program->task_count && levels < LIMIT_LEVELS; i++) {
		if (!interrupt_can(program, i) ||
		    (levels && program->task[i].priority == last))
			continue;
		last = program->task[i].priority;
		levels++;
	}
	return levels;
}

/* Behind the data: outputs of whole tasks; the inputs from outside while a scan goes on that
 * stood; then for each level the inputs and outputs of the interrupted task, and the outputs of
 * whole tasks as they were then. */
size_t interrupt_bytes(const struct program *program)
{
	const uint32_t levels = interrupt_levels(program);
	const size_t in = side_bytes(program, INPUTS), out = side_bytes(program, OUTPUTS);

	return levels ? out + in + levels * (in + 2 * out) : 0;
}

static uint8_t *written_at(const struct image *image)
{
	return image->memory + image_memory_size(image->program) -
	       interrupt_bytes(image->program);
}

struct level { uint8_t *inputs, *outputs, *before; };

static struct level level_at(const struct image *image, uint32_t level)
{
	const size_t in = side_bytes(image->program, INPUTS);
	const size_t out = side_bytes(image->program, OUTPUTS);
	uint8_t *at = written_at(image) + out + in + level * (in + 2 * out);

	return (struct level){ at, at + in, at + in + out };
}

void interrupt_written(struct image *image)
{
	save(image, OUTPUTS, written_at(image));
}

static uint8_t *outside_at(const struct image *image)
{
	return written_at(image) + side_bytes(image->program, OUTPUTS);
}

void interrupt_keep_inputs(struct image *image)
{
	save(image, INPUTS, outside_at(image));
}

void interrupt_give_inputs(struct image *image)
{
	restore(image, INPUTS, outside_at(image));
}

void interrupt_begin(struct image *image, uint32_t level)
{
	const struct level at = level_at(image, level);

	save(image, INPUTS, at.inputs);
	save(image, OUTPUTS, at.outputs);
	memcpy(at.before, written_at(image), side_bytes(image->program, OUTPUTS));
	restore(image, OUTPUTS, at.before);
}

void interrupt_end(struct image *image, uint32_t level)
{
	const struct level at = level_at(image, level);
	const uint8_t *written = written_at(image);
	const size_t size = side_bytes(image->program, OUTPUTS);

	interrupt_written(image);
	for (size_t i = 0; i < size; i++) {
		const uint8_t changed = written[i] ^ at.before[i];

		at.outputs[i] = (uint8_t)((at.outputs[i] & ~changed) | (written[i] & changed));
	}
	restore(image, OUTPUTS, at.outputs);
	restore(image, INPUTS, at.inputs);
}
