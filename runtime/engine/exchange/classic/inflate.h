/* SPDX-License-Identifier: MIT
 *
 * inflate - unpacks gzip (RFC 1951, RFC 1952), because the engine links nothing but libc.
 *
 * It does not pack. The caller sets a bound for the unpacked size.
 */
#ifndef CLASSIC_INFLATE_H
#define CLASSIC_INFLATE_H

#include "engine/base/arena.h"
#include "engine/base/diag.h"

#include <stdint.h>

/** inflate_is - true if the bytes begin as a gzip file does. Scan-safe: yes. */
bool inflate_is(const void *bytes, size_t len);

/**
 * inflate_gzip - unpacks one gzip member; nothing may follow it
 * @limit:   most bytes of the result
 * @out_len: gets its length
 * @why:     gets the error: NO_MEMORY, TOO_LARGE, IMPORT_PACKED
 *
 * Owns: @arena owns the text; a NUL follows it.   Scan-safe: no.
 * Fails: NULL, also if length or checksum are wrong.
 */
char *inflate_gzip(struct arena *arena, const void *bytes, size_t len, size_t limit,
		   size_t *out_len, enum diag_id *why);

/** inflate_crc32 - gzip's checksum. @crc: 0, or the result for the bytes before. */
uint32_t inflate_crc32(uint32_t crc, const void *bytes, size_t len);
#endif
