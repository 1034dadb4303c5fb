/* SPDX-License-Identifier: MIT
 *
 * board_devices - `ladder board … devices`: the lines and analog devices of a board, whether or not its map names
 * them.
 */
#include "ladder/foreign.h"
#include "ladder/remote.h"
#include "ladder/report.h"
#include "online/machine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define LOOKS 300 /* of 0.1 s                                              */

/* A column: at least one blank behind it. */
static void put(const struct sink *out, const char *text, int width)
{
	const int len = *text ? (int)strlen(text) : 1;

	foreign_text(out, *text ? text : "-");
	sink_repeat(out, " ", len < width ? width - len : 0);
	sink_text(out, " ");
}

static void print_row(const struct sink *out, const struct machine_row *row, bool first)
{
	const bool line = strcmp(row->driver, "gpio") == 0;
	char text[32] = "";

	if (first)
		sink_text(out, "driver device                   channel      now    value\n");
	put(out, row->driver, 6);
	if (line)
		snprintf(text, sizeof(text), " %u", (unsigned)row->offset);
	foreign_text(out, line ? row->label : row->device);
	sink_text(out, text);
	sink_repeat(out, " ", 24 - (int)(strlen(line ? row->label : row->device) + strlen(text)));
	sink_text(out, " ");
	put(out, row->channel, 12);
	put(out, row->flags & MACHINE_OUTPUT ? "output" : "input", 6);
	snprintf(text, sizeof(text), "%.9g %.7s", row->value, row->unit);
	if (row->flags & MACHINE_VALUE)
		foreign_text(out, text);
	else if (row->flags & MACHINE_USED)
		sink_text(out, "used by ");
	if (!(row->flags & MACHINE_VALUE))
		foreign_text(out, *row->about ? row->about : row->flags & MACHINE_USED ? "the kernel" : "-");
	if (!line && *row->label) {
		sink_text(out, "  (");
		foreign_text(out, row->label);
		sink_text(out, ")");
	}
	sink_text(out, "\n");
}

static void json_row(const struct sink *out, const struct machine_row *row, bool first)
{
	sink_text(out, first ? "[\n  {\"driver\": " : ",\n  {\"driver\": ");
	sink_json_text(out, row->driver);
	report_json_field("device", row->device, out);
	report_json_field("label", *row->label ? row->label : NULL, out);
	report_json_field("channel", *row->channel ? row->channel : NULL, out);
	if (strcmp(row->driver, "gpio") == 0) {
		sink_printf(out, ", \"offset\": %u, \"used\": %s", (unsigned)row->offset,
			    row->flags & MACHINE_USED ? "true" : "false");
		report_json_field("owner", *row->about ? row->about : NULL, out);
	}
	sink_printf(out, ", \"output\": %s", row->flags & MACHINE_OUTPUT ? "true" : "false");
	if (row->flags & MACHINE_VALUE)
		sink_printf(out, ", \"value\": %.9g", row->value);
	if (*row->unit)
		report_json_field("unit", row->unit, out);
	sink_text(out, "}");
}

static bool keep_row(struct remote_machine *machine, const struct machine_row *row)
{
	if (machine->count == machine->room) {
		const uint32_t room = machine->room ? 2 * machine->room : 64;
		struct machine_row *more = realloc(machine->row, room * sizeof(*more));

		if (!more)
			return false;
		machine->row = more;
		machine->room = room;
	}
	machine->row[machine->count++] = *row;
	return true;
}

/* The rows from *@next on, which moves behind them; 0: there are no more. *@ready: false: ask again. */
static enum status ask(struct remote *remote, struct remote_machine *machine, bool anew, uint32_t *next, bool *ready)
{
	const uint32_t from = *next;
	struct wire_writer out = desk_ask(&remote->desk, SERVICE_DEVICES);
	struct machine_row row;
	struct wire_reader in;
	enum desk_end end;
	uint16_t count;

	wire_put_u8(&out, anew);
	wire_put_u32(&out, from);
	end = desk_call(&remote->desk, &out, &in);
	if (end != DESK_GOOD)
		return remote_fail(remote, end);
	*ready = wire_u8(&in) != 0;
	*next = wire_u32(&in);
	count = wire_u16(&in);
	for (uint16_t i = 0; i < count; i++) {
		machine_take(&in, &row);
		if (in.failed)
			break;
		if (!keep_row(machine, &row))
			return report_no_memory(remote->where);
	}
	return in.failed || (*next && *next <= from) ? remote_fail(remote, DESK_NONSENSE) : STATUS_GOOD;
}

static enum status ask_all(struct remote *remote, struct remote_machine *machine)
{
	const struct timespec nap = { 0, 100000000 };
	bool ready = false;
	uint32_t next = 0;
	enum status status = ask(remote, machine, true, &next, &ready);

	for (int i = 0; status == STATUS_GOOD && !ready && i < LOOKS; i++) {
		nanosleep(&nap, NULL);
		next = 0;
		status = ask(remote, machine, false, &next, &ready);
	}
	while (status == STATUS_GOOD && next)
		status = ask(remote, machine, false, &next, &ready);
	return status == STATUS_GOOD && !ready ? remote_fail(remote, DESK_LATE) : status;
}

static void print_rows(const struct remote *remote, const struct remote_machine *machine)
{
	const struct sink *out = &remote->call->out;

	for (uint32_t i = 0; i < machine->count; i++)
		(remote->json ? json_row : print_row)(out, &machine->row[i], i == 0);
	if (remote->json)
		sink_text(out, machine->count ? "\n]\n" : "[]\n");
	else if (!machine->count)
		sink_text(out, "no GPIO lines and no analog devices\n");
}

enum status remote_devices(struct remote *remote)
{
	const struct call *call = remote->call;
	struct remote_machine machine = { .row = NULL };
	enum status status;

	if (call->arg_count > 3)
		return report_usage(call, "devices takes one MAP");
	status = ask_all(remote, &machine);
	if (status == STATUS_GOOD && call->arg_count == 3)
		status = remote_check_map(remote, call->arg[2], &machine);
	else if (status == STATUS_GOOD)
		print_rows(remote, &machine);
	free(machine.row);
	return status;
}
