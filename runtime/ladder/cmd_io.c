/* SPDX-License-Identifier: MIT
 *
 * cmd_io - `ladder io`: lists the lines and analog devices of this machine, checks a map against them, shows
 * their state with the names of a program. It requests no line and changes none.
 */
#include "ladder/devices.h"
#include "ladder/map_words.h"
#include "ladder/picture.h"
#include "ladder/tty.h"

#include "hal/buses.h"
#include "hal/hal.h"

#include <stdlib.h>

static void print_picture(const struct call *call,
			  const struct picture *picture)
{
	const struct sink *out = &call->out;

	if (!picture_rows(picture))
		return;
	picture_head(picture, out);
	sink_text(out, "\n");
	for (int i = 0; i < picture_rows(picture); i++) {
		picture_row(picture, i, out);
		sink_text(out, "\n");
	}
}

static void json_picture(const struct call *call,
			 const struct picture *picture,
			 const struct diag_list *diags)
{
	const struct sink *out = &call->out;

	sink_text(out, "{");
	if (picture->map) {
		sink_text(out, "\"board\": ");
		sink_json_text(out, picture->map->board);
		sink_text(out, ", ");
	}
	sink_text(out, picture->map ? "\"points\": [" : "\"lines\": [");
	for (int i = 0; i < picture_rows(picture); i++) {
		sink_text(out, i ? ",\n  " : "\n  ");
		picture_json(picture, i, out);
	}
	sink_text(out, picture_rows(picture) ? "\n],\n" : "],\n");
	if (!picture->map)
		devices_json(out);
	sink_text(out, "\"diagnostics\": ");
	report_json_diags(diags, out);
	sink_text(out, "}\n");
}

/* Shows all lines, or those of a map with the names of a program. */
static enum status show(struct call *call, struct picture *picture,
			struct diag_list *diags)
{
	bool json = call_flag(call, "--json"), good;
	enum status status = STATUS_NO;

	if (call_flag(call, "--live") && !json && tty_is()) {
		arena_init(&picture->arena);
		status = picture_live(call, picture);
		picture_free(picture);
		return status;
	}
	good = picture_take(picture, diags);
	if (json) {
		json_picture(call, picture, diags);
	} else {
		report_diags(diags);
		print_picture(call, picture);
		if (!picture->map && !picture->count && good)
			sink_printf(&call->out, "no GPIO lines here (libgpiod: "
				    "%s)\n", gpio_version());
		if (!picture->map)
			devices_print(&call->out);
	}
	if (good && picture_is_whole(picture))
		status = STATUS_GOOD;
	picture_free(picture);
	return status;
}

/* Its line, or that of its bus. */
static bool is_wrong(const struct iomap *map, const struct diag_list *diags, const struct io_point *point)
{
	const int bus = point->channel && map->net ? point->channel->bus : -1;
	const int bus_line = bus >= 0 && bus < map->net->bus_count ? map->net->bus[bus].text_line : 0;

	for (int i = 0; i < diags->count; i++)
		if (diags->diag[i].line == point->text_line || (bus_line && diags->diag[i].line == bus_line))
			return true;
	return false;
}

/* @value: NULL: none has one. */
static void print_points(const struct call *call, const struct iomap *map,
			 const struct diag_list *diags, char (*value)[DEVICE_VALUE])
{
	const struct sink *out = &call->out;
	char address[24], line[80];

	for (int i = 0; i < map->count; i++) {
		const struct io_point *point = &map->point[i];

		iec_addr_print(point->addr, address, sizeof(address));
		io_line_print(point, line, sizeof(line));
		sink_printf(out, "%-10s %-6s %-28s %-6s %s", address,
			    driver_row(point->driver)->word, line,
			    point->output ? "output" : "input",
			    is_wrong(map, diags, point) ? "wrong" : "good");
		sink_printf(out, "%s%s\n", value && *value[i] ? "   " : "", value ? value[i] : "");
	}
}

static void json_points(const struct call *call, const struct iomap *map,
			const struct diag_list *diags, char (*value)[DEVICE_VALUE])
{
	const struct sink *out = &call->out;
	char text[80];

	sink_text(out, "{\"board\": ");
	sink_json_text(out, map->board);
	sink_text(out, ", \"points\": [");
	for (int i = 0; i < map->count; i++) {
		const struct io_point *point = &map->point[i];

		iec_addr_print(point->addr, text, sizeof(text));
		sink_text(out, i ? ",\n  {\"address\": " :
				   "\n  {\"address\": ");
		sink_json_text(out, text);
		report_json_field("driver", driver_row(point->driver)->word, out);
		io_line_print(point, text, sizeof(text));
		report_json_field("line", text, out);
		if (value && *value[i])
			report_json_field("value", value[i], out);
		sink_printf(out, ", \"output\": %s, \"good\": %s}",
			    point->output ? "true" : "false",
			    is_wrong(map, diags, point) ? "false" : "true");
	}
	sink_text(out, "],\n\"diagnostics\": ");
	report_json_diags(diags, out);
	sink_text(out, "}\n");
}

/* Also the lines of a map with errors in others are checked on this machine. */
static enum status check_map(struct call *call, const struct iomap *map, bool is_read,
			     struct diag_list *diags)
{
	struct arena scratch;
	char (*value)[DEVICE_VALUE];
	bool good;

	arena_init(&scratch);
	good = hal_check(map, &scratch, diags) && is_read;
	good = buses_check(map, diags) && good;
	good = buses_check_peers(map, diags) && good;
	arena_free(&scratch);
	value = devices_values(map);
	if (call_flag(call, "--json")) {
		json_points(call, map, diags, value);
	} else {
		report_diags(diags);
		print_points(call, map, diags, value);
	}
	free(value);
	return good ? STATUS_GOOD : STATUS_NO;
}

/* Shows the state of the map's lines, with the names of --program. */
static enum status show_map(struct call *call, const struct iomap *map,
			    struct arena *arena, struct diag_list *diags)
{
	const char *file = call_option(call, "--program");
	struct picture picture = { .map = map };
	struct machine machine = { 0 };
	enum status status = STATUS_GOOD;
	bool fits = true;

	if (file)
		status = machine_open(&machine, file, 0);
	if (status == STATUS_GOOD) {
		if (file) {
			picture.program = ladder_program(machine.ladder);
			fits = iomap_check_program(map, picture.program, arena, diags);
		}
		status = show(call, &picture, diags);
		if (!fits)
			status = STATUS_NO;
	}
	if (file)
		machine_close(&machine);
	return status;
}

/* A picture needs the whole map. */
static enum status refuse_map(struct call *call, const struct iomap *map, const struct diag_list *diags)
{
	if (call_flag(call, "--json"))
		json_points(call, map, diags, NULL);
	else
		report_diags(diags);
	return STATUS_NO;
}

static enum status with_map(struct call *call, struct diag_list *diags)
{
	bool picture = call_option(call, "--program") ||
		       call_flag(call, "--live");
	struct iomap map = { .file = call->arg[0] };
	enum status status = STATUS_NO;
	struct arena arena;
	bool is_read;
	size_t len;
	char *text = report_read(call->arg[0], &len);

	if (!text)
		return STATUS_WRONG;
	arena_init(&arena);
	is_read = iomap_read(&map, &arena, call->arg[0], text, len, diags);
	if (!picture)
		status = check_map(call, &map, is_read, diags);
	else if (is_read)
		status = show_map(call, &map, &arena, diags);
	else
		status = refuse_map(call, &map, diags);
	arena_free(&arena);
	free(text);
	return status;
}

enum status cmd_io(struct call *call)
{
	struct diag_list *diags;
	struct picture all = { .map = NULL };
	enum status status;

	if (call_flag(call, "--words")) {
		if (call->arg_count || call_flag(call, "--json"))
			return report_usage(call, "--words stands alone");
		map_words_print(&call->out);
		return STATUS_GOOD;
	}
	if (!call->arg_count && call_option(call, "--program"))
		return report_usage(call, "--program needs a MAP");
	diags = report_list("ladder io");
	if (!diags)
		return STATUS_WRONG;
	status = call->arg_count ? with_map(call, diags) :
				   show(call, &all, diags);
	free(diags);
	return status;
}
