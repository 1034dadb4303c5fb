/* SPDX-License-Identifier: MIT
 *
 * load - reads a program and its I/O map and checks them against each other.
 *
 * It opens no line. Diagnostics of the program are in source.diags, those of the map in
 * diags.
 */
#ifndef LADDERD_LOAD_H
#define LADDERD_LOAD_H

#include "hal/iomap.h"
#include "ladderd/source.h"

struct load {
	struct source source;
	struct arena arena;       /* of the map, the HAL and the process image */
	struct iomap map;
	struct diag_list diags;   /* of the map                               */
	const char *map_text;     /* of the map                               */
	size_t map_len;
	bool unreadable;          /* a file could not be read at all          */
};

/** load_files - @watch: desks may want the power of cells. Owns: load_free(), also after a failure. Scan-safe: no. Fails: false. */
bool load_files(struct load *load, const char *file, const char *map, bool watch);
/** load_texts - the same of a program and a map in memory. */
bool load_texts(struct load *load, const void *program, size_t program_len, const char *map,
		size_t map_len);
void load_free(struct load *load);
#endif
