/* SPDX-License-Identifier: MIT
 *
 * iomap_beside - the I/O map of a project, as its file is on the disk.
 */
#ifndef EDITOR_IOMAP_BESIDE_H
#define EDITOR_IOMAP_BESIDE_H

#include "hal/said.h"

#include <glib.h>
#include <stdbool.h>

/** iomap_beside - NAME.io of NAME.rung, else the project's first own map (side_file.h).
 * @path: of the project. Caller: g_free(). Any thread. NULL: there is none. */
char *iomap_beside(const char *path);
/** iomap_is_own - does the name of map @map belong to project @path (side_file_list())?
 * Other maps may be for other wiring. Any thread. */
bool iomap_is_own(const char *path, const char *map);
/* What a simulation needs of a map. */
struct iomap_at_rest {
	guint8 *safe;            /* the values of outputs as `ladderd` drives them while nothing runs: a bit for
				  * each bit of Q, 8 a byte, then as many bits for those that keep their value
				  * instead; NULL: all 0. Caller: g_free()          */
	struct io_said *said;    /* what tells the quality of inputs. Caller: g_free() */
	int said_count;
};
/** iomap_read_beside - of that map; nothing if there is none, or one that `ladderd` would refuse. @areas: of
 * the program. Any thread. */
struct iomap_at_rest iomap_read_beside(const char *path, const struct areas *areas);

#endif
