/* SPDX-License-Identifier: MIT
 *
 * devices - lists the channels of iio, pwm, w1 and hwmon devices.
 */
#include "ladder/devices.h"

#ifndef RUNGBOARD_SMALL

#include "hal/channels.h"
#include "hal/drivers.h"

#include <stdio.h>
#include <string.h>

struct list {
	const struct sink *out;
	int count;
};

static const char *unit_word(enum io_unit unit)
{
	static const char *const words[] = { "", "V", "A", "\302\260C", "%", "Ohm" };

	return words[unit];
}

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
	snprintf(value, sizeof(value), "%g %s", seen->value, unit_word(seen->unit));
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
	report_json_field("unit", unit_word(seen->unit), list->out);
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
