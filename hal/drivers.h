/* SPDX-License-Identifier: MIT
 *
 * drivers - the interface of a driver: four functions that move raw levels.
 *
 * A driver handles chips, offsets and requests. Addresses, inversion, debounce and safe
 * values belong to hal.c, once for all drivers. A driver prints nothing. One call moves one
 * request with one system call.
 */
#ifndef HAL_DRIVERS_H
#define HAL_DRIVERS_H

#include "hal/iomap.h"

#define REQUEST_LINES 64 /* at most, in one request: one bit of a uint64_t each */

/* An error of a driver, which does not know the place in the map. */
struct trouble {
	enum diag_id id;
	uint32_t line;         /* index in the request                        */
	char text[LIMIT_ARG];  /* argument of the diagnostic                  */
};
/** trouble_set - fills @why. Returns false, for `return trouble_set(…)`. */
bool trouble_set(struct trouble *why, enum diag_id id, const char *format, ...)
	__attribute__((format(printf, 3, 4)));

/* The present place of a line on this machine. */
struct line_at {
	int chip;              /* N of gpiochipN; negative: no chip           */
	uint32_t offset;
};

struct request_line {
	const struct io_point *point;
	struct line_at at;
};

/* Lines of one chip and one direction (with libgpiod 1.6 also of one set of flags). */
struct request {
	const struct driver *driver;
	const char *dev;           /* folder of the device files: "/dev"      */
	struct request_line *line; /* in the order of the bits of a level     */
	uint32_t count;            /* 1 … REQUEST_LINES                       */
	bool output;
	uint64_t first;            /* initial raw levels of outputs           */
	void *state;               /* state_size bytes for the driver         */
};

/* One line of this machine, for hal_list(). Valid during the call only. */
struct line_seen {
	const char *chip, *label;  /* "gpiochip0", "pinctrl-bcm2711"          */
	uint32_t offset;
	const char *name;          /* "": the device tree gives none          */
	const char *owner;         /* consumer; "": none                      */
	bool used, output, active_low;
	enum io_bias bias;         /* BIAS_AS_IS: the kernel does not say     */
};

struct driver {
	const char *word;      /* as in an I/O map                            */
	size_t state_size;     /* bytes of request->state                     */
	bool needs_line;       /* a point must name a line or chip and offset */
	bool same_flags;       /* a request has one bias and drive            */
	bool by_channel;       /* its points have channels (hal/channel.h), and none of the
				* functions below                             */

	/**
	 * open - requests the lines; outputs begin with `first`. NULL: not built in.
	 * close - releases them; called once after each successful open.
	 * Scan-safe: no.   Fails: false, @why; no line is requested.
	 */
	bool (*open)(struct request *request, struct trouble *why);
	void (*close)(struct request *request);
	/* Move all levels of a request. Return 0 or -errno.  Scan-safe: yes; write also
	 * in a signal handler. */
	int (*read)(struct request *request, uint64_t *levels);
	int (*write)(struct request *request, uint64_t levels);

	/* Find and list lines; NULL for drivers without named lines. Of a line in use, find
	 * gives the place and DIAG_IO_BUSY. Scan-safe: no. */
	bool (*find)(const struct io_point *point, const char *dev,
		     struct line_at *out, struct trouble *why);
	bool (*list)(const char *dev,
		     void (*visit)(void *context, const struct line_seen *line),
		     void *context, struct trouble *why);
};

#define DRIVER(id) extern const struct driver driver_##id;
#include "hal/drivers.def"

/** driver_row - the driver of a point. Static. Scan-safe: yes. */
const struct driver *driver_row(enum driver_id id);
/** driver_find - the driver of that name, in any case; DRIVER_COUNT: none. */
enum driver_id driver_find(const char *word, size_t len);
/** gpio_library, gpio_version - "libgpiod" and "1.6.3" or "none", or "uAPI" and "v2".
 * Static. */
const char *gpio_library(void);
const char *gpio_version(void);
#endif
