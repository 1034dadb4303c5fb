/* SPDX-License-Identifier: MIT
 *
 * fake_v2 - libgpiod 2.x, as far as hal/gpiod_v2.c calls it, with the fake chips.
 */
#include "tests/hal/fake.h"

#include <errno.h>
#include <gpiod.h>
#include <stdlib.h>

struct gpiod_chip { struct fake_chip *fake; };
struct gpiod_chip_info { struct fake_chip *fake; };
struct gpiod_line_info { struct fake_line line; };
struct gpiod_request_config { const char *consumer; };

struct gpiod_line_settings {
	enum gpiod_line_direction direction;
	char bias, drive;
	int value;
};

struct gpiod_line_config {
	size_t count;
	unsigned int offset[FAKE_MOST];
	struct gpiod_line_settings settings[FAKE_MOST];
};

struct gpiod_line_request { struct fake_request fake; };

/* Counts the objects that must be freed. */
static void *new_object(size_t size)
{
	void *object = fake_fails() ? NULL : fake_new(size);

	if (object)
		fake_settings(1);
	return object;
}

static void free_object(void *object)
{
	if (object)
		fake_settings(-1);
	free(object);
}

struct gpiod_chip *gpiod_chip_open(const char *path)
{
	struct fake_chip *fake_chip = fake_open(path);
	struct gpiod_chip *chip;

	chip = fake_chip ? new_object(sizeof(*chip)) : NULL;
	if (!chip) {
		if (fake_chip)
			fake_close();
		return NULL;
	}
	chip->fake = fake_chip;
	return chip;
}

void gpiod_chip_close(struct gpiod_chip *chip)
{
	fake_close();
	free_object(chip);
}

struct gpiod_chip_info *gpiod_chip_get_info(struct gpiod_chip *chip)
{
	struct gpiod_chip_info *info = new_object(sizeof(*info));

	if (!info)
		return NULL;
	info->fake = chip->fake;
	return info;
}

void gpiod_chip_info_free(struct gpiod_chip_info *info)
{
	free_object(info);
}

const char *gpiod_chip_info_get_label(struct gpiod_chip_info *info)
{
	return info->fake->label;
}

size_t gpiod_chip_info_get_num_lines(struct gpiod_chip_info *info)
{
	return info->fake->lines;
}

struct gpiod_line_info *gpiod_chip_get_line_info(struct gpiod_chip *chip,
						 unsigned int offset)
{
	struct gpiod_line_info *info;

	if (offset >= chip->fake->lines) {
		errno = EINVAL;
		return NULL;
	}
	info = new_object(sizeof(*info));
	if (!info)
		return NULL;
	info->line = fake_line(chip->fake, offset);
	return info;
}

void gpiod_line_info_free(struct gpiod_line_info *info)
{
	free_object(info);
}

const char *gpiod_line_info_get_name(struct gpiod_line_info *info)
{
	return info->line.name;
}

const char *gpiod_line_info_get_consumer(struct gpiod_line_info *info)
{
	return info->line.owner;
}

bool gpiod_line_info_is_active_low(struct gpiod_line_info *info)
{
	return info->line.active_low;
}

enum gpiod_line_bias gpiod_line_info_get_bias(struct gpiod_line_info *info)
{
	switch (info->line.bias) {
	case 'u':
		return GPIOD_LINE_BIAS_PULL_UP;
	case 'd':
		return GPIOD_LINE_BIAS_PULL_DOWN;
	case 'n':
		return GPIOD_LINE_BIAS_DISABLED;
	default:
		return GPIOD_LINE_BIAS_UNKNOWN;
	}
}

bool gpiod_line_info_is_used(struct gpiod_line_info *info)
{
	return info->line.used;
}

enum gpiod_line_direction
gpiod_line_info_get_direction(struct gpiod_line_info *info)
{
	return info->line.output ? GPIOD_LINE_DIRECTION_OUTPUT :
				   GPIOD_LINE_DIRECTION_INPUT;
}

struct gpiod_line_settings *gpiod_line_settings_new(void)
{
	struct gpiod_line_settings *settings = new_object(sizeof(*settings));

	if (settings)
		gpiod_line_settings_reset(settings);
	return settings;
}

void gpiod_line_settings_free(struct gpiod_line_settings *settings)
{
	free_object(settings);
}

void gpiod_line_settings_reset(struct gpiod_line_settings *settings)
{
	*settings = (struct gpiod_line_settings){
		.direction = GPIOD_LINE_DIRECTION_AS_IS,
		.bias = '-', .drive = '-',
	};
}

int gpiod_line_settings_set_direction(struct gpiod_line_settings *settings,
				      enum gpiod_line_direction direction)
{
	settings->direction = direction;
	return fake_fails() ? -1 : 0;
}

int gpiod_line_settings_set_bias(struct gpiod_line_settings *settings,
				 enum gpiod_line_bias bias)
{
	static const char letter[] = {
		[GPIOD_LINE_BIAS_AS_IS] = '-',
		[GPIOD_LINE_BIAS_UNKNOWN] = '?',
		[GPIOD_LINE_BIAS_DISABLED] = 'n',
		[GPIOD_LINE_BIAS_PULL_UP] = 'u',
		[GPIOD_LINE_BIAS_PULL_DOWN] = 'd',
	};

	settings->bias = letter[bias];
	return fake_fails() ? -1 : 0;
}

int gpiod_line_settings_set_drive(struct gpiod_line_settings *settings,
				  enum gpiod_line_drive drive)
{
	static const char letter[] = {
		[GPIOD_LINE_DRIVE_PUSH_PULL] = '-',
		[GPIOD_LINE_DRIVE_OPEN_DRAIN] = 'o',
		[GPIOD_LINE_DRIVE_OPEN_SOURCE] = 's',
	};

	settings->drive = letter[drive];
	return fake_fails() ? -1 : 0;
}

int gpiod_line_settings_set_output_value(struct gpiod_line_settings *settings,
					 enum gpiod_line_value value)
{
	settings->value = value == GPIOD_LINE_VALUE_ACTIVE;
	return fake_fails() ? -1 : 0;
}

struct gpiod_line_config *gpiod_line_config_new(void)
{
	return new_object(sizeof(struct gpiod_line_config));
}

void gpiod_line_config_free(struct gpiod_line_config *config)
{
	free_object(config);
}

int gpiod_line_config_add_line_settings(struct gpiod_line_config *config,
					const unsigned int *offsets,
					size_t num_offsets,
					struct gpiod_line_settings *settings)
{
	if (fake_fails())
		return -1;
	for (size_t i = 0; i < num_offsets; i++) {
		if (config->count == FAKE_MOST) {
			errno = E2BIG;
			return -1;
		}
		config->offset[config->count] = offsets[i];
		config->settings[config->count++] = *settings;
	}
	return 0;
}

struct gpiod_request_config *gpiod_request_config_new(void)
{
	return new_object(sizeof(struct gpiod_request_config));
}

void gpiod_request_config_free(struct gpiod_request_config *config)
{
	free_object(config);
}

void gpiod_request_config_set_consumer(struct gpiod_request_config *config,
				       const char *consumer)
{
	config->consumer = consumer;
}

struct gpiod_line_request *
gpiod_chip_request_lines(struct gpiod_chip *chip,
			 struct gpiod_request_config *req_cfg,
			 struct gpiod_line_config *line_cfg)
{
	struct gpiod_line_request *request = new_object(sizeof(*request));
	char bias[FAKE_MOST], drive[FAKE_MOST];
	int values[FAKE_MOST];

	if (!request)
		return NULL;
	request->fake.count = line_cfg->count;
	request->fake.output = line_cfg->settings[0].direction ==
			       GPIOD_LINE_DIRECTION_OUTPUT;
	for (size_t i = 0; i < line_cfg->count; i++) {
		request->fake.offset[i] = line_cfg->offset[i];
		bias[i] = line_cfg->settings[i].bias;
		drive[i] = line_cfg->settings[i].drive;
		values[i] = line_cfg->settings[i].value;
	}
	if (fake_take(&request->fake, chip->fake, req_cfg->consumer, values,
		      bias, drive)) {
		free_object(request);
		return NULL;
	}
	return request;
}

void gpiod_line_request_release(struct gpiod_line_request *request)
{
	fake_release(&request->fake);
	free_object(request);
}

int gpiod_line_request_get_values(struct gpiod_line_request *request,
				  enum gpiod_line_value *values)
{
	int levels[FAKE_MOST];

	if (fake_read(&request->fake, levels))
		return -1;
	for (size_t i = 0; i < request->fake.count; i++)
		values[i] = levels[i] ? GPIOD_LINE_VALUE_ACTIVE :
					GPIOD_LINE_VALUE_INACTIVE;
	return 0;
}

int gpiod_line_request_set_values(struct gpiod_line_request *request,
				  const enum gpiod_line_value *values)
{
	int levels[FAKE_MOST];

	for (size_t i = 0; i < request->fake.count; i++)
		levels[i] = values[i] == GPIOD_LINE_VALUE_ACTIVE;
	return fake_write(&request->fake, levels);
}

const char *gpiod_api_version(void)
{
	return "2.0-fake";
}
