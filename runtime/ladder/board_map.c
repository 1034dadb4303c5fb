/* SPDX-License-Identifier: MIT
 *
 * board_map - `ladder board … devices MAP`: whether the board has the lines and devices that a map names.
 *
 * It compares the map with the list that the board gives; it opens no device and sends no map.
 */
#include "ladder/foreign.h"
#include "ladder/remote.h"
#include "ladder/report.h"

#include "hal/channel.h"
#include "hal/drivers.h"
#include "hal/iomap.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum found { FOUND_GOOD, FOUND_NONE, FOUND_USED, FOUND_OPEN };

static bool same(const char *a, const char *b)
{
	return a && strcmp(a, b) == 0;
}

/* /dev/gpiochip0 is gpiochip0. */
static bool is_chip(const char *chip, const struct machine_row *row)
{
	return chip && (same(chip, row->device) || (*row->label && same(chip, row->label)) ||
			(strncmp(chip, "/dev/", 5) == 0 && same(chip + 5, row->device)));
}

static bool is_line(const struct io_point *point, const struct machine_row *row)
{
	return point->line ? same(point->line, row->channel) :
			     is_chip(point->chip, row) && point->offset == row->offset;
}

static bool is_device(const struct io_point *point, const struct machine_row *row)
{
	const struct io_channel *channel = point->channel;
	char number[16];

	if (!channel->device || !(same(channel->device, row->device) || (*row->label && same(channel->device, row->label))))
		return false;
	snprintf(number, sizeof(number), "%u", (unsigned)channel->number);
	return point->driver == DRIVER_w1 || same(point->driver == DRIVER_pwm ? number : channel->name, row->channel);
}

/* A board tells a device by its name; one that a map names by its number or folder may be there all the same. */
static bool may_be_another_name(const struct io_point *point)
{
	const char *device = point->channel && point->channel->device ? point->channel->device : "";

	return point->driver != DRIVER_w1 && (strpbrk(device, ":.") || strncmp(device, "hwmon", 5) == 0 ||
					      strncmp(device, "1-", 2) == 0 || point->driver == DRIVER_pwm);
}

static enum found find(const struct io_point *point, const struct remote_machine *machine, const struct machine_row **row)
{
	const char *driver = driver_row(point->driver)->word;

	*row = NULL;
	if (!driver_row(point->driver)->needs_line && point->driver != DRIVER_iio && point->driver != DRIVER_pwm &&
	    point->driver != DRIVER_w1 && point->driver != DRIVER_hwmon)
		return FOUND_GOOD;
	for (uint32_t i = 0; i < machine->count && !*row; i++)
		if (same(driver, machine->row[i].driver) && (point->channel ? is_device : is_line)(point, &machine->row[i]))
			*row = &machine->row[i];
	if (!*row)
		return point->channel && may_be_another_name(point) ? FOUND_OPEN : FOUND_NONE;
	return (*row)->flags & MACHINE_USED && !same("ladderd", (*row)->about) ? FOUND_USED : FOUND_GOOD;
}

static void say(const struct sink *out, enum found found, const struct machine_row *row)
{
	static const char *const text[] = {
		[FOUND_GOOD] = "good", [FOUND_NONE] = "not on the board", [FOUND_USED] = "in use by ",
		[FOUND_OPEN] = "not in the list of the board by this name",
	};

	sink_text(out, text[found]);
	if (found == FOUND_USED)
		foreign_text(out, *row->about ? row->about : "the kernel");
}

static void print_point(const struct remote *remote, const struct io_point *point, enum found found,
			const struct machine_row *row, bool first)
{
	const struct sink *out = &remote->call->out;
	char address[24], line[80];

	iec_addr_print(point->addr, address, sizeof(address));
	io_line_print(point, line, sizeof(line));
	if (!remote->json) {
		sink_printf(out, "%-10s %-6s %-28s %-6s ", address, driver_row(point->driver)->word, line,
			    point->output ? "output" : "input");
		say(out, found, row);
		sink_text(out, "\n");
		return;
	}
	sink_text(out, first ? "[\n  {\"address\": " : ",\n  {\"address\": ");
	sink_json_text(out, address);
	report_json_field("driver", driver_row(point->driver)->word, out);
	report_json_field("line", line, out);
	sink_printf(out, ", \"map_line\": %d, \"good\": %s}", point->text_line,
		    found == FOUND_GOOD ? "true" : found == FOUND_OPEN ? "null" : "false");
}

enum status remote_check_map(struct remote *remote, const char *path, const struct remote_machine *machine)
{
	struct diag_list *diags = report_list(path);
	enum status status = STATUS_NO;
	struct arena arena;
	struct iomap map;
	size_t len;
	char *text = diags ? report_read(path, &len) : NULL;

	if (!text) {
		free(diags);
		return STATUS_WRONG;
	}
	arena_init(&arena);
	if (iomap_read(&map, &arena, path, text, len, diags))
		status = STATUS_GOOD;
	report_end(diags);
	for (int i = 0; i < map.count; i++) {
		const struct machine_row *row;
		const enum found found = find(&map.point[i], machine, &row);

		print_point(remote, &map.point[i], found, row, i == 0);
		if (found == FOUND_NONE || found == FOUND_USED)
			status = STATUS_NO;
	}
	if (remote->json)
		sink_text(&remote->call->out, map.count ? "\n]\n" : "[]\n");
	arena_free(&arena);
	free(text);
	return status;
}
