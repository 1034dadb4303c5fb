/* SPDX-License-Identifier: MIT
 *
 * iomap_check - errors of an I/O map by line, and the lines of this machine.
 *
 * The reader and the drivers of hal/ judge; this file sorts their answers by lines. It
 * requests no line of a chip. No toolkit.
 */
#ifndef EDITOR_IOMAP_CHECK_H
#define EDITOR_IOMAP_CHECK_H

#include "hal/drivers.h"

/* A line of this machine, or of a connected board. */
struct io_found {
	const char *chip, *label, *name, *owner; /* name, owner: may be ""     */
	uint32_t offset;
	bool used, output;
};

struct io_machine {
	struct arena arena;
	struct io_found *line;
	int count;
	bool elsewhere;         /* these lines are those of a connected board   */
	struct diag_list diags; /* chips that could not be opened              */
};

/** io_machine_look - the lines of all chips, now. @dev: NULL: "/dev". Owns:
 * io_machine_free(). */
void io_machine_look(struct io_machine *out, const char *dev);
void io_machine_free(struct io_machine *machine);
/** io_machine_name - the name of a line in a map: "GPIO17", or "label 17" if it has no name
 * or shares it. Returns as snprintf. */
int io_machine_name(const struct io_machine *machine, int line, char *out, size_t size);

/* A point of a line without errors. */
struct io_placed {
	const struct io_point *point;
	int found;              /* index in the lines of the machine; -1: not here, or no pin
				   */
};

struct io_check {
	struct arena arena;
	struct iomap map;          /* of the lines without errors              */
	struct io_placed *placed;  /* of map.point                             */
	struct diag_list errors;   /* of the text: they hold on every machine  */
	struct diag_list doubts;   /* of the text: outputs without safe= (LD030) */
	struct diag_list here;     /* of this machine only                     */
};

/**
 * io_check_new - checks a text; @areas: of the program
 * @machine: NULL, or without lines: nothing is checked against this machine
 * @dev: folder of the device files; NULL: "/dev"
 * Owns: io_check_free().   Fails: NULL: no memory.
 */
struct io_check *io_check_new(const char *text, size_t len, const struct areas *areas,
			      const struct io_machine *machine, const char *dev);
void io_check_free(struct io_check *check);
/** io_check_at - the first message of a line (1-based): an error of the text, a doubt, one about
 * this machine; NULL: none. @warns: gets whether it is no error of the text. */
const struct diag *io_check_at(const struct io_check *check, int line, bool *warns);
/** io_check_has - whether a line without errors has a value at @addr, or at some bits of it. */
bool io_check_has(const struct io_check *check, struct iec_addr addr);
/** io_check_point - the first point of a line of the text; NULL: the line has errors, or is no point. */
const struct io_placed *io_check_point(const struct io_check *check, int line);

#endif
