/* SPDX-License-Identifier: MIT
 *
 * picture - the lines of this machine as they are now, for `ladder io`: as
 * `gpioinfo` has them, with the addresses of a map and the names of a program.
 *
 * It takes no line. It is read anew as a whole each time.
 */
#ifndef LADDER_PICTURE_H
#define LADDER_PICTURE_H

#include "ladder/levels.h"
#include "ladder/report.h"

#include "hal/drivers.h"

struct picture_line {
	const char *chip, *label, *name, *owner;
	uint32_t offset;
	bool used, output, active_low;
	enum io_bias bias;
	enum level level;
};

struct picture {
	const struct iomap *map;        /* NULL: all lines                   */
	const struct program *program;  /* NULL: no names                    */
	struct arena arena;
	struct picture_line *line;
	int count;
	bool levels;                    /* the kernel tells them             */
};

/** picture_take - how it is now. Owns: picture_free(), always.
 * Fails: false and diagnostics; what could be seen is there. */
bool picture_take(struct picture *picture, struct diag_list *diags);
void picture_free(struct picture *picture);

/** picture_rows - points of the map, or lines of the machine. */
int picture_rows(const struct picture *picture);
/** picture_head, picture_row - text of a table, without a newline. */
void picture_head(const struct picture *picture, const struct sink *out);
void picture_row(const struct picture *picture, int row,
		 const struct sink *out);
/** picture_json - an object of one row. */
void picture_json(const struct picture *picture, int row,
		  const struct sink *out);
/** picture_is_whole - does the machine have every line of the map? */
bool picture_is_whole(const struct picture *picture);

/** picture_live - in the terminal, until q or a signal. */
enum status picture_live(struct call *call, struct picture *picture);
#endif
