/* SPDX-License-Identifier: MIT
 *
 * iomap_beside - the I/O map of a project, as its file is on the disk.
 */
#ifndef EDITOR_IOMAP_BESIDE_H
#define EDITOR_IOMAP_BESIDE_H

#include "engine/base/areas.h"

#include <glib.h>
#include <stdbool.h>

/** iomap_beside - NAME.io of NAME.rung, else the project's first own map (side_file.h).
 * @path: of the project. Caller: g_free(). Any thread. NULL: there is none. */
char *iomap_beside(const char *path);
/** iomap_is_own - does the name of map @map belong to project @path (side_file_list())?
 * Other maps may be for other wiring. Any thread. */
bool iomap_is_own(const char *path, const char *map);
/**
 * iomap_safe_beside - the safe values of the outputs in that map, as `ladderd` drives them
 * while nothing runs
 * @areas: of the program
 *
 * Returns a bit for each bit of Q, 8 a byte, then as many bits for those that keep their value
 * instead; NULL: all 0, or there is no map, or one that `ladderd` would refuse. Caller: g_free().
 * Any thread.
 */
guint8 *iomap_safe_beside(const char *path, const struct areas *areas);

#endif
