/* SPDX-License-Identifier: MIT
 *
 * carry - copies values by name and type from one image to another, then forces, tasks
 * and counters.
 */
#include "engine/scan/carry.h"
#include "engine/base/name.h"
#include "engine/scan/value.h"


#include <stdio.h>
#include <string.h>

/* A symbol of the old program, in the chain of its name. */
struct known {
	struct declared_name name;
	uint32_t hash;
	uint32_t next;  /* 1 + index; 0: the last                              */
	bool taken;     /* of a memory: another one took it                    */
};

struct work {
	struct image *to;
	const struct image *from;
	struct image to_cold, from_cold; /* hashes of their initial values     */
	struct known *known;
	uint32_t count, mask;
	uint32_t *first, *last;  /* by hash: 1 + index                         */
	uint8_t *done;           /* of the new program: a memory that has its value */
};

/* ---- names ---- */

static uint32_t mix(uint32_t hash, const char *text, size_t len)
{
	return (name_hash_more(hash, text, len) ^ 255u) * 16777619u;
}

static bool is_memory(const struct declared_name *name)
{
	return name->flags & SYMBOL_HIDDEN && strchr(name->name, ' ');
}

/* The bytes of a memory's name that identify its element; its rung follows. */
static size_t element_len(const char *name)
{
	const char *rung = strrchr(name, '@');

	return rung ? (size_t)(rung - name) : strlen(name);
}

static size_t key_len(const struct declared_name *name)
{
	return is_memory(name) ? element_len(name->name) : name->array.head;
}

static uint32_t hash_name(const struct declared_name *name)
{
	uint32_t hash = mix(NAME_HASH, name->pou, strlen(name->pou));

	hash = mix(hash, name->name, key_len(name));
	return hash ^ hash >> 15;
}

static bool same_name(const struct declared_name *a, const struct declared_name *b)
{
	const size_t len = key_len(a), pou = strlen(a->pou);

	return name_same(a->name, len, b->name, key_len(b)) &&
	       name_same(a->pou, pou, b->pou, strlen(b->pou)) && is_memory(a) == is_memory(b);
}

static uint32_t count_names(const struct program *program)
{
	struct declared_cursor cursor = { .memories = true };
	struct declared_name name;
	uint32_t count = 0;

	while (image_next_declared(program, &cursor, &name))
		count++;
	return count;
}

/* In the order of the program, so that symbols of one name are found in that order. */
static void enter(struct work *work, uint32_t index)
{
	struct known *known = &work->known[index];
	uint32_t slot;

	known->hash = hash_name(&known->name);
	slot = known->hash & work->mask;
	if (work->last[slot])
		work->known[work->last[slot] - 1].next = index + 1;
	else
		work->first[slot] = index + 1;
	work->last[slot] = index + 1;
}

static bool make_names(struct work *work, struct arena *arena)
{
	struct declared_cursor cursor = { .memories = true };
	uint32_t i = 0;

	work->count = count_names(work->from->program);
	for (work->mask = 15; work->mask < work->count; )
		work->mask = 2 * work->mask + 1;
	work->known = arena_alloc(arena, (work->count + 1) * sizeof(*work->known));
	work->first = arena_alloc(arena, (work->mask + 1) * sizeof(*work->first));
	work->last = arena_alloc(arena, (work->mask + 1) * sizeof(*work->last));
	if (!work->known || !work->first || !work->last)
		return false;
	while (i < work->count && image_next_declared(work->from->program, &cursor,
						      &work->known[i].name))
		enter(work, i++);
	return true;
}

/* @whole: compare a memory's rung, too. */
static struct known *find(const struct work *work, const struct declared_name *name,
			  bool whole)
{
	const uint32_t hash = hash_name(name);
	uint32_t at = work->first[hash & work->mask];

	for (; at; at = work->known[at - 1].next) {
		struct known *known = &work->known[at - 1];

		if (known->hash != hash || known->taken ||
		    !same_name(&known->name, name))
			continue;
		if (!whole || strcmp(known->name.name, name->name) == 0)
			return known;
	}
	return NULL;
}

/* ---- values ---- */

static bool is_read_only(const struct image *image, struct location at)
{
	const struct areas *areas = &image->program->areas;
	enum iec_area area = at.area;

	if (area == AREA_NONE)
		area = areas_find(areas, at.where);
	return area != AREA_NONE && iec_area_row(area)->access == ACCESS_READ;
}

static bool same_value(enum iec_type type, union iec_value a, union iec_value b)
{
	return type == IEC_STRING ? value_order(a.s, b.s) == 0 : a.i == b.i;
}

static bool has_room(const struct image *image, struct location at,
		     union iec_value value)
{
	return at.type != IEC_STRING ||
	       image_get(image, at).s->capacity >= value.s->length;
}

/* A value that was never changed gets its new initial value. */
static void carry_value(const struct work *work, struct location to,
			struct location from)
{
	const union iec_value old = image_get(work->from, from);
	const union iec_value begun = image_get(&work->from_cold, from);

	if (same_value(from.type, old, begun) || !has_room(work->to, to, old))
		image_set(work->to, to, image_get(&work->to_cold, to));
	else
		image_set(work->to, to, old);
}

static void carry_array(const struct work *work, const struct declared_name *to,
			const struct declared_name *from)
{
	for (uint32_t i = 0; i < to->array.count; i++) {
		const int64_t other = (int64_t)to->array.low + i - from->array.low;

		if (other >= 0 && other < from->array.count)
			carry_value(work, declared_element(to, i),
				    declared_element(from, (uint32_t)other));
	}
}

/* The inputs of @row whose initial value the edit changed. */
static void keep_inputs(const struct work *work, const struct word_row *row,
			uint32_t to, uint32_t from)
{
	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];
		const uint8_t *now = work->to_cold.memory + to + pin->offset;
		const uint8_t *then = work->from_cold.memory + from + pin->offset;
		const uint32_t size = iec_type_row(pin->type)->size;

		if (pin->dir == PIN_IN && memcmp(now, then, size) != 0)
			memcpy(work->to->memory + to + pin->offset, now, size);
	}
}

static void carry_instance(const struct work *work, uint32_t to, uint32_t from)
{
	const enum word word = code_instance(work->to->program, to);
	const struct word_row *row = word_row(word);

	if (word != code_instance(work->from->program, from))
		return;
	memcpy(work->to->memory + to, work->from->memory + from, row->size);
	keep_inputs(work, row, to, from);
}

static void carry_name(const struct work *work, const struct declared_name *to,
		       const struct declared_name *from)
{
	if (to->at.type != from->at.type || !to->array.count != !from->array.count ||
	    to->at.constant || is_read_only(work->to, to->at))
		return;
	if (to->array.count)
		carry_array(work, to, from);
	else if (to->at.type == IEC_NONE)
		carry_instance(work, to->at.where, from->at.where);
	else
		carry_value(work, to->at, from->at);
}

/* Memories are matched twice: first by rung, then by element. */
static void carry_names(struct work *work, bool memories, bool whole)
{
	struct declared_cursor cursor = { .memories = true };
	struct declared_name name;

	while (image_next_declared(work->to->program, &cursor, &name)) {
		uint8_t *done = &work->done[cursor.index - 1];
		struct known *known;

		if (is_memory(&name) != memories || *done)
			continue;
		known = find(work, &name, whole);
		if (!known)
			continue;
		carry_name(work, &name, &known->name);
		*done = memories;
		known->taken = memories;
	}
}

/* The contact that a new memory belongs to: its operand, and the path before it if it
 * is in an instance. */
static bool is_contact(const char *name, size_t *path, const char **operand, size_t *len)
{
	const char *blank = strchr(name, ' '), *word = blank;
	const struct word_row *row;

	while (word > name && word[-1] != '.')
		word--;
	row = word_row(word_find(word, (size_t)(blank - word)));
	*path = (size_t)(word - name);
	*operand = blank + 1;
	*len = element_len(name) - (size_t)(blank + 1 - name);
	*len -= *len > 0;
	return row->place == PLACE_SERIES && row->edge != EDGE_NONE;
}

/* Where the operand of a memory is; the nearest scope first. */
static struct location find_operand(const struct work *work,
				    const struct declared_name *memory)
{
	struct location at = { .type = IEC_NONE };
	char text[2 * LIMIT_NAME + 64];
	const char *operand;
	size_t path, len;
	int used;

	if (!is_contact(memory->name, &path, &operand, &len))
		return at;
	for (int i = 0; i < 3 && at.type == IEC_NONE; i++) {
		used = snprintf(text, sizeof(text), "%s%s%.*s%.*s",
				i == 0 ? memory->pou : "",
				i == 0 && *memory->pou ? "." : "",
				i < 2 ? (int)path : 0, memory->name, (int)len, operand);
		if (used > 0 && (size_t)used < sizeof(text))
			at = image_find(work->to, text, (size_t)used);
	}
	return at;
}

/* A new contact has seen no edge: its stored value is its operand's present value. */
static void begin_edges(const struct work *work)
{
	struct declared_cursor cursor = { .memories = true };
	struct declared_name name;

	while (image_next_declared(work->to->program, &cursor, &name)) {
		struct location at;

		if (work->done[cursor.index - 1] || !is_memory(&name))
			continue;
		at = find_operand(work, &name);
		if (at.type == IEC_BOOL)
			image_set(work->to, name.at, image_get(work->to, at));
	}
}

/* ---- areas ---- */

/* A bit that has its own byte in one image may be packed in the other. */
static void carry_bits(const struct work *work, const struct program *program)
{
	for (uint32_t i = 0; i < program->bits_count; i++) {
		const struct code_bits *bits = &program->bits[i];
		const enum iec_area area = (enum iec_area)bits->area;
		const uint32_t most = 8 * work->from->program->areas.bytes[area];

		for (uint32_t k = bits->first; k < bits->first + bits->count && k < most;
		     k++)
			image_set_bit(work->to, area, k,
				      image_get_bit(work->from, area, k));
	}
}

static void carry_areas(const struct work *work)
{
	const struct areas *to = &work->to->program->areas;
	const struct areas *from = &work->from->program->areas;

	for (int area = AREA_NONE + 1; area < AREA_COUNT; area++)
		memcpy(work->to->memory + to->at[area],
		       work->from->memory + from->at[area],
		       to->bytes[area] < from->bytes[area] ? to->bytes[area]
							   : from->bytes[area]);
	carry_bits(work, work->from->program);
	carry_bits(work, work->to->program);
}

/* ---- forces ---- */

static bool same_place(struct location a, struct location b)
{
	return a.type == b.type && a.area == b.area && a.where == b.where;
}

static void force_again(struct image *image, struct location at,
			const struct force *force)
{
	if (at.type != force->at.type)
		return;
	image_set(image, at, force->aside);
	image_force(image, at, force->value);
}

/* A variable in an area is forced by its address. */
static struct location same_address(const struct work *work, struct location at)
{
	const struct areas *to = &work->to->program->areas;
	const struct areas *from = &work->from->program->areas;
	const uint32_t size = iec_type_row(at.type)->size;
	enum iec_area area = at.area;
	uint32_t byte = at.where / 8;

	if (area == AREA_NONE) {
		area = areas_find(from, at.where);
		byte = at.where - from->at[area];
		at.where = to->at[area] + byte;
	}
	if (at.area != AREA_NONE ? byte >= to->bytes[area] :
	    byte >= to->bytes[area] || size > to->bytes[area] - byte)
		at.type = IEC_NONE;
	return at;
}

static bool has_address(const struct image *image, struct location at)
{
	return at.area != AREA_NONE || at.where < image->program->areas.size;
}

/* The forces of one variable of the old program. */
static void carry_forces_of(const struct work *work, const struct symbol *symbol)
{
	const struct image *from = work->from;

	for (int i = 0; i < from->force_count; i++) {
		const struct force *force = &from->force[i];

		if (!has_address(from, force->at) && same_place(force->at, symbol->at))
			force_again(work->to, image_find(work->to, symbol->name,
							 strlen(symbol->name)), force);
	}
}

static void carry_forces(const struct work *work)
{
	const struct image *from = work->from;
	struct symbol_cursor cursor = { .whole = true };
	struct symbol symbol;

	for (int i = 0; i < from->force_count; i++)
		if (has_address(from, from->force[i].at))
			force_again(work->to, same_address(work, from->force[i].at),
				    &from->force[i]);
	while (from->force_count && image_next_symbol(from, &cursor, &symbol))
		carry_forces_of(work, &symbol);
}

/* ---- tasks, counters, times ---- */

/* The name in the new program; "": none. */
static const char *own_name(const struct program *program, const char *name)
{
	for (uint32_t i = 0; name && i < program->entry_count && program->string_bytes;
	     i++)
		if (strcmp(program->string + program->entry[i].name, name) == 0)
			return program->string + program->entry[i].name;
	return name ? "" : NULL;
}

static uint32_t find_task(const struct program *program, const char *name)
{
	uint32_t i = 0;

	while (i < program->task_count && strcmp(task_name(program, i), name) != 0)
		i++;
	return i;
}

static struct fault_place own_place(const struct program *program,
				    struct fault_place place)
{
	place.pou = own_name(program, place.pou);
	if (place.task) {
		const uint32_t task = find_task(program, place.task);

		place.task = task < program->task_count ? task_name(program, task)
							: NULL;
	}
	return place;
}

static bool same_task(const struct code_task *a, const struct code_task *b)
{
	return a->kind == b->kind && memcmp(a->interval, b->interval,
					    sizeof(a->interval)) == 0;
}

/* A task that is new or has another interval begins now. An event variable that is TRUE
 * already starts no new task. */
static void carry_tasks(struct resource *to, const struct resource *from,
			int64_t now_ns)
{
	const struct program *program = to->image.program;
	const struct program *old = from->image.program;

	tasks_start(&to->tasks, program, now_ns);
	tasks_look(&to->tasks, program, to->image.memory);
	for (uint32_t i = 0; i < program->task_count; i++) {
		const uint32_t other = find_task(old, task_name(program, i));

		to->tasks.state[i].due = false;
		to->tasks.state[i].overruns = 0;
		if (other < old->task_count &&
		    same_task(&program->task[i], &old->task[other]))
			to->tasks.state[i] = from->tasks.state[other];
	}
}

static void carry_resource(struct resource *to, const struct resource *from)
{
	struct image *image = &to->image;
	const struct program *program = image->program;
	const struct vm vm = to->vm;

	to->state = from->state;
	to->fault = from->fault;
	to->fault_at = own_place(program, from->fault_at);
	to->halted = from->halted;
	to->halt_at = own_place(program, from->halt_at);
	to->error_at = own_place(program, from->error_at);
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
	to->vm.memory = vm.memory;
	to->vm.program = program;
	to->vm.error_text = to->vm.fault_text = to->vm.stop_text = 0;
	carry_tasks(to, from, from->vm.now_ns - from->timers_ns);
}

/* ---- all of it ---- */

static bool make_cold(struct image *cold, const struct program *program,
		      struct arena *arena)
{
	void *memory = arena_alloc(arena, image_memory_size(program));

	if (memory)
		image_init(cold, program, memory);
	return memory;
}

/* Only names, comments or drawings changed: all offsets are the same. */
static bool is_same_code(const struct program *a, const struct program *b)
{
	uint8_t one[32], other[32];

	if (a->header->data_size != b->header->data_size)
		return false;
	code_identity(a, one);
	code_identity(b, other);
	return memcmp(one, other, sizeof(one)) == 0;
}

static bool carry_image(struct image *to, const struct image *from, struct arena *arena)
{
	struct work *work = arena_alloc(arena, sizeof(*work));

	if (!work)
		return false;
	work->to = to;
	work->from = from;
	work->done = arena_alloc(arena, to->program->symbol_count + 1u);
	if (!work->done || !make_cold(&work->to_cold, to->program, arena) ||
	    !make_cold(&work->from_cold, from->program, arena) ||
	    !make_names(work, arena))
		return false;
	carry_areas(work);
	carry_names(work, false, false);
	carry_names(work, true, true);
	carry_names(work, true, false);
	begin_edges(work);
	carry_forces(work);
	return true;
}

bool carry(struct resource *to, const struct resource *from, struct arena *arena)
{
	struct image *image = &to->image;

	if (is_same_code(image->program, from->image.program)) {
		memcpy(image->memory, from->image.memory,
		       image_memory_size(image->program));
		image->force_count = from->image.force_count;
		memcpy(image->force, from->image.force, sizeof(image->force));
	} else if (!carry_image(image, &from->image, arena)) {
		return false;
	}
	carry_resource(to, from);
	return true;
}
