/* SPDX-License-Identifier: MIT
 *
 * cmd_io - `ladder io`: the lines of this machine, and whether a map fits
 * them. It takes no line and changes none.
 */
#include "ladder/report.h"

#include "hal/drivers.h"
#include "hal/hal.h"

#include <stdlib.h>

struct list {
	const struct call *call;
	bool json;
	int count;
};

static void json_field(const char *name, const char *text,
		       const struct sink *out)
{
	sink_printf(out, ", \"%s\": ", name);
	sink_json_text(out, text);
}

static void list_json(struct list *list, const struct line_seen *line)
{
	const struct sink *out = &list->call->out;

	sink_text(out, list->count ? ",\n  {\"chip\": " : "\n  {\"chip\": ");
	sink_json_text(out, line->chip);
	json_field("label", line->label, out);
	sink_printf(out, ", \"offset\": %u", line->offset);
	json_field("name", line->name, out);
	json_field("owner", line->owner, out);
	sink_printf(out, ", \"used\": %s, \"output\": %s}",
		    line->used ? "true" : "false",
		    line->output ? "true" : "false");
}

static void visit(void *context, const struct line_seen *line)
{
	struct list *list = context;
	const struct sink *out = &list->call->out;

	if (list->json) {
		list_json(list, line);
	} else {
		sink_printf(out, "%-12.40s %-20.40s %4u  %-24.60s %-6s ",
			    line->chip, line->label, line->offset,
			    *line->name ? line->name : "-",
			    line->output ? "output" : "input");
		sink_text(out, !line->used ? "free" :
			       *line->owner ? line->owner : "in use");
		sink_text(out, "\n");
	}
	list->count++;
}

static enum status list_lines(struct call *call, struct diag_list *diags)
{
	struct list list = { .call = call, .json = call_flag(call, "--json") };
	bool good;

	if (list.json)
		sink_text(&call->out, "{\"lines\": [");
	good = hal_list(NULL, visit, &list, diags);
	if (list.json) {
		sink_text(&call->out, list.count ? "\n],\n" : "],\n");
		sink_text(&call->out, "\"diagnostics\": ");
		report_json_diags(diags, &call->out);
		sink_text(&call->out, "}\n");
	} else {
		report_diags(diags);
		if (!list.count && good)
			sink_printf(&call->out, "no GPIO lines here (libgpiod: %s)\n",
				    gpio_version());
	}
	return good ? STATUS_GOOD : STATUS_NO;
}

static bool is_wrong(const struct diag_list *diags,
		     const struct io_point *point)
{
	for (int i = 0; i < diags->count; i++)
		if (diags->diag[i].line == point->text_line)
			return true;
	return false;
}

static void print_points(const struct call *call, const struct iomap *map,
			 const struct diag_list *diags)
{
	const struct sink *out = &call->out;
	char address[24], line[80];

	for (int i = 0; i < map->count; i++) {
		const struct io_point *point = &map->point[i];

		iec_addr_print(point->addr, address, sizeof(address));
		io_line_print(point, line, sizeof(line));
		sink_printf(out, "%-10s %-6s %-28s %-6s %s\n", address,
			    driver_row(point->driver)->word, line,
			    point->output ? "output" : "input",
			    is_wrong(diags, point) ? "wrong" : "good");
	}
}

static void json_points(const struct call *call, const struct iomap *map,
			const struct diag_list *diags)
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
		json_field("driver", driver_row(point->driver)->word, out);
		io_line_print(point, text, sizeof(text));
		json_field("line", text, out);
		sink_printf(out, ", \"output\": %s, \"good\": %s}",
			    point->output ? "true" : "false",
			    is_wrong(diags, point) ? "false" : "true");
	}
	sink_text(out, "],\n\"diagnostics\": ");
	report_json_diags(diags, out);
	sink_text(out, "}\n");
}

static enum status check_map(struct call *call, struct diag_list *diags)
{
	struct arena arena, scratch;
	struct iomap map = { .file = call->arg[0] };
	size_t len;
	char *text = report_read(call->arg[0], &len);
	bool good = false;

	if (!text)
		return STATUS_WRONG;
	arena_init(&arena);
	arena_init(&scratch);
	if (iomap_read(&map, &arena, call->arg[0], text, len, diags)) {
		good = hal_supported(&map, diags);
		good = good && hal_check(&map, &scratch, diags);
	}
	if (call_flag(call, "--json")) {
		json_points(call, &map, diags);
	} else {
		report_diags(diags);
		print_points(call, &map, diags);
	}
	arena_free(&scratch);
	arena_free(&arena);
	free(text);
	return good ? STATUS_GOOD : STATUS_NO;
}

enum status cmd_io(struct call *call)
{
	struct diag_list *diags = calloc(1, sizeof(*diags));
	enum status status;

	if (!diags)
		return report_no_memory("ladder io");
	diag_init(diags);
	status = call->arg_count ? check_map(call, diags) :
				   list_lines(call, diags);
	free(diags);
	return status;
}
