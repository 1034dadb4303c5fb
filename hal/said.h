/* SPDX-License-Identifier: MIT
 *
 * said - how good inputs are, as the lines of the driver `quality` of a map tell a program.
 *
 * Where no device is, in a simulation and in `ladder trace`, a person or a script sets these inputs as others,
 * and so makes the values bad that they are about. It changes no value.
 */
#ifndef HAL_SAID_H
#define HAL_SAID_H

#include "engine/scan/image.h"
#include "hal/hal.h"

struct io_said {
	uint32_t first, count;  /* bits of the process image that it is about   */
	struct iec_addr addr;   /* of what tells it                             */
	enum iec_type type;
};

/** io_said_list - what tells quality in a map, at most @most. @areas: of the program, which contain all points
 * (iomap_fits()). Returns how many there are, also those that found no room in @out. Scan-safe: no. */
int io_said_list(const struct iomap *map, const struct areas *areas, struct io_said *out, int most);
/** io_said_quality - of the value at @at, as @said has it: the worst of all that are about it. Between scans.
 * Scan-safe: yes. */
enum hal_quality io_said_quality(const struct io_said *said, int count, const struct image *image,
				 struct location at);
#endif
