/* SPDX-License-Identifier: MIT
 *
 * cmd_board - `ladder board`: a session with the program that runs on a board.
 */
#include "ladder/foreign.h"
#include "ladder/remote.h"

#include "engine/base/version.h"
#include "engine/trial/value.h"
#include "online/event.h"
#include "online/port.h"
#include "online/report.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define WATCH_US   100000
#define NAMES_MOST 2048

/* ---- values as text ---- */

static void print_value(const struct sink *out, enum iec_type type, union iec_value value)
{
	char text[IEC_VALUE_TEXT];

	iec_value_print(type, value, text, sizeof(text));
	sink_text(out, text);
}

/* Numbers and BOOLs are JSON's own; all other values are texts. */
static void print_json(const struct sink *out, enum iec_type type, union iec_value value)
{
	char text[IEC_VALUE_TEXT];
	const uint16_t class = iec_type_row(type)->class;

	iec_value_print(type, value, text, sizeof(text));
	if (type == IEC_BOOL)
		sink_text(out, value.i ? "true" : "false");
	else if (class & (ANY_INT | CLASS_BITS))
		sink_text(out, text);
	else
		sink_json_text(out, text);
}

/* ---- names ---- */

/* Reads the present values; this tells the types, too. */
static enum status look(struct remote *remote)
{
	struct wire_writer out = desk_ask(&remote->desk, SERVICE_READ);
	struct wire_reader in;
	enum desk_end end;

	wire_put_u16(&out, (uint16_t)remote->count);
	for (uint32_t i = 0; i < remote->count; i++) {
		wire_put_u8(&out, REF_NAME);
		wire_put_text(&out, remote->named[i].name, remote->named[i].len);
	}
	end = desk_call(&remote->desk, &out, &in);
	if (end != DESK_GOOD)
		return remote_fail(remote, end);
	wire_u8(&in);
	wire_u64(&in);
	wire_i64(&in);
	if (wire_u16(&in) != remote->count)
		return remote_fail(remote, DESK_NONSENSE);
	for (uint32_t i = 0; i < remote->count; i++) {
		struct named *named = &remote->named[i];

		named->flags = wire_u8(&in);
		named->type = (enum iec_type)wire_u8(&in);
		named->value = wire_value(&in, named->type, &named->text);
	}
	return in.failed ? remote_fail(remote, DESK_NONSENSE) : STATUS_GOOD;
}

/* Takes the arguments behind the action as names; @values: as NAME=VALUE. */
static enum status take_names(struct remote *remote, bool values)
{
	const struct call *call = remote->call;
	const int count = call->arg_count - 2;

	if (count < 1 || count > NAMES_MOST)
		return report_usage(call, "%.20s needs 1 to %d names", call->arg[1], NAMES_MOST);
	remote->named = calloc((size_t)count, sizeof(*remote->named));
	if (!remote->named)
		return report_no_memory(remote->where);
	for (int i = 0; i < count; i++) {
		struct named *named = &remote->named[i];

		named->name = call->arg[2 + i];
		named->len = strcspn(named->name, values ? "=" : "");
		if (values && (!named->len || !named->name[named->len]))
			return report_usage(call, "%.60s is not NAME=VALUE", named->name);
	}
	remote->count = (uint32_t)count;
	return look(remote);
}

static enum status take_values(struct remote *remote)
{
	enum status status = take_names(remote, true);

	for (uint32_t i = 0; i < remote->count && status == STATUS_GOOD; i++) {
		struct named *named = &remote->named[i];
		const char *text = named->name + named->len + 1;
		enum diag_id why;

		if (value_parse(named->type, text, strlen(text), &named->text, &named->value, &why))
			continue;
		report_diag((struct diag){ .id = why, .file = remote->where }, "%.100s", text);
		status = STATUS_NO;
	}
	return status;
}

/* ---- actions ---- */

static void json_status(const struct sink *out, const struct board_status *status,
			const struct desk *desk)
{
	char program[65], next[300];

	event_program(status->program, program);
	sink_text(out, "{\"board\": ");
	sink_json_text(out, status->board);
	report_json_field("mode", mode_word(status->mode), out);
	report_json_field("fault", status->fault, out);
	report_json_field("stop", *status->stop ? status->stop : NULL, out);
	status_next(status, event_text(status->next), next, sizeof(next));
	report_json_field("next_start", status->next ? next : NULL, out);
	status_began(status, event_text(status->began), next, sizeof(next));
	report_json_field("before_this_start", status->began ? next : NULL, out);
	report_json_field("disk", *status->disk ? status->disk : NULL, out);
	report_json_field("program", status_has_program(status) ? program : NULL, out);
	report_json_field("version", status->version, out);
	report_json_field("role", role_word(desk->role), out);
	sink_printf(out, ", \"forces\": %u, \"errors\": %u, \"scans\": %llu, \"missed\": %llu",
		    (unsigned)status->forces, (unsigned)status->errors,
		    (unsigned long long)status->scans, (unsigned long long)status->late);
	sink_printf(out, ", \"period_ns\": %lld, \"scan_mean_ns\": %lld, \"scan_max_ns\": %lld, "
		    "\"scan_p999_ns\": %lld", (long long)status->period_ns,
		    (long long)status->scan_mean_ns, (long long)status->scan_max_ns,
		    (long long)status->scan_p999_ns);
	sink_printf(out, ", \"late_mean_ns\": %lld, \"late_max_ns\": %lld, \"late_p999_ns\": %lld",
		    (long long)status->wake_mean_ns, (long long)status->wake_max_ns,
		    (long long)status->wake_p999_ns);
	sink_printf(out, ", \"lines\": %u, \"sessions\": %u, \"up_ms\": %llu, \"memory\": %llu",
		    (unsigned)status->lines, (unsigned)status->sessions,
		    (unsigned long long)status->up_ms, (unsigned long long)status->memory_bytes);
	sink_printf(out, ", \"cpu_permille\": %u, \"speed\": %u, \"tasks\": [",
		    (unsigned)status->cpu_permille, (unsigned)status->speed);
	for (int i = 0; i < status->task_count; i++) {
		const struct task_status *task = &status->task[i];

		sink_text(out, i ? ", {\"name\": " : "{\"name\": ");
		sink_json_text(out, task->name);
		sink_printf(out, ", \"runs\": %llu, \"missed\": %llu, \"last_ns\": %lld, "
			    "\"max_ns\": %lld, \"wait_ns\": %lld, \"interrupted\": %llu}",
			    (unsigned long long)task->runs,
			    (unsigned long long)task->overruns, (long long)task->last_ns,
			    (long long)task->max_ns, (long long)task->wait_ns,
			    (unsigned long long)task->interrupted);
	}
	sink_text(out, "]");
}

static enum status act_status(struct remote *remote)
{
	struct board_status *status = calloc(1, sizeof(*status));
	enum status result;

	if (!status)
		return report_no_memory(remote->where);
	result = remote_status(remote, status);
	if (result == STATUS_GOOD && remote->json)
		json_status(&remote->call->out, status, &remote->desk);
	else if (result == STATUS_GOOD)
		remote_print_status(remote, status);
	if (result == STATUS_GOOD)
		remote_print_alarms(remote);
	if (result == STATUS_GOOD)
		remote_print_gateways(remote);
	if (result == STATUS_GOOD && remote->json)
		sink_text(&remote->call->out, "}\n");
	free(status);
	return result;
}

/* One page of symbols. Returns the number of the next page's first one; 0: no more. */
static uint32_t print_symbols(const struct remote *remote, struct wire_reader *in, bool *any)
{
	const struct sink *out = &remote->call->out;
	const uint32_t next = wire_u32(in);
	const uint16_t count = wire_u16(in);

	for (uint16_t i = 0; i < count && !in->failed; i++) {
		size_t len, address_len;
		const char *name = wire_text(in, &len), *address;
		const enum iec_type type = (enum iec_type)wire_u8(in);

		wire_u8(in);
		wire_u32(in);
		address = wire_text(in, &address_len);
		if (in->failed || type >= IEC_TYPE_COUNT) {
			in->failed = true;
			break;
		}
		if (remote->json) {
			sink_text(out, *any ? ",\n  {\"name\": " : "\n  {\"name\": ");
			sink_json_string(out, name, len);
			report_json_field("type", iec_type_row(type)->word, out);
			sink_text(out, ", \"address\": ");
			sink_json_string(out, address, address_len);
			sink_text(out, "}");
		} else {
			foreign_write(out, name, len);
			sink_printf(out, "\t%s\t", iec_type_row(type)->word);
			foreign_write(out, address, address_len);
			sink_text(out, "\n");
		}
		*any = true;
	}
	return next;
}

static enum status act_symbols(struct remote *remote)
{
	uint32_t from = 0;
	bool any = false;

	if (remote->json)
		sink_text(&remote->call->out, "[");
	do {
		struct wire_writer out = desk_ask(&remote->desk, SERVICE_SYMBOLS);
		struct wire_reader in;
		enum desk_end end;
		uint32_t next;

		wire_put_u32(&out, from);
		end = desk_call(&remote->desk, &out, &in);
		if (end != DESK_GOOD)
			return remote_fail(remote, end);
		next = print_symbols(remote, &in, &any);
		if (in.failed || (next && next <= from))
			return remote_fail(remote, DESK_NONSENSE);
		from = next;
	} while (from);
	if (remote->json)
		sink_text(&remote->call->out, "\n]\n");
	return STATUS_GOOD;
}

/* "" for a value that is good and not forced; else a word or two, each behind @before. */
static void print_quality(const struct sink *out, uint8_t flags, const char *before)
{
	if (flags & VALUE_FORCED)
		sink_printf(out, "%sforced", before);
	if (flags & (VALUE_STALE | VALUE_FAULT))
		sink_printf(out, "%s%s", before, value_quality(flags));
}

static enum status act_get(struct remote *remote)
{
	const struct sink *out = &remote->call->out;
	const enum status status = take_names(remote, false);

	if (status != STATUS_GOOD)
		return status;
	for (uint32_t i = 0; i < remote->count; i++) {
		const struct named *named = &remote->named[i];

		if (remote->json) {
			sink_text(out, i ? ", " : "{");
			sink_json_text(out, named->name);
			sink_text(out, ": ");
			print_json(out, named->type, named->value);
			continue;
		}
		sink_text(out, named->name);
		sink_text(out, "=");
		print_value(out, named->type, named->value);
		print_quality(out, named->flags, " ");
		sink_text(out, "\n");
	}
	if (remote->json)
		sink_text(out, "}\n");
	return STATUS_GOOD;
}

/* ---- watch ---- */

static void print_row(struct remote *remote, uint64_t scan, int64_t now_ns)
{
	const struct sink *out = &remote->call->out;
	const bool csv = call_flag(remote->call, "--csv");

	sink_printf(out, csv ? "%llu,%lld.%03lld" : "%llu t=%lld.%03lld", (unsigned long long)scan,
		    (long long)((now_ns - remote->first_ns) / 1000000),
		    (long long)((now_ns - remote->first_ns) / 1000 % 1000));
	for (uint32_t i = 0; i < remote->count; i++) {
		const struct named *named = &remote->named[i];

		sink_text(out, csv ? "," : " ");
		if (!csv) {
			sink_text(out, named->name);
			sink_text(out, "=");
		}
		print_value(out, named->type, named->value);
		if (!csv)
			print_quality(out, named->flags, "!");
	}
	sink_text(out, "\n");
	report_flush(remote->call);
}

/* A message of the board: only changed values are in it. */
static void take_told(void *context, const struct frame *frame)
{
	struct remote *remote = context;
	struct wire_reader in = frame->body;
	uint64_t scan;
	int64_t now_ns;
	uint32_t lost;
	uint16_t count;

	if (frame->service != SERVICE_PUBLISH || wire_u8(&in) != 0)
		return;
	wire_u8(&in);
	scan = wire_u64(&in);
	now_ns = wire_i64(&in);
	lost = wire_u32(&in);
	count = wire_u16(&in);
	for (uint16_t i = 0; i < count && !in.failed; i++) {
		const uint16_t index = wire_u16(&in);
		struct named *named = index < remote->count ? &remote->named[index] : NULL;

		if (!named)
			return;
		named->flags = wire_u8(&in);
		named->value = wire_value(&in, named->type, &named->text);
	}
	if (in.failed)
		return;
	if (!remote->begun)
		remote->first_ns = now_ns;
	remote->begun = true;
	if (lost)
		report_diag((struct diag){ .id = DIAG_LINK_LOST, .file = remote->where }, "%u",
			    (unsigned)lost);
	print_row(remote, scan, now_ns);
	remote->lines++;
}

static bool read_number(const struct call *call, const char *name, uint64_t *out)
{
	const char *text = call_option(call, name);
	char *end;

	if (!text)
		return true;
	*out = strtoull(text, &end, 10);
	return *text >= '0' && *text <= '9' && !*end && *out > 0;
}

static enum status begin_watch(struct remote *remote)
{
	const char *period = call_option(remote->call, "--period");
	int64_t ns = INT64_C(1000) * WATCH_US;
	struct wire_writer out;
	struct wire_reader in;
	enum desk_end end;

	if (period && (value_parse_time(period, strlen(period), 0, &ns) != LITERAL_OK || ns < 1000))
		return report_usage(remote->call, "--period needs a time, such as 100ms");
	if (ns / 1000 > UINT32_MAX)
		return report_usage(remote->call, "--period is longer than an hour");
	out = desk_ask(&remote->desk, SERVICE_PUBLISH);
	wire_put_u32(&out, (uint32_t)(ns / 1000));
	wire_put_u8(&out, 0);
	wire_put_u16(&out, (uint16_t)remote->count);
	for (uint32_t i = 0; i < remote->count; i++)
		wire_put_name(&out, remote->named[i].name);
	remote->desk.told = take_told;
	remote->desk.context = remote;
	end = desk_call(&remote->desk, &out, &in);
	return end == DESK_GOOD ? STATUS_GOOD : remote_fail(remote, end);
}

static enum status act_watch(struct remote *remote)
{
	const struct sink *out = &remote->call->out;
	enum status status;
	enum desk_end end = DESK_GOOD;

	if (!read_number(remote->call, "--count", &remote->most))
		return report_usage(remote->call, "--count needs a number above 0");
	status = take_names(remote, false);
	if (status == STATUS_GOOD)
		status = begin_watch(remote);
	if (status != STATUS_GOOD)
		return status;
	if (call_flag(remote->call, "--csv")) {
		sink_text(out, "scan,ms");
		for (uint32_t i = 0; i < remote->count; i++) {
			sink_text(out, ",");
			sink_text(out, remote->named[i].name);
		}
		sink_text(out, "\n");
	}
	while ((end == DESK_GOOD || end == DESK_LATE) && !remote->call->out_failed &&
	       (!remote->most || remote->lines < remote->most))
		end = desk_listen(&remote->desk, 1000);
	return end == DESK_GOOD || end == DESK_LATE ? STATUS_GOOD : remote_fail(remote, end);
}

/* ---- changes ---- */

static enum status change_values(struct remote *remote, enum service service)
{
	enum status status = take_values(remote);
	struct wire_writer out;

	if (status == STATUS_GOOD)
		status = remote_begin(remote, service, &out);
	if (status != STATUS_GOOD)
		return status;
	wire_put_u16(&out, (uint16_t)remote->count);
	for (uint32_t i = 0; i < remote->count; i++) {
		const struct named *named = &remote->named[i];

		wire_put_u8(&out, REF_NAME);
		wire_put_text(&out, named->name, named->len);
		wire_put_u8(&out, (uint8_t)named->type);
		wire_put_value(&out, named->type, named->value);
	}
	return remote_finish(remote, &out);
}

static enum status act_set(struct remote *remote)
{
	return change_values(remote, SERVICE_WRITE);
}

static enum status act_force(struct remote *remote)
{
	return change_values(remote, SERVICE_FORCE);
}

static enum status act_unforce(struct remote *remote)
{
	enum status status = STATUS_GOOD;
	struct wire_writer out;

	if (remote->call->arg_count > 2)
		status = take_names(remote, false);
	if (status == STATUS_GOOD)
		status = remote_begin(remote, SERVICE_UNFORCE, &out);
	if (status != STATUS_GOOD)
		return status;
	wire_put_u16(&out, (uint16_t)remote->count);
	for (uint32_t i = 0; i < remote->count; i++)
		wire_put_name(&out, remote->named[i].name);
	return remote_finish(remote, &out);
}

static enum status act_forces(struct remote *remote)
{
	const struct sink *sink = &remote->call->out;
	struct wire_writer out = desk_ask(&remote->desk, SERVICE_FORCES);
	struct wire_reader in;
	const enum desk_end end = desk_call(&remote->desk, &out, &in);
	uint16_t count;

	if (end != DESK_GOOD)
		return remote_fail(remote, end);
	count = wire_u16(&in);
	if (remote->json)
		sink_text(sink, "{");
	for (uint16_t i = 0; i < count && !in.failed; i++) {
		struct iec_text text;
		union iec_value value, aside;
		enum iec_type type;
		const char *name;
		size_t len;

		wire_u32(&in);
		name = wire_text(&in, &len);
		type = (enum iec_type)wire_u8(&in);
		value = wire_value(&in, type, &text);
		aside = wire_value(&in, type, &text);
		if (in.failed)
			break;
		if (remote->json) {
			sink_text(sink, i ? ", " : "");
			sink_json_string(sink, name, len);
			sink_text(sink, ": ");
			print_json(sink, type, value);
			continue;
		}
		foreign_write(sink, name, len);
		sink_text(sink, "=");
		print_value(sink, type, value);
		sink_text(sink, " instead of ");
		print_value(sink, type, aside);
		sink_text(sink, "\n");
	}
	if (remote->json)
		sink_text(sink, "}\n");
	return in.failed ? remote_fail(remote, DESK_NONSENSE) : STATUS_GOOD;
}

/* ---- events ---- */

static void print_event(const struct remote *remote, const struct event *event, bool *any)
{
	const struct sink *out = &remote->call->out;
	const time_t seconds = (time_t)(event->time_ns / 1000000000);
	struct tm when = { 0 };
	char text[400], time_text[32] = "?";

	if (localtime_r(&seconds, &when))
		strftime(time_text, sizeof(time_text), "%Y-%m-%d %H:%M:%S", &when);
	event_print(event, text, sizeof(text));
	if (remote->json) {
		sink_printf(out, "%s{\"number\": %u, \"time_ns\": %lld, \"user\": ",
			    *any ? ",\n  " : "\n  ", (unsigned)event->seq,
			    (long long)event->time_ns);
		sink_json_text(out, *event->user ? event->user : NULL);
		report_json_field("event", text, out);
		sink_text(out, "}");
	} else {
		sink_printf(out, "%u %s ", (unsigned)event->seq, time_text);
		foreign_text(out, event->user);
		sink_text(out, *event->user ? " " : "");
		foreign_text(out, text);
		sink_text(out, "\n");
	}
	*any = true;
}

/* The events from @next on, which moves behind them. */
static enum status ask_events(struct remote *remote, uint32_t *next, bool *any)
{
	uint16_t count;

	do {
		struct wire_writer out = desk_ask(&remote->desk, SERVICE_EVENTS);
		struct wire_reader in;
		enum desk_end end;

		wire_put_u32(&out, *next);
		end = desk_call(&remote->desk, &out, &in);
		if (end != DESK_GOOD)
			return remote_fail(remote, end);
		count = wire_u16(&in);
		for (uint16_t i = 0; i < count; i++) {
			struct event event;

			event_take(&in, &event);
			if (in.failed || event.seq < *next)
				return remote_fail(remote, DESK_NONSENSE);
			*next = event.seq + 1;
			print_event(remote, &event, any);
		}
	} while (count);
	return STATUS_GOOD;
}

static enum status act_events(struct remote *remote)
{
	const bool follow = call_flag(remote->call, "--follow") && !remote->json;
	uint32_t next = 1;
	bool any = false;
	enum status status;

	if (remote->json)
		sink_text(&remote->call->out, "[");
	status = ask_events(remote, &next, &any);
	while (status == STATUS_GOOD && follow && !remote->call->out_failed) {
		const enum desk_end end = desk_listen(&remote->desk, 1000);

		if (end != DESK_GOOD && end != DESK_LATE)
			return remote_fail(remote, end);
		status = ask_events(remote, &next, &any);
		report_flush(remote->call);
	}
	if (remote->json)
		sink_text(&remote->call->out, "\n]\n");
	return status;
}

static enum status act_run(struct remote *remote)
{
	return remote_mode(remote, call_flag(remote->call, "--cold") ? MODE_COLD : MODE_WARM);
}

static enum status act_stop(struct remote *remote)
{
	return remote_mode(remote, MODE_STOP);
}

static enum status act_reset(struct remote *remote)
{
	return remote_mode(remote, MODE_RESET);
}

static const struct action {
	const char *word;
	bool names;                    /* takes arguments                      */
	enum status (*act)(struct remote *remote);
} actions[] = {
	{ "status", false, act_status },   { "symbols", false, act_symbols },
	{ "get", true, act_get },          { "watch", true, act_watch },
	{ "set", true, act_set },          { "force", true, act_force },
	{ "unforce", true, act_unforce },  { "forces", false, act_forces },
	{ "run", false, act_run },         { "stop", false, act_stop },
	{ "reset", false, act_reset },     { "download", true, remote_download },
	{ "upload", false, remote_upload }, { "events", false, act_events },
	{ "config", true, remote_config }, { "backup", false, remote_backup },
	{ "password", false, remote_password },
	{ "restore", true, remote_restore },
	{ "record", false, remote_record },
	{ "compare", true, remote_compare }, { "alarms", true, remote_alarms },
	{ "time", true, remote_time },     { "devices", true, remote_devices },
};

static enum status begin(struct remote *remote)
{
	const char *ssh = call_option(remote->call, "--ssh");
	struct stream stream;
	const int error = stream_open(&remote->to, ssh, &stream);
	enum desk_end end;

	if (error) {
		report_diag((struct diag){ .id = DIAG_BOARD_AWAY, .file = remote->where }, "%s",
			    remote->to.kind == STREAM_SERIAL ? port_why(error) :
							       strerror(-error));
		return STATUS_WRONG;
	}
	end = desk_open(&remote->desk, &stream, "ladder " LADDER_VERSION);
	return end == DESK_GOOD ? STATUS_GOOD : remote_fail(remote, end);
}

enum status cmd_board(struct call *call)
{
	struct remote *remote = calloc(1, sizeof(*remote));
	const struct action *action = NULL;
	const char *wrong;
	enum status status;

	if (!remote)
		return report_no_memory(call->arg[0]);
	remote->call = call;
	remote->where = call->arg[0];
	wrong = stream_parse(call->arg[0], &remote->to);
	remote->desk.stream.fd = -1;
	remote->json = call_flag(call, "--json");
	for (size_t i = 0; i < sizeof(actions) / sizeof(actions[0]); i++)
		if (strcmp(actions[i].word, call->arg[1]) == 0)
			action = &actions[i];
	if (wrong)
		status = report_usage(call, "%.60s: %s", call->arg[0], wrong);
	else if (!action)
		status = report_usage(call, "there is no action %.30s", call->arg[1]);
	else if (!action->names && call->arg_count > 2)
		status = report_usage(call, "%s takes no names", action->word);
	else
		status = begin(remote);
	if (status == STATUS_GOOD)
		status = action->act(remote);
	desk_close(&remote->desk);
	free(remote->named);
	free(remote);
	return status;
}
