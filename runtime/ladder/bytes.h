/* SPDX-License-Identifier: MIT
 *
 * bytes - bytes that grow.
 */
#ifndef LADDER_BYTES_H
#define LADDER_BYTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct bytes {
	uint8_t *at;           /* free(), or bytes_free()                     */
	size_t len, room;
	bool failed;           /* memory was out; `at` is incomplete          */
};

/** bytes_add - at the end. Scan-safe: no. Fails: sets `failed`. */
void bytes_add(struct bytes *bytes, const void *more, size_t len);
void bytes_free(struct bytes *bytes);
#endif
