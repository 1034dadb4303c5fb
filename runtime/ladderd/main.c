/* SPDX-License-Identifier: MIT
 *
 * main - ladderd, the runtime: loads a program and an I/O map, opens the lines, scans until
 * a signal, and leaves the outputs at their safe values. It has no network, and needs only
 * the right to open the lines.
 */
#define _DEFAULT_SOURCE /* syscall() */
#include "engine/base/digest.h"
#include "engine/base/version.h"
#include "engine/scan/still.h"
#include "hal/clock.h"
#include "hal/drivers.h"
#include "hal/ports.h"
#include "ladderd/conf.h"
#include "ladderd/control.h"
#include "ladderd/download.h"
#include "ladderd/guarded.h"
#include "ladderd/link.h"
#include "ladderd/load.h"
#include "ladderd/options.h"

#include <errno.h>
#include <fcntl.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#define STACK_BYTES 8192 /* for a scan; -Wframe-larger-than limits frames */
#ifdef RUNGBOARD_SMALL
#define HINT(text)  "" /* it has no room for it */
#else
#define HINT(text)  text
#endif
#define PORTS_NS    INT64_C(10000000000) /* an adapter on USB needs some seconds after power comes */

struct daemon {
	struct options options;
	struct load load;
	struct slots slots;
	struct conf conf;
	struct cycle cycle;
	bool again;            /* a desk has ordered this start               */
};

static void print_diags(const struct diag_list *list)
{
	char text[600];

	for (int i = 0; i < list->count; i++) {
		diag_print(&list->diag[i], text, sizeof(text));
		fprintf(stderr, "%s\n", text);
	}
	if (list->dropped)
		fprintf(stderr, "ladderd: %d more messages\n", list->dropped);
}

static void print_all_diags(const struct daemon *daemon)
{
	print_diags(&daemon->load.source.diags);
	print_diags(&daemon->load.diags);
}

static void print_retained(struct daemon *daemon)
{
	uint32_t values, bytes;

	if (store_measure(&daemon->load.source.program, &daemon->load.arena,
			  &values, &bytes))
		printf("retain: %u bytes in %u values\n", (unsigned)bytes,
		       (unsigned)values);
}

static void print_memory(struct daemon *daemon)
{
	const struct load *load = &daemon->load;

	printf("code: %zu bytes\n", load->source.image_bytes);
	printf("data: %zu bytes\n", image_memory_size(&load->source.program));
	printf("hal: at most %zu bytes, %d lines\n", hal_memory(&load->map),
	       load->map.count);
	printf("runtime: %zu bytes\n", sizeof(*daemon) + SAFE_STACK_BYTES);
	print_retained(daemon);
	printf("stack: at most %d bytes\n", STACK_BYTES);
	printf("while loading: %zu bytes of text and translation more\n",
	       load->source.other_bytes);
}

/* Without --retain, RETAIN variables do not keep their values. */
static void warn_of_retain(struct daemon *daemon)
{
	const struct program *program = &daemon->load.source.program;
	bool retains = program->header->retain_size > 0;

	for (uint32_t i = 0; i < program->group_count; i++)
		if (program->group[i].flags & SYMBOL_RETAIN)
			retains = true;
	if (retains && !daemon->options.retain.path)
		diag_add(&daemon->load.diags, (struct diag){
			.id = DIAG_RETAIN_IGNORED,
			.file = daemon->options.file }, "%s", "");
}

/* Loading has touched all memory and more stack than a scan needs, so mlockall() locks
 * present pages. Without an MMU nothing is paged out, and the kernel has no mlockall().
 * sched_setscheduler() of musl always fails, so the system call is used. */
static void make_real_time(int priority)
{
	struct sched_param wanted = { .sched_priority = priority };

	const int policy = priority ? SCHED_FIFO : SCHED_OTHER;

	if (syscall(SYS_sched_setscheduler, 0, policy, &wanted) != 0)
		fprintf(stderr, "ladderd: no real-time priority: %s" HINT("; set LimitRTPRIO= of its service, or leave --rt out") "\n",
			strerror(errno));
	if (priority && mlockall(MCL_CURRENT | MCL_FUTURE) != 0)
		fprintf(stderr, "ladderd: memory is not locked: %s" HINT("; set LimitMEMLOCK=infinity in its service") "\n",
			strerror(errno));
}

/* Asks the kernel for no idle state of the processor that it is slow to leave, as long as the
 * file is open (Linux, "PM Quality Of Service Interface"). Returns the file, -1: not granted. */
static int hold_wake_up(void)
{
	static const char path[] = "/dev/cpu_dma_latency";
	const int32_t most_us = 0;
	const int file = open(path, O_WRONLY | O_CLOEXEC);

	if (file >= 0 && write(file, &most_us, sizeof(most_us)) == (ssize_t)sizeof(most_us))
		return file;
	fprintf(stderr, "ladderd: %s: %s; scans may begin later\n", path, strerror(errno));
	if (file >= 0)
		close(file);
	return -1;
}

static int run_lines(struct daemon *daemon, int64_t limit_ns)
{
	struct cycle *cycle = &daemon->cycle;
	int error, status = 1;

	error = monitor_start(&cycle->monitor, &cycle->hal, cycle->requests,
			      limit_ns);
	if (error) {
		fprintf(stderr, "ladderd: no watchdog timer: %s\n",
			strerror(-error));
		return status;
	}
	error = cycle->store ? store_begin(cycle->store) : 0;
	if (error)
		fprintf(stderr, "ladderd: no thread for --retain: %s\n",
			strerror(-error));
	if (!error && cycle_link(cycle)) {
		error = link_begin(cycle->link);
		if (error)
			fprintf(stderr, "ladderd: no thread for --link: %s\n",
				strerror(-error));
	}
	if (!error)
		status = cycle_run(cycle);
	monitor_stop(&cycle->monitor);
	hal_write_safe(&cycle->hal);
	if (cycle_link(cycle))
		link_close(cycle->link); /* its store may be another one */
	if (cycle->store)
		store_close(cycle->store); /* may wait for a slow disk */
	if (cycle->clock_error)
		fprintf(stderr, "ladderd: no clock: %s\n",
			strerror(cycle->clock_error));
	if (cycle->most_scans)
		control_status(cycle, true);
	return status;
}

static bool open_link(struct daemon *daemon)
{
	struct cycle *cycle = &daemon->cycle;
	const struct link_store store = {
		.slots = &daemon->slots, .conf = &daemon->conf, .retain = &daemon->options.retain,
		.program = &daemon->load.source.program, .arena = &daemon->load.arena,
		.map_text = daemon->load.map_text, .map_len = daemon->load.map_len,
		.record_kb = (uint32_t)daemon->options.record_kb,
	};

	cycle->link = link_open(&daemon->options, cycle, &store);
	return cycle->link;
}

/* When power comes, ladderd may be there before an adapter is. A desk that has ordered this start does not wait. */
static void await_ports(const struct daemon *daemon)
{
	const struct iomap *map = &daemon->load.map;
	const struct timespec nap = { 0, 100000000 };
	const int64_t end_ns = clock_now() + PORTS_NS;

	if (daemon->again || ports_check(map, NULL, NULL))
		return;
	fprintf(stderr, "ladderd: waits up to 10 s for a serial line of the map; no output is driven\n");
	notify_send(&daemon->cycle.notify, "STATUS=waits for a serial line of the map; no output is driven");
	while (clock_now() < end_ns && !requests_end() && !ports_check(map, NULL, NULL))
		nanosleep(&nap, NULL);
}

/* A guard that holds the lines gives them back at the last moment. */
static bool open_lines(struct daemon *daemon)
{
	struct hal *hal = &daemon->cycle.hal;
	struct load *load = &daemon->load;

	await_ports(daemon);
	if (!hal_plan(hal, &load->map, &load->arena, &load->diags))
		return false;
	guarded_lines(hal);
	guarded_take(hal);
	return hal_open_planned(hal, &load->diags);
}

static int run(struct daemon *daemon)
{
	const struct options *options = &daemon->options;
	struct load *load = &daemon->load;
	struct cycle *cycle = &daemon->cycle;
	const struct program *program = &load->source.program;
	bool settled = source_settle(&load->source);
	void *memory = arena_alloc(&load->arena, image_memory_size(program));
	void *stack = arena_alloc(&load->arena, SAFE_STACK_BYTES);
	int64_t limit_ns;
	int status, error, latency = -1;

	if (!settled || !memory || !stack) {
		fprintf(stderr, "ladderd: out of memory\n");
		return 1;
	}
	resource_init(&cycle->resource, program, memory);
	if (HAS_STILL)
		cycle->full_scan = options->full_scan;
	if (HAS_STILL && !cycle->full_scan)
		cycle->resource.still = still_new(program, STILL_LEAST, &load->arena, NULL);
	if (daemon->slots.empty) {
		memcpy(cycle->identity, "none", 5);
	} else {
		code_identity(program, cycle->identity_bytes);
		digest_hex(cycle->identity_bytes, sizeof(cycle->identity_bytes), cycle->identity);
	}
	cycle_name(cycle, options->name, load->map.board);
	cycle->late_limit = options->late;
	limit_ns = cycle_plan(cycle, options->period_ns, options->watchdog);
	cycle->most_scans = (uint64_t)options->scans;
	cycle->requests = requests_listen();
	cycle->requests->attended = options->attended;
	if (options->retain.path) {
		cycle->store = store_open(&options->retain,
					  &cycle->resource.image, &load->arena,
					  &status);
		if (!cycle->store)
			return status;
	}
	error = notify_open(&cycle->notify);
	if (error)
		fprintf(stderr, "ladderd: NOTIFY_SOCKET: %s\n",
			strerror(-error));
	if (!open_lines(daemon)) {
		print_diags(&load->diags);
		notify_close(&cycle->notify);
		if (cycle->store)
			store_close(cycle->store);
		cycle->restart = HAS_LINK && slots_reject(&daemon->slots);
		return 1;
	}
	if (HAS_LINK && (options->link || options->serial) && !open_link(daemon)) {
		hal_close(&cycle->hal);
		notify_close(&cycle->notify);
		if (cycle->store)
			store_close(cycle->store);
		return 1;
	}
	if (options->trace_io)
		cycle->hal.trace = control_trace;
	safe_on_crash(&cycle->hal, stack);
	if (options->priority || daemon->again) /* the start before may have had one */
		make_real_time((int)options->priority);
	if (options->priority && !options->no_pm_qos)
		latency = hold_wake_up();
	if (!options->priority)
		source_leave_code();
	requests_heed();
	status = run_lines(daemon, limit_ns);
	if (latency >= 0)
		close(latency);
	safe_on_crash(NULL, NULL);
	hal_close(&cycle->hal);
	notify_close(&cycle->notify);
	if (cycle_link(cycle))
		link_free(cycle->link);
	cycle->link = NULL;
	return status;
}

static int load_and_run(struct daemon *daemon)
{
	const struct options *options = &daemon->options;
	struct load *load = &daemon->load;
	bool good = slots_load(&daemon->slots, options, load, &daemon->cycle.begin_stopped);

	if (good && options->check)
		good = hal_supported(&load->map, &load->diags);
	if (good)
		warn_of_retain(daemon);
	print_all_diags(daemon);
	diag_init(&load->diags);
	if (!good)
		return load->unreadable ? 2 : 1;
	if (!options->check)
		return run(daemon);
	print_memory(daemon);
	return fflush(stdout) == 0 ? 0 : 1;
}

enum again { ONCE, AGAIN, AGAIN_STOPPED };

/* Once, from reading the options to the last safe output. @again: why it
 * begins; gets whether a desk wants another start. @stopped: why it does so in STOP; NULL. */
static int run_once(int argc, char **argv, enum again *again, const char *stopped)
{
	struct daemon *daemon;
	int status;

	requests_hold();
	daemon = calloc(1, sizeof(*daemon));
	if (daemon) {
		daemon->again = *again >= AGAIN;
		daemon->cycle.begin_stopped = *again == AGAIN_STOPPED || stopped;
		daemon->cycle.stopped = stopped;
	}
	*again = ONCE;
	if (!daemon) {
		fprintf(stderr, "ladderd: out of memory\n");
		return 1;
	}
	if (!options_read(&daemon->options, argc, argv)) {
		fprintf(stderr, "ladderd: %s %s\nTry `ladderd --help`.\n",
			daemon->options.wrong, daemon->options.why);
		status = 2;
	} else if (daemon->options.help) {
		status = fputs(options_help(), stdout) < 0;
	} else if (daemon->options.version) {
		status = printf("ladderd %s, takes %s, gpio through %s: %s\n",
				LADDER_VERSION, source_kinds(),
				gpio_library(), gpio_version()) < 0;
	} else {
		conf_load(&daemon->conf, &daemon->options);
		status = load_and_run(daemon);
		load_free(&daemon->load);
		slots_close(&daemon->slots);
		if (daemon->cycle.restart)
			*again = daemon->cycle.restart_stopped ? AGAIN_STOPPED : AGAIN;
	}
	free(daemon);
	return status;
}

int main(int argc, char **argv)
{
	const char *stopped = guarded_begin();
	enum again again = ONCE;
	int status;

	do {
		status = run_once(argc, argv, &again, stopped);
		stopped = NULL;
	} while (again != ONCE);
	return status;
}
