/* SPDX-License-Identifier: MIT
 *
 * shadow - one scan of a program in another language; see shadow.h.
 *
 * Values are carried by name, as after an edit (scan/carry.h). What a converter added has other names and is
 * not touched by that, but for variables at addresses, which are kept aside.
 */
#include "engine/trial/shadow.h"

#include "engine/scan/carry.h"

#include <stdlib.h>
#include <string.h>

/* A variable, an array or an instance. */
struct named {
	const char *pou, *name;
	struct location at;
	uint32_t bytes;          /* of memory; of bits of areas: how many       */
};

/* The same variable in both programs. */
struct pair {
	struct location at;      /* of the shadow                               */
	struct location of;      /* IEC_NONE: only the shadow has it            */
	uint32_t bytes;
};

/* Bytes in the memory of the shadow. */
struct room { uint32_t where, bytes; };

struct shadow {
	struct resource resource;
	const struct program *of;
	struct program program;  /* of the shadow: blocks of the catalogue may be left out */
	struct arena arena;      /* of the plan, the pairs and a changed image  */
	const struct carry_plan *plan;
	struct pair *pair;       /* those in memory, by place                   */
	uint32_t pairs;
	struct pair *own;        /* bits and values at addresses that only the shadow has */
	uint32_t owns;
	union iec_value *aside;  /* of each                                     */
	struct pair *step;       /* of a chart that has become a ladder         */
	uint32_t steps;
	struct room *room;       /* what elements remember                      */
	uint32_t rooms;
	uint8_t *remembered;     /* all of them, one after the other            */
	const char *alone;       /* a POU; NULL: the whole program is run       */
	bool begun;              /* it has run a scan                           */
	void *memory;
};

/* ---- which variable is which ---- */

static uint32_t size_of(const struct program *program, const struct declared_name *name)
{
	if (name->array.count)
		return name->array.count * name->stride;
	if (name->at.area != AREA_NONE)
		return 1;
	if (name->at.type == IEC_NONE)
		return word_row(code_instance(program, name->at.where))->size;
	return iec_type_row(name->at.type)->size;
}

static int by_name(const void *a, const void *b)
{
	const struct named *one = a, *other = b;
	const int pou = strcmp(one->pou, other->pou);

	return pou ? pou : strcmp(one->name, other->name);
}

static int by_place(const void *a, const void *b)
{
	const struct pair *one = a, *other = b;

	return (one->at.where > other->at.where) - (one->at.where < other->at.where);
}

/* All that is declared, by name. NULL: no memory. */
static struct named *names_of(const struct program *program, struct arena *arena, uint32_t *count)
{
	struct declared_cursor cursor = { 0 };
	struct declared_name name;
	struct named *out;

	*count = 0;
	while (image_next_declared(program, &cursor, &name))
		(*count)++;
	out = arena_alloc(arena, (*count + 1) * sizeof(*out));
	cursor = (struct declared_cursor){ 0 };
	for (uint32_t i = 0; out && i < *count && image_next_declared(program, &cursor, &name); i++)
		out[i] = (struct named){ name.pou, name.name, name.at, size_of(program, &name) };
	if (out)
		qsort(out, *count, sizeof(*out), by_name);
	return out;
}

static bool has_address(const struct program *program, struct location at)
{
	return at.area != AREA_NONE || at.where < program->areas.size;
}

static bool ends_with(const char *text, size_t len, const char *end)
{
	return len > strlen(end) && strncmp(text + len - strlen(end), end, strlen(end)) == 0;
}

/* A chart as a ladder: Run_X is the step Run.X, and Way_Runs is TRUE after the first scan. */
static struct location step_of(const struct shadow *shadow, const struct named *bit, const struct named *its,
			       uint32_t count)
{
	const struct location none = { .type = IEC_NONE };
	const size_t len = strlen(bit->name);

	if (bit->at.type != IEC_BOOL || *bit->pou)
		return none;
	if (ends_with(bit->name, len, "_Runs"))
		return (struct location){ .type = IEC_BOOL, .constant = true, .where = CODE_TRUE_AT(&shadow->of->areas) };
	for (uint32_t i = 0; ends_with(bit->name, len, "_X") && i < count; i++)
		if (strlen(its[i].name) == len && strncmp(its[i].name, bit->name, len - 2) == 0 &&
		    strcmp(its[i].name + len - 2, ".X") == 0)
			return its[i].at;
	return none;
}

static bool match(struct shadow *shadow, struct arena *scratch)
{
	uint32_t count, other, j = 0;
	struct named *mine = names_of(&shadow->program, scratch, &count);
	struct named *its = names_of(shadow->of, scratch, &other);

	shadow->pair = arena_alloc(&shadow->arena, (count + 1) * sizeof(*shadow->pair));
	shadow->own = arena_alloc(&shadow->arena, (count + 1) * sizeof(*shadow->own));
	shadow->step = arena_alloc(&shadow->arena, (count + 1) * sizeof(*shadow->step));
	shadow->aside = arena_alloc(&shadow->arena, (count + 1) * sizeof(*shadow->aside));
	if (!mine || !its || !shadow->pair || !shadow->own || !shadow->step || !shadow->aside)
		return false;
	for (uint32_t i = 0; i < count; i++) {
		struct pair pair = { .at = mine[i].at, .bytes = mine[i].bytes, .of.type = IEC_NONE };
		bool both;

		while (j < other && by_name(&its[j], &mine[i]) < 0)
			j++;
		both = j < other && by_name(&its[j], &mine[i]) == 0 && its[j].at.type == mine[i].at.type;
		if (both)
			pair.of = its[j].at;
		if (!has_address(&shadow->program, pair.at) && both)
			shadow->pair[shadow->pairs++] = pair;
		else if (has_address(&shadow->program, pair.at) && !both && pair.bytes <= sizeof(union iec_value) &&
			 pair.at.type != IEC_NONE && pair.at.type != IEC_STRING)
			shadow->own[shadow->owns++] = pair;
		if (!both)
			pair.of = step_of(shadow, &mine[i], its, other);
		if (!both && pair.of.type == IEC_BOOL)
			shadow->step[shadow->steps++] = pair;
	}
	qsort(shadow->pair, shadow->pairs, sizeof(*shadow->pair), by_place);
	return true;
}

/* What an edge remembers has no name. */
static bool is_memory(const struct declared_name *name)
{
	return name->flags & SYMBOL_HIDDEN && strchr(name->name, ' ') && name->at.area == AREA_NONE && !name->at.constant;
}

static bool find_memories(struct shadow *shadow)
{
	struct declared_cursor cursor = { .memories = true };
	struct declared_name name;
	uint32_t count = 0, bytes = 0;

	while (image_next_declared(&shadow->program, &cursor, &name))
		count += is_memory(&name);
	shadow->room = arena_alloc(&shadow->arena, (count + 1) * sizeof(*shadow->room));
	cursor = (struct declared_cursor){ .memories = true };
	while (shadow->room && image_next_declared(&shadow->program, &cursor, &name)) {
		if (!is_memory(&name))
			continue;
		shadow->room[shadow->rooms] = (struct room){ name.at.where, size_of(&shadow->program, &name) };
		bytes += shadow->room[shadow->rooms++].bytes;
	}
	shadow->remembered = arena_alloc(&shadow->arena, bytes + 1);
	return shadow->room && shadow->remembered;
}

/* An address is the same in both. */
static struct location same_address(const struct shadow *shadow, struct location at)
{
	const struct areas *mine = &shadow->program.areas, *its = &shadow->of->areas;
	enum iec_area area = at.area;
	uint32_t byte = at.where / 8;

	if (area == AREA_NONE) {
		area = areas_find(mine, at.where);
		byte = at.where - mine->at[area];
		at.where = its->at[area] + byte;
	}
	if (byte + iec_type_row(at.type)->size > its->bytes[area])
		at.type = IEC_NONE;
	return at;
}

struct location shadow_place(const struct shadow *shadow, struct location at)
{
	const struct location none = { .type = IEC_NONE };
	uint32_t low = 0, high = shadow->pairs;
	const struct pair *pair;

	if (at.type == IEC_NONE || at.constant || LOCATION_IS_PART(at))
		return none;
	if (has_address(&shadow->program, at))
		return same_address(shadow, at);
	while (low < high) {
		const uint32_t middle = low + (high - low) / 2;

		if (shadow->pair[middle].at.where > at.where)
			high = middle;
		else
			low = middle + 1;
	}
	pair = low ? &shadow->pair[low - 1] : NULL;
	if (!pair || at.where - pair->at.where >= pair->bytes)
		return none;
	if (pair->of.area != AREA_NONE)
		return pair->of;
	at.where = pair->of.where + (at.where - pair->at.where);
	return at;
}

/* ---- blocks that do not run ---- */

/* The call of a block of the catalogue becomes a jump to the next instruction. */
static void leave_blocks(uint32_t *code, uint32_t words)
{
	for (uint32_t at = 0; at < words; at += code_words(code + at)) {
		if ((code[at] & 0xff) != VM_FB)
			continue;
		code[at] = VM_JMP;
		code[at + 1] = at + 2;
	}
}

static bool open_still(struct shadow *shadow, const struct program *shown, struct arena *scratch)
{
	const size_t size = shown->header->size;
	uint8_t *image = arena_alloc(&shadow->arena, size);
	enum diag_id why;
	size_t where;

	if (!image)
		return false;
	memcpy(image, shown->base, size);
	if (!code_open_made(image, scratch, &shadow->program, &why, &where))
		return false;
	leave_blocks((uint32_t *)(image + ((const uint8_t *)shadow->program.text - image)),
		     shadow->program.text_words);
	leave_blocks((uint32_t *)(image + ((const uint8_t *)shadow->program.watch - image)),
		     shadow->program.watch_words);
	return true;
}

/* ---- a scan ---- */

static void begin(struct shadow *shadow)
{
	resource_init(&shadow->resource, &shadow->program, shadow->memory);
	shadow->resource.watch = true;
}

/* Copies what elements remember out of the memory or, with @back, into it. */
static void remember(struct shadow *shadow, bool back)
{
	uint8_t *memory = shadow->resource.image.memory, *aside = shadow->remembered;

	for (uint32_t i = 0; i < shadow->rooms; i++) {
		const struct room *room = &shadow->room[i];

		memcpy(back ? memory + room->where : aside, back ? aside : memory + room->where, room->bytes);
		aside += room->bytes;
	}
}

/* All that the other program declares, and its time. Before the first scan, an edge remembers what there is. */
static void take(struct shadow *shadow, const struct twin *from)
{
	struct resource *resource = &shadow->resource;

	remember(shadow, false);
	for (uint32_t i = 0; i < shadow->owns; i++)
		shadow->aside[i] = image_get(&resource->image, shadow->own[i].at);
	resource->image.force_count = 0;
	carry_apply(shadow->plan, resource, &from->resource);
	for (uint32_t i = 0; i < shadow->owns; i++)
		image_set(&resource->image, shadow->own[i].at, shadow->aside[i]);
	if (shadow->begun)
		remember(shadow, true);
	/* Where it begins in the middle, the steps of a chart are where they are. */
	for (uint32_t i = 0; (!shadow->begun || shadow->alone) && from->resource.scans > 0 && i < shadow->steps; i++)
		image_set(&resource->image, shadow->step[i].at, image_get(&from->resource.image, shadow->step[i].of));
	/* A record has times of another clock. */
	resource->timers_ns = from->resource.vm.now_ns - from->now_ns;
}

static void take_inputs(struct shadow *shadow, const struct image *from)
{
	struct image *image = &shadow->resource.image;
	const struct areas *mine = &shadow->program.areas, *its = &from->program->areas;

	for (int i = AREA_NONE + 1; i < AREA_COUNT; i++) {
		const enum iec_area area = (enum iec_area)i;
		const uint32_t bytes = mine->bytes[i] < its->bytes[i] ? mine->bytes[i] : its->bytes[i];

		if (iec_area_row(area)->access == ACCESS_READ && bytes)
			memcpy(image_area(image, area), from->memory + its->at[i], bytes);
	}
}

static bool run(struct shadow *shadow, const struct twin *now)
{
	struct resource *resource = &shadow->resource;
	bool good;

	take_inputs(shadow, &now->resource.image);
	resource->state = STATE_RUN;
	good = resource_scan(resource, now->now_ns);
	shadow->begun = true;
	return good;
}

/* The number of a program that a task calls; -1: @name is none. */
static int entry_of(const struct program *program, const char *name)
{
	for (uint32_t i = 0; i < program->call_count; i++)
		if (strcmp(program->string + program->entry[program->call[i]].name, name) == 0)
			return (int)program->call[i];
	return -1;
}

/* Other programs might read what is not known. A block is run by those that call it. */
static bool run_alone(struct shadow *shadow, const struct twin *now)
{
	struct resource *resource = &shadow->resource;
	const int entry = entry_of(&shadow->program, shadow->alone);
	bool good;

	if (entry < 0)
		return run(shadow, now);
	take_inputs(shadow, &now->resource.image);
	image_begin(&resource->image);
	resource->vm.resume = 0;
	resource->vm.budget = shadow->program.header->budget;
	good = vm_run(&resource->vm, (uint32_t)entry, true) == FAULT_NONE;
	image_end(&resource->image);
	shadow->begun = true;
	return good;
}

bool shadow_scan(struct shadow *shadow, const struct twin *before, const struct twin *now)
{
	struct resource *resource = &shadow->resource;
	bool good;

	if (shadow->alone) {
		/* Twice: the first time an edge is seen by what remembers it. */
		take(shadow, now);
		run_alone(shadow, now);
		take(shadow, now);
		good = run_alone(shadow, now);
	} else if (before->resource.state != STATE_RUN || now->resource.scans <= 1) {
		begin(shadow);
		resource_start(resource);
		good = run(shadow, now);
	} else {
		take(shadow, before);
		good = run(shadow, now);
	}
	take(shadow, now);
	return good;
}

void shadow_values(struct shadow *shadow, const struct twin *now)
{
	take(shadow, now);
}

void shadow_jump(struct shadow *shadow, const struct twin *now)
{
	shadow->begun = false;
	take(shadow, now);
	shadow->begun = true;
}

const struct resource *shadow_resource(const struct shadow *shadow)
{
	return &shadow->resource;
}

/* ---- life ---- */

static bool make(struct shadow *shadow, const struct program *shown)
{
	struct arena scratch;
	bool good;

	arena_init(&scratch);
	shadow->program = *shown;
	good = (!shadow->alone || open_still(shadow, shown, &scratch)) && match(shadow, &scratch) &&
	       find_memories(shadow);
	arena_free(&scratch);
	shadow->memory = good ? calloc(1, image_memory_size(&shadow->program) + 8) : NULL;
	if (shadow->memory)
		shadow->plan = carry_plan_new(&shadow->program, shadow->of, &shadow->arena);
	if (shadow->plan)
		begin(shadow);
	return shadow->plan != NULL;
}

struct shadow *shadow_new(const struct program *shown, const struct program *of, const char *alone)
{
	struct shadow *shadow = calloc(1, sizeof(*shadow));

	if (!shadow)
		return NULL;
	arena_init(&shadow->arena);
	shadow->of = of;
	shadow->alone = alone;
	if (make(shadow, shown))
		return shadow;
	shadow_free(shadow);
	return NULL;
}

void shadow_free(struct shadow *shadow)
{
	if (!shadow)
		return;
	free(shadow->memory);
	arena_free(&shadow->arena);
	free(shadow);
}
