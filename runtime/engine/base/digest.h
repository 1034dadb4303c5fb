/* SPDX-License-Identifier: MIT
 *
 * digest - CRC-32C for stored bytes, SHA-256 for a program's identity.
 *
 * Its own code because the runtime needs nothing but libc. Not for secrets.
 */
#ifndef BASE_DIGEST_H
#define BASE_DIGEST_H

#include <stddef.h>
#include <stdint.h>

/** digest_crc32c - RFC 3720 B.4; @crc is 0 or what an earlier part gave. */
uint32_t digest_crc32c(uint32_t crc, const void *bytes, size_t len);

struct digest_sha256 {
	uint32_t state[8];
	uint64_t length;
	uint8_t block[64];
};
/** FIPS 180-4, in parts; @out gets 32 bytes. Scan-safe: yes, but slow. */
void digest_sha256_init(struct digest_sha256 *sha);
void digest_sha256_add(struct digest_sha256 *sha, const void *bytes, size_t len);
void digest_sha256_end(struct digest_sha256 *sha, uint8_t out[32]);
/** digest_hex - lower-case hex of @len bytes and a NUL; @out has 2*len+1. */
void digest_hex(const uint8_t *bytes, size_t len, char *out);
#endif
