/* SPDX-License-Identifier: MIT
 *
 * uses - flags for each declared variable, and bit maps of the process image.
 *
 * The maps make overlap free of charge: whoever touches %MW0 touches its 16
 * bits. It knows no rungs and no diagnostics.
 */
#include "engine/check/uses.h"

bool uses_init(struct uses *uses, const struct project *project,
	       struct arena *arena)
{
	size_t bytes = iec_areas_size();
	int count = project->globals.count;

	uses->project = project;
	uses->base = arena_alloc(arena, sizeof(*uses->base) *
				 ((size_t)project->pou_count + 1));
	if (!uses->base)
		return false;
	for (int i = 0; i < project->pou_count; i++) {
		uses->base[i + 1] = count;
		count += project->pou[i].vars.count;
	}
	uses->flags = arena_alloc(arena, (size_t)count);
	uses->map.read = arena_alloc(arena, bytes);
	uses->map.written = arena_alloc(arena, bytes);
	uses->map.coil = arena_alloc(arena, bytes);
	return !arena->failed;
}

/* Where an address begins in a map, how many bytes, and which bits of each. */
static uint32_t span(struct iec_addr at, uint32_t *count, uint8_t *mask)
{
	*mask = at.bits == 1 ? (uint8_t)(1u << (at.bit & 7)) : 0xff;
	*count = at.bits == 1 ? 1 : at.bits / 8u;
	return iec_area_row(at.area)->offset + at.byte;
}

static void map_set(uint8_t *map, struct iec_addr at)
{
	uint32_t count;
	uint8_t mask;
	uint32_t first = span(at, &count, &mask);

	for (uint32_t i = first; i < first + count; i++)
		map[i] |= mask;
}

static bool map_has(const uint8_t *map, struct iec_addr at)
{
	uint32_t count;
	uint8_t mask;
	uint32_t first = span(at, &count, &mask);

	for (uint32_t i = first; i < first + count; i++)
		if (map[i] & mask)
			return true;
	return false;
}

static bool map_add(struct uses *uses, struct iec_addr at, unsigned int use)
{
	bool again = use & USE_COIL && map_has(uses->map.coil, at);

	if (use & USE_READ)
		map_set(uses->map.read, at);
	if (use & USE_WRITTEN)
		map_set(uses->map.written, at);
	if (use & USE_COIL)
		map_set(uses->map.coil, at);
	return again;
}

static uint8_t *flags_of(struct uses *uses, const struct meaning *meaning)
{
	int table = 0;

	if (meaning->pou)
		table = (int)(meaning->pou - uses->project->pou) + 1;
	return &uses->flags[uses->base[table] + meaning->index];
}

bool uses_add(struct uses *uses, const struct meaning *meaning,
	      unsigned int use)
{
	unsigned int once = use & (USE_COIL | USE_CALLED);
	bool again = false;
	uint8_t *flags;

	if (meaning->kind == MEANING_LITERAL || meaning->kind == MEANING_NONE)
		return false;
	if (meaning->addr.area != AREA_NONE)
		again = map_add(uses, meaning->addr, use);
	if (!meaning->var)
		return again;
	flags = flags_of(uses, meaning);
	if (meaning->kind == MEANING_PIN)
		again = false; /* two pins of an instance are two places */
	else
		again |= (*flags & once) != 0;
	again &= !(*flags & USE_TWICE);
	*flags |= (uint8_t)(use | (again ? USE_TWICE : 0));
	return again;
}

unsigned int uses_of(const struct uses *uses, int table, int index,
		     struct iec_addr at)
{
	unsigned int flags = uses->flags[uses->base[table] + index];

	if (at.area == AREA_NONE)
		return flags;
	if (map_has(uses->map.read, at))
		flags |= USE_READ;
	if (map_has(uses->map.written, at))
		flags |= USE_WRITTEN;
	return flags;
}
