/* SPDX-License-Identifier: MIT
 *
 * test_stored - a slot is whole or it is none: cut at each byte, with each bit inverted.
 */
#include "online/stored.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

static const uint8_t beside[32] = { 1, 2, 3 };
static const struct stored given = {
	.len = { 5, 3, 4 }, .bytes = (const uint8_t *)"imagemapsrcs",
};

static uint8_t *seal(size_t *len)
{
	uint8_t *bytes;

	*len = SLOT_HEAD + stored_size(&given) + 4u;
	bytes = malloc(*len + 1);
	slot_seal(&given, 7, beside, bytes);
	return bytes;
}

static void test_what_is_sealed_is_read(void)
{
	struct slot slot;
	size_t len;
	uint8_t *bytes = seal(&len);

	CHECK(slot_open(bytes, len, &slot));
	CHECK(slot.seq == 7 && memcmp(slot.beside, beside, 32) == 0);
	CHECK(memcmp(slot.stored.len, given.len, sizeof(given.len)) == 0);
	CHECK(memcmp(stored_part(&slot.stored, STORED_IMAGE), "image", 5) == 0);
	CHECK(memcmp(stored_part(&slot.stored, STORED_MAP), "map", 3) == 0);
	CHECK(memcmp(stored_part(&slot.stored, STORED_SOURCES), "srcs", 4) == 0);
	free(bytes);
}

static void test_no_other_bytes_are(void)
{
	struct slot slot;
	int wrong = 0;
	size_t len;
	uint8_t *bytes = seal(&len);

	for (size_t part = 0; part < len; part++)
		wrong += slot_open(bytes, part, &slot);
	wrong += slot_open(bytes, len + 1, &slot);
	for (size_t bit = 0; bit < 8 * len; bit++) {
		bytes[bit / 8] ^= (uint8_t)(1u << bit % 8);
		wrong += slot_open(bytes, len, &slot);
		bytes[bit / 8] ^= (uint8_t)(1u << bit % 8);
	}
	CHECK(wrong == 0);
	CHECK(slot_open(bytes, len, &slot));
	free(bytes);
}

static void test_sizes_are_bounded(void)
{
	struct stored most = { .len = { STORED_MOST - 2, 1, 1 } };

	CHECK(stored_size(&most) == STORED_MOST);
	most.len[2] = 2;
	CHECK(stored_size(&most) == 0);
	most.len[0] = most.len[1] = most.len[2] = UINT32_MAX; /* their sum does not wrap */
	CHECK(stored_size(&most) == 0);
}

int main(void)
{
	test_what_is_sealed_is_read();
	test_no_other_bytes_are();
	test_sizes_are_bounded();
	return tap_done();
}
