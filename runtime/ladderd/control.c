/* SPDX-License-Identifier: MIT
 *
 * control - prints `word: value` lines. It allocates nothing and uses no stdio stream.
 */
#include "ladderd/control.h"

#include "hal/channels.h"

#include "engine/base/version.h"
#include "engine/scan/interrupt.h"
#include "online/status.h"

#include <poll.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define BLOCK_BYTES 880 /* a pipe takes so much in one write */

struct block {
	char text[BLOCK_BYTES];
	size_t len;
};

static void add(struct block *block, const char *format, ...)
	__attribute__((format(printf, 2, 3)));

static void add(struct block *block, const char *format, ...)
{
	size_t room = sizeof(block->text) - block->len;
	va_list args;
	int len;

	va_start(args, format);
	len = vsnprintf(block->text + block->len, room, format, args);
	va_end(args);
	if (len > 0)
		block->len += (size_t)len < room ? (size_t)len : room - 1;
}

static void put(int fd, const char *text, size_t len, bool wait)
{
	struct pollfd ready = { .fd = fd, .events = POLLOUT };
	ssize_t done;

	if (!wait && poll(&ready, 1, 0) != 1)
		return;
	while (len > 0 && (done = write(fd, text, len)) > 0) {
		text += done;
		len -= (size_t)done;
		if (!wait)
			return;
	}
}

/* Microseconds with one decimal, without floating point. */
static void add_us(struct block *block, const char *word, int64_t ns)
{
	add(block, "%s %lld.%lld us", word, (long long)(ns / 1000),
	    (long long)(ns % 1000 / 100));
}

/* In nanoseconds, because a small program takes less than 0.1 us. */
static void add_fine(struct block *block, const struct stats *stats)
{
	add(block, "body: mean %lld ns, max %lld ns, p50 %lld ns\n",
	    (long long)stats_mean(stats), (long long)stats->max_ns,
	    (long long)stats_share(stats, 500));
}

static void add_times(struct block *block, const char *word,
		      const struct stats *stats)
{
	add_us(block, word, stats->last_ns);
	add_us(block, ", mean", stats_mean(stats));
	add_us(block, ", max", stats->max_ns);
	add_us(block, ", p99", stats_share(stats, 990));
	add_us(block, ", p50", stats_share(stats, 500));
	add_us(block, ", p99.9", stats_share(stats, 999));
	add(block, "\n");
}

static void add_place(struct block *block, const struct fault_place *at)
{
	if (at->rung == 0)
		return;
	add(block, ", %.60s rung %u", at->pou, (unsigned)at->rung);
	if (at->row)
		add(block, " (%u,%u)", (unsigned)at->row, (unsigned)at->col);
}

/* The line of an instruction list; the text of a fault has it already. */
static void add_line(struct block *block, const struct fault_place *at)
{
	if (at->line)
		add(block, ", %.60s line %u", at->pou, (unsigned)at->line);
}

static void add_state(struct block *block, const struct resource *resource)
{
	static const char *const state[] = {
		[STATE_STOP] = "STOP", [STATE_RUN] = "RUN",
		[STATE_FAULT] = "FAULT",
	};
	char fault[96];

	resource_fault_print(resource, fault, sizeof(fault));
	add(block, "state: %s\nfault: %s", state[resource->state], fault);
	add_place(block, &resource->fault_at);
	if (resource->halted) {
		add(block, "\nstop: the program says so");
		add_line(block, &resource->halt_at);
		add_place(block, &resource->halt_at);
	}
	add(block, "\nerrors: %u", (unsigned)resource->vm.errors);
	add_line(block, &resource->error_at);
	add_place(block, &resource->error_at);
	add(block, "\nforces: %d\n", resource->image.force_count);
}

static void add_io(struct block *block, const struct hal *hal)
{
	static const char *const quality[] = {
		[QUALITY_GOOD] = "good", [QUALITY_STALE] = "stale",
		[QUALITY_FAULT] = "fault",
	};
	const struct channels_count count = channels_tally(hal_channels(hal));

	add(block, "io: %s, %d lines in %u requests, %llu calls failed, "
	    "%llu reopened\n", quality[hal_worst(hal)], hal->map->count,
	    (unsigned)hal->request_count, (unsigned long long)hal->failed,
	    (unsigned long long)hal->reopened);
	if (count.good + count.stale + count.fault)
		add(block, "channels: %u good, %u stale, %u in fault\n", (unsigned)count.good,
		    (unsigned)count.stale, (unsigned)count.fault);
}

static void add_retain(struct block *block, const struct store *store)
{
	struct store_status status;

	if (!store)
		return;
	status = store_status(store);
	add(block, "retain: copy %u, %u values, %u writes, %u failed\n",
	    (unsigned)status.copy, (unsigned)status.values,
	    (unsigned)status.writes, (unsigned)status.failures);
}

/* Writes the block if it is half full. */
static void make_room(struct block *block, bool wait)
{
	if (block->len <= BLOCK_BYTES / 2)
		return;
	put(STDOUT_FILENO, block->text, block->len, wait);
	block->len = 0;
}

/* One line a task. */
static void put_tasks(const struct resource *resource, struct block *block,
		      bool wait)
{
	const struct program *program = resource->image.program;

	for (uint32_t i = 0; i < program->task_count; i++) {
		const struct code_task *task = &program->task[i];
		const struct task_state *state = &resource->tasks.state[i];
		const char *name = task_name(program, i);

		make_room(block, wait);
		if (*name)
			add(block, "task %.40s: ", name);
		else
			add(block, "task %u: ", (unsigned)i + 1);
		if (task->kind == TASK_INTERVAL)
			add_us(block, "every", task_interval(task));
		else
			add(block, "%s", task->kind == TASK_EVENT ? "on event" :
								    "in every cycle");
		add(block, ", runs %llu, overruns %llu",
		    (unsigned long long)state->runs,
		    (unsigned long long)state->overruns);
		add_us(block, ", last", state->last_ns);
		add_us(block, ", max", state->max_ns);
		if (task->kind == TASK_INTERVAL)
			add_us(block, ", waited", state->wait_ns);
		if (interrupt_can(program, i))
			add(block, ", interrupted %llu", (unsigned long long)state->interrupted);
		add(block, "\n");
	}
}

static void copy(char *out, size_t size, const struct block *block)
{
	const size_t len = block->len < size ? block->len : size - 1;

	memcpy(out, block->text, len);
	out[len] = '\0';
}

void control_print_fault(const struct resource *resource, char *out, size_t size)
{
	struct block block = { .len = 0 };
	char fault[96];

	resource_fault_print(resource, fault, sizeof(fault));
	add(&block, "%s", fault);
	add_place(&block, &resource->fault_at);
	copy(out, size, &block);
}

static void fill_places(const struct cycle *cycle, struct board_status *status)
{
	const struct resource *resource = &cycle->resource;
	struct block block = { .len = 0 };

	control_print_fault(resource, status->fault, sizeof(status->fault));
	if (resource->vm.errors) {
		add_line(&block, &resource->error_at);
		add_place(&block, &resource->error_at);
	}
	copy(status->error, sizeof(status->error), &block);
	block.len = 0;
	if (resource->halted) {
		add(&block, "the program says so");
		add_line(&block, &resource->halt_at);
		add_place(&block, &resource->halt_at);
	} else if (cycle->stopped && resource->state == STATE_STOP) {
		add(&block, "%s", cycle->stopped);
	}
	copy(status->stop, sizeof(status->stop), &block);
}

static void fill_tasks(const struct resource *resource, struct board_status *status)
{
	const struct program *program = resource->image.program;

	status->task_count = (uint8_t)program->task_count;
	for (uint32_t i = 0; i < program->task_count; i++) {
		const struct task_state *state = &resource->tasks.state[i];
		struct task_status *task = &status->task[i];

		snprintf(task->name, sizeof(task->name), "%.63s", task_name(program, i));
		task->interval_ns = task_interval(&program->task[i]);
		task->runs = state->runs;
		task->overruns = state->overruns;
		task->last_ns = state->last_ns;
		task->max_ns = state->max_ns;
		task->interrupted = state->interrupted;
		task->wait_ns = state->wait_ns;
	}
}

static uint32_t speed_of(const struct cycle *cycle)
{
	const uint64_t ns = (uint64_t)cycle->body.sum_ns, ms = ns / 1000000;
	/* In a second no board runs so many words that the product is too large. */
	const uint64_t speed = ms > 1000 ? cycle->words / ms : ns ? cycle->words * 1000000 / ns : 0;

	return speed < UINT32_MAX ? (uint32_t)speed : UINT32_MAX;
}

void control_fill_status(const struct cycle *cycle, struct board_status *status)
{
	const struct resource *resource = &cycle->resource;

	status->mode = (uint8_t)resource->state;
	status->io = (uint8_t)hal_worst(&cycle->hal);
	status->forces = (uint16_t)resource->image.force_count;
	memcpy(status->program, cycle->identity_bytes, sizeof(status->program));
	status->scans = cycle->scans;
	status->late = cycle->late;
	status->resets = cycle->resets;
	status->period_ns = cycle->period_ns;
	status->scan_mean_ns = stats_mean(&cycle->scan);
	status->scan_max_ns = cycle->scan.max_ns;
	status->scan_p999_ns = stats_share(&cycle->scan, 999);
	status->wake_mean_ns = stats_mean(&cycle->wake);
	status->wake_max_ns = cycle->wake.max_ns;
	status->wake_p999_ns = stats_share(&cycle->wake, 999);
	status->speed = speed_of(cycle);
	status->errors = resource->vm.errors;
	status->lines = (uint32_t)cycle->hal.map->count;
	status->io_failed = cycle->hal.failed;
	snprintf(status->board, sizeof(status->board), "%.63s", cycle_board(cycle));
	snprintf(status->version, sizeof(status->version), "%s", LADDER_VERSION);
	fill_places(cycle, status);
	fill_tasks(resource, status);
}

void control_status(const struct cycle *cycle, bool wait)
{
	struct block block = { .len = 0 };

	add_state(&block, &cycle->resource);
	add(&block, "scans: %llu\n", (unsigned long long)cycle->scans);
	add_us(&block, "period:", cycle->period_ns);
	add_times(&block, "\nscan: last", &cycle->scan);
	add_fine(&block, &cycle->body);
	add_times(&block, "wake-up: last", &cycle->wake);
	add(&block, "late: %llu\nresets: %llu\n",
	    (unsigned long long)cycle->late,
	    (unsigned long long)cycle->resets);
	make_room(&block, wait);
	if (cycle->tasks)
		put_tasks(&cycle->resource, &block, wait);
	add_io(&block, &cycle->hal);
	add_retain(&block, cycle->store);
	add(&block, "board: %.60s\nprogram: %s\n\n", cycle_board(cycle),
	    cycle->identity);
	put(STDOUT_FILENO, block.text, block.len, wait);
}

void control_tell(const char *text)
{
	struct block block = { .len = 0 };

	add(&block, "ladderd: %s\n", text);
	put(STDERR_FILENO, block.text, block.len, false);
}

void control_tell_error(const char *text, const char *why)
{
	char line[300];

	snprintf(line, sizeof(line), "%.80s: %.200s", text, why);
	control_tell(line);
}

void control_tell_halt(const struct cycle *cycle)
{
	char text[96];

	resource_halt_print(&cycle->resource, text, sizeof(text));
	control_tell(text);
}

void control_tell_failed(const struct cycle *cycle)
{
	struct block block = { .len = 0 };

	add(&block, "ladderd: an operation failed, ENO is FALSE");
	add_line(&block, &cycle->resource.error_at);
	add_place(&block, &cycle->resource.error_at);
	add(&block, "\n");
	put(STDERR_FILENO, block.text, block.len, false);
}

void control_tell_fault(const struct cycle *cycle)
{
	const struct resource *resource = &cycle->resource;
	struct block block = { .len = 0 };
	char fault[96];

	resource_fault_print(resource, fault, sizeof(fault));
	add(&block, "ladderd: FAULT, outputs are safe: %s", fault);
	add_place(&block, &resource->fault_at);
	add(&block, "\n");
	put(STDERR_FILENO, block.text, block.len, false);
}

void control_trace(void *context, const struct io_point *point, bool value)
{
	char text[24] = "%QX";
	size_t len = 3;
	uint32_t byte = point->addr.byte, unit = 1;

	(void)context;
	while (byte / unit >= 10)
		unit *= 10;
	for (; unit > 0; unit /= 10)
		text[len++] = (char)('0' + byte / unit % 10);
	text[len++] = '.';
	text[len++] = (char)('0' + point->addr.bit);
	text[len++] = ' ';
	text[len++] = value ? '1' : '0';
	text[len++] = '\n';
	put(STDERR_FILENO, text, len, false);
}

#ifndef RUNGBOARD_SMALL
static void trace_value(void *context, const struct io_point *point, enum iec_type type, union iec_value value,
			enum hal_quality quality)
{
	static const char *const word[] = { [QUALITY_GOOD] = "", [QUALITY_STALE] = " stale", [QUALITY_FAULT] = " fault",
		[QUALITY_FORCED] = " forced" };
	char address[24], number[48], text[96];
	int len;

	(void)context;
	iec_addr_print(point->addr, address, sizeof(address));
	iec_value_print(type, value, number, sizeof(number));
	len = snprintf(text, sizeof(text), "%s %s%s\n", address, number, word[quality]);
	put(STDERR_FILENO, text, (size_t)len, false);
}

void control_trace_values(struct cycle *cycle)
{
	if (cycle->hal.trace)
		channels_trace(hal_channels(&cycle->hal), &cycle->resource.image, trace_value, NULL);
}
#endif
