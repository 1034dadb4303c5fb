/* SPDX-License-Identifier: MIT
 *
 * disk - files as the engine reads and saves them, with errors a person can read.
 *
 * Only regular files, of a bounded size; a save goes through links, keeps the mode, and
 * leaves the old file or the new one (engine/base/file.h).
 */
#ifndef EDITOR_DISK_H
#define EDITOR_DISK_H

#include "engine/base/diag.h"

#include <gio/gio.h>
#include <stdbool.h>

/** disk_read - all of it, NUL-ended; @limit: bytes at most. Caller frees with g_free().
 * Fails: NULL, and @error (or NULL) says why. */
char *disk_read(const char *path, gsize limit, gsize *len, GError **error);
/** disk_told_size - ": 1.1 TB, at most 67.1 MB" of a file that @diag says is larger than
 * @limit; "" of any other. Caller frees with g_free(). */
char *disk_told_size(const char *path, const struct diag *diag, gsize limit);
/** disk_save - in the place of what was there. Fails: false, and @error says why; the old
 * file is as it was. */
bool disk_save(const char *path, const char *bytes, gsize len, GError **error);
/** disk_is_locked - is it there, and nobody, or not this user, may write it? A save, which
 * puts another file in its place, would not know. */
bool disk_is_locked(const char *path);
/** disk_same - do both paths lead to one file, through links too? */
bool disk_same(const char *a, const char *b);

#endif
