/* SPDX-License-Identifier: MIT
 *
 * pwm - pulse width by the kernel's files. The value is the part of the period in percent.
 *
 * A channel that is exported stays so, also after the end: its pin then shows the safe value. The chip is named
 * as in /sys/class/pwm (pwmchip0), or, which is the same after each start, by the folder of its device
 * (fe20c000.pwm, 1-0040), the name of the device (pca9685) or that of its driver (pca9685-pwm).
 */
#include "hal/device.h"
#include "hal/sysfs.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

struct chip_search {
	const char *class, *wanted;
	char found[64], known[LIMIT_ARG];
	int count;
};

/* The end of what a link of a chip leads to; "": there is none. */
static void link_name(const char *class, const char *chip, const char *link, char *out, size_t size)
{
	char path[DEVICE_PATH], to[DEVICE_PATH];
	const char *name;
	ssize_t len;

	out[0] = '\0';
	if (!sysfs_path(path, sizeof(path), class, chip, link))
		return;
	len = readlink(path, to, sizeof(to) - 1);
	if (len <= 0)
		return;
	to[len] = '\0';
	name = strrchr(to, '/');
	snprintf(out, size, "%.*s", (int)size - 1, name ? name + 1 : to);
}

/* The folder of the chip's device: …/fe20c000.pwm, …/i2c-1/1-0040. */
static void device_name(const char *class, const char *chip, char *out, size_t size)
{
	link_name(class, chip, "/device", out, size);
}

/* By the name of the chip, of its device's folder, of the device, or of its driver. */
static bool is_named(const char *class, const char *chip, const char *wanted)
{
	char path[DEVICE_PATH], name[SYSFS_TEXT];

	if (strcmp(chip, wanted) == 0)
		return true;
	device_name(class, chip, name, sizeof(name));
	if (strcmp(name, wanted) == 0)
		return true;
	link_name(class, chip, "/device/driver", name, sizeof(name));
	if (strcmp(name, wanted) == 0)
		return true;
	return sysfs_path(path, sizeof(path), class, chip, "/device/name") &&
	       sysfs_read(path, name, sizeof(name)) == 0 && strcmp(name, wanted) == 0;
}

static bool match_chip(void *context, const char *name)
{
	struct chip_search *search = context;
	char device[64];

	if (strncmp(name, "pwmchip", 7) != 0)
		return true;
	device_name(search->class, name, device, sizeof(device));
	device_known(search->known, sizeof(search->known), *device ? device : name);
	if (!is_named(search->class, name, search->wanted))
		return true;
	snprintf(search->found, sizeof(search->found), "%s", name);
	search->count++;
	return true;
}

static bool pwm_find(struct device_search *search, const struct io_point *point, struct device *out,
		     struct trouble *why)
{
	const struct io_channel *channel = point->channel;
	char class[DEVICE_PATH], chip[DEVICE_PATH], path[DEVICE_PATH];
	struct chip_search chips = { .class = class, .wanted = channel->device };
	double channels = 0;

	sysfs_path(class, sizeof(class), search->sys, "class/pwm", "");
	sysfs_each(class, match_chip, &chips);
	if (!chips.count)
		return trouble_set(why, DIAG_IO_NO_DEVICE, "%.30s" DIAG_AND "%s", channel->device,
				   chips.known);
	if (chips.count > 1)
		return trouble_set(why, DIAG_IO_DEVICE_TWICE, "%.30s", channel->device);
	if (!point->output)
		return trouble_set(why, DIAG_IO_ONLY_OUTPUT, "%s %u", channel->device,
				   (unsigned)channel->number);
	sysfs_path(chip, sizeof(chip), class, chips.found, "");
	sysfs_path(path, sizeof(path), chip, "npwm", "");
	sysfs_read_number(path, &channels);
	if (channel->number >= channels)
		return trouble_set(why, DIAG_IO_NO_CHANNEL, "%.30s" DIAG_AND "%u" DIAG_AND "%u",
				   channel->device, (unsigned)channel->number, (unsigned)channels);
	out->home = (uint32_t)strlen(chip);
	snprintf(path, sizeof(path), "pwm%u", (unsigned)channel->number);
	if (!sysfs_path(out->path, sizeof(out->path), chip, path, "/duty_cycle"))
		return trouble_set(why, DIAG_IO_NO_DEVICE, "%.30s", channel->device);
	out->scale = 100.0 / (double)channel->period_ns;
	out->offset = 0;
	out->most = channel->period_ns;
	sysfs_path(path, sizeof(path), chip, "export", "");
	if (access(out->path, F_OK) == 0 ? access(out->path, W_OK) != 0 : access(path, W_OK) != 0)
		return device_denied(why, channel->device, access(out->path, F_OK) == 0 ? out->path : path);
	return true;
}

static bool refused(struct trouble *why, const struct io_point *point, const char *file, int error)
{
	return trouble_set(why, DIAG_IO_DEVICE_REFUSED, "%.24s %s" DIAG_AND "%s", point->channel->device,
			   file, strerror(-error));
}

/* The rule of udev that gives the files to a group takes a moment. */
static bool await_file(const char *path)
{
	const struct timespec nap = { 0, 10000000 };

	for (int i = 0; i < 100; i++) {
		if (access(path, W_OK) == 0)
			return true;
		nanosleep(&nap, NULL);
	}
	return false;
}

static int export(const struct device *device, uint32_t number)
{
	char path[DEVICE_PATH + 8], text[24];

	if (access(device->path, F_OK) == 0)
		return 0;
	snprintf(path, sizeof(path), "%.*s/export", (int)device->home, device->path);
	sysfs_print(number, text);
	return sysfs_write(path, text);
}

static int set(const struct device *device, const char *name, const char *text)
{
	char path[DEVICE_PATH];
	const size_t folder = strlen(device->path) - strlen("duty_cycle");

	snprintf(path, sizeof(path), "%.*s%s", (int)folder, device->path, name);
	return sysfs_write(path, text);
}

/* A channel whose polarity is as wanted is not asked: many chips have no other. */
static int set_polarity(const struct device *device, bool inversed)
{
	static const char *const words[] = { "normal", "inversed" };
	const size_t folder = strlen(device->path) - strlen("duty_cycle");
	char path[DEVICE_PATH], now[SYSFS_TEXT];

	snprintf(path, sizeof(path), "%.*spolarity", (int)folder, device->path);
	if (sysfs_read(path, now, sizeof(now)) == 0 ? strcmp(now, words[inversed]) == 0 : !inversed)
		return 0;
	set(device, "enable", "0"); /* the polarity changes only so */
	return sysfs_write(path, words[inversed]);
}

/* A duty cycle is never longer than the period, also in between. */
static bool pwm_take(const struct device *device, const struct io_point *point, int64_t number,
		     struct trouble *why)
{
	char period[24], duty[24];
	int error = export(device, point->channel->number);

	if (error)
		return refused(why, point, "export", error);
	if (!await_file(device->path))
		return device_denied(why, point->channel->device, device->path);
	sysfs_print(point->channel->period_ns, period);
	sysfs_print(number, duty);
	error = set_polarity(device, point->active_low && point->channel->type != IEC_BOOL);
	if (error)
		return refused(why, point, "polarity", error);
	error = set(device, "period", period);
	if (error) { /* of now it may be shorter than its duty cycle */
		set(device, "duty_cycle", "0");
		error = set(device, "period", period);
	}
	if (error)
		return refused(why, point, "period", error);
	error = set(device, "duty_cycle", duty);
	if (error)
		return refused(why, point, "duty_cycle", error);
	error = set(device, "enable", "1");
	return !error || refused(why, point, "enable", error);
}

/* ---- the list ---- */

struct chip_list {
	const char *class;
	device_visit *visit;
	void *context;
};

static void see_channel(const struct chip_list *list, const char *chip, const char *device,
			unsigned number)
{
	char channel[12], of_channel[16], folder[DEVICE_PATH], path[DEVICE_PATH];
	double duty = 0, period = 0;
	struct device_seen seen = {
		.driver = DRIVER_pwm, .device = chip, .label = device, .channel = channel,
		.output = true, .unit = UNIT_PERCENT, .problem = "",
	};

	snprintf(channel, sizeof(channel), "%u", number);
	snprintf(of_channel, sizeof(of_channel), "/pwm%u", number);
	seen.has_value = sysfs_path(folder, sizeof(folder), list->class, chip, of_channel) &&
			 sysfs_path(path, sizeof(path), folder, "period", "") &&
			 sysfs_read_number(path, &period) && period > 0 &&
			 sysfs_path(path, sizeof(path), folder, "duty_cycle", "") &&
			 sysfs_read_number(path, &duty);
	if (seen.has_value)
		seen.value = 100 * duty / period;
	list->visit(list->context, &seen);
}

static bool see_chip(void *context, const char *name)
{
	const struct chip_list *list = context;
	char path[DEVICE_PATH], device[64];
	double channels = 0;

	if (strncmp(name, "pwmchip", 7) != 0 || strlen(name) > 40 ||
	    !sysfs_path(path, sizeof(path), list->class, name, "/npwm"))
		return true;
	device_name(list->class, name, device, sizeof(device));
	sysfs_read_number(path, &channels);
	for (unsigned i = 0; i < channels && i < 1000; i++)
		see_channel(list, name, device, i);
	return true;
}

void pwm_list(struct device_search *search, device_visit *visit, void *context)
{
	char class[DEVICE_PATH];
	struct chip_list list = { class, visit, context };

	if (sysfs_path(class, sizeof(class), search->sys, "class/pwm", ""))
		sysfs_each(class, see_chip, &list);
}

const struct device_driver device_pwm = {
	.find = pwm_find, .take = pwm_take,
};
