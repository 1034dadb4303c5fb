/* SPDX-License-Identifier: MIT
 *
 * drivers - what hal.c asks of a driver: four functions that move raw levels.
 *
 * A driver knows chips, offsets and requests. It does not know addresses,
 * inversion, debounce or safe values, and it prints nothing: hal.c has these
 * once for all drivers. One request is moved by one call, and that is one
 * system call.
 */
#ifndef HAL_DRIVERS_H
#define HAL_DRIVERS_H

#include "hal/iomap.h"

#define REQUEST_LINES 64 /* at most, in one request: a bit each of a uint64_t */

/* What is wrong with a line, from a driver that does not know the map's
 * text. */
struct trouble {
	enum diag_id id;
	uint32_t line;         /* index in the request it belongs to          */
	char text[LIMIT_ARG];  /* argument of the diagnostic                  */
};
/** trouble_set - fills @why; returns false, so that `return trouble_set(…)`. */
bool trouble_set(struct trouble *why, enum diag_id id, const char *format, ...)
	__attribute__((format(printf, 3, 4)));

/* Where a line is on this machine, now. */
struct line_at {
	int chip;              /* N of gpiochipN; negative: no chip           */
	uint32_t offset;
};

struct request_line {
	const struct io_point *point;
	struct line_at at;
};

/* A chip, a direction (and with libgpiod 1.6 one set of flags). */
struct request {
	const struct driver *driver;
	const char *dev;           /* folder of the device files: "/dev"      */
	struct request_line *line; /* in the order of the bits of a level     */
	uint32_t count;            /* 1 … REQUEST_LINES                       */
	bool output;
	uint64_t first;            /* raw levels that outputs begin with      */
	void *state;               /* the driver's own, state_size bytes      */
};

/* One line of this machine, for a list. Lives during the call only. */
struct line_seen {
	const char *chip, *label;  /* "gpiochip0", "pinctrl-bcm2711"          */
	uint32_t offset;
	const char *name;          /* "" if the board's makers gave none      */
	const char *owner;         /* who uses it; "" if nobody               */
	bool used, output, active_low;
	enum io_bias bias;         /* BIAS_AS_IS: the kernel does not say     */
};

struct driver {
	const char *word, *doc;
	size_t state_size;     /* bytes that hal.c gives to every request     */
	bool needs_line;       /* a point must name a line or chip and offset */
	bool same_flags;       /* a request has one bias and drive            */

	/**
	 * open - takes the lines of a request; outputs begin with `first`
	 * Fails: false, @why; nothing is taken. NULL here: not built in.
	 * close gives them back; it is called once after each good open.
	 * Scan-safe: no.
	 */
	bool (*open)(struct request *request, struct trouble *why);
	void (*close)(struct request *request);
	/* All levels at once; 0 or -errno.  Scan-safe: yes; write also in a
	 * signal handler. */
	int (*read)(struct request *request, uint64_t *levels);
	int (*write)(struct request *request, uint64_t levels);

	/* Of drivers whose lines must be looked for; else NULL. Scan-safe:
	 * no. */
	bool (*find)(const struct io_point *point, const char *dev,
		     struct line_at *out, struct trouble *why);
	bool (*list)(const char *dev,
		     void (*visit)(void *context, const struct line_seen *line),
		     void *context, struct trouble *why);
};

#define DRIVER(id, doc) extern const struct driver driver_##id;
#include "hal/drivers.def"

/** driver_row - the driver of a point. Lives for ever. Scan-safe: yes. */
const struct driver *driver_row(enum driver_id id);
/** driver_find - DRIVER_COUNT: no driver of that name (any case). */
enum driver_id driver_find(const char *word, size_t len);
/** gpio_library, gpio_version - "libgpiod" and "1.6.3" or "none"; "uAPI" and "v2".
 * Live for ever. */
const char *gpio_library(void);
const char *gpio_version(void);
#endif
