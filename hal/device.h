/* SPDX-License-Identifier: MIT
 *
 * device - the interface of the drivers whose values are numbers in files of the kernel.
 *
 * A driver finds the file of a point and knows its unit. The engine (hal/channels_run.c) opens, reads and
 * writes the file, in threads; channels_safe() also in a signal handler. Private to the HAL.
 */
#ifndef HAL_DEVICE_H
#define HAL_DEVICE_H

#include "hal/channels.h"
#include "hal/drivers.h"

#define DEVICE_PATH 168

/* Where the value of a point is on this machine, now. */
struct device {
	char path[DEVICE_PATH];  /* of the file of its value                 */
	uint32_t home;           /* bytes of `path` that name the device     */
	double scale, offset;    /* value = (number in the file + offset) * scale */
	int64_t most;            /* largest number of an output; 0 is the least, unless signs are allowed */
	bool negative;
	/* For a driver that tells a wrong number by the one before. */
	double last;
	bool has_last;
};

/* A search, so that the devices of a library are listed once for all points. */
struct device_search {
	const char *sys;         /* "/sys"                                   */
	void *context;           /* of the driver iio                        */
};

struct device_driver {
	/** find - the device of a point. Fails: false, @why. Scan-safe: no. */
	bool (*find)(struct device_search *search, const struct io_point *point,
		     struct device *out, struct trouble *why);
	/** end - after a search; NULL: nothing to do. */
	void (*end)(struct device_search *search);
	/** take - makes an output ready; it gets @number with the first level that it shows. NULL: nothing to
	 * do. Fails: false, @why. Scan-safe: no. */
	bool (*take)(const struct device *device, const struct io_point *point, int64_t number,
		     struct trouble *why);
	/** parse - the number in the text of the file. Fails: false: it is no valid measurement. */
	bool (*parse)(const struct device *device, const char *text, double *number);
};

/** device_driver - NULL: another program serves its points. Static. */
const struct device_driver *device_driver(enum driver_id id);

extern const struct device_driver device_iio, device_pwm, device_w1, device_hwmon;

/* Each channel of this machine, for channels_list(). Not in the table above, because ladderd lists none. */
void iio_list(struct device_search *search, device_visit *visit, void *context);
void pwm_list(struct device_search *search, device_visit *visit, void *context);
void w1_list(struct device_search *search, device_visit *visit, void *context);
void hwmon_list(struct device_search *search, device_visit *visit, void *context);

/** device_denied - LD551 with the group of the file; false. */
bool device_denied(struct trouble *why, const char *name, const char *path);
/** device_known - adds @name to a list in @out, for messages: "a, b, ...". */
void device_known(char *out, size_t size, const char *name);
#endif
