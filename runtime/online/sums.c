/* SPDX-License-Identifier: MIT
 *
 * sums - a sum of sums modulo 2^16 and a part of SHA-256.
 */
#include "online/sums.h"

#include "engine/base/digest.h"

#include <string.h>

uint32_t sums_weak(const uint8_t *bytes, uint32_t len)
{
	uint32_t one = 0, two = 0;

	for (uint32_t i = 0; i < len; i++) {
		one += bytes[i];
		two += one;
	}
	return (one & 0xffff) | two << 16;
}

uint32_t sums_roll(uint32_t weak, uint32_t len, uint8_t gone, uint8_t come)
{
	const uint32_t one = (weak - gone + come) & 0xffff;
	const uint32_t two = (weak >> 16) - len * gone + one;

	return one | two << 16;
}

void sums_strong(const uint8_t *bytes, uint32_t len, uint8_t out[SUMS_STRONG])
{
	struct digest_sha256 sha;
	uint8_t all[32];

	digest_sha256_init(&sha);
	digest_sha256_add(&sha, bytes, len);
	digest_sha256_end(&sha, all);
	memcpy(out, all, SUMS_STRONG);
}
