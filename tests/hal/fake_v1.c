/* SPDX-License-Identifier: MIT
 *
 * fake_v1 - libgpiod 1.6, as far as hal/gpiod_v1.c calls it, with the fake chips.
 */
#include "tests/hal/fake.h"

#include <errno.h>
#include <gpiod.h>
#include <stdlib.h>

struct gpiod_line {
	struct gpiod_chip *chip;
	unsigned int offset;
};

struct gpiod_chip {
	struct fake_chip *fake;
	struct fake_request *request; /* the request of its lines */
	struct gpiod_line line[FAKE_LINES];
};

struct gpiod_chip *gpiod_chip_open(const char *path)
{
	struct fake_chip *fake_chip = fake_open(path);
	struct gpiod_chip *chip = fake_chip ? fake_new(sizeof(*chip)) : NULL;

	if (!chip)
		return NULL;
	chip->fake = fake_chip;
	for (unsigned int i = 0; i < FAKE_LINES; i++)
		chip->line[i] = (struct gpiod_line){ chip, i };
	return chip;
}

void gpiod_chip_close(struct gpiod_chip *chip)
{
	fake_close();
	free(chip);
}

const char *gpiod_chip_label(struct gpiod_chip *chip)
{
	return chip->fake->label;
}

unsigned int gpiod_chip_num_lines(struct gpiod_chip *chip)
{
	return chip->fake->lines;
}

struct gpiod_line *gpiod_chip_get_line(struct gpiod_chip *chip,
				       unsigned int offset)
{
	if (fake_fails())
		return NULL;
	if (offset < chip->fake->lines)
		return &chip->line[offset];
	errno = EINVAL;
	return NULL;
}

static const struct fake_line *seen(const struct gpiod_line *line)
{
	return &line->chip->fake->line[line->offset];
}

const char *gpiod_line_name(struct gpiod_line *line)
{
	return seen(line)->name;
}

const char *gpiod_line_consumer(struct gpiod_line *line)
{
	return seen(line)->owner;
}

int gpiod_line_direction(struct gpiod_line *line)
{
	return seen(line)->output ? GPIOD_LINE_DIRECTION_OUTPUT :
				    GPIOD_LINE_DIRECTION_INPUT;
}

int gpiod_line_active_state(struct gpiod_line *line)
{
	return seen(line)->active_low ? GPIOD_LINE_ACTIVE_STATE_LOW :
					GPIOD_LINE_ACTIVE_STATE_HIGH;
}

int gpiod_line_bias(struct gpiod_line *line)
{
	switch (seen(line)->bias) {
	case 'u':
		return GPIOD_LINE_BIAS_PULL_UP;
	case 'd':
		return GPIOD_LINE_BIAS_PULL_DOWN;
	case 'n':
		return GPIOD_LINE_BIAS_DISABLE;
	default:
		return GPIOD_LINE_BIAS_AS_IS;
	}
}

bool gpiod_line_is_used(struct gpiod_line *line)
{
	return seen(line)->used;
}

void gpiod_line_bulk_init(struct gpiod_line_bulk *bulk)
{
	bulk->num_lines = 0;
}

void gpiod_line_bulk_add(struct gpiod_line_bulk *bulk, struct gpiod_line *line)
{
	bulk->lines[bulk->num_lines++] = line;
}

int gpiod_line_request_bulk(struct gpiod_line_bulk *bulk,
			    const struct gpiod_line_request_config *config,
			    const int *default_vals)
{
	struct gpiod_chip *chip = bulk->lines[0]->chip;
	struct fake_request *request = fake_new(sizeof(*request));
	char bias[FAKE_MOST], drive[FAKE_MOST];
	int flags = config->flags;

	request->count = bulk->num_lines;
	request->output = config->request_type ==
			  GPIOD_LINE_REQUEST_DIRECTION_OUTPUT;
	for (size_t i = 0; i < request->count; i++) {
		request->offset[i] = bulk->lines[i]->offset;
		bias[i] = flags & GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP ? 'u' :
			  flags & GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN ?
			  'd' : flags & GPIOD_LINE_REQUEST_FLAG_BIAS_DISABLE ?
			  'n' : '-';
		drive[i] = flags & GPIOD_LINE_REQUEST_FLAG_OPEN_DRAIN ? 'o' :
			   flags & GPIOD_LINE_REQUEST_FLAG_OPEN_SOURCE ? 's' :
			   '-';
	}
	if (fake_take(request, chip->fake, config->consumer, default_vals,
		      bias, drive)) {
		free(request);
		return -1;
	}
	chip->request = request;
	return 0;
}

void gpiod_line_release_bulk(struct gpiod_line_bulk *bulk)
{
	struct gpiod_chip *chip = bulk->lines[0]->chip;

	fake_release(chip->request);
	free(chip->request);
	chip->request = NULL;
}

int gpiod_line_get_value_bulk(struct gpiod_line_bulk *bulk, int *values)
{
	return fake_read(bulk->lines[0]->chip->request, values);
}

int gpiod_line_set_value_bulk(struct gpiod_line_bulk *bulk, const int *values)
{
	return fake_write(bulk->lines[0]->chip->request, values);
}

const char *gpiod_version_string(void)
{
	return "1.6-fake";
}
