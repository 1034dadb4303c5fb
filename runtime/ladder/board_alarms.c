/* SPDX-License-Identifier: MIT
 *
 * board_alarms - `ladder board WHERE alarms`: the list of alarms; `alarms ack N`, `alarms ack all`.
 */
#include "ladder/foreign.h"
#include "ladder/remote.h"

#include "online/alarms.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

struct alarm_page {
	uint32_t active, waiting, lost, left_out;
	uint16_t count;
};

static void print_time(const struct sink *out, int64_t time_ns)
{
	const time_t seconds = (time_t)(time_ns / 1000000000);
	struct tm when = { 0 };
	char text[32] = "?";

	if (!time_ns)
		snprintf(text, sizeof(text), "-");
	else if (localtime_r(&seconds, &when))
		strftime(text, sizeof(text), "%Y-%m-%d %H:%M:%S", &when);
	sink_printf(out, "%-19s  ", text);
}

static void print_row(const struct remote *remote, const struct alarm_row *row)
{
	const struct sink *out = &remote->call->out;

	sink_printf(out, "%-6u  %-22s  %-7s  ", (unsigned)row->number,
		    alarm_state_word(row->state), alarm_class_word(row->class));
	print_time(out, row->came_ns);
	print_time(out, row->went_ns);
	print_time(out, row->acked_ns);
	foreign_text(out, row->name);
	if (row->times > 1)
		sink_printf(out, " (%u times)", (unsigned)row->times);
	if (*row->text) {
		sink_text(out, ": ");
		foreign_text(out, row->text);
	}
	if (*row->who) {
		sink_text(out, "; acknowledged by ");
		foreign_text(out, row->who);
	}
	sink_text(out, "\n");
}

static void json_time(const struct sink *out, const char *name, int64_t time_ns)
{
	if (time_ns)
		sink_printf(out, ", \"%s_ns\": %lld", name, (long long)time_ns);
	else
		sink_printf(out, ", \"%s_ns\": null", name);
}

static void print_json(const struct remote *remote, const struct alarm_row *row, bool first)
{
	const struct sink *out = &remote->call->out;

	sink_printf(out, "%s{\"number\": %u, \"times\": %u", first ? "\n  " : ",\n  ",
		    (unsigned)row->number, (unsigned)row->times);
	report_json_field("state", alarm_state_word(row->state), out);
	report_json_field("class", alarm_class_word(row->class), out);
	json_time(out, "came", row->came_ns);
	json_time(out, "went", row->went_ns);
	json_time(out, "acknowledged", row->acked_ns);
	report_json_field("name", row->name, out);
	report_json_field("message", row->text, out);
	report_json_field("by", *row->who ? row->who : NULL, out);
	sink_text(out, "}");
}

static bool take_page(struct wire_reader *in, struct alarm_page *page)
{
	page->active = wire_u32(in);
	page->waiting = wire_u32(in);
	page->lost = wire_u32(in);
	page->left_out = wire_u32(in);
	page->count = wire_u16(in);
	return !in->failed;
}

/* The rows from @next on, which moves behind them. */
static enum status ask_page(struct remote *remote, uint32_t *next, bool *any, struct alarm_page *page)
{
	struct wire_writer out = desk_ask(&remote->desk, SERVICE_ALARMS);
	struct wire_reader in;
	enum desk_end end;

	wire_put_u32(&out, *next);
	end = desk_call(&remote->desk, &out, &in);
	if (end != DESK_GOOD)
		return remote_fail(remote, end);
	if (!take_page(&in, page))
		return remote_fail(remote, DESK_NONSENSE);
	for (uint16_t i = 0; i < page->count; i++) {
		struct alarm_row row;

		alarm_read(&in, &row);
		if (in.failed || row.number < *next)
			return remote_fail(remote, DESK_NONSENSE);
		*next = row.number + 1;
		if (remote->json)
			print_json(remote, &row, !*any);
		else if (!*any)
			sink_printf(&remote->call->out, "%-6s  %-22s  %-7s  %-19s  %-19s  %-19s  %s\n", "number",
				    "state", "class", "came", "went", "acknowledged", "name: message");
		*any = true;
		if (!remote->json)
			print_row(remote, &row);
	}
	return STATUS_GOOD;
}

static enum status print_list(struct remote *remote)
{
	const struct sink *out = &remote->call->out;
	struct alarm_page page = { .count = 0 };
	enum status status;
	uint32_t next = 1;
	bool any = false;

	if (remote->json)
		sink_text(out, "[");
	do
		status = ask_page(remote, &next, &any, &page);
	while (status == STATUS_GOOD && page.count);
	if (remote->json)
		sink_text(out, "\n]\n");
	if (remote->json || status != STATUS_GOOD)
		return status;
	sink_printf(out, "%u active, %u to acknowledge\n", (unsigned)page.active,
		    (unsigned)page.waiting);
	if (page.lost)
		sink_printf(out, "alarms came %u times and found no room in the list of %u\n", (unsigned)page.lost,
			    (unsigned)ALARM_ROWS);
	if (page.left_out)
		sink_printf(out, "%u blocks are not watched: a board watches %u\n",
			    (unsigned)page.left_out, (unsigned)ALARM_MOST);
	return status;
}

/* 0: all. */
static enum status acknowledge(struct remote *remote, uint32_t number)
{
	struct wire_writer out = desk_ask(&remote->desk, SERVICE_ACK);
	struct wire_reader in;
	enum desk_end end;
	uint32_t count;

	wire_put_u32(&out, number);
	end = desk_call(&remote->desk, &out, &in);
	if (end != DESK_GOOD)
		return remote_fail(remote, end);
	count = wire_u32(&in);
	if (in.failed)
		return remote_fail(remote, DESK_NONSENSE);
	sink_printf(&remote->call->out, "%u acknowledged\n", (unsigned)count);
	return STATUS_GOOD;
}

enum status remote_alarms(struct remote *remote)
{
	const struct call *call = remote->call;
	char *end = NULL;
	unsigned long number;

	if (call->arg_count == 2)
		return print_list(remote);
	if (call->arg_count != 4 || strcmp(call->arg[2], "ack") != 0)
		return report_usage(call, "write alarms, alarms ack NUMBER or alarms ack all");
	if (strcmp(call->arg[3], "all") == 0)
		return acknowledge(remote, 0);
	number = strtoul(call->arg[3], &end, 10);
	if (!*call->arg[3] || *end || number == 0 || number > UINT32_MAX)
		return report_usage(call, "write alarms, alarms ack NUMBER or alarms ack all");
	return acknowledge(remote, (uint32_t)number);
}

void remote_print_alarms(struct remote *remote)
{
	const struct sink *out = &remote->call->out;
	struct wire_writer request = desk_ask(&remote->desk, SERVICE_ALARMS);
	struct alarm_page page;
	struct wire_reader in;
	bool told;

	wire_put_u32(&request, UINT32_MAX);
	told = desk_call(&remote->desk, &request, &in) == DESK_GOOD && take_page(&in, &page);
	if (!told) /* an older or a small board */
		sink_text(out, remote->json ? ", \"alarms\": null" : "");
	else
		sink_printf(out, remote->json ? ", \"alarms\": {\"active\": %u, \"to_acknowledge\": %u}" :
			    "alarms: %u active, %u to acknowledge\n", (unsigned)page.active,
			    (unsigned)page.waiting);
}
