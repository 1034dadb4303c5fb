/* SPDX-License-Identifier: MIT
 *
 * board_time - `ladder board WHERE time`: date and time of a board; `time set`, `time set WHEN`.
 */
#include "ladder/foreign.h"
#include "ladder/remote.h"

#include "online/board_time.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define SECOND INT64_C(1000000000)

enum what { ASK_TIME, SET_TIME, SET_ANYWAY };

/* An answer, and how far the board is ahead of this machine: at most @unsure_ns more or less. */
struct told {
	struct board_time time;
	int64_t ahead_ns, unsure_ns;
};

static int64_t now_of(clockid_t clock)
{
	struct timespec now;

	clock_gettime(clock, &now);
	return now.tv_sec * SECOND + now.tv_nsec;
}

/* @at_ns: of ASK_TIME, when the zone is wanted; else the new time. */
static enum status ask(struct remote *remote, enum what what, int64_t at_ns, struct told *out)
{
	struct wire_writer request = desk_ask(&remote->desk, SERVICE_TIME);
	const int64_t began_ns = now_of(CLOCK_MONOTONIC);
	struct wire_reader in;
	enum desk_end end;

	wire_put_u8(&request, (uint8_t)what);
	wire_put_i64(&request, at_ns);
	end = desk_call(&remote->desk, &request, &in);
	out->unsure_ns = (now_of(CLOCK_MONOTONIC) - began_ns + 1) / 2;
	out->ahead_ns = -(now_of(CLOCK_REALTIME) - out->unsure_ns);
	if (end != DESK_GOOD)
		return remote_fail(remote, end);
	board_time_take(&in, &out->time);
	if (in.failed)
		return remote_fail(remote, DESK_NONSENSE);
	out->ahead_ns += out->time.time_ns;
	return STATUS_GOOD;
}

/* "+01:00" */
static void print_zone(int32_t zone_s, const struct sink *out)
{
	const unsigned minutes = (unsigned)(zone_s < 0 ? -zone_s : zone_s) / 60;

	sink_printf(out, "%c%02u:%02u", zone_s < 0 ? '-' : '+', minutes / 60 % 100, minutes % 60);
}

static void print_json(const struct told *told, const struct sink *out)
{
	static const char *const sync[] = { "false", "true", "null" };

	sink_printf(out, "{\"time_ns\": %lld, \"zone_s\": %ld, \"zone\": ",
		    (long long)told->time.time_ns, (long)told->time.zone_s);
	sink_json_text(out, *told->time.zone ? told->time.zone : NULL);
	sink_printf(out, ", \"synchronised\": %s, \"ahead_ns\": %lld, \"unsure_ns\": %lld}\n",
		    sync[told->time.sync < SYNC_UNKNOWN ? told->time.sync : SYNC_UNKNOWN],
		    (long long)told->ahead_ns, (long long)told->unsure_ns);
}

static void print_told(const struct remote *remote, const struct told *told)
{
	const struct sink *out = &remote->call->out;
	const struct board_time *time = &told->time;
	const int64_t ahead_ms = told->ahead_ns / 1000000;
	char text[20];

	if (remote->json) {
		print_json(told, out);
		return;
	}
	board_time_print(time->time_ns, time->zone_s, text);
	sink_printf(out, "%s ", text);
	foreign_text(out, time->zone);
	sink_text(out, *time->zone ? " (UTC" : "(UTC");
	print_zone(time->zone_s, out);
	sink_printf(out, ")\n%s\n", time->sync == SYNC_YES ? "synchronised by a time server" :
		    time->sync == SYNC_NO ? "not synchronised" :
		    "synchronised or not: ladderd may not ask the kernel");
	if (ahead_ms <= told->unsure_ns / 1000000 + 1 && -ahead_ms <= told->unsure_ns / 1000000 + 1)
		sink_text(out, "the same as on this machine\n");
	else
		sink_printf(out, "%lld.%03lld s %s this machine\n", llabs(ahead_ms) / 1000,
			    llabs(ahead_ms) % 1000, ahead_ms > 0 ? "ahead of" : "behind");
}

/* Local time of the board at that date, in UTC: its zone may be another one than now. */
static enum status to_utc(struct remote *remote, int64_t local_ns, int64_t *utc_ns)
{
	struct told told;
	enum status status = ask(remote, ASK_TIME, local_ns, &told);

	if (status == STATUS_GOOD)
		status = ask(remote, ASK_TIME, local_ns - told.time.zone_s * SECOND, &told);
	*utc_ns = local_ns - told.time.zone_s * SECOND;
	return status;
}

static enum status set(struct remote *remote, const char *when)
{
	const enum what what = call_flag(remote->call, "--yes") ? SET_ANYWAY : SET_TIME;
	const bool now = !when || strcmp(when, "now") == 0;
	enum status status = STATUS_GOOD;
	struct told told = { .ahead_ns = 0 };
	int64_t time_ns = 0;
	bool utc = false;

	if (!now && !board_time_parse(when, &time_ns, &utc))
		return report_usage(remote->call, "%.30s is no date and time; write it as "
				    "2026-05-31 07:30:00", when);
	if (now)
		status = ask(remote, ASK_TIME, 0, &told); /* how long a request takes */
	else if (!utc)
		status = to_utc(remote, time_ns, &time_ns);
	if (now)
		time_ns = now_of(CLOCK_REALTIME) + told.unsure_ns;
	if (status == STATUS_GOOD)
		status = ask(remote, what, time_ns, &told);
	if (status == STATUS_GOOD)
		print_told(remote, &told);
	return status;
}

enum status remote_time(struct remote *remote)
{
	const struct call *call = remote->call;
	enum status status;
	struct told told;

	if (call->arg_count == 2) {
		status = ask(remote, ASK_TIME, 0, &told);
		if (status == STATUS_GOOD)
			print_told(remote, &told);
		return status;
	}
	if (call->arg_count > 4 || strcmp(call->arg[2], "set") != 0)
		return report_usage(call, "write time, time set or time set WHEN");
	return set(remote, call->arg_count == 4 ? call->arg[3] : NULL);
}
