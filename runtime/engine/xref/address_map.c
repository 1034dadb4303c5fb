/* SPDX-License-Identifier: MIT
 *
 * address_map - a bit map of the process image, filled from the cross reference.
 */
#include "engine/xref/address_map.h"

#include <stdlib.h>

static uint32_t first_bit(const struct areas *areas, struct iec_addr addr)
{
	return areas_byte(areas, addr) * 8 + addr.bit;
}

/* Behind the last bit of its area. */
static uint32_t area_end(const struct areas *areas, enum iec_area area)
{
	return (areas->at[area] + areas->bytes[area]) * 8;
}

static void mark(uint8_t *map, uint32_t at, uint32_t end)
{
	for (; at < end; at++)
		map[at / 8] |= (uint8_t)(1u << at % 8);
}

static bool is_marked(const uint8_t *map, uint32_t at, uint32_t end)
{
	for (; at < end; at++)
		if (map[at / 8] & 1u << at % 8)
			return true;
	return false;
}

/* Bits of a variable at an address, all its elements. */
static uint32_t bits_of(struct project *project, const struct xref_target *target)
{
	const struct var *var = xref_var(project, target);

	return target->addr.bits * (var && var->array.count ? var->array.count : 1);
}

bool address_map_make(struct address_map *out, const struct xref *xref,
		      struct arena *arena)
{
	const struct areas *areas = &out->areas;
	size_t bytes;

	project_areas(xref->project, &out->areas);
	bytes = (size_t)areas->size + 1;
	out->used = arena_alloc(arena, bytes);
	out->reached = arena_alloc(arena, bytes);
	if (!out->used || !out->reached)
		return false;
	for (int i = 0; i < xref->count; i++) {
		const struct xref_use *use = &xref->use[i];
		const enum iec_area area = use->target.addr.area;
		uint32_t at, end;

		if (area == AREA_NONE)
			continue;
		at = first_bit(areas, use->target.addr);
		end = at + bits_of(xref->project, &use->target);
		end = end < area_end(areas, area) ? end : area_end(areas, area);
		mark(out->used, at, end);
		if (use->target.what == XREF_ADDRESS && use->open)
			end = area_end(areas, area);
		mark(out->reached, at, end);
	}
	return true;
}

bool address_map_is_used(const struct address_map *map, struct iec_addr addr)
{
	uint32_t at;

	if (!areas_have(&map->areas, addr))
		return false;
	at = first_bit(&map->areas, addr);
	return is_marked(map->used, at, at + addr.bits);
}

static bool search(const struct address_map *map, const uint8_t *marks,
		   enum iec_area area, uint32_t bits, uint32_t count, uint32_t from,
		   struct iec_addr *out)
{
	const uint32_t base = map->areas.at[area] * 8;
	const uint64_t size = (uint64_t)map->areas.bytes[area] * 8;
	uint32_t at = (from + bits - 1) / bits * bits;

	for (; (uint64_t)at + (uint64_t)bits * count <= size; at += bits) {
		if (is_marked(marks, base + at, base + at + bits * count))
			continue;
		*out = (struct iec_addr){ area, (uint8_t)bits, (uint8_t)(at % 8), at / 8 };
		return true;
	}
	return false;
}

bool address_map_next(const struct address_map *map, enum iec_area area, int bits,
		      uint32_t count, const struct iec_addr *after, struct iec_addr *out)
{
	uint32_t from = 0;

	if (area <= AREA_NONE || area >= AREA_COUNT || count < 1 ||
	    count > LIMIT_ELEMENTS ||
	    (bits != 1 && bits != 8 && bits != 16 && bits != 32 && bits != 64))
		return false;
	if (after && after->area == area)
		from = after->byte * 8 + after->bit + after->bits;
	return search(map, map->reached, area, (uint32_t)bits, count, from, out) ||
	       search(map, map->used, area, (uint32_t)bits, count, from, out);
}

/* ---- two names ---- */

struct range {
	uint32_t first, end;
	int use;
};

static int by_first(const void *left, const void *right)
{
	const struct range *a = left, *b = right;

	if (a->first != b->first)
		return a->first < b->first ? -1 : 1;
	if (a->end != b->end)
		return a->end < b->end ? -1 : 1;
	return a->use < b->use ? -1 : a->use > b->use;
}

/* All areas far apart: what is declared beyond the end of one lies in no other. */
static uint32_t apart(struct iec_addr addr)
{
	return (uint32_t)addr.area << 27 | (addr.byte * 8 + addr.bit);
}
_Static_assert(LIMIT_MEMORY * 8 + LIMIT_ELEMENTS * 64 <= 1u << 27 && AREA_COUNT <= 32,
	       "areas have room");

/* Every variable with an address, and every address that is used, each once. */
static int ranges_of(struct xref *xref, struct range *range)
{
	int count = 0, kept = 0;

	for (int i = 0; i < xref->count; i++) {
		const struct xref_use *use = &xref->use[i];

		if (use->target.addr.area == AREA_NONE ||
		    (use->target.what == XREF_VARIABLE && use->kind != XREF_DECLARED))
			continue;
		range[count].first = apart(use->target.addr);
		range[count].end = range[count].first +
				   bits_of(xref->project, &use->target);
		range[count++].use = i;
	}
	qsort(range, (size_t)count, sizeof(*range), by_first);
	for (int i = 0; i < count; i++) {
		const struct xref_target *one = &xref->use[range[i].use].target;

		if (kept > 0 && one->what == XREF_ADDRESS &&
		    xref_same(one, &xref->use[range[kept - 1].use].target))
			continue;
		range[kept++] = range[i];
	}
	return kept;
}

int address_map_clashes(struct xref *xref, struct address_clash *out, int most)
{
	struct range *range = arena_alloc(&xref->arena,
					  sizeof(*range) * ((size_t)xref->count + 1));
	int count = range ? ranges_of(xref, range) : 0, found = 0;

	for (int i = 0; i < count; i++) {
		for (int k = i + 1; k < count && range[k].first < range[i].end; k++) {
			int a = range[i].use, b = range[k].use;

			if (found < most)
				out[found] = (struct address_clash){ a < b ? a : b,
								     a < b ? b : a };
			if (++found > LIMIT_VARS) /* all of one word: enough */
				return found;
		}
	}
	return range ? found : -1;
}
