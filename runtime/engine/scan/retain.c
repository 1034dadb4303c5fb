/* SPDX-License-Identifier: MIT
 *
 * retain - copies retained values from an image and back. This is the part that runs in
 * a scan. Names and slots are in retain_plan.c and retain_slot.c.
 */
#include "engine/scan/retain.h"

#include <string.h>

void retain_copy(const struct retain *retain, const struct image *image,
		 uint8_t *copy)
{
	const struct code_header *header = retain->program->header;

	if (retain->count == retain->loose_count)
		memset(copy, 0, header->retain_size);
	else
		memcpy(copy, image->memory + header->retain_offset,
		       header->retain_size);
	for (int i = 0; i < retain->loose_count; i++) {
		const struct retain_var *var = &retain->var[retain->loose[i]];

		if (var->at.area != AREA_NONE)
			copy[var->kept] = image_get_bit(image, var->at.area,
							var->at.where);
		else
			memcpy(copy + var->kept, image->memory + var->at.where,
			       var->size);
	}
}

static void put_var(struct image *image, const struct retain_var *var,
		    const uint8_t *value)
{
	struct location at = var->at;
	uint32_t size = var->size / var->elements;

	for (uint32_t i = 0; i < var->elements; i++, at.where += size)
		image_set(image, at, iec_load(value + i * size, at.type));
}

/* Through image_set(), so that a BOOL is 0 or 1 and bits of areas agree. */
void retain_put(const struct retain *retain, struct image *image,
		const uint8_t *copy)
{
	for (int i = 0; i < retain->count; i++) {
		const struct retain_var *var = &retain->var[i];

		put_var(image, var, copy + var->kept);
	}
}
