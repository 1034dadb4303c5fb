/* SPDX-License-Identifier: MIT
 *
 * gpiod_v1 - the gpio driver with libgpiod 1.6 (Debian 12). A request has one set of flags,
 * and its chip stays open.
 */
#include "hal/gpio.h"

#include <errno.h>
#include <gpiod.h>
#include <stdio.h>

struct v1_state {
	struct gpiod_chip *chip;
	struct gpiod_line_bulk lines;
};

int gpio_chip_open(const char *path, struct gpio_chip *out)
{
	struct gpiod_chip *chip = gpiod_chip_open(path);

	if (!chip)
		return -errno;
	out->chip = chip;
	out->lines = gpiod_chip_num_lines(chip);
	gpio_text(out->label, gpiod_chip_label(chip));
	return 0;
}

void gpio_chip_close(struct gpio_chip *chip)
{
	gpiod_chip_close(chip->chip);
}

static enum io_bias bias_of(int bias)
{
	switch (bias) {
	case GPIOD_LINE_BIAS_PULL_UP:
		return BIAS_UP;
	case GPIOD_LINE_BIAS_PULL_DOWN:
		return BIAS_DOWN;
	case GPIOD_LINE_BIAS_DISABLE:
		return BIAS_NONE;
	default:
		return BIAS_AS_IS;
	}
}

int gpio_chip_line(struct gpio_chip *chip, uint32_t offset,
		   struct gpio_line *out)
{
	struct gpiod_line *line = gpiod_chip_get_line(chip->chip, offset);

	if (!line)
		return -errno;
	gpio_text(out->name, gpiod_line_name(line));
	gpio_text(out->owner, gpiod_line_consumer(line));
	out->used = gpiod_line_is_used(line);
	out->output = gpiod_line_direction(line) == GPIOD_LINE_DIRECTION_OUTPUT;
	out->active_low = gpiod_line_active_state(line) ==
			  GPIOD_LINE_ACTIVE_STATE_LOW;
	out->bias = bias_of(gpiod_line_bias(line));
	return 0;
}

static int flags_of(const struct io_point *point)
{
	static const int bias[] = {
		[BIAS_NONE] = GPIOD_LINE_REQUEST_FLAG_BIAS_DISABLE,
		[BIAS_UP] = GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP,
		[BIAS_DOWN] = GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN,
	};
	static const int drive[] = {
		[DRIVE_OPEN_DRAIN] = GPIOD_LINE_REQUEST_FLAG_OPEN_DRAIN,
		[DRIVE_OPEN_SOURCE] = GPIOD_LINE_REQUEST_FLAG_OPEN_SOURCE,
	};

	return bias[point->bias] | drive[point->drive];
}

static void split(uint64_t levels, uint32_t count, int *out)
{
	for (uint32_t i = 0; i < count; i++)
		out[i] = (int)(levels >> i & 1);
}

static int take_lines(struct request *request, const struct gpio_chip *chip)
{
	struct v1_state *state = request->state;
	struct gpiod_line_request_config config = {
		.consumer = GPIO_OWNER,
		.request_type = request->output ?
				GPIOD_LINE_REQUEST_DIRECTION_OUTPUT :
				GPIOD_LINE_REQUEST_DIRECTION_INPUT,
		.flags = flags_of(request->line[0].point),
	};
	int values[REQUEST_LINES];

	gpiod_line_bulk_init(&state->lines);
	for (uint32_t i = 0; i < request->count; i++) {
		struct gpiod_line *line =
			gpiod_chip_get_line(chip->chip, request->line[i].at.offset);

		if (!line)
			return -errno;
		gpiod_line_bulk_add(&state->lines, line);
	}
	split(request->first, request->count, values);
	return gpiod_line_request_bulk(&state->lines, &config, values) ?
	       -errno : 0;
}

static bool v1_open(struct request *request, struct trouble *why)
{
	struct v1_state *state = request->state;
	struct gpio_chip chip;

	if (!gpio_take(request, why, take_lines, &chip))
		return false;
	state->chip = chip.chip;
	return true;
}

static void v1_close(struct request *request)
{
	struct v1_state *state = request->state;

	gpiod_line_release_bulk(&state->lines);
	gpiod_chip_close(state->chip);
	state->chip = NULL;
}

static int v1_read(struct request *request, uint64_t *levels)
{
	struct v1_state *state = request->state;
	int values[REQUEST_LINES];

	if (gpiod_line_get_value_bulk(&state->lines, values) != 0)
		return -errno;
	*levels = 0;
	for (uint32_t i = 0; i < request->count; i++)
		*levels |= (uint64_t)(values[i] != 0) << i;
	return 0;
}

static int v1_write(struct request *request, uint64_t levels)
{
	struct v1_state *state = request->state;
	int values[REQUEST_LINES];

	split(levels, request->count, values);
	return gpiod_line_set_value_bulk(&state->lines, values) ? -errno : 0;
}

const char *gpio_library(void)
{
	return "libgpiod";
}

const char *gpio_version(void)
{
	return gpiod_version_string();
}

const struct driver driver_gpio = {
	.word = "gpio", .state_size = sizeof(struct v1_state),
	.needs_line = true, .same_flags = true,
	.open = v1_open, .close = v1_close, .read = v1_read, .write = v1_write,
	.find = gpio_find, .list = gpio_list,
};
