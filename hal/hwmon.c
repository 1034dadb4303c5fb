/* SPDX-License-Identifier: MIT
 *
 * hwmon - sensors of the kernel: temperatures in °C, voltages in V, currents in A, and fans by their pulse width
 * in percent. A device is named by its file `name`, or as in /sys/class/hwmon.
 */
#include "hal/device.h"
#include "hal/sysfs.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* What the channels of a kind measure (Linux, hwmon/sysfs-interface). */
struct kind {
	const char *word;        /* of "temp1"                                */
	const char *end;         /* of its file                               */
	double scale;
	enum io_unit unit;
};
static const struct kind kinds[] = {
	{ "temp",     "_input", 0.001,        UNIT_CELSIUS },
	{ "in",       "_input", 0.001,        UNIT_VOLT },
	{ "curr",     "_input", 0.001,        UNIT_AMPERE },
	{ "humidity", "_input", 0.001,        UNIT_PERCENT },
	{ "power",    "_input", 0.000001,     UNIT_NONE },
	{ "fan",      "_input", 1,            UNIT_NONE },
	{ "pwm",      "",       100.0 / 255,  UNIT_PERCENT },
};
#define KINDS (sizeof(kinds) / sizeof(kinds[0]))

/* "temp12" with @rest "_input"; NULL: none. */
static const struct kind *kind_of(const char *channel, const char *rest)
{
	for (size_t i = 0; i < KINDS; i++) {
		const size_t len = strlen(kinds[i].word);
		const char *at = channel + len;

		if (strncmp(channel, kinds[i].word, len) != 0 || *at < '0' || *at > '9')
			continue;
		while (*at >= '0' && *at <= '9')
			at++;
		if (strcmp(at, rest ? kinds[i].end : "") == 0)
			return &kinds[i];
	}
	return NULL;
}

struct hwmon_search {
	const char *class, *wanted;
	char found[32], known[LIMIT_ARG], twice[LIMIT_ARG];
	int count;
};

static bool match_device(void *context, const char *name)
{
	struct hwmon_search *search = context;
	char path[DEVICE_PATH], device[SYSFS_TEXT];

	if (!sysfs_path(path, sizeof(path), search->class, name, "/name") ||
	    sysfs_read(path, device, sizeof(device)) != 0)
		return true;
	device_known(search->known, sizeof(search->known), device);
	if (strcmp(search->wanted, name) != 0 && strcmp(search->wanted, device) != 0)
		return true;
	device_known(search->twice, sizeof(search->twice), name);
	snprintf(search->found, sizeof(search->found), "%s", name);
	search->count++;
	return true;
}

static bool hwmon_find(struct device_search *search, const struct io_point *point, struct device *out,
		       struct trouble *why)
{
	const struct io_channel *channel = point->channel;
	const struct kind *kind = kind_of(channel->name, NULL);
	char class[DEVICE_PATH], folder[DEVICE_PATH];
	struct hwmon_search devices = { .class = class, .wanted = channel->device };

	sysfs_path(class, sizeof(class), search->sys, "class/hwmon", "");
	sysfs_each(class, match_device, &devices);
	if (!devices.count)
		return trouble_set(why, DIAG_IO_NO_DEVICE, "%.30s" DIAG_AND "%.30s", channel->device,
				   devices.known);
	if (devices.count > 1)
		return trouble_set(why, DIAG_IO_DEVICE_TWICE, "%.30s" DIAG_AND "%.30s", channel->device,
				   devices.twice);
	if (!sysfs_path(folder, sizeof(folder), class, devices.found, "") || !kind ||
	    !sysfs_path(out->path, sizeof(out->path), folder, channel->name, kind->end) ||
	    access(out->path, F_OK) != 0)
		return trouble_set(why, DIAG_IO_NO_CHANNEL, "%.30s" DIAG_AND "%.30s", channel->device,
				   channel->name);
	if (point->output && *kind->end)
		return trouble_set(why, DIAG_IO_ONLY_INPUT, "%.30s %.30s", channel->device,
				   channel->name);
	if (access(out->path, point->output ? W_OK : R_OK) != 0)
		return device_denied(why, channel->device, out->path);
	out->home = (uint32_t)strlen(folder);
	out->scale = kind->scale;
	out->offset = 0;
	out->most = 255;
	return true;
}

/* A fan that the chip controls by itself takes no number. */
static bool hwmon_take(const struct device *device, const struct io_point *point, int64_t number,
		       struct trouble *why)
{
	char path[DEVICE_PATH];
	int error;

	(void)number;
	if (!sysfs_path(path, sizeof(path), device->path, "", "_enable") || access(path, F_OK) != 0)
		return true;
	error = sysfs_write(path, "1");
	return !error || trouble_set(why, DIAG_IO_DEVICE_REFUSED, "%.24s %.16s_enable" DIAG_AND "%s",
				     point->channel->device, point->channel->name, strerror(-error));
}

static bool hwmon_parse(const struct device *device, const char *text, double *number)
{
	(void)device;
	return sysfs_number(text, number);
}

struct hwmon_list {
	const char *class;
	const char *name, *device; /* of one                                 */
	device_visit *visit;
	void *context;
};

static bool see_channel(void *context, const char *name)
{
	const struct hwmon_list *list = context;
	const struct kind *kind = kind_of(name, name);
	char channel[32], path[DEVICE_PATH], folder[DEVICE_PATH];
	struct device_seen seen = {
		.driver = DRIVER_hwmon, .device = list->device, .label = list->name, .channel = channel,
		.problem = "",
	};
	double number;

	if (!kind)
		return true;
	snprintf(channel, sizeof(channel), "%.*s", (int)(strlen(name) - strlen(kind->end)), name);
	seen.output = !*kind->end;
	seen.unit = kind->unit;
	seen.has_value = sysfs_path(folder, sizeof(folder), list->class, list->name, "") &&
			 sysfs_path(path, sizeof(path), folder, name, "") &&
			 sysfs_read_number(path, &number);
	if (seen.has_value)
		seen.value = number * kind->scale;
	list->visit(list->context, &seen);
	return true;
}

static bool see_device(void *context, const char *name)
{
	struct hwmon_list list = *(const struct hwmon_list *)context;
	char path[DEVICE_PATH], device[SYSFS_TEXT];

	if (!sysfs_path(path, sizeof(path), list.class, name, "/name") ||
	    sysfs_read(path, device, sizeof(device)) != 0)
		return true;
	list.name = name;
	list.device = device;
	if (sysfs_path(path, sizeof(path), list.class, name, ""))
		sysfs_each(path, see_channel, &list);
	return true;
}

void hwmon_list(struct device_search *search, device_visit *visit, void *context)
{
	char class[DEVICE_PATH];
	struct hwmon_list list = { .class = class, .visit = visit, .context = context };

	if (sysfs_path(class, sizeof(class), search->sys, "class/hwmon", ""))
		sysfs_each(class, see_device, &list);
}

const struct device_driver device_hwmon = {
	.find = hwmon_find, .take = hwmon_take, .parse = hwmon_parse,
};
