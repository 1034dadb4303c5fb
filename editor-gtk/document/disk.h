/* SPDX-License-Identifier: MIT
 *
 * disk - reads and saves files as the engine does, with errors for the user.
 *
 * Only regular files, of a bounded size. A save follows links, keeps the mode, and leaves
 * the old file or the new one (engine/base/file.h).
 */
#ifndef EDITOR_DISK_H
#define EDITOR_DISK_H

#include "engine/base/diag.h"

#include <gio/gio.h>
#include <stdbool.h>

/** disk_read - a whole file, NUL-ended; @limit: bytes at most. Caller frees with g_free().
 * Fails: NULL, and @error (or NULL) says why. */
char *disk_read(const char *path, gsize limit, gsize *len, GError **error);
/** disk_told_size - ": 1.1 TB, at most 67.1 MB" if @diag says that a file is larger than
 * @limit, else "". Caller frees with g_free(). */
char *disk_told_size(const char *path, const struct diag *diag, gsize limit);
/** disk_save - replaces the file. Fails: false, and @error says why; the old file is
 * unchanged. */
bool disk_save(const char *path, const char *bytes, gsize len, GError **error);
/** disk_is_locked - does the file exist, but not for this user to write? A save replaces
 * the file and would not notice. */
bool disk_is_locked(const char *path);
/** disk_same - do both paths lead to one file, also through links? */
bool disk_same(const char *a, const char *b);

#endif
