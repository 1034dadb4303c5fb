/* SPDX-License-Identifier: MIT
 *
 * w1 - temperatures on a 1-wire bus, in °C. A measurement of a DS18B20 takes 0.75 s.
 *
 * A newer kernel has the file `temperature`, each has `w1_slave` with the bytes and their check. A sensor that
 * has lost its power shows 85 °C until it measures, so that is no measurement unless the one before was near.
 */
#include "hal/device.h"
#include "hal/sysfs.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define POWER_ON 85000 /* thousandths of a degree */
#define NEAR      2000

static bool known_sensor(void *context, const char *name)
{
	char *known = context;

	if (strchr(name, '-')) /* not w1_bus_master1 */
		device_known(known, LIMIT_ARG, name);
	return true;
}

static bool w1_find(struct device_search *search, const struct io_point *point, struct device *out,
		    struct trouble *why)
{
	char devices[DEVICE_PATH], folder[DEVICE_PATH], known[LIMIT_ARG] = "";
	const char *sensor = point->channel->device;

	if (!sysfs_path(devices, sizeof(devices), search->sys, "bus/w1/devices", "") || strchr(sensor, '/') ||
	    !sysfs_path(folder, sizeof(folder), devices, sensor, "") || access(folder, F_OK) != 0) {
		sysfs_each(devices, known_sensor, known);
		return trouble_set(why, DIAG_IO_NO_DEVICE, "%.30s" DIAG_AND "%.30s", sensor, known);
	}
	if (point->output)
		return trouble_set(why, DIAG_IO_ONLY_INPUT, "%s", sensor);
	out->home = (uint32_t)strlen(folder);
	out->scale = 0.001;
	out->offset = 0;
	if ((sysfs_path(out->path, sizeof(out->path), folder, "temperature", "") &&
	     access(out->path, F_OK) == 0) ||
	    (sysfs_path(out->path, sizeof(out->path), folder, "w1_slave", "") &&
	     access(out->path, F_OK) == 0))
		return access(out->path, R_OK) == 0 || device_denied(why, sensor, out->path);
	return trouble_set(why, DIAG_IO_NO_CHANNEL, "%.30s" DIAG_AND "temperature", sensor);
}

/* "2b 00 4b 46 ff ff 0d 10 a1 : crc=a1 YES\n2b 00 … t=21437", or "21437". */
static bool w1_parse(const struct device *device, const char *text, double *number)
{
	const char *at = strstr(text, "t=");

	if (strstr(text, "crc=")) {
		if (!strstr(text, "YES") || !at)
			return false;
		text = at + 2;
	}
	if (!sysfs_number(text, number))
		return false;
	return *number != POWER_ON ||
	       (device->has_last && device->last > POWER_ON - NEAR && device->last < POWER_ON + NEAR);
}

struct sensor_list {
	struct device_search *search;
	device_visit *visit;
	void *context;
};

static bool see_sensor(void *context, const char *name)
{
	const struct sensor_list *list = context;
	const struct io_channel channel = { .device = name };
	const struct io_point point = { .channel = &channel };
	struct device_seen seen = {
		.driver = DRIVER_w1, .device = name, .label = "", .channel = "",
		.unit = UNIT_CELSIUS, .problem = "",
	};
	struct device device = { .scale = 1 };
	struct trouble why;
	char text[SYSFS_TEXT];
	double number;
	bool answers;

	if (!strchr(name, '-') || !w1_find(list->search, &point, &device, &why))
		return true;
	answers = sysfs_read(device.path, text, sizeof(text)) == 0;
	seen.has_value = answers && w1_parse(&device, text, &number);
	if (seen.has_value)
		seen.value = number * device.scale;
	else
		seen.problem = answers ? "no valid measurement" : "it does not answer";
	list->visit(list->context, &seen);
	return true;
}

void w1_list(struct device_search *search, device_visit *visit, void *context)
{
	struct sensor_list list = { search, visit, context };
	char devices[DEVICE_PATH];

	if (sysfs_path(devices, sizeof(devices), search->sys, "bus/w1/devices", ""))
		sysfs_each(devices, see_sensor, &list);
}

const struct device_driver device_w1 = { .find = w1_find, .parse = w1_parse };
