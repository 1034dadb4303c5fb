/* SPDX-License-Identifier: MIT
 *
 * tar - a tar archive in memory: plain files only, as POSIX.1 (ustar) and GNU tar write them.
 *
 * It opens no file and follows no name.
 */
#ifndef LADDER_TAR_H
#define LADDER_TAR_H

#include "ladder/bytes.h"

#define TAR_NAME 1200

struct tar_file {
	char name[TAR_NAME];
	const uint8_t *bytes;  /* in the archive                              */
	size_t len;
};

/** tar_add - a file at the end of @archive. Scan-safe: no; so are all functions. */
void tar_add(struct bytes *archive, const char *name, const void *bytes, size_t len);
/** tar_end - the two blocks of zeros behind the last file. */
void tar_end(struct bytes *archive);
/** tar_next - the file at @at, which moves behind it. Others than plain files are left out.
 * Fails: false: the end, or bytes that are no tar. */
bool tar_next(const uint8_t *archive, size_t len, size_t *at, struct tar_file *out);
/** tar_is_at_end - whether a block of zeros is at @at. */
bool tar_is_at_end(const uint8_t *archive, size_t len, size_t at);
#endif
