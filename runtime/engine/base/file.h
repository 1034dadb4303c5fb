/* SPDX-License-Identifier: MIT
 *
 * file - whole files in, whole files out.
 *
 * A read sees one version of the file. A save is complete, or the old file stays.
 */
#ifndef BASE_FILE_H
#define BASE_FILE_H

#include "engine/base/diag.h"

/**
 * file_read - a whole regular file
 * @limit: bytes at most
 * Owns: the caller, free(). NULL and a diagnostic (with errno's text; @diags may be NULL) on failure.
 */
char *file_read(const char *path, size_t limit, size_t *len,
		struct diag_list *diags);
/**
 * file_save - replaces a file atomically: temporary file beside it,
 * fsync, rename, fsync of the folder. Keeps the mode of an old file.
 * Fails: false and a diagnostic; the old file is intact.
 */
bool file_save(const char *path, const void *bytes, size_t len,
	       struct diag_list *diags);

#endif
