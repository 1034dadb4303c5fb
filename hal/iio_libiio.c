/* SPDX-License-Identifier: MIT
 *
 * iio - analog inputs and outputs of the kernel. libiio's local context finds devices and channels; the values
 * are then read from and written to their files, which a signal handler can do, too. Without a point of this
 * driver the library is not loaded.
 *
 * A device is named by its name, its label or its number: ads1115, tank, iio:device0. Values are in V, A and
 * °C: the kernel gives thousandths of them (Linux, ABI/testing/sysfs-bus-iio).
 */
#include "hal/device.h"
#include "hal/iio_calls.h"
#include "hal/sysfs.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct kind {
	const char *word;        /* a channel's id begins with it              */
	double scale;
	enum io_unit unit;
};
static const struct kind kinds[] = {
	{ "voltage", 0.001, UNIT_VOLT },       { "altvoltage", 0.001, UNIT_VOLT },
	{ "current", 0.001, UNIT_AMPERE },     { "temp", 0.001, UNIT_CELSIUS },
	{ "resistance", 1, UNIT_OHM },         { "humidityrelative", 0.001, UNIT_PERCENT },
};
#define KINDS (sizeof(kinds) / sizeof(kinds[0]))

static const struct kind *kind_of(const char *channel)
{
	static const struct kind other = { "", 1, UNIT_NONE };

	for (size_t i = 0; i < KINDS; i++)
		if (strncmp(channel, kinds[i].word, strlen(kinds[i].word)) == 0)
			return &kinds[i];
	return &other;
}

/* Of a search. */
struct library {
	struct iio_calls call;
	struct iio_context *context; /* NULL: it has failed                    */
	unsigned int count;          /* of devices                             */
};

/* NULL: it is not installed, or no memory. */
static const struct library *library_of(struct device_search *search)
{
	struct library *library = search->context;

	if (library)
		return library;
	library = calloc(1, sizeof(*library));
	if (library && !iio_calls_find(&library->call)) {
		free(library);
		return NULL;
	}
	search->context = library;
	if (!library)
		return NULL;
	library->context = library->call.create_local_context();
	if (library->context)
		library->count = library->call.context_get_devices_count(library->context);
	return library;
}

static void iio_end(struct device_search *search)
{
	struct library *library = search->context;

	if (library && library->context)
		library->call.context_destroy(library->context);
	free(library);
	search->context = NULL;
}

static const char *name_of(const struct iio_calls *call, const struct iio_device *device)
{
	const char *name = call->device_get_name(device);

	return name ? name : call->device_get_id(device);
}

static const char *label_of(const struct iio_calls *call, const struct iio_device *device)
{
	const char *label = call->device_get_label(device);

	return label ? label : "";
}

static bool is_named(const struct iio_calls *call, const struct iio_device *device, const char *name)
{
	return strcmp(call->device_get_id(device), name) == 0 || strcmp(name_of(call, device), name) == 0 ||
	       strcmp(label_of(call, device), name) == 0;
}

/* libiio also lists sensors of hwmon and triggers; these have no channels of their own here. */
static struct iio_device *device_at(const struct library *library, unsigned int i)
{
	struct iio_device *device = library->call.context_get_device(library->context, i);

	return strncmp(library->call.device_get_id(device), "iio:device", 10) == 0 ? device : NULL;
}

static struct iio_device *find_device(const struct library *library, const char *wanted,
				      struct trouble *why)
{
	const struct iio_calls *call = &library->call;
	char known[LIMIT_ARG] = "", twice[LIMIT_ARG] = "";
	struct iio_device *found = NULL;
	int matches = 0;

	for (unsigned int i = 0; i < library->count; i++) {
		struct iio_device *device = device_at(library, i);

		if (!device)
			continue;
		device_known(known, sizeof(known), *label_of(call, device) ? label_of(call, device) :
								     name_of(call, device));
		if (!is_named(call, device, wanted))
			continue;
		device_known(twice, sizeof(twice), call->device_get_id(device));
		found = device;
		matches++;
	}
	if (matches > 1)
		trouble_set(why, DIAG_IO_DEVICE_TWICE, "%.30s" DIAG_AND "%.30s", wanted, twice);
	else if (!matches)
		trouble_set(why, DIAG_IO_NO_DEVICE, "%.30s" DIAG_AND "%.30s", wanted, known);
	return matches == 1 ? found : NULL;
}

/* The file of an attribute of a channel; false: it has none. */
static bool file_of(const struct iio_calls *call, const struct iio_channel *channel, const char *attribute,
		    const char *folder, char *out, size_t size)
{
	const char *name = call->channel_attr_get_filename(channel, attribute);

	return name && sysfs_path(out, size, folder, name, "");
}

/* `raw` needs the scale, `input` has it already. */
static bool find_value(const struct iio_calls *call, const struct iio_channel *channel, const char *folder,
		       struct device *out)
{
	const struct kind *kind = kind_of(call->channel_get_id(channel));
	char path[DEVICE_PATH];
	double scale = 1;

	out->offset = 0;
	out->most = INT32_MAX;
	if (file_of(call, channel, "raw", folder, out->path, sizeof(out->path))) {
		if (file_of(call, channel, "scale", folder, path, sizeof(path)))
			sysfs_read_number(path, &scale);
		if (file_of(call, channel, "offset", folder, path, sizeof(path)))
			sysfs_read_number(path, &out->offset);
	} else if (!file_of(call, channel, "input", folder, out->path, sizeof(out->path))) {
		return false;
	}
	out->scale = (scale != 0 ? scale : 1) * kind->scale;
	return true;
}

static const struct iio_channel *find_channel(const struct iio_calls *call, const struct iio_device *device,
					      const char *folder, const struct io_point *point,
					      struct device *out, struct trouble *why)
{
	const struct io_channel *wanted = point->channel;
	const unsigned int count = call->device_get_channels_count(device);
	const struct iio_channel *other = NULL;
	char known[LIMIT_ARG] = "";

	for (unsigned int i = 0; i < count; i++) {
		const struct iio_channel *channel = call->device_get_channel(device, i);

		if (!find_value(call, channel, folder, out))
			continue;
		device_known(known, sizeof(known), call->channel_get_id(channel));
		if (strcmp(call->channel_get_id(channel), wanted->name) != 0)
			continue;
		if (call->channel_is_output(channel) == point->output)
			return channel;
		other = channel;
	}
	if (other)
		trouble_set(why, point->output ? DIAG_IO_ONLY_INPUT : DIAG_IO_ONLY_OUTPUT, "%.30s %.30s",
			    wanted->device, wanted->name);
	else
		trouble_set(why, DIAG_IO_NO_CHANNEL, "%.20s" DIAG_AND "%.16s" DIAG_AND "%.22s",
			    wanted->device, wanted->name, known);
	return NULL;
}

static bool iio_find(struct device_search *search, const struct io_point *point, struct device *out,
		     struct trouble *why)
{
	const char *wanted = point->channel->device;
	const struct library *library = library_of(search);
	const struct iio_device *device = library ? find_device(library, wanted, why) : NULL;
	char devices[DEVICE_PATH], folder[DEVICE_PATH];

	if (!library)
		return trouble_set(why, DIAG_IO_NO_LIBRARY, "%.30s", wanted);
	if (!device)
		return false;
	if (!sysfs_path(devices, sizeof(devices), search->sys, "bus/iio/devices", "") ||
	    !sysfs_path(folder, sizeof(folder), devices, library->call.device_get_id(device), ""))
		return trouble_set(why, DIAG_IO_NO_DEVICE, "%.30s", wanted);
	if (!find_channel(&library->call, device, folder, point, out, why))
		return false;
	out->home = (uint32_t)strlen(folder);
	if (access(out->path, point->output ? W_OK : R_OK) != 0)
		return device_denied(why, wanted, out->path);
	return true;
}

/* A converter that is powered down drives nothing. It gets the value first. */
static bool iio_take(const struct device *device, const struct io_point *point, int64_t number,
		     struct trouble *why)
{
	char path[DEVICE_PATH], text[24];
	const size_t len = strlen(device->path);
	int error = 0;

	sysfs_print(number, text);
	if (len < 4 || strcmp(device->path + len - 4, "_raw") != 0)
		return true;
	snprintf(path, sizeof(path), "%.*s_powerdown", (int)(len - 4), device->path);
	if (access(path, F_OK) != 0)
		return true;
	sysfs_write(device->path, text);
	error = sysfs_write(path, "0");
	return !error || trouble_set(why, DIAG_IO_DEVICE_REFUSED, "%.24s powerdown" DIAG_AND "%s",
				     point->channel->device, strerror(-error));
}

static bool iio_parse(const struct device *device, const char *text, double *number)
{
	(void)device;
	return sysfs_number(text, number);
}

static void see_device(const struct iio_calls *call, const struct iio_device *device, const char *folder,
		       device_visit *visit, void *context)
{
	const unsigned int count = call->device_get_channels_count(device);

	for (unsigned int i = 0; i < count; i++) {
		const struct iio_channel *channel = call->device_get_channel(device, i);
		struct device at = { .scale = 1 };
		struct device_seen seen = {
			.driver = DRIVER_iio, .device = name_of(call, device), .label = label_of(call, device),
			.channel = call->channel_get_id(channel), .output = call->channel_is_output(channel),
			.unit = kind_of(call->channel_get_id(channel))->unit, .problem = "",
		};
		double number;

		if (!find_value(call, channel, folder, &at))
			continue;
		seen.has_value = sysfs_read_number(at.path, &number);
		if (seen.has_value)
			seen.value = (number + at.offset) * at.scale;
		visit(context, &seen);
	}
}

void iio_list(struct device_search *search, device_visit *visit, void *context)
{
	const struct library *library = library_of(search);
	char folder[DEVICE_PATH], path[DEVICE_PATH];

	if (!library || !sysfs_path(folder, sizeof(folder), search->sys, "bus/iio/devices", ""))
		return;
	for (unsigned int i = 0; i < library->count; i++) {
		const struct iio_device *device = device_at(library, i);

		if (device && sysfs_path(path, sizeof(path), folder, library->call.device_get_id(device), ""))
			see_device(&library->call, device, path, visit, context);
	}
}

const struct device_driver device_iio = {
	.find = iio_find, .end = iio_end, .take = iio_take, .parse = iio_parse,
};
