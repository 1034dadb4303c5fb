/* SPDX-License-Identifier: MIT
 *
 * machine - a line of a chip or a channel of a device that a board has, as the service `devices` tells it.
 *
 * It says what is there, whether or not the I/O map names it.
 */
#ifndef ONLINE_MACHINE_H
#define ONLINE_MACHINE_H

#include "online/service.h"

#define MACHINE_TEXT 96 /* bytes of each text, with its NUL                   */

enum machine_flag { MACHINE_OUTPUT = 1, MACHINE_USED = 2, MACHINE_VALUE = 4 };

struct machine_row {
	char driver[16];             /* "gpio", "iio", "pwm", "w1", "hwmon"    */
	char device[MACHINE_TEXT];   /* gpio: "gpiochip0"; else as in device=, chip=, sensor= */
	char label[MACHINE_TEXT];    /* of the chip; another name of the device; "" */
	char channel[MACHINE_TEXT];  /* gpio: the name of the line; else as in channel=; "" */
	char about[MACHINE_TEXT];    /* gpio: who uses it; else why it has no value; "" */
	char unit[8];                /* "V"; ""                                */
	uint32_t offset;             /* of a line                              */
	uint8_t flags;               /* of enum machine_flag                   */
	double value;
};
#define MACHINE_BYTES 512      /* of a row on the wire, at most              */

/** machine_put - texts are cut at whole letters. Scan-safe: yes; so is machine_take(). */
void machine_put(struct wire_writer *out, const struct machine_row *row);
/** machine_take - texts are cut and end with NUL. Fails: the reader has failed. */
void machine_take(struct wire_reader *in, struct machine_row *row);
#endif
