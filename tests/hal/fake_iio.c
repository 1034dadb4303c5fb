/* SPDX-License-Identifier: MIT
 *
 * fake_iio - libiio's local context, as far as hal/iio_libiio.c calls it, of the folder FAKE_SYS.
 */
#define _GNU_SOURCE /* scandir, versionsort */
#include "hal/iio_calls.h"

#include <dirent.h>
#include <iio.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define MOST 16

struct iio_channel {
	const struct iio_device *device;
	char id[40];
	bool output;
	char file[3][80];        /* raw or input, scale, offset                */
};

struct iio_device {
	char id[40], name[40], label[40], folder[300];
	struct iio_channel channel[MOST];
	unsigned int count;
};

struct iio_context {
	struct iio_device device[MOST];
	unsigned int count;
};

/* For the test: how many are not destroyed. */
extern int fake_iio_contexts;
int fake_iio_contexts;
/* By the test: the library is not installed. */
extern bool fake_iio_missing;
bool fake_iio_missing;

static bool has(const struct iio_device *device, const char *file)
{
	char path[400];

	snprintf(path, sizeof(path), "%s/%s", device->folder, file);
	return access(path, F_OK) == 0;
}

static void take_text(const struct iio_device *device, const char *file, char *out, size_t size)
{
	char path[400];
	FILE *in;

	snprintf(path, sizeof(path), "%s/%s", device->folder, file);
	in = fopen(path, "r");
	if (!in)
		return;
	if (!fgets(out, (int)size, in))
		out[0] = '\0';
	fclose(in);
	out[strcspn(out, "\n")] = '\0';
}

/* Of the channel, or of all of its kind: in_voltage0_scale, in_voltage_scale. */
static void take_attribute(struct iio_channel *channel, int number, const char *name)
{
	const char *way = channel->output ? "out" : "in";
	const int kind = (int)strcspn(channel->id, "0123456789");

	snprintf(channel->file[number], 80, "%s_%s_%s", way, channel->id, name);
	if (!has(channel->device, channel->file[number]))
		snprintf(channel->file[number], 80, "%s_%.*s_%s", way, kind, channel->id, name);
	if (!has(channel->device, channel->file[number]))
		channel->file[number][0] = '\0';
}

static void add_channel(struct iio_device *device, const char *file)
{
	struct iio_channel *channel = &device->channel[device->count];
	const size_t len = strlen(file);
	const bool output = strncmp(file, "out_", 4) == 0;
	const size_t head = output ? 4 : 3, tail = strcmp(file + len - 4, "_raw") == 0 ? 4 : 6;

	if ((!output && strncmp(file, "in_", 3) != 0) || device->count == MOST ||
	    (tail == 6 && (len < 7 || strcmp(file + len - 6, "_input") != 0)))
		return;
	*channel = (struct iio_channel){ .device = device, .output = output };
	snprintf(channel->id, sizeof(channel->id), "%.*s", (int)(len - head - tail), file + head);
	snprintf(channel->file[0], 80, "%.79s", file);
	take_attribute(channel, 1, "scale");
	take_attribute(channel, 2, "offset");
	device->count++;
}

static void add_device(struct iio_context *context, const char *devices, const char *id)
{
	struct iio_device *device = &context->device[context->count];
	struct dirent **file;
	int count;

	if (id[0] == '.' || context->count == MOST)
		return;
	*device = (struct iio_device){ .count = 0 };
	snprintf(device->id, sizeof(device->id), "%.39s", id);
	snprintf(device->folder, sizeof(device->folder), "%s/%.60s", devices, id);
	take_text(device, "name", device->name, sizeof(device->name));
	take_text(device, "label", device->label, sizeof(device->label));
	count = scandir(device->folder, &file, NULL, versionsort);
	for (int i = 0; i < count; i++) {
		if (strlen(file[i]->d_name) > 4)
			add_channel(device, file[i]->d_name);
		free(file[i]);
	}
	if (count >= 0)
		free(file);
	context->count++;
}

struct iio_context *iio_create_local_context(void)
{
	struct iio_context *context = calloc(1, sizeof(*context));
	struct dirent **entry;
	const char *sys = getenv("FAKE_SYS");
	char devices[200];
	int count;

	if (!context)
		return NULL;
	snprintf(devices, sizeof(devices), "%.150s/bus/iio/devices", sys ? sys : "/sys");
	count = scandir(devices, &entry, NULL, versionsort);
	for (int i = 0; i < count; i++) {
		add_device(context, devices, entry[i]->d_name);
		free(entry[i]);
	}
	if (count >= 0)
		free(entry);
	__atomic_fetch_add(&fake_iio_contexts, 1, __ATOMIC_RELAXED);
	return context;
}

void iio_context_destroy(struct iio_context *context)
{
	__atomic_fetch_sub(&fake_iio_contexts, 1, __ATOMIC_RELAXED);
	free(context);
}

unsigned int iio_context_get_devices_count(const struct iio_context *context)
{
	return context->count;
}

struct iio_device *iio_context_get_device(const struct iio_context *context, unsigned int index)
{
	return (struct iio_device *)&context->device[index];
}

const char *iio_device_get_id(const struct iio_device *device)
{
	return device->id;
}

const char *iio_device_get_name(const struct iio_device *device)
{
	return device->name[0] ? device->name : NULL;
}

const char *iio_device_get_label(const struct iio_device *device)
{
	return device->label[0] ? device->label : NULL;
}

unsigned int iio_device_get_channels_count(const struct iio_device *device)
{
	return device->count;
}

struct iio_channel *iio_device_get_channel(const struct iio_device *device, unsigned int index)
{
	return (struct iio_channel *)&device->channel[index];
}

const char *iio_channel_get_id(const struct iio_channel *channel)
{
	return channel->id;
}

bool iio_channel_is_output(const struct iio_channel *channel)
{
	return channel->output;
}

const char *iio_channel_attr_get_filename(const struct iio_channel *channel, const char *attribute)
{
	const char *end = strrchr(channel->file[0], '_') + 1;
	const char *file = strcmp(attribute, end) == 0 ? channel->file[0] :
			   strcmp(attribute, "scale") == 0 ? channel->file[1] :
			   strcmp(attribute, "offset") == 0 ? channel->file[2] : "";

	return *file ? file : NULL;
}

bool iio_calls_find(struct iio_calls *out)
{
#define CALL(type, name, ...) out->name = iio_##name;
	IIO_CALLS(CALL)
#undef CALL
	return !fake_iio_missing;
}
