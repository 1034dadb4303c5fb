/* SPDX-License-Identifier: MIT
 *
 * remote - what the actions of `ladder board` share: why a call failed, what runs on the board, its mode.
 */
#include "ladder/foreign.h"
#include "ladder/remote.h"

#include "engine/base/version.h"
#include "engine/scan/resource.h"
#include "online/event.h"

#include <stdlib.h>
#include <string.h>

enum status remote_fail(const struct remote *remote, enum desk_end end)
{
	struct diag diag = desk_diag(&remote->desk, end);

	diag.file = remote->where;
	report_diag(diag, "%s", diag.arg);
	return end == DESK_REFUSED ? STATUS_NO : STATUS_WRONG;
}

enum status remote_tell(const struct remote *remote, enum diag_id id)
{
	report_diag((struct diag){ .id = id, .file = remote->where }, "%s", "");
	return STATUS_WRONG;
}

enum status remote_status(struct remote *remote, struct board_status *status)
{
	struct wire_writer out = desk_ask(&remote->desk, SERVICE_STATUS);
	struct wire_reader in;
	const enum desk_end end = desk_call(&remote->desk, &out, &in);

	if (end != DESK_GOOD)
		return remote_fail(remote, end);
	status_take(&in, status);
	if (in.failed)
		return remote_fail(remote, DESK_NONSENSE);
	remote->expect.mode = status->mode;
	memcpy(remote->expect.program, status->program, sizeof(status->program));
	return STATUS_GOOD;
}

bool remote_peek(struct remote *remote, struct board_status *status)
{
	struct wire_writer out = desk_ask(&remote->desk, SERVICE_STATUS);
	struct wire_reader in;

	if (desk_call(&remote->desk, &out, &in) != DESK_GOOD)
		return false;
	status_take(&in, status);
	return !in.failed;
}

enum status remote_expect(struct remote *remote, bool mode)
{
	struct board_status *status = calloc(1, sizeof(*status));
	const enum status result = status ? remote_status(remote, status) :
					    report_no_memory(remote->where);

	free(status);
	if (!mode)
		remote->expect.mode = EXPECT_ANY;
	return result;
}

static void print_us(const struct sink *out, const char *word, int64_t ns)
{
	sink_printf(out, "%s%lld.%lld us", word, (long long)(ns / 1000),
		    (long long)(ns % 1000 / 100));
}

static void print_starts(const struct sink *out, const struct board_status *status)
{
	char text[300];

	if (status->began) {
		status_began(status, event_text(status->began), text, sizeof(text));
		sink_text(out, "\nbefore this start: ");
		foreign_text(out, text);
	}
	if (status->next) {
		status_next(status, event_text(status->next), text, sizeof(text));
		sink_text(out, "\nnext start: ");
		foreign_text(out, text);
	}
}

void remote_print_status(const struct remote *remote, const struct board_status *status)
{
	const struct sink *out = &remote->call->out;
	char program[65];

	event_program(status->program, program);
	sink_text(out, "board: ");
	foreign_text(out, status->board);
	sink_text(out, "\nmode: ");
	sink_text(out, mode_word(status->mode));
	sink_text(out, "\nfault: ");
	foreign_text(out, status->fault);
	if (*status->stop) {
		sink_text(out, "\nstop: ");
		foreign_text(out, status->stop);
	}
	print_starts(out, status);
	if (*status->disk) {
		sink_text(out, "\ndisk: ");
		foreign_text(out, status->disk);
	}
	sink_printf(out, "\nforces: %u\nfailed operations: %u", (unsigned)status->forces,
		    (unsigned)status->errors);
	foreign_text(out, status->error);
	sink_printf(out, "\nscans: %llu\n", (unsigned long long)status->scans);
	print_us(out, "period: ", status->period_ns);
	print_us(out, "\nscan: mean ", status->scan_mean_ns);
	print_us(out, ", longest ", status->scan_max_ns);
	print_us(out, ", p99.9 ", status->scan_p999_ns);
	if (status->speed)
		sink_printf(out, "\nspeed: %u words/ms", (unsigned)status->speed);
	print_us(out, "\nlateness: mean ", status->wake_mean_ns);
	print_us(out, ", longest ", status->wake_max_ns);
	print_us(out, ", p99.9 ", status->wake_p999_ns);
	sink_printf(out, "\nmissed scans: %llu\n", (unsigned long long)status->late);
	for (int i = 0; i < status->task_count && *status->task[0].name; i++) {
		const struct task_status *task = &status->task[i];

		sink_text(out, "task ");
		foreign_text(out, task->name);
		sink_printf(out, ": runs %llu, missed %llu", (unsigned long long)task->runs,
			    (unsigned long long)task->overruns);
		print_us(out, ", last ", task->last_ns);
		print_us(out, ", longest ", task->max_ns);
		if (task->wait_ns)
			print_us(out, ", waited ", task->wait_ns);
		if (task->interrupted)
			sink_printf(out, ", interrupted %llu",
				    (unsigned long long)task->interrupted);
		sink_text(out, "\n");
	}
	sink_printf(out, "lines: %u, %s, %llu calls failed\n", (unsigned)status->lines,
		    status->io == 0 ? "good" : status->io == 1 ? "stale" : "fault",
		    (unsigned long long)status->io_failed);
	sink_printf(out, "processor: %u.%u %%\nmemory: %llu KB\nup: %llu s\nsessions: %u\n",
		    (unsigned)(status->cpu_permille / 10), (unsigned)(status->cpu_permille % 10),
		    (unsigned long long)(status->memory_bytes / 1024),
		    (unsigned long long)(status->up_ms / 1000), (unsigned)status->sessions);
	sink_text(out, "program: ");
	sink_text(out, program);
	sink_text(out, "\nladderd: ");
	foreign_text(out, status->version);
	sink_text(out, "\nyou may: ");
	sink_text(out, role_word(remote->desk.role));
	sink_text(out, "\n");
}

enum status remote_finish(struct remote *remote, struct wire_writer *out)
{
	struct wire_reader in;
	const enum desk_end end = desk_call(&remote->desk, out, &in);

	return end == DESK_GOOD ? STATUS_GOOD : remote_fail(remote, end);
}

enum status remote_begin(struct remote *remote, enum service service, struct wire_writer *out)
{
	const enum status status = remote_expect(remote, service == SERVICE_MODE);

	if (status != STATUS_GOOD)
		return status;
	*out = desk_ask(&remote->desk, service);
	wire_put_expect(out, &remote->expect);
	return STATUS_GOOD;
}

enum status remote_mode(struct remote *remote, enum mode_wish wish)
{
	struct wire_writer out;
	const enum status status = remote_begin(remote, SERVICE_MODE, &out);

	if (status != STATUS_GOOD)
		return status;
	wire_put_u8(&out, (uint8_t)wish);
	return remote_finish(remote, &out);
}

enum status remote_stop(struct remote *remote)
{
	struct board_status *now = calloc(1, sizeof(*now));
	enum status status = now ? remote_status(remote, now) : report_no_memory(remote->where);

	if (status == STATUS_GOOD && now->mode == STATE_RUN)
		status = remote_mode(remote, MODE_STOP);
	free(now);
	return status;
}

bool remote_again(struct remote *remote)
{
	struct stream stream;

	desk_close(&remote->desk);
	remote->desk.stream.fd = -1;
	return stream_open(&remote->to, call_option(remote->call, "--ssh"), &stream) == 0 &&
	       desk_open(&remote->desk, &stream, "ladder " LADDER_VERSION) == DESK_GOOD;
}
