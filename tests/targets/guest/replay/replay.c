/* SPDX-License-Identifier: MIT
 *
 * replay - repeats random programs that were recorded on the machine that built them:
 * `replay BUNDLE` prints TAP. It links only base/ and scan/, so it is the smallest target.
 *
 * After every scan the whole process image is compared byte for byte, also REAL. REAL is
 * equal everywhere because it has 32 bits of IEEE 754 and each operation is rounded once:
 * `-std=c11 -ffp-contract=off` keeps a compiler from fusing a product and a sum; no target
 * computes in wider registers (FLT_EVAL_METHOD is 0, which is checked below); sums and
 * products in double are exact before they are rounded; a result that is infinite or not a
 * number is never stored; and no function of libm is called whose last bit may vary.
 */
#include "tests/targets/guest/bundle.h"

#include "engine/scan/resource.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

#if FLT_EVAL_METHOD != 0
#error "REAL would be computed with more bits than it has"
#endif

#define BATCH 100 /* programs per result line                                */

struct player {
	FILE *in;
	unsigned number;          /* of the program, 1-based                 */
	uint32_t image_len, scans, record_len, data_len;
	const uint8_t *at, *end;  /* in the record                           */
	struct program program;
	struct resource resource;
	char why[160];
};

static _Alignas(8) uint8_t image[BUNDLE_IMAGE];
static _Alignas(8) uint8_t memory[BUNDLE_DATA + 64];
static uint8_t record[BUNDLE_RECORD], want[BUNDLE_DATA];
static struct player player;
static int results, failures;

static void result(bool good, const char *what)
{
	printf("%sok %d - %s\n", good ? "" : "not ", ++results, what);
	failures += !good;
	fflush(stdout);
}

static bool wrong(const char *why)
{
	snprintf(player.why, sizeof(player.why), "program %u: %s",
		 player.number, why);
	return false;
}

static uint64_t number(const uint8_t *bytes, unsigned count)
{
	uint64_t value = 0;

	while (count-- > 0)
		value = value << 8 | bytes[count];
	return value;
}

static bool take_u32(uint32_t *out)
{
	uint8_t bytes[4];

	if (fread(bytes, 1, 4, player.in) != 4)
		return false;
	*out = (uint32_t)number(bytes, 4);
	return true;
}

static bool take_varint(uint32_t *out)
{
	*out = 0;
	for (unsigned shift = 0; shift < 32 && player.at < player.end;
	     shift += 7) {
		uint8_t byte = *player.at++;

		*out |= (uint32_t)(byte & 127) << shift;
		if (!(byte & 128))
			return true;
	}
	return false;
}

static bool take_changes(void)
{
	uint32_t count, gap;
	size_t at = 0;

	if (!take_varint(&count))
		return wrong("the record is short");
	for (uint32_t i = 0; i < count; i++, at++) {
		if (!take_varint(&gap) || player.at == player.end ||
		    gap >= player.data_len - at)
			return wrong("the record is short");
		at += gap;
		want[at] = *player.at++;
	}
	return true;
}

static bool same_memory(uint32_t scan)
{
	for (size_t i = 0; i < player.data_len; i++) {
		if (memory[i] == want[i])
			continue;
		snprintf(player.why, sizeof(player.why), "program %u, scan %u:"
			 " byte %u is %02x, not %02x", player.number,
			 (unsigned)scan, (unsigned)i, memory[i], want[i]);
		return false;
	}
	return true;
}

static bool play_scan(uint32_t scan)
{
	const uint8_t *head = player.at;
	bool good;

	if (player.end - player.at < BUNDLE_HEAD)
		return wrong("the record is short");
	player.at += BUNDLE_HEAD;
	memcpy(image_area(&player.resource.image, AREA_I), head + 8,
	       BUNDLE_INPUTS);
	good = resource_scan(&player.resource, (int64_t)number(head, 8));
	if (good != (head[8 + BUNDLE_INPUTS] != 0) ||
	    player.resource.vm.errors !=
		    number(head + 8 + BUNDLE_INPUTS + 1, 4))
		return wrong("a scan ends in another way");
	return take_changes() && same_memory(scan);
}

static bool open_image(size_t len)
{
	struct arena scratch;
	enum diag_id why;
	size_t where;
	bool good;

	arena_init(&scratch);
	good = code_open(image, len, &scratch, &player.program, &why, &where);
	arena_free(&scratch);
	return good;
}

static bool read_program(void)
{
	player.number++;
	if (!take_u32(&player.image_len) || !take_u32(&player.scans) ||
	    !take_u32(&player.record_len) || !take_u32(&player.data_len) ||
	    player.image_len > sizeof(image) ||
	    player.record_len > sizeof(record) ||
	    player.data_len > sizeof(want))
		return wrong("its head is damaged");
	if (fread(image, 1, player.image_len, player.in) != player.image_len ||
	    fread(record, 1, player.record_len, player.in) !=
		    player.record_len)
		return wrong("the bundle is short");
	player.at = record;
	player.end = record + player.record_len;
	return true;
}

static bool play_program(void)
{
	if (!open_image(player.image_len))
		return wrong("its image is refused");
	if (player.program.header->data_size != player.data_len ||
	    image_memory_size(&player.program) > sizeof(memory))
		return wrong("its data has another size");
	resource_init(&player.resource, &player.program, memory);
	resource_start(&player.resource);
	memset(want, 0, sizeof(want));
	if (!take_changes() || !same_memory(0))
		return false;
	for (uint32_t scan = 1; scan <= player.scans; scan++)
		if (!play_scan(scan))
			return false;
	return player.at == player.end || wrong("the record is long");
}

/* Changes a bit of every byte of the last image, and cuts the image there. */
static void damage(void)
{
	uint32_t refused = 0;
	char text[120];

	for (uint32_t at = 0; at < player.image_len; at++) {
		image[at] ^= (uint8_t)(1u << at % 8);
		refused += !open_image(player.image_len);
		image[at] ^= (uint8_t)(1u << at % 8);
	}
	snprintf(text, sizeof(text), "a bit turned round: %u of %u images are "
		 "refused", (unsigned)refused, (unsigned)player.image_len);
	result(refused == player.image_len, text);
	refused = 0;
	for (uint32_t len = 0; len < player.image_len; len++)
		refused += !open_image(len);
	snprintf(text, sizeof(text), "cut short: %u of %u images are refused",
		 (unsigned)refused, (unsigned)player.image_len);
	result(refused == player.image_len, text);
	result(open_image(player.image_len), "and the whole one is not");
}

static void play_all(uint32_t begin, uint32_t count)
{
	const uint32_t last = begin + count - 1;
	unsigned long scans = 0;
	unsigned good = 0, first = (unsigned)begin;
	bool sound = true;
	char text[80];

	player.number = first - 1;
	for (uint32_t i = begin; i <= last && sound; i++) {
		sound = read_program();
		if (sound && play_program())
			good++;
		else
			printf("# %s\n", player.why);
		scans += player.scans;
		if (i % BATCH && i != last && sound)
			continue;
		snprintf(text, sizeof(text), "programs %u to %u: every scan "
			 "byte for byte", first, (unsigned)i);
		result(good == i - first + 1, text);
		first = i + 1;
		good = 0;
	}
	printf("# %u programs, %lu scans\n", player.number + 1 - (unsigned)begin, scans);
	if (sound)
		damage();
}

int main(int argc, char **argv)
{
	char magic[8];
	uint32_t begin = 0, count = 0;

	if (argc != 2) {
		fprintf(stderr, "usage: replay BUNDLE\n");
		return 2;
	}
	player.in = fopen(argv[1], "rb");
	if (!player.in || fread(magic, 1, 8, player.in) != 8 ||
	    memcmp(magic, BUNDLE_MAGIC, 8) != 0 || !take_u32(&begin) ||
	    !take_u32(&count) || begin == 0 || count == 0 ||
	    count > UINT32_MAX - begin) {
		printf("Bail out! %s is no bundle\n", argv[1]);
		return 1;
	}
	play_all(begin, count);
	fclose(player.in);
	printf("1..%d\n", results);
	return results == 0 || failures;
}
