/* SPDX-License-Identifier: MIT
 *
 * picture - the present state of the lines of this machine, for `ladder io`: what
 * `gpioinfo` shows, with the addresses of a map and the names of a program.
 *
 * It requests no line. Each picture_take() reads all lines again.
 */
#ifndef LADDER_PICTURE_H
#define LADDER_PICTURE_H

#include "ladder/report.h"

#include "hal/drivers.h"

enum level { LEVEL_UNKNOWN, LEVEL_LOW, LEVEL_HIGH };

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
	bool levels;                    /* could be read                     */
};

/** picture_take - reads the state of all lines. Owns: picture_free(), always.
 * Fails: false and diagnostics; lines of readable chips are there. */
bool picture_take(struct picture *picture, struct diag_list *diags);
void picture_free(struct picture *picture);

/** picture_rows - number of points of the map, or of lines of the machine. */
int picture_rows(const struct picture *picture);
/** picture_head, picture_row - text of a table, without a newline. */
void picture_head(const struct picture *picture, const struct sink *out);
void picture_row(const struct picture *picture, int row,
		 const struct sink *out);
/** picture_json - a row as a JSON object. */
void picture_json(const struct picture *picture, int row,
		  const struct sink *out);
/** picture_is_whole - does the machine have every line of the map? */
bool picture_is_whole(const struct picture *picture);

/** picture_live - shows the table in the terminal until q or a signal. */
enum status picture_live(struct call *call, struct picture *picture);
#endif
