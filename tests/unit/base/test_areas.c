/* SPDX-License-Identifier: MIT
 *
 * test_areas - areas of all sizes: their places, what is inside them, and images with
 * exactly that memory.
 */
#include "engine/base/areas.h"
#include "engine/base/limits.h"

#include "tests/tap.h"
#include "tests/unit/rig.h"

#include <stdlib.h>

static void test_usual(void)
{
	struct areas areas;

	areas_init(&areas);
	CHECK(areas_place(&areas));
	CHECK(areas.bytes[AREA_NONE] == 0 && areas.at[AREA_I] == 0);
	CHECK(areas.at[AREA_Q] == 512 && areas.at[AREA_M] == 1024);
	CHECK(areas.size == 20160 && areas.size % 8 == 0);
}

/* Each byte belongs to at most one area. */
static bool is_sound(const struct areas *areas)
{
	uint32_t at = 0, offset = 0;
	bool good = true;

	for (int i = AREA_NONE + 1; i < AREA_COUNT; i++) {
		enum iec_area area = (enum iec_area)i;

		good &= areas->at[i] == at && at % 8 == 0;
		for (; offset < at + areas->bytes[i]; offset++)
			good &= areas_find(areas, offset) == area;
		at = (at + areas->bytes[i] + 7) / 8 * 8;
		for (; offset < at; offset++)
			good &= areas_find(areas, offset) == AREA_NONE;
	}
	return good && areas->size == at && areas_find(areas, at) == AREA_NONE &&
	       areas_find(areas, UINT32_MAX) == AREA_NONE;
}

static void test_places(void)
{
	struct areas areas;
	uint32_t random = 1;
	bool good = true;

	for (int round = 0; round < 200; round++) {
		areas_init(&areas);
		for (int i = AREA_NONE + 1; i < AREA_COUNT; i++) {
			random = random * 1664525u + 1013904223u;
			if (i != AREA_SM)
				areas.bytes[i] = random >> 16 & (round % 2 ? 1023 : 7);
		}
		good &= areas_place(&areas) && is_sound(&areas);
	}
	CHECK_AS(good, "areas of random sizes, also 0, do not overlap");
}

static bool takes(enum iec_area area, uint32_t bytes)
{
	struct areas areas;

	areas_init(&areas);
	areas.bytes[area] = bytes;
	return areas_place(&areas);
}

static void test_bounds(void)
{
	struct areas areas;
	bool good = true;

	for (int i = AREA_NONE + 1; i < AREA_COUNT; i++) {
		const struct iec_area_row *row = iec_area_row((enum iec_area)i);

		good &= takes((enum iec_area)i, row->least) &&
			takes((enum iec_area)i, row->most) &&
			!takes((enum iec_area)i, row->most + 1) &&
			!takes((enum iec_area)i, UINT32_MAX);
	}
	CHECK_AS(good,
		 "each area takes its least and its largest size, and no larger one");
	CHECK(!takes(AREA_SM, 63) && !takes(AREA_NONE, 1));
	areas_init(&areas);
	areas.bytes[AREA_V] = LIMIT_MEMORY;
	areas.bytes[AREA_M] = LIMIT_MEMORY - (areas.size - 2 * 8192);
	CHECK_AS(areas_place(&areas) && areas.size == LIMIT_AREAS,
		 "areas of LIMIT_AREAS bytes in all are accepted");
	areas.bytes[AREA_M] += 8;
	CHECK_AS(!areas_place(&areas) && areas.size == LIMIT_AREAS + 8,
		 "areas of 8 bytes more are refused");
}

static void test_have(void)
{
	struct areas areas;
	struct iec_addr at = { AREA_Q, 16, 0, 1 };

	areas_init(&areas);
	areas.bytes[AREA_Q] = 3;
	areas.bytes[AREA_V] = 0;
	CHECK(areas_place(&areas) && areas_have(&areas, at) &&
	      areas_byte(&areas, at) == 513);
	at.byte = 2;
	CHECK_AS(!areas_have(&areas, at),
		 "a word of which the area has only the first byte is refused");
	at.bits = 1;
	at.bit = 7;
	CHECK(areas_have(&areas, at));
	at.byte = 3;
	CHECK(!areas_have(&areas, at));
	at.byte = UINT32_MAX;
	at.bits = 64;
	CHECK(!areas_have(&areas, at));
	at = (struct iec_addr){ AREA_V, 1, 0, 0 };
	CHECK(!areas_have(&areas, at));
	at = (struct iec_addr){ AREA_NONE, 1, 0, 0 };
	CHECK(!areas_have(&areas, at));
}

#define SIZED(lines) "\nCONFIGURATION C\n" lines "END_CONFIGURATION\n\n" \
	"PROGRAM Main LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.7 |\nEND_PROGRAM\n"

static size_t memory_of(const char *text)
{
	struct rig rig;
	size_t size = 0;

	if (rig_open(&rig, text, false))
		size = image_memory_size(ladder_program(rig.ladder));
	rig_close(&rig);
	return size;
}

static void test_memory(void)
{
	size_t usual = memory_of(SIZED("  AREA V 8192;\n"));

	CHECK(usual > 20160);
	CHECK(memory_of(SIZED("  AREA V 65536;\n")) == usual + 65536 - 8192);
	CHECK(memory_of(SIZED("  AREA V 0;\n")) == usual - 8192);
	CHECK(memory_of(SIZED("  AREA V 1;\n  AREA M 9;\n")) ==
	      usual - 8192 - 8192 + 8 + 16);
}

/* Access to an image between scans uses the sizes of its areas. */
static void test_image(void)
{
	struct rig rig;
	struct image *image;

	if (!rig_open(&rig, SIZED("  AREA Q 1;\n  AREA V 65533;\n"), false)) {
		CHECK_AS(false, "the program with areas of other sizes builds");
		return;
	}
	image = &rig.resource.image;
	CHECK(image_find(image, "%VB65532", 8).type == IEC_BYTE);
	CHECK(image_find(image, "%VW65532", 8).type == IEC_NONE);
	CHECK(image_find(image, "V524263", 7).type == IEC_BOOL);
	CHECK(image_find(image, "V524264", 7).type == IEC_NONE);
	CHECK(image_find(image, "%QX0.7", 6).area == AREA_Q);
	CHECK(image_find(image, "%QX1.0", 6).type == IEC_NONE);
	CHECK(image_set_bit(image, AREA_V, 65533 * 8 - 1, true) &&
	      image_get_bit(image, AREA_V, 65533 * 8 - 1));
	CHECK(!image_set_bit(image, AREA_V, 65533 * 8, true));
	CHECK(!image_set_bit(image, AREA_Q, 8, true));
	rig_close(&rig);
}

int main(void)
{
	test_usual();
	test_places();
	test_bounds();
	test_have();
	test_memory();
	test_image();
	return tap_done();
}
