/* SPDX-License-Identifier: MIT
 *
 * board - the make-believe board that `ladder run` drives: lamps and switches.
 *
 * With an I/O map all its lines are simulated ones (driver sim), so inversion,
 * debounce and safe values are those of the real board. Without one, switches
 * act on the inputs at once. It draws nothing and waits for nothing.
 */
#ifndef LADDER_BOARD_H
#define LADDER_BOARD_H

#include "ladder/report.h"

#include "hal/hal.h"

struct lamp {
	const char *name;      /* as declared, or the address                */
	const char *line;      /* of the I/O map, or ""                      */
	char address[16];      /* "%IX0.3"                                   */
	struct location at;
	bool wanted;           /* inputs: what the switch says               */
};

struct moving {
	const char *name;
	struct location at;
	union iec_value last;  /* of a STRING its own copy                   */
	bool moved;            /* since the start                            */
};
/** moving_update - keeps @value as the last one; true if it differs. */
bool moving_update(struct moving *moving, union iec_value value);

struct lamps {
	struct lamp *lamp;
	int count;
};

struct board {
	struct resource *resource;
	struct plant *plant;   /* or NULL                                     */
	struct arena arena;
	bool mapped;
	struct iomap map;
	struct hal hal;
	struct lamps input, output;
	struct moving *moving; /* every other variable, but for input pins   */
	int moving_count;
};

/**
 * board_open - lamps and switches of a program
 * @map: path of an I/O map, or NULL
 * Owns: board_close(), always.   Fails: a status after diagnostics.
 */
enum status board_open(struct board *board, struct machine *machine,
		       const char *map);
void board_close(struct board *board);

/** board_start - cold start; switches stay. */
void board_start(struct board *board);
/** board_set - a variable; a switch if it is an input. */
void board_set(struct board *board, struct location at, union iec_value value);
/** board_is_on - what a lamp shows: in a FAULT outputs have their safe values. */
bool board_is_on(const struct board *board, const struct lamp *lamp);
/** board_toggle - switch number @index. */
void board_toggle(struct board *board, int index);
/** board_scan - inputs, one scan, outputs. False: the program is in FAULT. */
bool board_scan(struct board *board, int64_t now_ns);
#endif
