/* SPDX-License-Identifier: MIT
 *
 * carry_plan - matches the names of two programs. Values are not its business; the moves
 * that it asks for are written by carry_moves.c.
 */
#include "engine/base/name.h"
#include "engine/scan/carry_moves.h"
#include "engine/scan/symbol_index.h"

#include <stdio.h>
#include <string.h>

/* A symbol of the old program, in the chain of its name. */
struct known {
	struct declared_name name;
	uint32_t hash;
	uint32_t next;  /* 1 + index; 0: the last                              */
	bool taken;     /* of a memory: another one took it                    */
	bool found;     /* the new program has a symbol of this name           */
};

/* All in temporary memory. */
struct work {
	struct carry_plan *plan;
	struct arena *arena;
	struct image to, from;   /* as at a cold start: hashes of initial values */
	struct program indexed;  /* the new program, with an index             */
	struct moves moves;
	struct known *known;
	uint32_t count, mask;
	uint32_t *first, *last;  /* by hash: 1 + index                         */
	bool *done;              /* of the new program: a memory that has its value */
	struct carry_force *force;
	int force_count;
	bool points;             /* the new program has a pointer              */
	struct carry_lead *lead;
	int lead_count;
	struct carry_pointer *pointer;
	int pointer_count;
	struct carry_lost *lost;
	int lost_count;
	uint32_t values;         /* moved so far                               */
};

/* More values than memory can hold: arrays of a hostile image, which overlap. */
#define VALUES_MOST (LIMIT_DATA + LIMIT_LOCATED)

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

/* All symbols that stand for memory of their own: a line of VAR_ACCESS is one more name. */
static bool next_name(const struct program *program, struct declared_cursor *cursor,
		      struct declared_name *out)
{
	while (image_next_declared(program, cursor, out)) {
		struct declared_name access = *out;

		if (!image_as_access(&access))
			return true;
	}
	return false;
}

static uint32_t count_names(const struct program *program)
{
	struct declared_cursor cursor = { .memories = true };
	struct declared_name name;
	uint32_t count = 0;

	while (next_name(program, &cursor, &name))
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

static bool make_names(struct work *work)
{
	const struct program *from = work->plan->from;
	struct declared_cursor cursor = { .memories = true };
	uint32_t i = 0;

	work->count = count_names(from);
	for (work->mask = 15; work->mask < work->count; )
		work->mask = 2 * work->mask + 1;
	work->known = arena_alloc(work->arena, (work->count + 1) * sizeof(*work->known));
	work->first = arena_alloc(work->arena, (work->mask + 1) * sizeof(*work->first));
	work->last = arena_alloc(work->arena, (work->mask + 1) * sizeof(*work->last));
	if (!work->known || !work->first || !work->last)
		return false;
	while (i < work->count && next_name(from, &cursor, &work->known[i].name))
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

/* ---- losses ---- */

/* A place with an address keeps what is there, if @other has the address, too. */
static bool keeps_address(const struct program *program,
			  const struct declared_name *name, const struct program *other)
{
	const uint32_t count = name->array.count ? name->array.count : 1;
	const struct location at = name->at;
	enum iec_area area = at.area;
	uint32_t end = (at.where + count - 1) / 8 + 1;

	if (area == AREA_NONE)
		area = areas_find(&program->areas, at.where);
	if (area == AREA_NONE)
		return false;
	if (at.area == AREA_NONE)
		end = at.where - program->areas.at[area] +
		      count * iec_type_row(at.type)->size;
	return end <= other->areas.bytes[area];
}

static struct carry_lost *lose(struct work *work, const struct declared_name *name,
			       enum carry_reason reason)
{
	const struct program *to = work->plan->to, *from = work->plan->from;
	const struct program *own = reason == CARRY_GONE ? from : to;
	struct carry_lost *lost;

	if (name->flags & SYMBOL_HIDDEN || name->at.constant ||
	    keeps_address(own, name, own == to ? from : to))
		return NULL;
	lost = arena_push(work->arena, &work->lost, &work->lost_count, sizeof(*lost));
	if (lost)
		*lost = (struct carry_lost){
			.pou = name->pou, .name = name->name,
			.head = (uint32_t)name->array.head, .reason = reason,
			.low = name->array.low, .count = name->array.count,
			.at = name->at, .stride = name->stride };
	return lost;
}

/* Elements @from up to @end of an array, counted from its first one. */
static void lose_elements(struct work *work, const struct declared_name *array,
			  int64_t from, int64_t end, enum carry_reason reason)
{
	struct declared_name part = *array;

	if (from < 0)
		from = 0;
	if (end > array->array.count)
		end = array->array.count;
	if (from >= end)
		return;
	part.at = declared_element(array, (uint32_t)from);
	part.array.low += (int32_t)from;
	part.array.count = (uint32_t)(end - from);
	lose(work, &part, reason);
}

/* Elements that only one of two arrays has. */
static void lose_ends(struct work *work, const struct declared_name *to,
		      const struct declared_name *from)
{
	const int64_t shift = (int64_t)to->array.low - from->array.low;
	const int64_t new = to->array.count, old = from->array.count;

	lose_elements(work, from, 0, shift, CARRY_GONE);
	lose_elements(work, from, shift + new > 0 ? shift + new : 0, old, CARRY_GONE);
	lose_elements(work, to, 0, -shift, CARRY_NEW);
	lose_elements(work, to, old - shift > 0 ? old - shift : 0, new, CARRY_NEW);
}

static uint16_t room_of(const struct program *program, struct location at)
{
	const struct code_run *run = code_run_at(program, at.where);

	return run->kind == RUN_INSTANCE ? WORD_TEXT : run->word;
}

/* @to, @from: the first of @to->array.count elements, or a text. */
static void lose_texts(struct work *work, const struct declared_name *to,
		       const struct declared_name *from)
{
	const uint16_t room = room_of(work->plan->to, to->at);
	struct carry_lost *lost;

	if (room >= room_of(work->plan->from, from->at))
		return;
	lost = lose(work, to, CARRY_TEXT);
	if (!lost)
		return;
	lost->from = from->at.where;
	lost->stride = from->stride;
	lost->room = room;
}

/* ---- forces ---- */

static void allow_force(struct work *work, struct location to, struct location from,
			uint32_t count)
{
	struct carry_force *force;

	if (from.area != AREA_NONE || from.where < work->plan->from->areas.size ||
	    to.type == IEC_STRING)
		return;
	force = arena_push(work->arena, &work->force, &work->force_count, sizeof(*force));
	if (force)
		*force = (struct carry_force){
			.from = from.where, .to = to.where, .count = count,
			.type = (uint8_t)to.type, .area = (uint8_t)to.area };
}

static struct location pin_of(const struct word_pin *pin, uint32_t instance)
{
	return (struct location){ .type = pin->type, .where = instance + pin->offset };
}

/* A pin of another block may have the same name. */
static void allow_pins(struct work *work, const struct word_row *row, uint32_t to,
		       const struct word_row *old, uint32_t from)
{
	for (int i = 0; i < old->pin_count; i++) {
		const struct word_pin *pin = &old->pin[i];
		const int at = word_pin_find(row, pin->name, strlen(pin->name));

		if (at >= 0 && row->pin[at].type == pin->type)
			allow_force(work, pin_of(&row->pin[at], to), pin_of(pin, from), 1);
	}
}

static uint32_t force_end(const struct carry_force *force)
{
	return force->from + force->count * iec_type_row((enum iec_type)force->type)->size;
}

static bool force_follows(const struct carry_force *force, const struct carry_force *next)
{
	const uint32_t size = iec_type_row((enum iec_type)force->type)->size;

	return force->type == next->type && force->area == next->area &&
	       force_end(force) == next->from &&
	       force->to + force->count * (force->area == AREA_NONE ? size : 1) == next->to;
}

/* By their old place. Where two overlap, the first one counts. */
static bool order_forces(struct work *work, struct arena *arena)
{
	const size_t count = (size_t)work->force_count;
	uint64_t *key = arena_alloc(work->arena, count * sizeof(*key));
	struct carry_force *out = arena_alloc(arena, count * sizeof(*out));
	uint32_t used = 0, end = 0;

	if (!key || !out)
		return false;
	for (size_t i = 0; i < count; i++)
		key[i] = (uint64_t)work->force[i].from << 32 | i;
	moves_sort(key, count);
	for (size_t i = 0; i < count; i++) {
		const struct carry_force *next = &work->force[(uint32_t)key[i]];

		if (next->from < end)
			continue;
		if (used && force_follows(&out[used - 1], next))
			out[used - 1].count += next->count;
		else
			out[used++] = *next;
		end = force_end(next);
	}
	work->plan->force = out;
	work->plan->force_count = used;
	return true;
}

/* ---- pointers ---- */

static bool has_pointers(const struct program *program)
{
	for (uint32_t i = 0; i < program->run_count; i++)
		if (code_is_pointer(program, program->run[i].offset))
			return true;
	return false;
}

/* No pointer leads to what has an address. */
static bool is_led_to(const struct work *work, struct location to, struct location from)
{
	return work->points && to.area == AREA_NONE && from.area == AREA_NONE &&
	       to.where >= work->plan->to->areas.size && from.where >= work->plan->from->areas.size;
}

static void add_lead(struct work *work, uint32_t to, uint32_t from, uint32_t bytes)
{
	struct carry_lead *lead = work->lead_count ? &work->lead[work->lead_count - 1] : NULL;

	if (lead && lead->from + lead->bytes == from && lead->to + lead->bytes == to) {
		lead->bytes += bytes;
		return;
	}
	lead = arena_push(work->arena, &work->lead, &work->lead_count, sizeof(*lead));
	if (lead)
		*lead = (struct carry_lead){ .from = from, .to = to, .bytes = bytes };
}

/* One value; both places have the same type. */
static void lead_value(struct work *work, struct location to, struct location from)
{
	const struct code_run *new, *old;
	struct carry_pointer *pointer;

	if (!is_led_to(work, to, from))
		return;
	new = code_run_at(work->plan->to, to.where);
	old = code_run_at(work->plan->from, from.where);
	if (to.type != IEC_STRING)
		add_lead(work, to.where, from.where, iec_type_row(to.type)->size);
	else if (new->kind == RUN_VALUES && old->kind == RUN_VALUES && new->word == old->word)
		add_lead(work, to.where, from.where, code_run_size(new));
	if (!code_is_pointer(work->plan->to, to.where))
		return;
	pointer = arena_push(work->arena, &work->pointer, &work->pointer_count, sizeof(*pointer));
	if (!pointer)
		return;
	*pointer = (struct carry_pointer){ .from = from.where, .to = to.where };
	memcpy(&pointer->begun, work->from.memory + from.where, sizeof(pointer->begun));
}

/* By their old place. */
static bool order_leads(struct work *work, struct arena *arena)
{
	const size_t count = (size_t)work->lead_count, pointers = (size_t)work->pointer_count;
	uint64_t *key = arena_alloc(work->arena, count * sizeof(*key));
	struct carry_lead *lead = arena_alloc(arena, count * sizeof(*lead));
	struct carry_pointer *pointer = arena_alloc(arena, pointers * sizeof(*pointer));

	if (!key || !lead || !pointer)
		return false;
	for (size_t i = 0; i < count; i++)
		key[i] = (uint64_t)work->lead[i].from << 32 | i;
	moves_sort(key, count);
	for (size_t i = 0; i < count; i++)
		lead[i] = work->lead[(uint32_t)key[i]];
	if (pointers)
		memcpy(pointer, work->pointer, pointers * sizeof(*pointer));
	work->plan->lead = lead;
	work->plan->lead_count = (uint32_t)count;
	work->plan->pointer = pointer;
	work->plan->pointer_count = (uint32_t)pointers;
	work->plan->cost.operations += (uint32_t)pointers;
	return true;
}

/* ---- values ---- */

static bool is_read_only(const struct program *program, struct location at)
{
	enum iec_area area = at.area;

	if (area == AREA_NONE)
		area = areas_find(&program->areas, at.where);
	return area != AREA_NONE && iec_area_row(area)->access == ACCESS_READ;
}

static void carry_value(struct work *work, const struct declared_name *to,
			const struct declared_name *from)
{
	allow_force(work, to->at, from->at, 1);
	if (is_read_only(work->plan->to, to->at))
		return;
	work->values++;
	moves_value(&work->moves, to->at, from->at);
	lead_value(work, to->at, from->at);
	if (to->at.type == IEC_STRING)
		lose_texts(work, to, from);
}

static void carry_array(struct work *work, const struct declared_name *to,
			const struct declared_name *from)
{
	const int64_t shift = (int64_t)to->array.low - from->array.low;
	const int64_t first = shift < 0 ? -shift : 0;
	const int64_t old = (int64_t)from->array.count - shift;
	const int64_t end = old < to->array.count ? old : to->array.count;
	struct declared_name new = *to, was = *from;

	lose_ends(work, to, from);
	if (first >= end)
		return;
	new.at = declared_element(to, (uint32_t)first);
	was.at = declared_element(from, (uint32_t)(first + shift));
	new.array.low += (int32_t)first;
	new.array.count = (uint32_t)(end - first);
	allow_force(work, new.at, was.at, new.array.count);
	if (is_read_only(work->plan->to, to->at))
		return;
	work->values += new.array.count;
	for (uint32_t i = 0; i < new.array.count && work->values <= VALUES_MOST; i++) {
		moves_value(&work->moves, declared_element(&new, i),
			    declared_element(&was, i));
		lead_value(work, declared_element(&new, i), declared_element(&was, i));
	}
	if (to->at.type == IEC_STRING)
		lose_texts(work, &new, &was);
}

static void carry_instance(struct work *work, const struct declared_name *to,
			   const struct declared_name *from)
{
	const enum word word = code_instance(work->plan->to, to->at.where);
	const enum word old = code_instance(work->plan->from, from->at.where);
	const struct word_row *row = word_row(word);

	allow_pins(work, row, to->at.where, word_row(old), from->at.where);
	if (word == old && is_led_to(work, to->at, from->at))
		add_lead(work, to->at.where, from->at.where, row->size);
	if (word == old)
		moves_instance(&work->moves, row, to->at.where, from->at.where);
	else
		lose(work, to, CARRY_BLOCK);
}

static void carry_name(struct work *work, const struct declared_name *to,
		       const struct declared_name *from)
{
	if (to->at.type != from->at.type || !to->array.count != !from->array.count)
		lose(work, to, CARRY_TYPE);
	else if (to->at.constant)
		return;
	else if (to->array.count)
		carry_array(work, to, from);
	else if (to->at.type == IEC_NONE)
		carry_instance(work, to, from);
	else
		carry_value(work, to, from);
}

static void carry_names(struct work *work)
{
	struct declared_cursor cursor = { 0 };
	struct declared_name name;

	while (work->values <= VALUES_MOST &&
	       next_name(work->plan->to, &cursor, &name)) {
		struct known *known = find(work, &name, false);

		if (known)
			carry_name(work, &name, &known->name);
		else
			lose(work, &name, CARRY_NEW);
		if (known)
			known->found = true;
	}
	for (uint32_t i = 0; i < work->count; i++)
		if (!work->known[i].found)
			lose(work, &work->known[i].name, CARRY_GONE);
}

/* ---- memories ---- */

/* Memories are matched twice: first by rung, then by element. */
static void carry_memories(struct work *work, bool whole)
{
	struct declared_cursor cursor = { .memories = true };
	struct declared_name name;

	while (work->values <= VALUES_MOST &&
	       next_name(work->plan->to, &cursor, &name)) {
		bool *done = &work->done[cursor.index - 1];
		struct known *known;

		if (!is_memory(&name) || *done)
			continue;
		known = find(work, &name, whole);
		if (!known)
			continue;
		carry_name(work, &name, &known->name);
		*done = known->taken = true;
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

/* Searches the new program for the operands of its contacts: with an index, as there may
 * be many. */
static void make_index(struct work *work)
{
	if (work->to.program == &work->indexed)
		return;
	work->indexed = *work->plan->to;
	if (!work->indexed.index)
		work->indexed.index = symbol_index_new(&work->indexed, work->arena);
	work->to.program = &work->indexed;
}

/* Where the operand of a memory is; the nearest scope first. */
static struct location find_operand(struct work *work, const struct declared_name *memory)
{
	struct location at = { .type = IEC_NONE };
	char text[2 * LIMIT_NAME + 64];
	const char *operand;
	size_t path, len;
	int used;

	if (!is_contact(memory->name, &path, &operand, &len))
		return at;
	make_index(work);
	for (int i = 0; i < 3 && at.type == IEC_NONE; i++) {
		used = snprintf(text, sizeof(text), "%s%s%.*s%.*s",
				i == 0 ? memory->pou : "",
				i == 0 && *memory->pou ? "." : "",
				i < 2 ? (int)path : 0, memory->name, (int)len, operand);
		if (used > 0 && (size_t)used < sizeof(text))
			at = image_find(&work->to, text, (size_t)used);
	}
	return at;
}

/* A new contact has seen no edge: its stored value is its operand's present value. */
static void begin_edges(struct work *work)
{
	struct declared_cursor cursor = { .memories = true };
	struct declared_name name;

	while (next_name(work->plan->to, &cursor, &name)) {
		struct location at;

		if (work->done[cursor.index - 1] || !is_memory(&name) ||
		    name.at.type != IEC_BOOL || name.at.constant)
			continue;
		at = find_operand(work, &name);
		if (at.type == IEC_BOOL)
			moves_seen(&work->moves, name.at, at);
	}
}

/* ---- POUs and tasks ---- */

static uint32_t find_entry(const struct program *program, const char *name)
{
	for (uint32_t i = 0; i < program->entry_count && program->string_bytes; i++)
		if (strcmp(program->string + program->entry[i].name, name) == 0)
			return 1 + program->entry[i].name;
	return 0;
}

static bool match_pous(struct carry_plan *plan, struct arena *arena)
{
	const struct program *from = plan->from;
	uint32_t *pou = arena_alloc(arena, from->entry_count * sizeof(*pou));

	if (!pou)
		return false;
	for (uint32_t i = 0; i < from->entry_count && from->string_bytes; i++)
		pou[i] = find_entry(plan->to, from->string + from->entry[i].name);
	plan->pou = pou;
	return true;
}

static uint8_t find_task(const struct program *program, const char *name)
{
	for (uint32_t i = 0; i < program->task_count; i++)
		if (strcmp(task_name(program, i), name) == 0)
			return (uint8_t)i;
	return CARRY_NO_TASK;
}

static bool same_task(const struct code_task *a, const struct code_task *b)
{
	return a->kind == b->kind && memcmp(a->interval, b->interval,
					    sizeof(a->interval)) == 0;
}

static void match_tasks(struct carry_plan *plan)
{
	const struct program *to = plan->to, *from = plan->from;

	for (uint32_t i = 0; i < from->task_count; i++)
		plan->task[i] = find_task(to, task_name(from, i));
	for (uint32_t i = 0; i < to->task_count; i++) {
		const uint8_t other = find_task(from, task_name(to, i));

		plan->state[i] = CARRY_NO_TASK;
		if (other != CARRY_NO_TASK && same_task(&to->task[i], &from->task[other]))
			plan->state[i] = other;
	}
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

static bool copy_losses(const struct work *work, struct arena *arena)
{
	const size_t size = (size_t)work->lost_count * sizeof(*work->lost);
	struct carry_lost *lost = arena_alloc(arena, size);

	if (lost && size)
		memcpy(lost, work->lost, size);
	work->plan->lost = lost;
	work->plan->lost_count = (uint32_t)work->lost_count;
	return lost;
}

static bool match_names(struct work *work)
{
	const struct program *to = work->plan->to;

	work->done = arena_alloc(work->arena, to->symbol_count + 1u);
	if (!work->done || !make_cold(&work->to, to, work->arena) ||
	    !make_cold(&work->from, work->plan->from, work->arena) || !make_names(work))
		return false;
	work->moves = (struct moves){ .arena = work->arena, .to = &work->to,
				      .from = &work->from };
	moves_areas(&work->moves);
	carry_names(work);
	carry_memories(work, true);
	carry_memories(work, false);
	begin_edges(work);
	return work->values <= VALUES_MOST;
}

static bool make_moves(struct carry_plan *plan, struct arena *arena,
		       struct arena *temporary)
{
	struct work *work = arena_alloc(temporary, sizeof(*work));

	if (!work)
		return false;
	work->plan = plan;
	work->arena = temporary;
	work->points = has_pointers(plan->to);
	plan->cost.operations = LIMIT_FORCES;
	return match_names(work) && moves_finish(&work->moves, plan, arena) &&
	       order_forces(work, arena) && order_leads(work, arena) && copy_losses(work, arena);
}

/* Only names, comments or drawings changed: all offsets are the same. */
static bool is_same_code(const struct program *a, const struct program *b)
{
	return a->header->data_size == b->header->data_size && code_is_same(a, b);
}

const struct carry_plan *carry_plan_new(const struct program *to,
					const struct program *from, struct arena *arena)
{
	struct carry_plan *plan = arena_alloc(arena, sizeof(*plan));
	struct arena temporary;
	bool good;

	if (!plan)
		return NULL;
	plan->to = to;
	plan->from = from;
	match_tasks(plan);
	if (!match_pous(plan, arena))
		return NULL;
	plan->same = is_same_code(to, from);
	plan->cost.bytes = plan->same ? image_memory_size(to) : 0;
	if (plan->same)
		return plan;
	arena_init(&temporary);
	good = make_moves(plan, arena, &temporary);
	arena_free(&temporary);
	return good ? plan : NULL;
}

bool carry(struct resource *to, const struct resource *from, struct arena *arena)
{
	const struct carry_plan *plan = carry_plan_new(to->image.program,
						       from->image.program, arena);

	return plan && carry_apply(plan, to, from);
}
