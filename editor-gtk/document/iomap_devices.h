/* SPDX-License-Identifier: MIT
 *
 * iomap_devices - the analog devices of this machine, to choose from in an I/O map.
 *
 * Looking reads each sensor, which may take seconds: a thread does it.
 */
#ifndef EDITOR_IOMAP_DEVICES_H
#define EDITOR_IOMAP_DEVICES_H

#include "engine/base/arena.h"

#include <stdbool.h>

/* A channel of a device. Texts live in the arena. */
struct io_device {
	const char *driver;    /* "iio"                                        */
	const char *device;    /* as in device=, chip=, sensor=                */
	const char *channel;   /* as in channel=; "": it has only one          */
	const char *about;     /* "ads1115 1.25 V", "28-… : no answer"         */
	bool output;
};

struct io_devices {
	struct arena arena;
	struct io_device *device;
	int count;
};

/** io_devices_look - lists them. @sys: NULL: "/sys". May wait for sensors. Any thread. Owns:
 * io_devices_free(). */
void io_devices_look(struct io_devices *out, const char *sys);
void io_devices_free(struct io_devices *devices);

#endif
