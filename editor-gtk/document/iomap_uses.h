/* SPDX-License-Identifier: MIT
 *
 * iomap_uses - the inputs and outputs of a program, of any area and width, and their names.
 *
 * No toolkit.
 */
#ifndef EDITOR_IOMAP_USES_H
#define EDITOR_IOMAP_USES_H

#include "engine/base/arena.h"
#include "engine/model/project.h"

struct io_use {
	struct iec_addr addr;
	const char *name;    /* of its variable; "" if there is none           */
	const char *comment; /* of the variable, with its delimiters; ""        */
};

struct io_uses {
	struct arena arena;
	struct io_use *use;  /* by area and address, each once                 */
	int count;
};

/** io_uses_make - of @project, which may have errors; only its table of names grows
 * Owns: io_uses_free(), always.   Fails: false: no memory. */
bool io_uses_make(struct io_uses *out, struct project *project);
void io_uses_free(struct io_uses *uses);

#endif
