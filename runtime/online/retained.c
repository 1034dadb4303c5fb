/* SPDX-License-Identifier: MIT
 *
 * retained - plans, payloads that are sent in parts, and what of them fits a program.
 */
#include "online/retained.h"

#include <stdlib.h>
#include <string.h>

void retained_init(struct retained *retained)
{
	memset(retained, 0, sizeof(*retained));
	retained->owner = -1;
	arena_init(&retained->arena);
}

void retained_free(struct retained *retained)
{
	arena_free(&retained->arena);
	free(retained->bytes);
	retained_init(retained);
}

bool retained_plan(struct retained *retained, const struct program *program)
{
	struct image *image;

	arena_free(&retained->arena);
	arena_init(&retained->arena);
	retained->copy = NULL;
	image = arena_alloc(&retained->arena, sizeof(*image));
	if (!image)
		return false;
	image->program = program;
	if (!retain_plan(&retained->plan, image, &retained->arena))
		return false;
	retained->copy = arena_alloc(&retained->arena, retained->plan.copy_size + 1u);
	retained->told = arena_alloc(&retained->arena, (size_t)retained->plan.count + 1u);
	return retained->copy && retained->told;
}

void retained_fill(struct retained *retained)
{
	retain_fill(&retained->plan, retained->copy, retained->clock_ns);
}

const uint8_t *retained_payload(const struct retained *retained, uint32_t *size)
{
	*size = retained->plan.payload_size;
	return retained->plan.slot + sizeof(struct retain_slot);
}

bool retained_take_part(struct retained *retained, uint32_t size, uint32_t offset,
			const uint8_t *bytes, size_t len)
{
	if (!size || size > LIMIT_RETAIN)
		return false;
	if (offset == 0) {
		free(retained->bytes);
		retained->bytes = malloc(size);
		retained->size = size;
		retained->received = 0;
	}
	if (!retained->bytes || size != retained->size || offset != retained->received ||
	    len > size - offset)
		return false;
	memcpy(retained->bytes + offset, bytes, len);
	retained->received += (uint32_t)len;
	return true;
}

int retained_merge(struct retained *retained,
		   void (*told)(void *context, const struct retain_record *record,
				enum retain_fate fate),
		   void *context)
{
	struct retain_record record;
	uint32_t at = RETAIN_HEAD;
	int kept = 0;

	if (!retained->bytes || retained->received != retained->size ||
	    !retain_is_well_formed(retained->bytes, retained->size))
		return -1;
	while (retain_next(retained->bytes, retained->size, &at, &record)) {
		const enum retain_fate fate = retain_take(&retained->plan, &record,
							  retained->copy);

		if (fate == RETAIN_KEPT)
			kept++;
		if (retained->plan.met)
			retained->told[retained->plan.met - 1] = true;
		if (fate != RETAIN_KEPT)
			told(context, &record, fate);
	}
	for (int i = 0; i < retained->plan.count; i++) {
		record = retain_record_of(&retained->plan, i);
		if (!retained->plan.taken[i] && !retained->told[i])
			told(context, &record, RETAIN_KEPT);
	}
	retained->clock_ns = retain_clock(retained->bytes);
	return kept;
}
