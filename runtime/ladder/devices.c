/* SPDX-License-Identifier: MIT
 *
 * devices - lists the channels of iio, pwm, w1 and hwmon devices.
 */
#include "ladder/devices.h"

#ifndef RUNGBOARD_SMALL

#include "hal/channel.h"
#include "hal/channels.h"
#include "hal/drivers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct list {
	const struct sink *out;
	int count;
};

/* Columns of the screen, not bytes: of ASCII, but for the degree sign at an end. */
static void put(const struct sink *out, const char *text, int width)
{
	const int len = *text ? (int)strlen(text) : 1;

	sink_text(out, *text ? text : "-");
	sink_repeat(out, " ", len < width ? width - len : 0);
	sink_text(out, " ");
}

static void print_one(void *context, const struct device_seen *seen)
{
	struct list *list = context;
	char value[64];

	if (!list->count++)
		sink_text(list->out, "driver device                   channel      now    value\n");
	put(list->out, driver_row(seen->driver)->word, 6);
	put(list->out, seen->device, 24);
	put(list->out, seen->channel, 12);
	put(list->out, seen->output ? "output" : "input", 6);
	snprintf(value, sizeof(value), "%g %s", seen->value, io_unit_word(seen->unit));
	sink_text(list->out, seen->has_value ? value : *seen->problem ? seen->problem : "-");
	if (*seen->label)
		sink_printf(list->out, "  (%s)", seen->label);
	sink_text(list->out, "\n");
}

int devices_print(const struct sink *out)
{
	struct list list = { out, 0 };

	channels_list(NULL, print_one, &list);
	return list.count;
}

/* ---- of a map ---- */

struct map_values {
	const struct iomap *map;
	char (*text)[DEVICE_VALUE];
};

static bool is_named(const char *name, const struct device_seen *seen)
{
	return name && (strcmp(name, seen->device) == 0 || (*seen->label && strcmp(name, seen->label) == 0));
}

static bool is_of(const struct io_point *point, const struct device_seen *seen)
{
	char number[12];

	if (point->driver != seen->driver || point->output != seen->output || !is_named(point->channel->device, seen))
		return false;
	snprintf(number, sizeof(number), "%u", (unsigned)point->channel->number);
	return !*seen->channel || strcmp(point->channel->name ? point->channel->name : number, seen->channel) == 0;
}

static void take_value(void *context, const struct device_seen *seen)
{
	const struct map_values *values = context;

	for (int i = 0; i < values->map->count; i++) {
		char *text = values->text[i];

		if (!values->map->point[i].channel || !is_of(&values->map->point[i], seen))
			continue;
		if (seen->has_value)
			snprintf(text, DEVICE_VALUE, "%.9g%s%s", seen->value, seen->unit == UNIT_NONE ? "" : " ",
				 io_unit_word(seen->unit));
		else
			snprintf(text, DEVICE_VALUE, "%.47s", seen->problem);
	}
}

char (*devices_values(const struct iomap *map))[DEVICE_VALUE]
{
	struct map_values values = { map, NULL };
	bool any = false;

	for (int i = 0; i < map->count; i++)
		any = any || (map->point[i].channel && map->point[i].channel->device &&
			      map->point[i].driver != DRIVER_peer);
	if (any)
		values.text = calloc((size_t)map->count, sizeof(*values.text));
	if (values.text)
		channels_list(map->sys, take_value, &values);
	return values.text;
}

static void json_one(void *context, const struct device_seen *seen)
{
	struct list *list = context;

	sink_text(list->out, list->count++ ? ",\n  {\"driver\": " : "\n  {\"driver\": ");
	sink_json_text(list->out, driver_row(seen->driver)->word);
	report_json_field("device", seen->device, list->out);
	report_json_field("label", *seen->label ? seen->label : NULL, list->out);
	report_json_field("channel", *seen->channel ? seen->channel : NULL, list->out);
	sink_printf(list->out, ", \"output\": %s, \"value\": ", seen->output ? "true" : "false");
	if (seen->has_value)
		sink_printf(list->out, "%.9g", seen->value);
	else
		sink_text(list->out, "null");
	report_json_field("unit", io_unit_word(seen->unit), list->out);
	report_json_field("problem", *seen->problem ? seen->problem : NULL, list->out);
	sink_text(list->out, "}");
}

void devices_json(const struct sink *out)
{
	struct list list = { out, 0 };

	sink_text(out, "\"devices\": [");
	channels_list(NULL, json_one, &list);
	sink_text(out, list.count ? "\n],\n" : "],\n");
}
#endif
