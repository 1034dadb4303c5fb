/* SPDX-License-Identifier: MIT
 *
 * gpiod.h of a fake libgpiod 1.6: the calls of hal/gpiod_v1.c, declared again from the
 * public interface. Values of constants may differ from the real ones, because no real
 * libgpiod is ever linked.
 */
#ifndef TESTS_FAKE_GPIOD_V1_H
#define TESTS_FAKE_GPIOD_V1_H

#include <stdbool.h>

struct gpiod_chip;
struct gpiod_line;

struct gpiod_line_bulk {
	struct gpiod_line *lines[64];
	unsigned int num_lines;
};

struct gpiod_line_request_config {
	const char *consumer;
	int request_type;
	int flags;
};

enum { GPIOD_LINE_DIRECTION_INPUT = 1, GPIOD_LINE_DIRECTION_OUTPUT };
enum { GPIOD_LINE_ACTIVE_STATE_HIGH = 1, GPIOD_LINE_ACTIVE_STATE_LOW };
enum {
	GPIOD_LINE_BIAS_AS_IS = 1,
	GPIOD_LINE_BIAS_DISABLE,
	GPIOD_LINE_BIAS_PULL_UP,
	GPIOD_LINE_BIAS_PULL_DOWN,
};
enum {
	GPIOD_LINE_REQUEST_DIRECTION_INPUT = 11,
	GPIOD_LINE_REQUEST_DIRECTION_OUTPUT,
};
enum {
	GPIOD_LINE_REQUEST_FLAG_OPEN_DRAIN = 1,
	GPIOD_LINE_REQUEST_FLAG_OPEN_SOURCE = 2,
	GPIOD_LINE_REQUEST_FLAG_BIAS_DISABLE = 8,
	GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN = 16,
	GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP = 32,
};

struct gpiod_chip *gpiod_chip_open(const char *path);
void gpiod_chip_close(struct gpiod_chip *chip);
const char *gpiod_chip_label(struct gpiod_chip *chip);
unsigned int gpiod_chip_num_lines(struct gpiod_chip *chip);
struct gpiod_line *gpiod_chip_get_line(struct gpiod_chip *chip,
				       unsigned int offset);

const char *gpiod_line_name(struct gpiod_line *line);
const char *gpiod_line_consumer(struct gpiod_line *line);
int gpiod_line_direction(struct gpiod_line *line);
int gpiod_line_active_state(struct gpiod_line *line);
int gpiod_line_bias(struct gpiod_line *line);
bool gpiod_line_is_used(struct gpiod_line *line);

void gpiod_line_bulk_init(struct gpiod_line_bulk *bulk);
void gpiod_line_bulk_add(struct gpiod_line_bulk *bulk,
			 struct gpiod_line *line);
int gpiod_line_request_bulk(struct gpiod_line_bulk *bulk,
			    const struct gpiod_line_request_config *config,
			    const int *default_vals);
void gpiod_line_release_bulk(struct gpiod_line_bulk *bulk);
int gpiod_line_get_value_bulk(struct gpiod_line_bulk *bulk, int *values);
int gpiod_line_set_value_bulk(struct gpiod_line_bulk *bulk, const int *values);
const char *gpiod_version_string(void);
#endif
