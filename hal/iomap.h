/* SPDX-License-Identifier: MIT
 *
 * iomap - the text that says which pin an address of a program is.
 *
 * It reads a `.io` file and checks all that can be checked without the machine:
 * every error with line and column, and no half map on an error. It opens no
 * chip and does not know whether a line exists. docs/boards.md describes the
 * text.
 */
#ifndef HAL_IOMAP_H
#define HAL_IOMAP_H

#include "engine/base/areas.h"
#include "engine/base/arena.h"
#include "engine/base/diag.h"

enum driver_id {
#define DRIVER(id, doc) DRIVER_##id,
#include "hal/drivers.def"
	DRIVER_COUNT
};

enum io_bias { BIAS_AS_IS, BIAS_NONE, BIAS_UP, BIAS_DOWN };
enum io_drive { DRIVE_AS_IS, DRIVE_PUSH_PULL, DRIVE_OPEN_DRAIN,
		DRIVE_OPEN_SOURCE };

/* One line of the map. Strings live in the arena that the map was read into. */
struct io_point {
	struct iec_addr addr;  /* one bit of AREA_I or AREA_Q                 */
	enum driver_id driver;
	bool output;
	const char *line;      /* kernel's name of the line, or NULL          */
	const char *chip;      /* label, gpiochipN or its path, or NULL       */
	uint32_t offset;       /* with chip                                   */
	enum io_bias bias;
	enum io_drive drive;
	bool active_low;       /* TRUE is the low level                       */
	bool safe;             /* value of an output while nothing runs, as a
				  program would write it                      */
	int64_t debounce_ns;   /* of inputs                                   */
	int text_line, text_column; /* 1-based, in the file                   */
};

struct iomap {
	const char *file;      /* as the user wrote it; borrowed              */
	const char *board;     /* "Raspberry Pi 4"                            */
	const char *dev;       /* folder of device files; tests change it     */
	struct io_point *point;
	int count;
};

#define IO_DEBOUNCE_MAX_NS 10000000000 /* 10 s */
#define IO_OFFSET_MAX      65535

/**
 * iomap_read - the map that @text spells
 * @arena: strings and points live in it
 * @file:  names the file in diagnostics; must outlive @diags and @map
 *
 * Owns: the arena.   Scan-safe: no.
 * Fails: false with at least one error in @diags; @map is then empty.
 */
bool iomap_read(struct iomap *map, struct arena *arena, const char *file,
		const char *text, size_t len, struct diag_list *diags);

/**
 * iomap_fits - is every point inside the areas of a program?
 *
 * Whoever moves levels between a map and a process image asks first.
 * Owns: nothing.   Scan-safe: no.   Fails: false and an error for each point that is not.
 */
bool iomap_fits(const struct iomap *map, const struct areas *areas,
		struct diag_list *diags);

/** io_place - the place of a point in its file, for diag_add. */
struct diag io_place(const struct iomap *map, const struct io_point *point,
		     enum diag_id id);
/** io_line_print - "GPIO17" or "pinctrl-bcm2711 17"; as snprintf. */
int io_line_print(const struct io_point *point, char *out, size_t size);
#endif
