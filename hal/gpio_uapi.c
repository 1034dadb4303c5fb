/* SPDX-License-Identifier: MIT
 *
 * gpio_uapi - the gpio driver for boards without libgpiod: version 2 of the GPIO character
 * device (linux/gpio.h, Linux 5.10 and later). Each line of a request has its own flags. It
 * allocates nothing.
 */
#include "hal/gpio.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/gpio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

struct uapi_state {
	int fd;        /* of the lines; the chip is closed                  */
	uint64_t all;  /* a bit for each line                               */
};

static int call(int fd, unsigned long what, void *about)
{
	return ioctl(fd, what, about) < 0 ? -errno : 0;
}

int gpio_chip_open(const char *path, struct gpio_chip *out)
{
	struct gpiochip_info about;
	int error;

	memset(&about, 0, sizeof(about));
	out->fd = open(path, O_RDWR | O_CLOEXEC | O_NONBLOCK);
	if (out->fd < 0)
		return -errno;
	error = call(out->fd, GPIO_GET_CHIPINFO_IOCTL, &about);
	if (error) {
		close(out->fd);
		return error;
	}
	out->lines = about.lines;
	about.label[sizeof(about.label) - 1] = 0;
	gpio_text(out->label, about.label);
	return 0;
}

void gpio_chip_close(struct gpio_chip *chip)
{
	close(chip->fd);
}

static enum io_bias bias_of(uint64_t flags)
{
	if (flags & GPIO_V2_LINE_FLAG_BIAS_PULL_UP)
		return BIAS_UP;
	if (flags & GPIO_V2_LINE_FLAG_BIAS_PULL_DOWN)
		return BIAS_DOWN;
	return flags & GPIO_V2_LINE_FLAG_BIAS_DISABLED ? BIAS_NONE : BIAS_AS_IS;
}

int gpio_chip_line(struct gpio_chip *chip, uint32_t offset,
		   struct gpio_line *out)
{
	struct gpio_v2_line_info about;
	int error;

	memset(&about, 0, sizeof(about));
	about.offset = offset;
	error = call(chip->fd, GPIO_V2_GET_LINEINFO_IOCTL, &about);
	if (error)
		return error;
	about.name[sizeof(about.name) - 1] = 0;
	about.consumer[sizeof(about.consumer) - 1] = 0;
	gpio_text(out->name, about.name);
	gpio_text(out->owner, about.consumer);
	out->used = about.flags & GPIO_V2_LINE_FLAG_USED;
	out->output = about.flags & GPIO_V2_LINE_FLAG_OUTPUT;
	out->active_low = about.flags & GPIO_V2_LINE_FLAG_ACTIVE_LOW;
	out->bias = bias_of(about.flags);
	return 0;
}

static uint64_t flags_of(const struct io_point *point, bool output)
{
	static const uint64_t bias[] = {
		[BIAS_NONE] = GPIO_V2_LINE_FLAG_BIAS_DISABLED,
		[BIAS_UP] = GPIO_V2_LINE_FLAG_BIAS_PULL_UP,
		[BIAS_DOWN] = GPIO_V2_LINE_FLAG_BIAS_PULL_DOWN,
	};
	static const uint64_t drive[] = {
		[DRIVE_OPEN_DRAIN] = GPIO_V2_LINE_FLAG_OPEN_DRAIN,
		[DRIVE_OPEN_SOURCE] = GPIO_V2_LINE_FLAG_OPEN_SOURCE,
	};

	return bias[point->bias] | drive[point->drive] |
	       (output ? GPIO_V2_LINE_FLAG_OUTPUT : GPIO_V2_LINE_FLAG_INPUT);
}

/* Finds or adds the attribute with these flags; NULL: too many for the kernel. */
static struct gpio_v2_line_config_attribute *
attribute_of(struct gpio_v2_line_config *config, uint64_t flags)
{
	struct gpio_v2_line_config_attribute *attr = config->attrs;
	const struct gpio_v2_line_config_attribute *end = attr + config->num_attrs;

	for (; attr < end; attr++)
		if (attr->attr.id == GPIO_V2_LINE_ATTR_ID_FLAGS &&
		    attr->attr.flags == flags)
			return attr;
	if (config->num_attrs == GPIO_V2_LINE_NUM_ATTRS_MAX)
		return NULL;
	config->num_attrs++;
	attr->attr.id = GPIO_V2_LINE_ATTR_ID_FLAGS;
	attr->attr.flags = flags;
	return attr;
}

/* The request has the flags of its first line; lines with other flags have attributes. */
static int set_config(struct gpio_v2_line_config *config,
		      const struct request *request)
{
	if (request->output) {
		config->num_attrs = 1;
		config->attrs[0].attr.id = GPIO_V2_LINE_ATTR_ID_OUTPUT_VALUES;
		config->attrs[0].attr.values = request->first;
		config->attrs[0].mask = UINT64_MAX >> (64 - request->count);
	}
	for (uint32_t i = 0; i < request->count; i++) {
		uint64_t flags = flags_of(request->line[i].point,
					  request->output);
		struct gpio_v2_line_config_attribute *attr;

		if (i == 0)
			config->flags = flags;
		if (flags == config->flags)
			continue;
		attr = attribute_of(config, flags);
		if (!attr)
			return -E2BIG;
		attr->mask |= UINT64_C(1) << i;
	}
	return 0;
}

static int take_lines(struct request *request, const struct gpio_chip *chip)
{
	struct uapi_state *state = request->state;
	struct gpio_v2_line_request ask;
	int error;

	memset(&ask, 0, sizeof(ask));
	memcpy(ask.consumer, GPIO_OWNER, sizeof(GPIO_OWNER));
	ask.num_lines = request->count;
	for (uint32_t i = 0; i < request->count; i++)
		ask.offsets[i] = request->line[i].at.offset;
	error = set_config(&ask.config, request);
	if (!error)
		error = call(chip->fd, GPIO_V2_GET_LINE_IOCTL, &ask);
	state->fd = ask.fd;
	state->all = UINT64_MAX >> (64 - request->count);
	return error;
}

static bool uapi_open(struct request *request, struct trouble *why)
{
	return gpio_take(request, why, take_lines, NULL);
}

static void uapi_close(struct request *request)
{
	struct uapi_state *state = request->state;

	close(state->fd);
	state->fd = -1;
}

static int uapi_read(struct request *request, uint64_t *levels)
{
	const struct uapi_state *state = request->state;
	struct gpio_v2_line_values values = { .mask = state->all };
	int error = call(state->fd, GPIO_V2_LINE_GET_VALUES_IOCTL, &values);

	*levels = values.bits & state->all;
	return error;
}

static int uapi_write(struct request *request, uint64_t levels)
{
	const struct uapi_state *state = request->state;
	struct gpio_v2_line_values values = {
		.bits = levels & state->all, .mask = state->all,
	};

	return call(state->fd, GPIO_V2_LINE_SET_VALUES_IOCTL, &values);
}

const char *gpio_library(void)
{
	return "uAPI";
}

const char *gpio_version(void)
{
	return "v2";
}

const struct driver driver_gpio = {
	.word = "gpio", .state_size = sizeof(struct uapi_state),
	.needs_line = true,
	.open = uapi_open, .close = uapi_close,
	.read = uapi_read, .write = uapi_write,
	.find = gpio_find, .list = gpio_list,
};
