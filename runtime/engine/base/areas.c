/* SPDX-License-Identifier: MIT
 *
 * areas - checks the sizes of the areas and places them one after another.
 */
#include "engine/base/areas.h"
#include "engine/base/limits.h"

/* Bits of all areas are counted in 24 bits (scan/code.h). */
_Static_assert(LIMIT_AREAS * 8 <= 1u << 24, "areas are too large");

#define ALIGN 8u /* aligned, so that %MD0 is one load                         */

void areas_init(struct areas *areas)
{
	for (int area = 0; area < AREA_COUNT; area++)
		areas->bytes[area] = iec_area_row((enum iec_area)area)->usual;
	areas_place(areas);
}

bool areas_place(struct areas *areas)
{
	bool good = true;

	areas->size = 0;
	for (int area = 0; area < AREA_COUNT; area++) {
		const struct iec_area_row *row = iec_area_row((enum iec_area)area);

		good = good && areas->bytes[area] >= row->least &&
		       areas->bytes[area] <= row->most;
		areas->at[area] = areas->size;
		areas->size += (areas->bytes[area] + ALIGN - 1) / ALIGN * ALIGN;
	}
	return good && areas->size <= LIMIT_AREAS;
}

enum iec_area areas_find(const struct areas *areas, uint32_t offset)
{
	for (int area = AREA_NONE + 1; area < AREA_COUNT; area++)
		if (offset - areas->at[area] < areas->bytes[area])
			return (enum iec_area)area;
	return AREA_NONE;
}

bool areas_have(const struct areas *areas, struct iec_addr addr)
{
	uint32_t size = addr.bits < 8 ? 1 : addr.bits / 8u;
	uint32_t most = areas->bytes[addr.area];

	return addr.byte < most && size <= most - addr.byte;
}
