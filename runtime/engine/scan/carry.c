/* SPDX-License-Identifier: MIT
 *
 * carry - executes a plan: values, forces, tasks, counters. This is the part that runs
 * between two scans: no names, no allocation, no loop that depends on a value.
 */
#include "engine/scan/carry_plan.h"

#include <string.h>

/* ---- values ---- */

static bool bit_at(const uint8_t *memory, uint32_t bit)
{
	return memory[bit / 8] >> bit % 8 & 1;
}

static void put_bit(uint8_t *memory, uint32_t bit, bool value)
{
	const uint32_t rest = memory[bit / 8] & ~(1u << bit % 8);

	memory[bit / 8] = (uint8_t)(rest | (uint32_t)value << bit % 8);
}

static void pack(const struct carry_move *move, uint8_t *to, const uint8_t *from)
{
	for (uint32_t i = 0; i < move->count; i++)
		put_bit(to, move->to + i, from[move->from + i] != 0);
}

static void unpack(const struct carry_move *move, uint8_t *to, const uint8_t *from)
{
	for (uint32_t i = 0; i < move->count; i++)
		to[move->to + i] = bit_at(from, move->from + i);
}

static void copy_bits(const struct carry_move *move, uint8_t *to, const uint8_t *from)
{
	for (uint32_t i = 0; i < move->count; i++)
		put_bit(to, move->to + i, bit_at(from, move->from + i));
}

static void copy_changed(const struct carry_move *move, uint8_t *to, const uint8_t *from,
			 const uint8_t *begun)
{
	const uint32_t size = move->size;

	begun += move->begun;
	to += move->to;
	from += move->from;
	for (uint32_t i = 0; i < move->count; i++) {
		const bool unchanged = memcmp(from, begun, size) == 0;

		memcpy(to, unchanged ? begun + size : from, size);
		begun += 2 * size;
		to += size;
		from += size;
	}
}

/* The new image still has its initial text there. */
static void copy_text(const struct carry_move *move, uint8_t *to, const uint8_t *from,
		      const uint8_t *begun)
{
	const union iec_value old = iec_load(from + move->from, IEC_STRING);
	const union iec_value now = iec_load(to + move->to, IEC_STRING);

	if (old.s->length > now.s->capacity)
		return;
	if (move->begun) {
		const struct iec_string *first = iec_load(begun + move->begun - 1,
							  IEC_STRING).s;

		if (old.s->length == first->length &&
		    memcmp(old.s->text, first->text, first->length) == 0)
			return;
	}
	iec_store(to + move->to, IEC_STRING, old);
}

static void execute(const struct carry_plan *plan, const struct carry_move *move, uint8_t *to,
		    const uint8_t *from)
{
	switch ((enum move)move->kind) {
	case MOVE_BYTES: memcpy(to + move->to, from + move->from, move->count); return;
	case MOVE_PACK: pack(move, to, from); return;
	case MOVE_UNPACK: unpack(move, to, from); return;
	case MOVE_BITS: copy_bits(move, to, from); return;
	case MOVE_CHANGED: copy_changed(move, to, from, plan->begun); return;
	case MOVE_TEXT: copy_text(move, to, from, plan->begun); return;
	}
}

/* ---- pointers ---- */

/* The first that ends behind @where; the number of all: none. */
static uint32_t first_lead(const struct carry_plan *plan, uint32_t where)
{
	uint32_t low = 0, high = plan->lead_count;

	while (low < high) {
		const uint32_t middle = low + (high - low) / 2;

		if (plan->lead[middle].from + plan->lead[middle].bytes > where)
			high = middle;
		else
			low = middle + 1;
	}
	return low;
}

#define GAP_MOST 8u /* bytes between two parts of a variable, less than the largest value has */

/* Where all of these bytes went together; 0: they did not. */
static uint32_t lead_place(const struct carry_plan *plan, uint32_t where, uint32_t bytes)
{
	uint32_t i = first_lead(plan, where), end = where;
	uint32_t away;

	if (i == plan->lead_count || plan->lead[i].from > where)
		return 0;
	away = plan->lead[i].to - plan->lead[i].from;
	for (; i < plan->lead_count && plan->lead[i].from < where + bytes; i++) {
		const struct carry_lead *lead = &plan->lead[i];

		if (lead->to - lead->from != away || (lead->from > end && lead->from - end >= GAP_MOST))
			return 0;
		end = lead->from + lead->bytes;
	}
	return end + GAP_MOST > where + bytes ? where + away : 0;
}

/* A pointer with its old initial value has the new one already. */
static void carry_pointers(const struct carry_plan *plan, uint8_t *to, const uint8_t *from)
{
	const uint64_t rest = (UINT64_C(1) << CODE_POINTER_PLACE) - 1;

	for (uint32_t i = 0; i < plan->pointer_count; i++) {
		const struct carry_pointer *pointer = &plan->pointer[i];
		uint64_t value;
		uint32_t place;

		memcpy(&value, from + pointer->from, sizeof(value));
		if (value == pointer->begun)
			continue;
		place = lead_place(plan, (uint32_t)(value >> CODE_POINTER_PLACE),
				   (uint32_t)(value >> CODE_POINTER_BYTES & CODE_POINTER_MOST));
		value = place ? (uint64_t)place << CODE_POINTER_PLACE | (value & rest) : 0;
		memcpy(to + pointer->to, &value, sizeof(value));
	}
}

/* ---- forces ---- */

/* An address stays the same. */
static struct location same_address(const struct carry_plan *plan, struct location at)
{
	const struct areas *to = &plan->to->areas, *from = &plan->from->areas;
	const uint32_t size = iec_type_row(at.type)->size;
	enum iec_area area = at.area;
	uint32_t byte = at.where / 8;

	if (area == AREA_NONE) {
		area = areas_find(from, at.where);
		byte = at.where - from->at[area];
		at.where = to->at[area] + byte;
	}
	if (byte >= to->bytes[area] ||
	    (at.area == AREA_NONE && size > to->bytes[area] - byte))
		at.type = IEC_NONE;
	return at;
}

static const struct carry_force *find_force(const struct carry_plan *plan, uint32_t where)
{
	uint32_t low = 0, high = plan->force_count;

	while (low < high) {
		const uint32_t middle = low + (high - low) / 2;

		if (plan->force[middle].from > where)
			high = middle;
		else
			low = middle + 1;
	}
	return low ? &plan->force[low - 1] : NULL;
}

struct location carry_force_place(const struct carry_plan *plan, struct location at)
{
	const struct location nowhere = { .type = IEC_NONE };
	const struct carry_force *force;
	uint32_t size, number;

	if (plan->same)
		return at;
	if (at.area != AREA_NONE || at.where < plan->from->areas.size)
		return same_address(plan, at);
	force = find_force(plan, at.where);
	if (!force || force->type != (uint32_t)at.type)
		return nowhere;
	size = iec_type_row(at.type)->size;
	number = (at.where - force->from) / size;
	if (number >= force->count || (at.where - force->from) % size != 0)
		return nowhere;
	at.area = (enum iec_area)force->area;
	at.where = force->to + (at.area == AREA_NONE ? number * size : number);
	return at;
}

static void carry_forces(const struct carry_plan *plan, struct image *to,
			 const struct image *from)
{
	for (int i = 0; i < from->force_count; i++) {
		const struct force *force = &from->force[i];
		const struct location at = carry_force_place(plan, force->at);

		if (at.type == IEC_NONE)
			continue;
		image_set(to, at, force->aside);
		image_force(to, at, force->value);
	}
}

/* ---- the image ---- */

static void carry_image(const struct carry_plan *plan, struct image *to,
			const struct image *from)
{
	if (plan->same) {
		memcpy(to->memory, from->memory, image_memory_size(plan->to));
		to->force_count = from->force_count;
		memcpy(to->force, from->force, sizeof(to->force));
		return;
	}
	for (uint32_t i = 0; i < plan->move_count; i++) {
		const struct carry_move *move = &plan->move[i];

		execute(plan, move, to->memory, move->own ? to->memory : from->memory);
	}
	carry_pointers(plan, to->memory, from->memory);
	carry_forces(plan, to, from);
}

/* ---- tasks, counters, times ---- */

/* The POU's name in the new program; "": none. A place has the very pointer that its
 * program has. */
static const char *own_pou(const struct carry_plan *plan, const char *name)
{
	const struct program *from = plan->from;

	for (uint32_t i = 0; name && i < from->entry_count && from->string_bytes; i++)
		if (from->string + from->entry[i].name == name)
			return plan->pou[i] ? plan->to->string + plan->pou[i] - 1 : "";
	return name ? "" : NULL;
}

static const char *own_task(const struct carry_plan *plan, const char *name)
{
	for (uint32_t i = 0; name && i < plan->from->task_count; i++)
		if (task_name(plan->from, i) == name)
			return plan->task[i] == CARRY_NO_TASK ?
			       NULL : task_name(plan->to, plan->task[i]);
	return NULL;
}

static struct fault_place own_place(const struct carry_plan *plan,
				    struct fault_place place)
{
	place.pou = own_pou(plan, place.pou);
	place.task = own_task(plan, place.task);
	return place;
}

/* A task that is new or has another interval begins now. An event variable that is TRUE
 * already starts no new task. */
static void carry_tasks(const struct carry_plan *plan, struct resource *to,
			const struct resource *from)
{
	tasks_start(&to->tasks, plan->to, from->vm.now_ns - from->timers_ns);
	tasks_look(&to->tasks, plan->to, to->image.memory);
	for (uint32_t i = 0; i < plan->to->task_count; i++) {
		to->tasks.state[i].due = false;
		if (plan->state[i] != CARRY_NO_TASK)
			to->tasks.state[i] = from->tasks.state[plan->state[i]];
	}
}

static void carry_resource(const struct carry_plan *plan, struct resource *to,
			   const struct resource *from)
{
	to->state = from->state;
	to->fault = from->fault;
	to->fault_at = own_place(plan, from->fault_at);
	to->halted = from->halted;
	to->halt_at = own_place(plan, from->halt_at);
	to->error_at = own_place(plan, from->error_at);
	to->scans = from->scans;
	to->start_ns = from->start_ns;
	to->errors_before = from->errors_before;
	to->late = from->late;
	to->io_fault = from->io_fault;
	to->warm = from->warm;
	to->retain_lost = from->retain_lost;
	to->retain_old_copy = from->retain_old_copy;
	to->timers_ns = from->timers_ns;
	to->scan_us = from->scan_us;
	to->scan_max_us = from->scan_max_us;
	to->wall_offset_ns = from->wall_offset_ns;
	to->second_ns = from->second_ns;
	to->day_ns = from->day_ns;
	to->vm = from->vm;
	to->vm.memory = to->image.memory;
	to->vm.program = to->image.program;
	to->vm.error_text = to->vm.fault_text = to->vm.stop_text = 0;
	carry_tasks(plan, to, from);
}

bool carry_apply(const struct carry_plan *plan, struct resource *to,
		 const struct resource *from)
{
	if (to->image.program != plan->to || from->image.program != plan->from)
		return false;
	carry_image(plan, &to->image, &from->image);
	carry_resource(plan, to, from);
	return true;
}

struct carry_cost carry_cost(const struct carry_plan *plan)
{
	return plan->cost;
}
