/* SPDX-License-Identifier: MIT
 *
 * inflate - what gzip packed, unpacked (RFC 1951, RFC 1952).
 *
 * Its own code because the engine needs nothing but libc. It packs nothing, and what it
 * unpacks has a bound that the caller sets.
 */
#ifndef CLASSIC_INFLATE_H
#define CLASSIC_INFLATE_H

#include "engine/base/arena.h"
#include "engine/base/diag.h"

#include <stdint.h>

/** inflate_is - do these bytes begin as gzip's do? Scan-safe: yes. */
bool inflate_is(const void *bytes, size_t len);

/**
 * inflate_gzip - unpacks one gzip member, which must be all there is
 * @limit:   bytes at most, unpacked
 * @out_len: gets their number
 * @why:     gets what is wrong: NO_MEMORY, TOO_LARGE, IMPORT_PACKED
 *
 * Owns: @arena owns the text; a NUL stands behind it.   Scan-safe: no.
 * Fails: NULL. Length and checksum of the text must be those that were packed.
 */
char *inflate_gzip(struct arena *arena, const void *bytes, size_t len, size_t limit,
		   size_t *out_len, enum diag_id *why);

/** inflate_crc32 - gzip's checksum; @crc is 0 or what an earlier part gave. */
uint32_t inflate_crc32(uint32_t crc, const void *bytes, size_t len);
#endif
