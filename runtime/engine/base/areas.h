/* SPDX-License-Identifier: MIT
 *
 * areas - how large the areas of one program are, and where each begins.
 *
 * No other file computes this. Sizes come from the rows of catalog.def, from a
 * project's CONFIGURATION or from the header of a code image; a process image has the
 * areas one after another, each from a multiple of 8 on. The memory itself belongs to
 * the caller.
 */
#ifndef BASE_AREAS_H
#define BASE_AREAS_H

#include "engine/base/iec.h"

struct areas {
	uint32_t bytes[AREA_COUNT]; /* AREA_NONE: 0                           */
	uint32_t at[AREA_COUNT];    /* offset of its first byte               */
	uint32_t size;              /* of all together; a multiple of 8       */
};

/** areas_init - as large as they usually are.   Scan-safe: yes. */
void areas_init(struct areas *areas);
/**
 * areas_place - sets `at` and `size` from `bytes`
 *
 * Scan-safe: yes.   Fails: false if a size is outside the bounds of its row, or all are
 * larger than LIMIT_AREAS together: how large, is in `size` then.
 */
bool areas_place(struct areas *areas);
/** areas_find - the area that holds byte @offset of a process image, or AREA_NONE.
 * Scan-safe: yes. */
enum iec_area areas_find(const struct areas *areas, uint32_t offset);
/** areas_have - whether an address lies inside its area with all its bits. Scan-safe:
 * yes. */
bool areas_have(const struct areas *areas, struct iec_addr addr);
/** areas_byte - offset of the first byte of an address.   Scan-safe: yes. */
static inline uint32_t areas_byte(const struct areas *areas, struct iec_addr addr)
{
	return areas->at[addr.area] + addr.byte;
}
#endif
