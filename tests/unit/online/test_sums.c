/* SPDX-License-Identifier: MIT
 *
 * test_sums - a window that rolls over bytes has the sum that its bytes have.
 */
#include "online/sums.h"
#include "tests/tap.h"

#include <stdbool.h>
#include <string.h>

static void test_a_rolled_sum_is_that_of_the_window(void)
{
	static uint8_t bytes[70000];
	uint32_t seed = 1;

	for (size_t i = 0; i < sizeof(bytes); i++) {
		seed = seed * 1103515245u + 12345u;
		bytes[i] = i < 20000 ? 255 : (uint8_t)(seed >> 16);
	}
	for (uint32_t len = 64; len <= SUMS_MOST; len = len * 5 / 2) {
		uint32_t weak = sums_weak(bytes, len);
		bool same = true;

		for (uint32_t at = 1; at < 30000; at++) {
			weak = sums_roll(weak, len, bytes[at - 1], bytes[at - 1 + len]);
			if (at % 97 == 0)
				same = same && weak == sums_weak(bytes + at, len);
		}
		CHECK(same);
	}
}

static void test_a_strong_sum_is_the_beginning_of_sha_256(void)
{
	/* FIPS 180-2, B.1 */
	static const uint8_t abc[SUMS_STRONG] = { 0xba, 0x78, 0x16, 0xbf, 0x8f, 0x01, 0xcf, 0xea };
	uint8_t strong[SUMS_STRONG];

	sums_strong((const uint8_t *)"abc", 3, strong);
	CHECK(memcmp(strong, abc, sizeof(abc)) == 0);
	CHECK(sums_weak((const uint8_t *)"\1\2\3", 3) == (6u | 10u << 16));
}

int main(void)
{
	test_a_rolled_sum_is_that_of_the_window();
	test_a_strong_sum_is_the_beginning_of_sha_256();
	return tap_done();
}
