/* SPDX-License-Identifier: MIT
 *
 * iomap_check - what is wrong with an I/O map, line by line, and what this machine has.
 *
 * The reader and the drivers of hal/ judge; here their answers are sorted by lines. It
 * takes no line of a chip. No toolkit.
 */
#ifndef EDITOR_IOMAP_CHECK_H
#define EDITOR_IOMAP_CHECK_H

#include "hal/drivers.h"

/* A line of this machine. */
struct io_found {
	const char *chip, *label, *name, *owner; /* name, owner: may be ""     */
	uint32_t offset;
	bool used, output;
};

struct io_machine {
	struct arena arena;
	struct io_found *line;
	int count;
	struct diag_list diags; /* chips that could not be looked at           */
};

/** io_machine_look - the lines of all chips, now. @dev: NULL: "/dev". Owns:
 * io_machine_free(). */
void io_machine_look(struct io_machine *out, const char *dev);
void io_machine_free(struct io_machine *machine);
/** io_machine_name - how a map names a line: "GPIO17", or "label 17" if that name is not
 * there or there twice. As snprintf. */
int io_machine_name(const struct io_machine *machine, int line, char *out, size_t size);

/* A point that can be read, and where its line is. */
struct io_placed {
	const struct io_point *point;
	int found;              /* in the lines of the machine; -1: not here,
				   or no pin                                   */
};

struct io_check {
	struct arena arena;
	struct iomap map;          /* of the lines that can be read            */
	struct io_placed *placed;  /* of map.point                             */
	struct diag_list errors;   /* of the text: they hold on every machine  */
	struct diag_list here;     /* of this machine only                     */
};

/**
 * io_check_new - judges a text; @areas: of the program
 * @machine: NULL, or one without lines: nothing is said of this machine
 * @dev: folder of the device files; NULL: "/dev"
 * Owns: io_check_free().   Fails: NULL: no memory.
 */
struct io_check *io_check_new(const char *text, size_t len, const struct areas *areas,
			      const struct io_machine *machine, const char *dev);
void io_check_free(struct io_check *check);
/** io_check_at - the first message of a line (1-based), errors of the text before what
 * holds here only; NULL: none. @here: is it of this machine only? */
const struct diag *io_check_at(const struct io_check *check, int line, bool *here);
/** io_check_point - of a line of the text; NULL: it cannot be read. */
const struct io_placed *io_check_point(const struct io_check *check, int line);

#endif
