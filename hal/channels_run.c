/* SPDX-License-Identifier: MIT
 *
 * channels_run - finds and opens the devices of a map, and the threads that read and write them.
 */
#define _GNU_SOURCE /* eventfd, PTHREAD_STACK_MIN */
#include "hal/channel_cell.h"
#include "hal/clock.h"
#include "hal/sysfs.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/eventfd.h>
#include <time.h>
#include <unistd.h>

#define STACK_LEAST (128 * 1024)  /* a library lists its devices on it       */
#define SEARCH_NS   500000000     /* between two searches for a device that is gone */
#define RETRY_NS    100000000     /* … two tries to write                    */
#define FIRST_NS    1000000000    /* for the first values                    */
#define END_NS      2000000000    /* for a thread to end                     */

static void nap(void)
{
	const struct timespec ms = { 0, 1000000 };

	nanosleep(&ms, NULL);
}

/* ---- for drivers ---- */

bool channels_supported(enum driver_id id)
{
	return !device_driver(id) || device_driver(id)->find;
}

static void end_search(struct device_search *search)
{
	for (int id = 0; id < DRIVER_COUNT; id++) {
		const struct device_driver *driver = device_driver((enum driver_id)id);

		if (driver && driver->end)
			driver->end(search);
	}
}

void channels_list(const char *sys, device_visit *visit, void *context)
{
	struct device_search search = { .sys = sys ? sys : "/sys" };

	iio_list(&search, visit, context);
	pwm_list(&search, visit, context);
	w1_list(&search, visit, context);
	hwmon_list(&search, visit, context);
	end_search(&search);
}

/* ---- the threads ---- */

void channels_wake(const struct channels *channels, const struct cell *cell)
{
	const int number = channels->runner_of[cell - channels->cell];
	const uint64_t one = 1;

	if (number >= 0 && channels->runner[number].wake >= 0 &&
	    write(channels->runner[number].wake, &one, sizeof(one)) < 0)
		return; /* it is full: the thread wakes anyway */
}

/* 0 or -errno. The number of the open file stays the same. */
static int open_file(struct cell *cell)
{
	const int fresh = open(cell->device.path, O_WRONLY | O_CLOEXEC);
	int error = 0;

	if (fresh < 0)
		return -errno;
	if (cell->file < 0) {
		cell->file = fresh;
		return 0;
	}
	if (dup3(fresh, cell->file, O_CLOEXEC) < 0)
		error = -errno;
	close(fresh);
	return error;
}

/* A range without a unit, and a whole number without a range, are the numbers of the device. */
static void without_unit(struct cell *cell)
{
	const struct io_channel *channel = &cell->channel;

	if (channel->unit != UNIT_NONE && (channel->scaled || channel->switches ||
					   iec_type_row(channel->type)->class & CLASS_REAL))
		return;
	if (!channel->scaled && iec_type_row(channel->type)->class & CLASS_REAL)
		return;
	cell->device.scale = 1;
	cell->device.offset = 0;
}

/* A device may come back with another number. Until then it is searched for now and then. */
static bool search_again(const struct channels *channels, struct cell *cell, int64_t now_ns)
{
	struct device_search search = { .sys = channels->sys };
	struct device found = { .scale = 1 };
	struct trouble why;
	bool good;

	if (now_ns - cell->found_ns < SEARCH_NS)
		return false;
	cell->found_ns = now_ns;
	good = cell->driver->find(&search, &cell->point, &found, &why);
	end_search(&search);
	if (!good)
		return false;
	found.last = cell->device.last;
	found.has_last = cell->device.has_last;
	cell->device = found;
	without_unit(cell);
	return true;
}

/* Finds it, makes it ready and opens it. */
static bool reopen(const struct channels *channels, struct cell *cell)
{
	struct trouble why;

	return search_again(channels, cell, clock_now()) &&
	       (!cell->driver->take ||
		cell->driver->take(&cell->device, &cell->point,
				   cell_number(&cell->device, cell_output(channels, cell)), &why)) &&
	       open_file(cell) == 0;
}

static void read_input(const struct channels *channels, struct cell *cell)
{
	char text[SYSFS_TEXT];
	double number = 0;
	const int error = sysfs_read(cell->device.path, text, sizeof(text));
	const bool good = !error && cell->driver->parse(&cell->device, text, &number);
	const double value = (number + cell->device.offset) * cell->device.scale;

	if (atomic_load_explicit(&channels->ending, memory_order_acquire))
		return;
	if (good) {
		cell->device.last = number;
		cell->device.has_last = true;
	}
	cell_put(cell, bits_of(value), good, clock_now());
	if (error)
		search_again(channels, cell, clock_now());
}

/* What is wanted may change while it is written. */
static void write_output(const struct channels *channels, struct cell *cell)
{
	uint32_t asks;
	int error;

	do {
		const double raw = (asks = atomic_load_explicit(&cell->asks, memory_order_acquire),
				    cell_output(channels, cell));

		atomic_store_explicit(&cell->writing_ns, clock_now(), memory_order_seq_cst);
		error = cell->file < 0 ? -ENODEV : cell_write(cell, cell_number(&cell->device, raw));
		atomic_store_explicit(&cell->writing_ns, 0, memory_order_release);
		cell_put(cell, bits_of(raw), error == 0, clock_now());
	} while (!error && asks != atomic_load_explicit(&cell->asks, memory_order_acquire));
	cell->written = error ? asks - 1 : asks;
	cell->next_ns = clock_now() + RETRY_NS;
	if (error)
		reopen(channels, cell);
}

/* When the cell is due; it is done if that is now. */
static int64_t tend_cell(const struct channels *channels, struct cell *cell)
{
	const int64_t now_ns = clock_now();

	if (cell->point.output) {
		if (!channels->active && !cell->leaves)
			return INT64_MAX;
		if (cell->written == atomic_load_explicit(&cell->asks, memory_order_acquire))
			return INT64_MAX;
		if (!cell->failures || now_ns >= cell->next_ns)
			write_output(channels, cell);
		return cell->written == atomic_load_explicit(&cell->asks, memory_order_acquire) ?
			INT64_MAX : cell->next_ns;
	}
	if (now_ns < cell->next_ns)
		return cell->next_ns;
	read_input(channels, cell);
	cell->next_ns += cell->channel.poll_ns;
	if (cell->next_ns < clock_now())
		cell->next_ns = clock_now() + cell->channel.poll_ns;
	return cell->next_ns;
}

static void leave(struct channels *channels)
{
	if (atomic_fetch_sub_explicit(&channels->users, 1, memory_order_acq_rel) != 1)
		return;
	for (int i = 0; i < channels->count; i++)
		if (channels->cell[i].file >= 0)
			close(channels->cell[i].file);
	for (int i = 0; i < channels->runner_count; i++)
		if (channels->runner[i].wake >= 0)
			close(channels->runner[i].wake);
	arena_free(&channels->arena);
	free(channels);
}

static void *run(void *of)
{
	struct runner *runner = of;
	struct channels *channels = runner->of;

	while (!atomic_load_explicit(&channels->ending, memory_order_acquire)) {
		struct pollfd wake = { .fd = runner->wake, .events = POLLIN };
		int64_t due_ns = INT64_MAX, left_ns;
		uint64_t count;

		for (int i = 0; i < channels->count; i++)
			if (channels->runner_of[i] == runner->number) {
				const int64_t next_ns = tend_cell(channels, &channels->cell[i]);

				due_ns = next_ns < due_ns ? next_ns : due_ns;
			}
		left_ns = due_ns == INT64_MAX ? INT64_C(1000000000) : due_ns - clock_now();
		if (left_ns > 0 && poll(&wake, 1, (int)((left_ns + 999999) / 1000000)) > 0 &&
		    read(runner->wake, &count, sizeof(count)) < 0)
			continue;
	}
	leave(channels);
	return NULL;
}

/* Signals are for the thread of the scan, except those of a crash. */
static bool start_thread(struct runner *runner, pthread_attr_t *attr)
{
	static const int own[] = { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT };
	sigset_t all, before;
	pthread_t thread;
	int error;

	sigfillset(&all);
	for (size_t i = 0; i < sizeof(own) / sizeof(own[0]); i++)
		sigdelset(&all, own[i]);
	atomic_fetch_add(&runner->of->users, 1);
	pthread_sigmask(SIG_SETMASK, &all, &before);
	error = pthread_create(&thread, attr, run, runner);
	pthread_sigmask(SIG_SETMASK, &before, NULL);
	if (error)
		atomic_fetch_sub(&runner->of->users, 1);
	return error == 0;
}

static bool start_threads(struct channels *channels)
{
	const long least = PTHREAD_STACK_MIN; /* not constant in glibc */
	pthread_attr_t attr;
	bool good = true;

	if (pthread_attr_init(&attr) != 0)
		return false;
	pthread_attr_setstacksize(&attr, least > STACK_LEAST ? (size_t)least : STACK_LEAST);
	pthread_attr_setinheritsched(&attr, PTHREAD_EXPLICIT_SCHED);
	pthread_attr_setdetachstate(&attr, PTHREAD_CREATE_DETACHED);
	for (int i = 0; i < channels->runner_count && good; i++) {
		channels->runner[i].wake = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
		good = channels->runner[i].wake >= 0 && start_thread(&channels->runner[i], &attr);
	}
	pthread_attr_destroy(&attr);
	return good;
}

/* ---- planning ---- */

static bool no_memory(const struct iomap *map, struct diag_list *diags)
{
	return diag_add(diags, (struct diag){ .id = DIAG_NO_MEMORY, .file = map->file }, "%s", "");
}

static const char *copy_text(struct arena *arena, const char *text)
{
	return text ? arena_copy(arena, text, strlen(text)) : NULL;
}

static void make_cell(struct channels *channels, const struct iomap *map, int number)
{
	struct cell *cell = &channels->cell[channels->count];

	cell->point = map->point[number];
	cell->channel = *map->point[number].channel;
	cell->point.channel = &cell->channel;
	cell->channel.device = copy_text(&channels->arena, cell->channel.device);
	cell->channel.name = copy_text(&channels->arena, cell->channel.name);
	cell->number = number;
	cell->driver = device_driver(cell->point.driver);
	cell->safe = channel_raw(&cell->channel, cell->channel.safe);
	if (cell->point.active_low && cell->channel.type == IEC_BOOL)
		cell->safe = channel_raw(&cell->channel,
					 (union iec_value){ .i = !cell->channel.safe.i });
	cell->file = -1;
	cell->device.scale = 1;
	cell->quality = QUALITY_STALE;
	channels->of_point[number] = channels->count++;
}

/* The cells that have bits of what a cell of the driver quality tells about. */
static void join_quality(struct channels *channels, struct cell *cell)
{
	const struct iec_addr of = cell->channel.of;
	const uint32_t first = 8 * of.byte + of.bit, behind = first + cell->channel.of_bits;

	cell->of = arena_alloc(&channels->arena, sizeof(int) * (size_t)channels->count);
	for (int i = 0; cell->of && i < channels->count; i++) {
		const struct iec_addr addr = channels->cell[i].point.addr;
		const uint32_t bit = 8 * addr.byte + addr.bit;

		if (addr.area == of.area && bit < behind && first < bit + addr.bits)
			cell->of[cell->of_count++] = i;
	}
}

static struct channels *make_channels(const struct iomap *map, int count)
{
	struct channels *channels = calloc(1, sizeof(*channels));
	struct arena *arena;

	if (!channels)
		return NULL;
	arena = &channels->arena;
	arena_init(arena);
	channels->users = 1;
	channels->active = true;
	channels->worst = QUALITY_STALE;
	channels->file = map->file;
	channels->sys = copy_text(arena, map->sys ? map->sys : "/sys");
	channels->points = map->count;
	channels->of_point = arena_alloc(arena, sizeof(int) * (size_t)map->count);
	channels->cell = arena_alloc(arena, sizeof(struct cell) * (size_t)count);
	channels->runner_of = arena_alloc(arena, sizeof(int) * (size_t)count);
	channels->runner = arena_alloc(arena, sizeof(struct runner) * RUNNERS);
	for (int i = 0; i < map->count && !arena->failed; i++) {
		channels->of_point[i] = -1;
		if (map->point[i].channel)
			make_cell(channels, map, i);
	}
	for (int i = 0; !arena->failed && i < channels->count; i++)
		if (channels->cell[i].point.driver == DRIVER_quality)
			join_quality(channels, &channels->cell[i]);
	if (!arena->failed)
		return channels;
	leave(channels);
	return NULL;
}

static bool same_text(const char *a, const char *b)
{
	return a && b ? strcmp(a, b) == 0 : a == b;
}

/* A point that has the file of one before. An input of two points is read twice; an output has one. */
static bool check_twice(const struct channels *channels, const struct iomap *map, int number,
			struct diag_list *diags)
{
	const struct cell *cell = &channels->cell[number];
	char first[24];

	for (int i = 0; i < number; i++) {
		const struct cell *other = &channels->cell[i];

		if (!cell->driver || !other->driver || !same_text(cell->device.path, other->device.path) ||
		    !cell->device.path[0] || (!cell->point.output && !other->point.output))
			continue;
		iec_addr_print(other->point.addr, first, sizeof(first));
		return diag_add(diags, io_place(map, &map->point[cell->number],
				cell->point.output == other->point.output ? DIAG_IO_LINE_TWICE :
									    DIAG_IO_BOTH_WAYS),
				"%.36s" DIAG_AND "%s", cell->channel.device, first);
	}
	return true;
}

static bool find_cell(struct device_search *search, struct cell *cell, const struct iomap *map,
		      struct diag_list *diags)
{
	struct trouble why;

	if (!cell->driver)
		return true;
	if (cell->driver->find(search, &cell->point, &cell->device, &why)) {
		without_unit(cell);
		cell->safe_number = cell_number(&cell->device, cell->safe);
		return true;
	}
	cell->device.path[0] = '\0';
	return diag_add(diags, io_place(map, &map->point[cell->number], why.id), "%s", why.text);
}

/* A measurement takes 0.75 s, one after the other on a bus. */
static void give_time(struct channels *channels)
{
	int64_t least_ns = 2 * IO_STALE_NS;

	for (int i = 0; i < channels->count; i++)
		least_ns += channels->cell[i].point.driver == DRIVER_w1 ? IO_STALE_NS : 0;
	for (int i = 0; i < channels->count; i++)
		if (channels->cell[i].point.driver == DRIVER_w1 &&
		    channels->cell[i].channel.stale_ns == IO_STALE_NS)
			channels->cell[i].channel.stale_ns = least_ns;
}

/* One thread for each device, so that none waits for another. */
static void assign(struct channels *channels)
{
	for (int i = 0; i < channels->count; i++) {
		const struct device *device = &channels->cell[i].device;
		int number = 0;

		channels->runner_of[i] = -1;
		if (!channels->cell[i].driver)
			continue;
		while (number < channels->runner_count &&
		       (strncmp(channels->runner[number].home, device->path, device->home) != 0 ||
			channels->runner[number].home[device->home]))
			number++;
		if (number == RUNNERS)
			number = i % RUNNERS;
		channels->runner_of[i] = number;
		if (number < channels->runner_count)
			continue;
		channels->runner[number] = (struct runner){ .of = channels, .number = number, .wake = -1 };
		memcpy(channels->runner[number].home, device->path, device->home);
		channels->runner_count++;
	}
}

bool channels_plan(struct channels **out, const struct iomap *map, struct diag_list *diags)
{
	struct device_search search = { .sys = map->sys ? map->sys : "/sys" };
	struct channels *channels;
	bool good = true;
	int count = 0;

	*out = NULL;
	for (int i = 0; i < map->count; i++)
		count += map->point[i].channel != NULL;
	if (!count)
		return true;
	channels = make_channels(map, count);
	if (!channels)
		return no_memory(map, diags);
	for (int i = 0; i < count; i++)
		if (!find_cell(&search, &channels->cell[i], map, diags) ||
		    !check_twice(channels, map, i, diags))
			good = false;
	end_search(&search);
	if (!good) {
		leave(channels);
		return false;
	}
	assign(channels);
	give_time(channels);
	*out = channels;
	return true;
}

size_t channels_memory(void)
{
	return sizeof(struct cell) + 2 * sizeof(int) + sizeof(struct runner);
}

/* ---- opening ---- */

static bool open_output(struct cell *cell, const struct iomap *map, struct diag_list *diags)
{
	struct trouble why = { .id = DIAG_IO_DEVICE_REFUSED };
	int error = 0;

	if (cell->twin)
		return open_file(cell) == 0;
	if (cell->driver->take &&
	    !cell->driver->take(&cell->device, &cell->point, cell->safe_number, &why))
		return diag_add(diags, io_place(map, &cell->point, why.id), "%s", why.text);
	error = open_file(cell);
	if (!error)
		error = cell_write(cell, cell->safe_number);
	cell->goods = !error;
	if (error == -EACCES)
		device_denied(&why, cell->channel.device, cell->device.path);
	else if (error)
		trouble_set(&why, DIAG_IO_DEVICE_REFUSED, "%s" DIAG_AND "%s", cell->channel.device,
			    strerror(-error));
	return !error || diag_add(diags, io_place(map, &cell->point, why.id), "%s", why.text);
}

/* A device that does not answer at once is stale in the first scan. */
static void await_first(const struct channels *channels)
{
	const int64_t end_ns = clock_now() + FIRST_NS;

	for (;;) {
		bool all = true;

		for (int i = 0; i < channels->count; i++) {
			const struct cell *cell = &channels->cell[i];

			all = all && (!cell->driver || cell->point.output ||
				      atomic_load_explicit(&cell->tries, memory_order_acquire));
		}
		if (all || clock_now() >= end_ns)
			return;
		nap();
	}
}

bool channels_open(struct channels *channels, struct diag_list *diags)
{
	const struct iomap map = { .file = channels ? channels->file : NULL };
	bool good = true;

	for (int i = 0; channels && i < channels->count; i++) {
		struct cell *cell = &channels->cell[i];

		if (cell->driver && cell->point.output && !open_output(cell, &map, diags))
			good = false;
	}
	if (!channels || !good)
		return good;
	if (!start_threads(channels))
		return no_memory(&map, diags);
	await_first(channels);
	return true;
}

/* Outputs of the other map keep what they have. */
static void stop_outputs(struct channels *channels)
{
	for (int i = 0; i < channels->count; i++) {
		struct cell *cell = &channels->cell[i];

		if (cell->twin) {
			cell->twin->twin = NULL;
			continue;
		}
		if (cell->file >= 0 && !cell->point.hold)
			cell_write_safe(cell);
	}
}

void channels_close(struct channels *channels)
{
	int64_t end_ns;

	if (!channels)
		return;
	end_ns = clock_now() + END_NS;
	atomic_store(&channels->ending, true);
	for (int i = 0; i < channels->runner_count; i++)
		for (int k = 0; k < channels->count; k++)
			if (channels->runner_of[k] == i) {
				channels_wake(channels, &channels->cell[k]);
				break;
			}
	while (atomic_load(&channels->users) > 1 && clock_now() < end_ns)
		nap();
	stop_outputs(channels);
	leave(channels);
}

/* ---- another map beside it ---- */

static bool same_channel(const struct cell *a, const struct cell *b)
{
	const struct io_channel *x = &a->channel, *y = &b->channel;

	if (a->point.driver != b->point.driver || a->point.output != b->point.output)
		return false;
	if (a->driver)
		return same_text(x->device, y->device) && same_text(x->name, y->name) &&
		       x->number == y->number;
	return a->point.addr.area == b->point.addr.area && a->point.addr.byte == b->point.addr.byte &&
	       a->point.addr.bit == b->point.addr.bit && a->point.addr.bits == b->point.addr.bits &&
	       x->unit_id == y->unit_id && x->table == y->table && x->reg == y->reg &&
	       x->raw == y->raw && same_text(x->device, y->device) && same_text(x->name, y->name);
}

/* How the kernel drives an output is set once. */
static bool needs_take(const struct cell *a, const struct cell *b)
{
	return a->driver && a->point.output &&
	       (a->channel.period_ns != b->channel.period_ns ||
		(a->channel.type != IEC_BOOL && a->point.active_low != b->point.active_low));
}

enum hal_beside channels_beside(struct channels **next, struct channels *now,
				const struct iomap *map, struct diag_list *diags, char *line)
{
	if (!channels_plan(next, map, diags))
		return BESIDE_REFUSED;
	if (*next)
		(*next)->active = false;
	for (int i = 0; now && i < now->count; i++)
		now->cell[i].twin = NULL;
	for (int i = 0; *next && i < (*next)->count; i++) {
		struct cell *cell = &(*next)->cell[i];

		for (int k = 0; now && k < now->count && !cell->twin; k++) {
			struct cell *other = &now->cell[k];

			if (other->twin || !same_channel(cell, other))
				continue;
			if (needs_take(cell, other)) {
				snprintf(line, LIMIT_ARG, "%s", cell->channel.device);
				channels_close(*next);
				*next = NULL;
				return BESIDE_RESTART;
			}
			cell->twin = other;
			other->twin = cell;
		}
	}
	return BESIDE_GOOD;
}
