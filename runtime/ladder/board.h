/* SPDX-License-Identifier: MIT
 *
 * board - the simulated board of `ladder run`: a switch for each input, a lamp for each
 * output.
 *
 * With an I/O map all lines use the driver sim, so inversion, debounce and safe values
 * are those of the real board. Without a map, a switch sets its input directly. It draws
 * nothing, reads no clock and opens no real line.
 */
#ifndef LADDER_BOARD_H
#define LADDER_BOARD_H

#include "ladder/report.h"

#include "hal/hal.h"

struct lamp {
	const char *name;      /* as declared; "": it has no name            */
	const char *line;      /* of the I/O map, or ""                      */
	char address[16];      /* "%IX0.3"                                   */
	struct location at;
	bool wanted;           /* inputs: position of the switch             */
};

/* A variable that is neither input nor output. */
struct moving {
	const char *name;
	struct location at;
	union iec_value last;  /* a STRING is copied                         */
	bool moved;            /* its value has changed since the start      */
};
/** moving_update - stores @value as the last one. Returns whether it differs. */
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
	struct moving *moving; /* all other variables except input pins      */
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

/** board_start - cold start; switches keep their positions. */
void board_start(struct board *board);
/** board_set - sets a variable; for an input, moves its switch. */
void board_set(struct board *board, struct location at, union iec_value value);
/** board_is_on - whether a lamp is lit; in a FAULT outputs have their safe values. */
bool board_is_on(const struct board *board, const struct lamp *lamp);
/** board_toggle - flips switch number @index. */
void board_toggle(struct board *board, int index);
/** board_scan - reads inputs, scans once, writes outputs. False: the program is in
 * FAULT. */
bool board_scan(struct board *board, int64_t now_ns);
#endif
