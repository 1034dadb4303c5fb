/* SPDX-License-Identifier: MIT
 *
 * uses - flags for each declared variable, and bit maps of the process image.
 *
 * The maps find overlaps: a use of %MW0 sets the bits of its 16 bits, a coil those of the variable or
 * of its part. It knows no rungs and no diagnostics.
 */
#include "engine/check/uses.h"
#include "engine/model/shape.h"

#include <string.h>

bool uses_init(struct uses *uses, const struct scope *scope, struct arena *arena)
{
	const struct project *project = scope_project(scope);
	size_t bytes = scope_areas(scope)->size;
	int count = project->globals.count;

	uses->project = project;
	uses->areas = scope_areas(scope);
	uses->arena = arena;
	uses->coils = NULL;
	uses->coil = NULL;
	uses->coil_end = &uses->coil;
	uses->base = arena_alloc(arena, sizeof(*uses->base) *
				 ((size_t)project->pou_count + 1));
	if (!uses->base)
		return false;
	for (int i = 0; i < project->pou_count; i++) {
		uses->base[i + 1] = count;
		count += project->pou[i].vars.count;
	}
	uses->count = count;
	uses->flags = arena_alloc(arena, (size_t)count);
	uses->map.read = arena_alloc(arena, bytes);
	uses->map.written = arena_alloc(arena, bytes);
	uses->map.coils.once = arena_alloc(arena, bytes);
	uses->map.coils.twice = arena_alloc(arena, bytes);
	return !arena->failed;
}

/* The bits of a map that an address covers, or an array of such. */
struct span {
	uint32_t first, count;
};

/* Skips a variable beyond all areas: it was reported. */
static struct span span_of(const struct uses *uses, struct iec_addr at,
			   struct var_array array)
{
	uint64_t first = areas_byte(uses->areas, at) * (uint64_t)8 + at.bit;
	uint64_t count = at.bits * (uint64_t)(array.count ? array.count : 1);

	if (first + count > uses->areas->size * (uint64_t)8)
		return (struct span){ 0, 0 };
	return (struct span){ (uint32_t)first, (uint32_t)count };
}

/* Bits of byte @byte that are in the span. */
static uint8_t mask_of(struct span span, uint32_t byte)
{
	uint32_t end = span.first + span.count;
	unsigned int mask = 0xff;

	if (byte * 8 < span.first)
		mask &= 0xffu << (span.first - byte * 8);
	if (byte * 8 + 8 > end)
		mask &= 0xffu >> (byte * 8 + 8 - end);
	return (uint8_t)mask;
}

static void map_set(uint8_t *map, struct span span)
{
	uint32_t at = span.first / 8, last = (span.first + span.count - 1) / 8;

	if (!span.count)
		return;
	map[at] |= mask_of(span, at);
	map[last] |= mask_of(span, last);
	if (last - at > 1)
		memset(map + at + 1, 0xff, last - at - 1);
}

static bool map_has(const uint8_t *map, struct span span)
{
	uint32_t at = span.first / 8, last = (span.first + span.count - 1) / 8;

	for (; span.count && at <= last; at++)
		if (map[at] & mask_of(span, at))
			return true;
	return false;
}

static void map_add(struct uses *uses, struct span at, unsigned int use)
{
	if (use & USE_READ)
		map_set(uses->map.read, at);
	if (use & (USE_WRITTEN | USE_PASSED))
		map_set(uses->map.written, at);
}

/* Another coil: bits that one has already are written twice. */
static void coil_set(struct use_coils coils, struct span at)
{
	if (map_has(coils.once, at))
		map_set(coils.twice, at);
	map_set(coils.once, at);
}

/* Of a meaning with a variable. */
static int number_of(const struct uses *uses, const struct meaning *meaning)
{
	const int table = meaning->pou ? (int)(meaning->pou - uses->project->pou) + 1 : 0;

	return uses->base[table] + meaning->index;
}

/* An element, a member, a pin, a bit of a number. */
static bool is_part(const struct meaning *meaning)
{
	return meaning->kind == MEANING_ELEMENT || meaning->kind == MEANING_PIN || meaning->part ||
	       meaning->offset > 0;
}

/* The bits of its variable that a coil writes; none of a variable without a size. */
static struct span part_span(const struct uses *uses, const struct meaning *meaning, size_t *bytes)
{
	const struct extent whole = shape_of_var(&uses->project->words, meaning->var);
	uint64_t first = 0, count = whole.size * (uint64_t)8;

	*bytes = (size_t)whole.size;
	if (count > UINT32_MAX)
		return (struct span){ 0, 0 };
	if (is_part(meaning) || meaning->var->array.count) {
		first = meaning->offset * (uint64_t)8 + (meaning->part ? meaning->first % 8 : 0);
		count = meaning->type == IEC_BOOL && meaning->part ? 1 :
			meaning->type == IEC_STRING ? 8 : 8u * iec_type_row(meaning->type)->size;
	}
	if (first + count > whole.size * (uint64_t)8)
		count = 0;
	return (struct span){ (uint32_t)first, (uint32_t)count };
}

static struct span add_part(struct uses *uses, int number, const struct meaning *meaning)
{
	size_t bytes;
	const struct span at = part_span(uses, meaning, &bytes);
	struct use_coils *coils;

	if (!at.count)
		return at;
	if (!uses->coils)
		uses->coils = arena_alloc(uses->arena, sizeof(*uses->coils) * (size_t)uses->count);
	if (!uses->coils)
		return (struct span){ 0, 0 };
	coils = &uses->coils[number];
	if (!coils->once) {
		coils->once = arena_alloc(uses->arena, bytes);
		coils->twice = arena_alloc(uses->arena, bytes);
	}
	if (!coils->once || !coils->twice)
		return (struct span){ 0, 0 };
	coil_set(*coils, at);
	return at;
}

bool uses_add(struct uses *uses, const struct meaning *meaning,
	      unsigned int use)
{
	bool again;
	int number;

	if (meaning->kind == MEANING_LITERAL || meaning->kind == MEANING_NONE)
		return false;
	/* A member of a union is in the variable itself. */
	if (meaning->through && use & (USE_WRITTEN | USE_PASSED))
		use = (meaning->var && meaning->var->target ? use & ~(unsigned)(USE_WRITTEN | USE_PASSED) : use) | USE_READ;
	if (meaning->addr.area != AREA_NONE)
		map_add(uses, span_of(uses, meaning->addr, meaning_reach(meaning)), use);
	if (!meaning->var)
		return false;
	number = number_of(uses, meaning);
	if (is_part(meaning) || meaning->var->array.count) {
		uses->flags[number] |= (uint8_t)use;
		return false;
	}
	again = uses->flags[number] & use & USE_CALLED && !(uses->flags[number] & USE_TWICE);
	uses->flags[number] |= (uint8_t)(use | (again ? USE_TWICE : 0));
	return again;
}

void uses_add_within(struct uses *uses, const struct meaning *meaning, unsigned int use)
{
	const struct project *project = uses->project;

	for (int i = 0; meaning->like && i < project->pou_count; i++) {
		const struct var_table *table = &project->pou[i].vars;

		if (meaning->like >= table->var && meaning->like < table->var + table->count)
			uses->flags[uses->base[i + 1] + (meaning->like - table->var)] |= (uint8_t)use;
	}
}

void uses_add_coil(struct uses *uses, const struct meaning *meaning, struct use_coil at)
{
	struct use_coil *kept;
	struct span span;

	uses_add(uses, meaning, USE_WRITTEN);
	/* Two computed indices seldom reach the same element, so they do not conflict. */
	if (meaning->opens > 0 || meaning->through || meaning->kind == MEANING_LITERAL ||
	    meaning->kind == MEANING_NONE || (meaning->addr.area == AREA_NONE && !meaning->var))
		return;
	at.number = USE_COIL_IMAGE;
	if (meaning->addr.area != AREA_NONE) {
		span = span_of(uses, meaning->addr, meaning_reach(meaning));
		coil_set(uses->map.coils, span);
	} else {
		at.number = number_of(uses, meaning);
		span = add_part(uses, at.number, meaning);
	}
	kept = span.count ? arena_alloc(uses->arena, sizeof(*kept)) : NULL;
	if (!kept)
		return;
	*kept = at;
	kept->next = NULL;
	kept->first = span.first;
	kept->count = span.count;
	*uses->coil_end = kept;
	uses->coil_end = &kept->next;
}

bool uses_coil_twice(const struct uses *uses, const struct use_coil *coil)
{
	const struct use_coils *coils = coil->number == USE_COIL_IMAGE ? &uses->map.coils :
					&uses->coils[coil->number];

	return map_has(coils->twice, (struct span){ coil->first, coil->count });
}

void uses_add_index(struct uses *uses, struct scope *scope, const struct pou *pou,
		    uint32_t text, const struct meaning *meaning)
{
	const char *all = scope_text(scope, text);
	const struct meaning *index;
	size_t at = 0;

	if (!meaning->index_of)
		return;
	while (strpbrk(all + at, "[,")) {
		index = scope_index(scope, pou, text, &at);
		if (index)
			uses_add(uses, index, USE_READ);
	}
}

unsigned int uses_of(const struct uses *uses, int table, int index,
		     const struct var *var)
{
	unsigned int flags = uses->flags[uses->base[table] + index];
	struct span at;

	if (var->at.area == AREA_NONE)
		return flags;
	at = span_of(uses, var->at, var->array);
	if (map_has(uses->map.read, at))
		flags |= USE_READ;
	if (map_has(uses->map.written, at))
		flags |= USE_WRITTEN;
	return flags;
}
