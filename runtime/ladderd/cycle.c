/* SPDX-License-Identifier: MIT
 *
 * cycle - absolute deadlines, the watchdog, the latched fault. After a fault the outputs
 * have their safe values until a reset. A reset is refused while a line does not answer.
 */
#include "ladderd/control.h"
#include "ladderd/guarded.h"
#include "ladderd/link.h"

#include "hal/channels.h"

#include "engine/scan/interrupt.h"
#include "hal/clock.h"

#include <errno.h>
#include <stdatomic.h>
#include <stddef.h>
#include <string.h>
#include <time.h>

#define SLICE_NS 100000000  /* requests are checked at least so often */
#define TEND_NS  1000000000 /* in FAULT, time between attempts to repair lines */
#define SECOND   INT64_C(1000000000)
#define PERIOD   INT64_C(10000000) /* default of --period */

static int64_t clock_of_task(const struct resource *resource)
{
	(void)resource;
	return clock_now();
}

static const struct interrupts by_clock;

/* The limit of a scan with tasks is the sum of their limits. */
int64_t cycle_plan(struct cycle *cycle, int64_t period_ns, int64_t watchdog)
{
	struct resource *resource = &cycle->resource;
	const struct program *program = resource->image.program;
	int64_t limit_ns = 0;

	cycle->wanted_ns = period_ns;
	cycle->period_ns = tasks_tick(program, period_ns, PERIOD);
	cycle->watchdog = watchdog;
	wall_offset(&cycle->wall, 0); /* allocates at its first call */
	cycle->tasks = tasks_declared(program);
	if (!cycle->tasks) {
		safe_ask(NULL);
		return watchdog * cycle->period_ns;
	}
	resource->clock_ns = clock_of_task;
	resource->tick_ns = cycle->period_ns;
	resource->patience = (uint32_t)watchdog;
	resource->period_ns = period_ns ? period_ns : PERIOD;
	resource->interrupts =
		safe_ask(interrupt_levels(program) ? &resource->vm.ask : NULL) ?
			&by_clock : NULL;
	cycle->asked_ns = 0;
	for (uint32_t i = 0; i < program->task_count; i++)
		limit_ns += task_limit(&program->task[i], resource->patience,
				       resource->period_ns);
	return limit_ns;
}

void cycle_name(struct cycle *cycle, const char *name, const char *of_map)
{
	atomic_store_explicit(&cycle->board, *name ? name : of_map, memory_order_release);
}

static void note(const struct cycle *cycle, enum link_note what, int64_t now_ns)
{
	if (cycle_link(cycle))
		link_note(cycle_link(cycle), what, now_ns);
}

static void enter_fault(struct cycle *cycle, enum fault fault)
{
	resource_fail(&cycle->resource, fault);
	note(cycle, NOTE_FAULT, 0);
	hal_write_safe(&cycle->hal);
	cycle->tended_ns = clock_now();
	control_tell_fault(cycle);
	if (cycle->store)
		store_hurry(cycle->store);
	notify_send(&cycle->notify, "STATUS=FAULT, outputs are safe");
}

/* A chip that comes again may have another number. */
static bool guarded_reopen(struct cycle *cycle)
{
	const bool good = hal_reopen(&cycle->hal);

	guarded_lines(&cycle->hal);
	return good;
}

/* In FAULT: writes the safe values again, and reopens lines that were lost. */
static void tend_lines(struct cycle *cycle, int64_t now_ns)
{
	if (now_ns - cycle->tended_ns < TEND_NS)
		return;
	cycle->tended_ns = now_ns;
	hal_write_safe(&cycle->hal);
	if (hal_quality(&cycle->hal) == QUALITY_FAULT)
		guarded_reopen(cycle);
}

/* The program executed STOP. Only a reset starts it again. */
static void enter_stop(struct cycle *cycle)
{
	hal_write_safe(&cycle->hal);
	if (cycle_on_trial(cycle))
		cycle_pass(cycle);
	cycle->tended_ns = clock_now();
	control_tell_halt(cycle);
	if (cycle->store)
		store_hurry(cycle->store);
	notify_send(&cycle->notify, "STATUS=STOP, outputs are safe");
}

/* @cold: without retained values. */
static void start(struct cycle *cycle, bool cold)
{
	const int64_t now_ns = clock_now();

	resource_start(&cycle->resource);
	if (cycle->store && !cold)
		store_restore(cycle->store, &cycle->resource, now_ns);
	/* Retained values may be read before the first scan. */
	cycle->resource.vm.now_ns = now_ns + cycle->resource.timers_ns;
	note(cycle, NOTE_START, 0);
}

/* What desks have written since the last scan. In FAULT a scan may have been cut off. */
static void keep_written(struct cycle *cycle)
{
	if (cycle->store && cycle->resource.state != STATE_FAULT)
		store_keep(cycle->store, &cycle->resource.image);
}

/* From STOP or FAULT to RUN. */
static enum refusal restart(struct cycle *cycle, bool cold)
{
	struct resource *resource = &cycle->resource;

	if ((hal_quality(&cycle->hal) == QUALITY_FAULT &&
	     !guarded_reopen(cycle)) || !hal_write_safe(&cycle->hal))
		return REFUSAL_IO;
	if (cycle_on_trial(cycle))
		cycle_pass(cycle);
	keep_written(cycle);
	resource_stop(resource);
	start(cycle, cold);
	cycle->monitor.tripped = 0;
	cycle->late_row = 0;
	hal_release(&cycle->hal);
	cycle->stopped = NULL;
	notify_send(&cycle->notify, "STATUS=RUN");
	return REFUSAL_NONE;
}

static void reset(struct cycle *cycle)
{
	if (cycle->resource.state == STATE_RUN) {
		control_tell("in RUN, nothing to reset");
		return;
	}
	if (restart(cycle, false) != REFUSAL_NONE) {
		control_tell("no reset: a line does not answer");
		return;
	}
	cycle->resets++;
	control_tell("reset, RUN");
}

/* Ordered by a person: the outputs get their safe values now. */
static enum refusal stop(struct cycle *cycle)
{
	if (cycle->resource.state != STATE_RUN)
		return REFUSAL_NOT_NOW;
	if (cycle_on_trial(cycle))
		cycle_pass(cycle);
	keep_written(cycle);
	resource_stop(&cycle->resource);
	note(cycle, NOTE_STOP, 0);
	hal_write_safe(&cycle->hal);
	cycle->tended_ns = clock_now();
	if (cycle->store)
		store_hurry(cycle->store);
	control_tell("stopped by a desk, outputs are safe");
	notify_send(&cycle->notify, "STATUS=STOP, outputs are safe");
	return REFUSAL_NONE;
}

/* A board that was given no program has the identity of zeros. */
static bool has_program(const struct cycle *cycle)
{
	static const uint8_t none[sizeof(cycle->identity_bytes)];

	return memcmp(cycle->identity_bytes, none, sizeof(none)) != 0;
}

enum refusal cycle_mode(struct cycle *cycle, enum mode_wish wish)
{
	enum refusal refusal;

	if (wish == MODE_STOP)
		return stop(cycle);
	if (wish == MODE_RESET ? cycle->resource.state != STATE_FAULT :
				 cycle->resource.state != STATE_STOP)
		return REFUSAL_NOT_NOW;
	if (!has_program(cycle))
		return REFUSAL_NO_PROGRAM;
	refusal = restart(cycle, wish == MODE_COLD);
	if (refusal != REFUSAL_NONE)
		return refusal;
	cycle->resets += wish == MODE_RESET;
	control_tell(wish == MODE_RESET ? "reset by a desk, RUN" : "started by a desk, RUN");
	return REFUSAL_NONE;
}

static void serve_requests(struct cycle *cycle)
{
	struct requests *requests = cycle->requests;

	if (requests->status) {
		requests->status = 0;
		control_status(cycle, false);
	}
	if (requests->reset) {
		requests->reset = 0;
		reset(cycle);
	}
}

/* Runs the program without lines. Retained values are copied only after a whole scan. */
static bool scan_program(struct cycle *cycle, int64_t now_ns)
{
	struct resource *resource = &cycle->resource;
	struct store *store = cycle->store;
	int64_t begin_ns;
	bool good;

	note(cycle, NOTE_SCAN, now_ns);
	begin_ns = clock_now();
	good = resource_scan(resource, now_ns);
	stats_add(&cycle->body, clock_now() - begin_ns);
	cycle->words += resource->words;
	note(cycle, NOTE_SCANNED, 0);
	if (!good && !resource->halted)
		return false;
	if (store)
		store_take(store, &resource->image, resource->vm.now_ns);
	return true;
}

/* Reads inputs, runs the program, writes outputs. Returns the first fault. */
static enum fault scan_lines(struct cycle *cycle, int64_t now_ns)
{
	struct resource *resource = &cycle->resource;
	struct image *image = &resource->image;

	if (!ReadPhysicalInputs(&cycle->hal, image, now_ns))
		return FAULT_IO;
	resource->io_fault = hal_worst(&cycle->hal) != QUALITY_GOOD;
	resource_zone(resource, cycle->wall.zone_ns);
	resource_disk(resource, cycle->disk_bad || (cycle->store && store_error(cycle->store)));
	if (!scan_program(cycle, now_ns))
		return resource->fault;
	if (cycle->monitor.tripped)
		return FAULT_WATCHDOG;
	if (resource->halted)
		return hal_write_safe(&cycle->hal) ? FAULT_NONE : FAULT_IO;
	return WritePhysicalOutputs(&cycle->hal, image, now_ns) ? FAULT_NONE :
								  FAULT_IO;
}

/* Leaves out the periods that are over; how many. */
static int64_t skip_periods(struct cycle *cycle, int64_t now_ns)
{
	const int64_t missed = (now_ns - cycle->next_ns) / cycle->period_ns + 1;

	cycle->next_ns += missed * cycle->period_ns;
	return missed;
}

static void count_late(struct cycle *cycle, int64_t end_ns)
{
	cycle->resource.late = end_ns >= cycle->next_ns;
	if (!cycle->resource.late) {
		cycle->late_row = 0;
		return;
	}
	cycle->late += (uint64_t)skip_periods(cycle, end_ns);
	cycle->late_row++;
	if (cycle->late_row == cycle->late_limit)
		atomic_fetch_add_explicit(&cycle->late_rows, 1, memory_order_relaxed);
}

static bool is_too_slow(const struct cycle *cycle, int64_t took_ns)
{
	if (cycle->monitor.tripped || cycle->tasks)
		return cycle->monitor.tripped;
	return cycle->late_row >= cycle->watchdog ||
	       took_ns >= cycle->watchdog * cycle->period_ns;
}

/* Prints a message once per start; the status counts failed operations. */
static void tell_failed(struct cycle *cycle)
{
	const bool failed = cycle->resource.vm.errors != 0;

	if (failed && !cycle->failed)
		control_tell_failed(cycle);
	cycle->failed = failed;
}

/* ---- tasks that interrupt others: a cycle within a scan ---- */

static struct cycle *cycle_of(struct resource *resource)
{
	return (struct cycle *)((char *)resource - offsetof(struct cycle, resource));
}

static bool asks_clock(struct resource *resource, int64_t *now_ns)
{
	resource->vm.ask = 0;
	*now_ns = clock_now();
	return *now_ns >= cycle_of(resource)->next_ns;
}

static bool begin_inner(struct resource *resource, int64_t now_ns)
{
	struct cycle *cycle = cycle_of(resource);

	/* The one that begins now is not left out. */
	cycle->late += (uint64_t)skip_periods(cycle, now_ns) - 1;
	resource->due_ns = cycle->next_ns - cycle->period_ns;
	stats_add(&cycle->wake, now_ns - resource->due_ns);
	note(cycle, NOTE_INTERRUPTING, now_ns);
	notify_feed(&cycle->notify, now_ns);
	if (!ReadPhysicalInputs(&cycle->hal, &resource->image, now_ns))
		return false;
	note(cycle, NOTE_INTERRUPT, now_ns);
	return true;
}

/* When the watchdog has written the safe outputs, they stay. */
static bool end_inner(struct resource *resource, int64_t now_ns)
{
	struct cycle *cycle = cycle_of(resource);

	return cycle->monitor.tripped ||
	       WritePhysicalOutputs(&cycle->hal, &resource->image, now_ns);
}

static const struct interrupts by_clock = { asks_clock, begin_inner, end_inner, NULL };

/* The timer has the phase of the cycles; it changes when the program starts again. */
static void keep_phase(struct cycle *cycle)
{
	if (!cycle->resource.interrupts ||
	    (cycle->asked_ns && (cycle->next_ns - cycle->asked_ns) % cycle->period_ns == 0))
		return;
	cycle->asked_ns = cycle->next_ns;
	safe_ask_from(cycle->next_ns, cycle->period_ns);
}

static void scan_once(struct cycle *cycle, int64_t *due_ns)
{
	struct resource *resource = &cycle->resource;
	int64_t begin_ns = clock_now(), took_ns;
	enum fault fault;

	resource->due_ns = *due_ns;
	cycle->next_ns = *due_ns + cycle->period_ns;
	keep_phase(cycle);
	resource->wall_offset_ns = wall_offset(&cycle->wall, begin_ns);
	stats_add(&cycle->wake, begin_ns - *due_ns);
	monitor_begin(&cycle->monitor, begin_ns);
	fault = scan_lines(cycle, begin_ns);
	monitor_end(&cycle->monitor);
	took_ns = clock_now() - begin_ns;
	stats_add(&cycle->scan, took_ns);
	cycle->scans++;
	resource->scan_us = (uint32_t)(took_ns / 1000);
	if (resource->scan_us > resource->scan_max_us)
		resource->scan_max_us = resource->scan_us;
	count_late(cycle, begin_ns + took_ns);
	*due_ns = cycle->next_ns;
	if (fault == FAULT_NONE && is_too_slow(cycle, took_ns))
		fault = FAULT_WATCHDOG;
	if (fault != FAULT_NONE && cycle_on_trial(cycle))
		cycle_back(cycle, fault);
	else if (fault != FAULT_NONE)
		enter_fault(cycle, fault);
	else if (resource->halted)
		enter_stop(cycle);
	else if (cycle_on_trial(cycle) && --cycle->trial_left == 0)
		cycle_pass(cycle);
	tell_failed(cycle);
	control_trace_values(cycle);
}

/* Serves requests, and sleeps until @due_ns. What comes during the sleep waits for the next one, so that
 * the scan begins at once. */
static void wait_until(struct cycle *cycle, int64_t due_ns)
{
	for (;;) {
		int64_t now_ns = clock_now(), until_ns = due_ns;
		struct timespec until;

		notify_feed(&cycle->notify, now_ns);
		requests_attend(cycle->requests);
		serve_requests(cycle);
		if (cycle_link(cycle))
			link_serve(cycle_link(cycle));
		if (cycle->requests->stop || cycle->restart || now_ns >= due_ns)
			return;
		if (until_ns - now_ns > SLICE_NS)
			until_ns = now_ns + SLICE_NS;
		until.tv_sec = until_ns / SECOND;
		until.tv_nsec = until_ns % SECOND;
		if (cycle_link(cycle) && link_doze(cycle_link(cycle), until_ns))
			continue;
		cycle->clock_error = clock_nanosleep(CLOCK_MONOTONIC,
						     TIMER_ABSTIME, &until,
						     NULL);
		if (cycle_link(cycle))
			link_wake(cycle_link(cycle));
		if (cycle->clock_error == EINTR)
			cycle->clock_error = 0;
		else if (cycle->clock_error || until_ns == due_ns)
			return;
	}
}

static bool is_done(const struct cycle *cycle)
{
	if (cycle->requests->stop || cycle->restart || cycle->clock_error)
		return true;
	if (!cycle->most_scans)
		return false;
	return cycle->scans >= cycle->most_scans ||
	       cycle->resource.state != STATE_RUN;
}

int cycle_run(struct cycle *cycle)
{
	int64_t due_ns = clock_now();
	bool ready = false, was_fault = false;

	start(cycle, false);
	if (cycle->begin_stopped) {
		resource_stop(&cycle->resource);
		note(cycle, NOTE_STOP, 0);
	}
	while (!is_done(cycle)) {
		if (cycle->resource.state == STATE_RUN) {
			if (was_fault)
				due_ns = clock_now();
			was_fault = false;
			scan_once(cycle, &due_ns);
		} else {
			was_fault = true;
			keep_written(cycle);
			tend_lines(cycle, clock_now());
			due_ns = clock_now() + SLICE_NS;
		}
		if (cycle_link(cycle))
			link_show(cycle_link(cycle), cycle->resource.vm.now_ns);
		if (!ready)
			notify_send(&cycle->notify, "READY=1");
		ready = true;
		if (!is_done(cycle))
			wait_until(cycle, due_ns);
	}
	/* systemd kills a service that has said this and goes on. */
	if (!cycle->restart)
		notify_send(&cycle->notify, "STOPPING=1");
	serve_requests(cycle);
	keep_written(cycle);
	resource_stop(&cycle->resource);
	return cycle->resource.state == STATE_FAULT || cycle->clock_error;
}
