/* SPDX-License-Identifier: MIT
 *
 * load - a program and its I/O map from their files, checked against each
 * other.
 *
 * Touches no pin. What is wrong is in two lists of diagnostics for the caller.
 */
#ifndef LADDERD_LOAD_H
#define LADDERD_LOAD_H

#include "hal/iomap.h"
#include "ladderd/source.h"

struct load {
	struct source source;
	struct arena arena;       /* the map, later the HAL and the image     */
	struct iomap map;
	struct diag_list diags;   /* of the map                               */
	bool unreadable;          /* a file could not be read at all          */
};

/** load_files - Fails: false; load_free() all the same. Scan-safe: no. */
bool load_files(struct load *load, const char *file, const char *map);
void load_free(struct load *load);
#endif
