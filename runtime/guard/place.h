/* SPDX-License-Identifier: MIT
 *
 * place - which device a file of the kernel belongs to, so that it is found again when its device has another number:
 * iio:device0, pwmchip0 and hwmon0 are numbered in the order in which they come, and a device that comes back gets a
 * free number. Its old number may then be that of another device, which must not be written.
 *
 * All texts of all files lie in one room, each text once: many outputs are of few devices.
 */
#ifndef GUARD_PLACE_H
#define GUARD_PLACE_H

#include "guard/say.h"

#include <stdbool.h>

#define PLACES      64
#define PLACE_TEXT  6144 /* bytes of all texts                              */
#define PLACE_WHERE 256
#define PLACE_NAME  64
#define PLACE_NONE  UINT16_MAX

/* A device. Its texts are places in struct places. */
struct place {
	uint16_t path;   /* of the entry when it was learned, as "/sys/class/pwm/pwmchip0" */
	uint16_t folder; /* bytes of it: "/sys/class/pwm"                   */
	uint16_t where;  /* folder that the entry is in as a device, as "/sys/devices/…/1-0040/pwm"; "": unknown */
	uint16_t name;   /* what its file "name" says; "": it has none      */
	bool several;    /* others of the folder have this name, so it alone tells nothing */
};

struct places {
	struct place place[PLACES];
	uint16_t count, bytes;
	char text[PLACE_TEXT]; /* begins with an empty one                  */
};

/* A file: its device, PLACE_NONE if it has none, and the rest of its path behind that of the device. */
struct place_file {
	uint16_t place, rest;
};

/** places_reset - forgets all that is behind @count devices and @bytes of text. */
void places_reset(struct places *places, uint16_t count, uint16_t bytes);
/**
 * places_learn - while the device of @path is there
 * @from: devices before this one were learned earlier, and may have another number now
 * Fails: false, there is no room.
 */
bool places_learn(struct places *places, uint16_t from, const char *path, struct place_file *out);
/** places_path - the path as it was learned. */
void places_path(const struct places *places, const struct place_file *file, char out[GUARD_PATH]);
/**
 * places_find - the path of the same file of the same device now
 * It is the device at the same place with the same name, or else the only one with this name, if no other one had it
 * when the place was learned.
 * Returns 0 or -errno: -ENODEV if the device is not there.
 */
int places_find(const struct places *places, const struct place_file *file, char out[GUARD_PATH]);
#endif
