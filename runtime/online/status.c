/* SPDX-License-Identifier: MIT
 *
 * status - the fields of a board's status, written and read in one order.
 */
#include "online/status.h"

#include <string.h>

void status_put(struct wire_writer *out, const struct board_status *status)
{
	wire_put_u8(out, status->mode);
	wire_put_u8(out, status->io);
	wire_put_u16(out, status->forces);
	wire_put_bytes(out, status->program, sizeof(status->program));
	wire_put_u64(out, status->scans);
	wire_put_u64(out, status->late);
	wire_put_u64(out, status->resets);
	wire_put_i64(out, status->period_ns);
	wire_put_i64(out, status->scan_mean_ns);
	wire_put_i64(out, status->scan_max_ns);
	wire_put_i64(out, status->scan_p999_ns);
	wire_put_i64(out, status->wake_mean_ns);
	wire_put_i64(out, status->wake_max_ns);
	wire_put_i64(out, status->wake_p999_ns);
	wire_put_u32(out, status->errors);
	wire_put_u32(out, status->cpu_permille);
	wire_put_u64(out, status->memory_bytes);
	wire_put_u64(out, status->up_ms);
	wire_put_u32(out, status->sessions);
	wire_put_u32(out, status->lines);
	wire_put_u64(out, status->io_failed);
	wire_put_string(out, status->board);
	wire_put_string(out, status->version);
	wire_put_string(out, status->fault);
	wire_put_string(out, status->error);
	wire_put_string(out, status->stop);
	wire_put_u8(out, status->task_count);
	for (uint8_t i = 0; i < status->task_count; i++) {
		const struct task_status *task = &status->task[i];

		wire_put_string(out, task->name);
		wire_put_i64(out, task->interval_ns);
		wire_put_u64(out, task->runs);
		wire_put_u64(out, task->overruns);
		wire_put_i64(out, task->last_ns);
		wire_put_i64(out, task->max_ns);
	}
	wire_put_u8(out, status->next);
	wire_put_string(out, status->next_why);
	wire_put_string(out, status->disk);
	for (uint8_t i = 0; i < status->task_count; i++) {
		wire_put_u64(out, status->task[i].interrupted);
		wire_put_i64(out, status->task[i].wait_ns);
	}
	wire_put_u32(out, status->speed);
	wire_put_u8(out, status->began);
	wire_put_u16(out, status->began_how);
	wire_put_u32(out, status->began_ends);
}

bool status_has_program(const struct board_status *status)
{
	static const uint8_t none[sizeof(status->program)];

	return memcmp(status->program, none, sizeof(none)) != 0;
}

static void take_task(struct wire_reader *in, struct task_status *task)
{
	wire_copy_text(in, task->name, sizeof(task->name));
	task->interval_ns = wire_i64(in);
	task->runs = wire_u64(in);
	task->overruns = wire_u64(in);
	task->last_ns = wire_i64(in);
	task->max_ns = wire_i64(in);
}

void status_take(struct wire_reader *in, struct board_status *status)
{
	const uint8_t *program;

	memset(status, 0, sizeof(*status));
	status->mode = wire_u8(in);
	status->io = wire_u8(in);
	status->forces = wire_u16(in);
	program = wire_bytes(in, sizeof(status->program));
	if (program)
		memcpy(status->program, program, sizeof(status->program));
	status->scans = wire_u64(in);
	status->late = wire_u64(in);
	status->resets = wire_u64(in);
	status->period_ns = wire_i64(in);
	status->scan_mean_ns = wire_i64(in);
	status->scan_max_ns = wire_i64(in);
	status->scan_p999_ns = wire_i64(in);
	status->wake_mean_ns = wire_i64(in);
	status->wake_max_ns = wire_i64(in);
	status->wake_p999_ns = wire_i64(in);
	status->errors = wire_u32(in);
	status->cpu_permille = wire_u32(in);
	status->memory_bytes = wire_u64(in);
	status->up_ms = wire_u64(in);
	status->sessions = wire_u32(in);
	status->lines = wire_u32(in);
	status->io_failed = wire_u64(in);
	wire_copy_text(in, status->board, sizeof(status->board));
	wire_copy_text(in, status->version, sizeof(status->version));
	wire_copy_text(in, status->fault, sizeof(status->fault));
	wire_copy_text(in, status->error, sizeof(status->error));
	wire_copy_text(in, status->stop, sizeof(status->stop));
	status->task_count = wire_u8(in);
	if (status->task_count > LIMIT_TASKS) {
		status->task_count = 0;
		in->failed = true;
	}
	for (uint8_t i = 0; i < status->task_count; i++)
		take_task(in, &status->task[i]);
	if (!wire_left(in))
		return; /* a board of before these fields */
	status->next = wire_u8(in);
	wire_copy_text(in, status->next_why, sizeof(status->next_why));
	if (wire_left(in))
		wire_copy_text(in, status->disk, sizeof(status->disk));
	for (uint8_t i = 0; i < status->task_count && wire_left(in); i++) {
		status->task[i].interrupted = wire_u64(in);
		status->task[i].wait_ns = wire_i64(in);
	}
	if (wire_left(in))
		status->speed = wire_u32(in);
	if (!wire_left(in))
		return;
	status->began = wire_u8(in);
	status->began_how = wire_u16(in);
	status->began_ends = wire_u32(in);
}
