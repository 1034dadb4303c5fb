/* SPDX-License-Identifier: MIT
 *
 * gpio - the common part of the three gpio drivers; only they include it.
 *
 * gpiod_v1.c, gpiod_v2.c and gpio_uapi.c each implement access to chips and lines.
 * gpio_find.c finds lines with it.
 */
#ifndef HAL_GPIO_H
#define HAL_GPIO_H

#include "hal/drivers.h"

#define GPIO_OWNER "ladderd" /* consumer of our lines, as others see it    */
#define GPIO_GUARD "ladder-guard" /* gives the line back when ladderd asks */
#define GPIO_TEXT  40        /* names of the kernel have at most 31 bytes  */

struct gpio_chip {
	void *chip;              /* of libgpiod                            */
	int fd;                  /* of the uAPI                            */
	char label[GPIO_TEXT];
	uint32_t lines;
};

struct gpio_line {
	char name[GPIO_TEXT];    /* "": none                               */
	char owner[GPIO_TEXT];   /* "": none, or one without a name        */
	bool used, output, active_low;
	enum io_bias bias;       /* BIAS_AS_IS: the kernel does not say    */
};

/* Implemented by each driver. Return 0 or -errno.  Scan-safe: no. */
int gpio_chip_open(const char *path, struct gpio_chip *out);
void gpio_chip_close(struct gpio_chip *chip);
int gpio_chip_line(struct gpio_chip *chip, uint32_t offset,
		   struct gpio_line *out);

/* Implemented in gpio_find.c. */
bool gpio_find(const struct io_point *point, const char *dev,
	       struct line_at *out, struct trouble *why);
bool gpio_list(const char *dev,
	       void (*visit)(void *context, const struct line_seen *line),
	       void *context, struct trouble *why);
/**
 * gpio_take - opens the chip of a request and requests its lines with @take
 * @take: returns 0 or -errno
 * @kept: gets the open chip; NULL: the chip is closed
 * Fails: false, @why names the chip, or the line that is in use; nothing is open.
 */
bool gpio_take(struct request *request, struct trouble *why,
	       int (*take)(struct request *request, const struct gpio_chip *chip),
	       struct gpio_chip *kept);
/** gpio_text - copies a text of any length, or NULL, to GPIO_TEXT bytes. */
void gpio_text(char *out, const char *text);
#endif
