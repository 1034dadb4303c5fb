/* SPDX-License-Identifier: MIT
 *
 * gpiod_v2 - the gpio driver with libgpiod 2.x (Debian 13). Each line of a request has its
 * own settings, and the chip is closed after the request.
 */
#include "hal/gpio.h"

#include <errno.h>
#include <gpiod.h>
#include <stdio.h>

struct v2_state {
	struct gpiod_line_request *lines;
};

static int last_error(void)
{
	return errno ? -errno : -ENOMEM;
}

int gpio_chip_open(const char *path, struct gpio_chip *out)
{
	struct gpiod_chip *chip = gpiod_chip_open(path);
	struct gpiod_chip_info *about;
	int error;

	if (!chip)
		return last_error();
	about = gpiod_chip_get_info(chip);
	if (!about) {
		error = last_error();
		gpiod_chip_close(chip);
		return error;
	}
	out->chip = chip;
	out->lines = (uint32_t)gpiod_chip_info_get_num_lines(about);
	gpio_text(out->label, gpiod_chip_info_get_label(about));
	gpiod_chip_info_free(about);
	return 0;
}

void gpio_chip_close(struct gpio_chip *chip)
{
	gpiod_chip_close(chip->chip);
}

static enum io_bias bias_of(enum gpiod_line_bias bias)
{
	switch (bias) {
	case GPIOD_LINE_BIAS_PULL_UP:
		return BIAS_UP;
	case GPIOD_LINE_BIAS_PULL_DOWN:
		return BIAS_DOWN;
	case GPIOD_LINE_BIAS_DISABLED:
		return BIAS_NONE;
	case GPIOD_LINE_BIAS_AS_IS:
	case GPIOD_LINE_BIAS_UNKNOWN:
		break;
	}
	return BIAS_AS_IS;
}

int gpio_chip_line(struct gpio_chip *chip, uint32_t offset,
		   struct gpio_line *out)
{
	struct gpiod_line_info *about =
		gpiod_chip_get_line_info(chip->chip, offset);

	if (!about)
		return last_error();
	gpio_text(out->name, gpiod_line_info_get_name(about));
	gpio_text(out->owner, gpiod_line_info_get_consumer(about));
	out->used = gpiod_line_info_is_used(about);
	out->output = gpiod_line_info_get_direction(about) ==
		      GPIOD_LINE_DIRECTION_OUTPUT;
	out->active_low = gpiod_line_info_is_active_low(about);
	out->bias = bias_of(gpiod_line_info_get_bias(about));
	gpiod_line_info_free(about);
	return 0;
}

static enum gpiod_line_value value_of(uint64_t levels, uint32_t line)
{
	return levels >> line & 1 ? GPIOD_LINE_VALUE_ACTIVE :
				    GPIOD_LINE_VALUE_INACTIVE;
}

static int set_settings(struct gpiod_line_settings *settings,
			const struct request *request, uint32_t line)
{
	static const enum gpiod_line_bias bias[] = {
		[BIAS_AS_IS] = GPIOD_LINE_BIAS_AS_IS,
		[BIAS_NONE] = GPIOD_LINE_BIAS_DISABLED,
		[BIAS_UP] = GPIOD_LINE_BIAS_PULL_UP,
		[BIAS_DOWN] = GPIOD_LINE_BIAS_PULL_DOWN,
	};
	static const enum gpiod_line_drive drive[] = {
		[DRIVE_AS_IS] = GPIOD_LINE_DRIVE_PUSH_PULL,
		[DRIVE_PUSH_PULL] = GPIOD_LINE_DRIVE_PUSH_PULL,
		[DRIVE_OPEN_DRAIN] = GPIOD_LINE_DRIVE_OPEN_DRAIN,
		[DRIVE_OPEN_SOURCE] = GPIOD_LINE_DRIVE_OPEN_SOURCE,
	};
	const struct io_point *point = request->line[line].point;

	if (gpiod_line_settings_set_direction(settings, request->output ?
			GPIOD_LINE_DIRECTION_OUTPUT :
			GPIOD_LINE_DIRECTION_INPUT) ||
	    gpiod_line_settings_set_bias(settings, bias[point->bias]) ||
	    gpiod_line_settings_set_drive(settings, drive[point->drive]) ||
	    gpiod_line_settings_set_output_value(settings,
			value_of(request->first, line)))
		return last_error();
	return 0;
}

static int add_lines(struct gpiod_line_config *lines,
		     struct gpiod_line_settings *settings,
		     const struct request *request)
{
	for (uint32_t i = 0; i < request->count; i++) {
		unsigned int offset = request->line[i].at.offset;
		int error;

		gpiod_line_settings_reset(settings);
		error = set_settings(settings, request, i);
		if (error)
			return error;
		if (gpiod_line_config_add_line_settings(lines, &offset, 1,
							settings))
			return last_error();
	}
	return 0;
}

static int take_lines(struct request *request, const struct gpio_chip *chip)
{
	struct v2_state *state = request->state;
	struct gpiod_line_settings *settings = gpiod_line_settings_new();
	struct gpiod_line_config *lines = gpiod_line_config_new();
	struct gpiod_request_config *owner = gpiod_request_config_new();
	int error = -ENOMEM;

	if (!settings || !lines || !owner)
		goto out;
	error = add_lines(lines, settings, request);
	if (error)
		goto out;
	gpiod_request_config_set_consumer(owner, GPIO_OWNER);
	state->lines = gpiod_chip_request_lines(chip->chip, owner, lines);
	if (!state->lines)
		error = last_error();
out:
	gpiod_request_config_free(owner);
	gpiod_line_config_free(lines);
	gpiod_line_settings_free(settings);
	return error;
}

static bool v2_open(struct request *request, struct trouble *why)
{
	return gpio_take(request, why, take_lines, NULL);
}

static void v2_close(struct request *request)
{
	struct v2_state *state = request->state;

	gpiod_line_request_release(state->lines);
	state->lines = NULL;
}

static int v2_read(struct request *request, uint64_t *levels)
{
	struct v2_state *state = request->state;
	enum gpiod_line_value values[REQUEST_LINES];

	if (gpiod_line_request_get_values(state->lines, values) != 0)
		return last_error();
	*levels = 0;
	for (uint32_t i = 0; i < request->count; i++)
		if (values[i] == GPIOD_LINE_VALUE_ACTIVE)
			*levels |= UINT64_C(1) << i;
	return 0;
}

static int v2_write(struct request *request, uint64_t levels)
{
	struct v2_state *state = request->state;
	enum gpiod_line_value values[REQUEST_LINES];

	for (uint32_t i = 0; i < request->count; i++)
		values[i] = value_of(levels, i);
	return gpiod_line_request_set_values(state->lines, values) ?
	       last_error() : 0;
}

const char *gpio_library(void)
{
	return "libgpiod";
}

const char *gpio_version(void)
{
	return gpiod_api_version();
}

const struct driver driver_gpio = {
	.word = "gpio", .state_size = sizeof(struct v2_state),
	.needs_line = true,
	.open = v2_open, .close = v2_close, .read = v2_read, .write = v2_write,
	.find = gpio_find, .list = gpio_list,
};
