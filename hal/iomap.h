/* SPDX-License-Identifier: MIT
 *
 * iomap - the I/O map, a text that assigns a pin to each address (docs/boards.md).
 *
 * It reads a `.io` file and reports every error with line and column. It opens no chip and
 * does not know whether a line exists.
 */
#ifndef HAL_IOMAP_H
#define HAL_IOMAP_H

#include "engine/base/areas.h"
#include "engine/base/arena.h"
#include "engine/base/diag.h"

struct program;
struct io_channel; /* hal/channel.h */
struct io_net;

enum driver_id {
#define DRIVER(id) DRIVER_##id,
#include "hal/drivers.def"
	DRIVER_COUNT
};

enum io_bias { BIAS_AS_IS, BIAS_NONE, BIAS_UP, BIAS_DOWN };
enum io_drive { DRIVE_AS_IS, DRIVE_PUSH_PULL, DRIVE_OPEN_DRAIN,
		DRIVE_OPEN_SOURCE };

/* One line of the map. The arena owns the strings. */
struct io_point {
	struct iec_addr addr;  /* of an input or output; without channel: one bit of I or Q */
	enum driver_id driver;
	bool output;
	const char *line;      /* name of the line in the kernel, or NULL     */
	const char *chip;      /* label, gpiochipN or its path, or NULL       */
	uint32_t offset;       /* with chip                                   */
	enum io_bias bias;
	enum io_drive drive;
	bool active_low;       /* TRUE is the low level                       */
	bool safe;             /* value of an output while no program runs    */
	bool hold;             /* it keeps its last value instead             */
	bool has_safe;         /* the map says so                             */
	int64_t debounce_ns;   /* of inputs                                   */
	int text_line, text_column; /* 1-based, in the file                   */
	const struct io_channel *channel; /* NULL: one level of a chip        */
};

struct iomap {
	const char *file;      /* as the user wrote it; borrowed              */
	const char *board;     /* "Raspberry Pi 4"                            */
	const char *dev;       /* folder of device files: "/dev", except in tests */
	const char *sys;       /* of the kernel's files; NULL: "/sys", except in tests */
	struct io_point *point;
	int count;
	const struct io_net *net; /* buses and what others may ask of us; NULL: none */
};

#define IO_DEBOUNCE_MAX_NS 10000000000 /* 10 s */
#define IO_OFFSET_MAX      65535

/**
 * iomap_read - reads a map from @text
 * @arena: gets strings and points
 * @file:  names the file in diagnostics; must outlive @diags and @map
 *
 * Owns: the arena.   Scan-safe: no.
 * Fails: false with at least one error in @diags. @map has then the lines without an error: to check them further,
 * never to drive anything.
 */
bool iomap_read(struct iomap *map, struct arena *arena, const char *file,
		const char *text, size_t len, struct diag_list *diags);

/**
 * iomap_fits - checks that the areas of a program contain every point
 *
 * Call it before levels are moved between a map and a process image.
 * Owns: nothing.   Scan-safe: no.   Fails: false and an error for each point outside.
 */
bool iomap_fits(const struct iomap *map, const struct areas *areas,
		struct diag_list *diags);

/**
 * iomap_check_program - checks a map and a program against each other
 * @program: verified
 * @arena:   temporary memory
 *
 * As iomap_fits(). Also warns (LD515) about inputs and outputs that the program declares
 * or uses by address, of any area and width, without a line; a value of several bits
 * needs one line. And once about outputs of the map without safe= (LD030).
 * Owns: nothing.   Scan-safe: no.   Fails: false after an error.
 */
bool iomap_check_program(const struct iomap *map, const struct program *program,
			 struct arena *arena, struct diag_list *diags);

/** iomap_group_read - of "%IW100" or "%IW100..106": the first address, and how many bits all have
 * together; 0: what stands behind ".." is wrong. False: it is no address. */
bool iomap_group_read(const char *text, size_t len, struct iec_addr *addr, uint32_t *bits);
/** io_place - the place of a point in its file, for diag_add. */
struct diag io_place(const struct iomap *map, const struct io_point *point,
		     enum diag_id id);
/** io_line_print - prints "GPIO17" or "pinctrl-bcm2711 17", as snprintf(). */
int io_line_print(const struct io_point *point, char *out, size_t size);
#endif
