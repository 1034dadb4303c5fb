/* SPDX-License-Identifier: MIT
 *
 * place - which device a file of the kernel belongs to, so that it is found again when its device has another number:
 * iio:device0, pwmchip0 and hwmon0 are numbered in the order in which they come, and a device that comes back gets a
 * free number. Its old number may then be that of another device, which must not be written.
 */
#ifndef GUARD_PLACE_H
#define GUARD_PLACE_H

#include "guard/say.h"

#include <stdbool.h>

#define PLACE_WHERE 256
#define PLACE_NAME  64

/* All 0: nothing is known of the device; its file is taken as it is. */
struct place {
	uint32_t folder;           /* bytes of the path: "/sys/class/pwm"; "pwmchip0" of it; 0: it has no such part */
	uint16_t entry;
	bool several;              /* others of the folder have this name, so it alone tells nothing */
	char where[PLACE_WHERE];   /* folder that the entry is in as a device, as "/sys/devices/…/1-0040/pwm"; "": unknown */
	char name[PLACE_NAME];     /* what its file "name" says; "": it has none */
};

/** place_learn - while the device of @path is there. */
void place_learn(struct place *place, const char *path);
/**
 * place_find - the path of the same file of the same device now
 * @path: as in place_learn()
 * It is the device at the same place with the same name, or else the only one with this name, if no other one had it
 * when the place was learned.
 * Returns 0 or -errno: -ENODEV if the device is not there.
 */
int place_find(const struct place *place, const char *path, char out[GUARD_PATH]);
#endif
