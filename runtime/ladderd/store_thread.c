/* SPDX-License-Identifier: MIT
 *
 * store_thread - copies values from the scan to a thread, which writes them.
 *
 * There are three buffers and one atomic word. The scan fills one buffer, the thread reads
 * another, and each exchanges its buffer for the third one, so neither waits for the other.
 * Nobody writes to the buffer that the scan gave last until it gives the next one; a reset
 * reads it.
 */
#define _GNU_SOURCE /* eventfd() */
#include "ladderd/store.h"
#include "hal/clock.h"
#include "ladderd/control.h"
#include "ladderd/disk.h"
#include "ladderd/store_file.h"

#include <errno.h>
#include <limits.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <time.h>
#include <unistd.h>

#define SECOND     INT64_C(1000000000)
#define TICK_NS    (SECOND / 10) /* longest time between two looks           */
#define QUIET_NS   SECOND        /* values are written after so long without a change */
#define HANGS_MS   3000      /* a write that takes longer is reported        */
#define FRESH      4u            /* the thread has not read `middle` yet     */
#define STACK_LEAST 65536u
#define TOLD_MOST  20            /* names of lost values that are printed    */

struct copy {
	int64_t clock_ns;
	uint8_t *value;
};

struct store {
	struct retain retain;
	struct store_file file;
	struct copy copy[3];
	_Atomic unsigned middle;
	/* Used by the scan. */
	unsigned back, last;
	bool warm, lost, old_copy, restored;
	int64_t offset_ns;
	/* Used by the thread. */
	unsigned front;
	struct copy seen, stored;
	bool any;              /* the scan gave at least one copy            */
	bool up_to_date;       /* the file holds `stored`                    */
	bool failing;
	bool quiet;            /* of store_wish                              */
	int64_t period_ns, changed_ns, dirty_ns, wrote_ns;
	pthread_t thread;
	bool runs;
	int wake;
	_Atomic bool stop;
	_Atomic int hurry; /* no bool: RISC-V exchanges no single byte     */
	_Atomic uint32_t seq, writes, failures;
	_Atomic int error;     /* of the last write; 0: it is on the disk    */
	_Atomic uint32_t since_ms; /* of the write that goes on, | 1; 0: none */
};

/* ---- the scan's side ---- */

static void give(struct store *store)
{
	store->last = store->back;
	store->back = atomic_exchange(&store->middle, store->back | FRESH) &
		      ~FRESH;
}

void store_take(struct store *store, const struct image *image, int64_t clock_ns)
{
	struct copy *copy = &store->copy[store->back];

	copy->clock_ns = clock_ns;
	retain_copy(&store->retain, image, copy->value);
	give(store);
}

void store_keep(struct store *store, const struct image *image)
{
	const struct copy *last = &store->copy[store->last];
	struct copy *copy = &store->copy[store->back];

	copy->clock_ns = last->clock_ns;
	retain_copy(&store->retain, image, copy->value);
	if (memcmp(copy->value, last->value, store->retain.copy_size) != 0)
		give(store);
}

void store_go_on(struct store *store, const struct resource *resource)
{
	store->offset_ns = resource->timers_ns;
	store->restored = true;
	if (resource->state != STATE_FAULT)
		store_take(store, &resource->image, resource->vm.now_ns);
}

void store_restore(struct store *store, struct resource *resource,
		   int64_t now_ns)
{
	const struct copy *copy = &store->copy[store->last];

	if (!store->restored && store->warm)
		store->offset_ns = copy->clock_ns - now_ns;
	if (store->restored || store->warm)
		retain_put(&store->retain, &resource->image, copy->value);
	resource->timers_ns = store->offset_ns;
	resource->warm = store->restored || store->warm;
	resource->retain_lost = store->lost;
	resource->retain_old_copy = store->old_copy;
	store->restored = true;
}

void store_put(struct store *store, const uint8_t *values, int64_t clock_ns)
{
	struct copy *copy = &store->copy[store->back];

	copy->clock_ns = clock_ns;
	memcpy(copy->value, values, store->retain.copy_size);
	give(store);
	store->restored = false; /* the clock goes on from that of the values */
	store->warm = true;
	store->lost = store->old_copy = false;
	store_hurry(store);
}

static void wake(struct store *store)
{
	uint64_t one = 1;

	/* If the counter were full, the thread would be awake. */
	if (write(store->wake, &one, sizeof(one)) < 0)
		return;
}

void store_hurry(struct store *store)
{
	atomic_store(&store->hurry, 1);
	wake(store);
}

struct store_status store_status(const struct store *store)
{
	return (struct store_status){
		.copy = atomic_load(&store->seq),
		.values = (uint32_t)store->retain.count,
		.writes = atomic_load(&store->writes),
		.failures = atomic_load(&store->failures),
	};
}

int store_error(const struct store *store)
{
	const uint32_t since_ms = atomic_load(&store->since_ms);

	if (since_ms && (int32_t)((uint32_t)(clock_now() / 1000000) - since_ms) > HANGS_MS)
		return EINPROGRESS;
	return atomic_load(&store->error);
}

/* ---- the thread ---- */

/* Takes the newest copy of the scan into `seen`. */
static void look(struct store *store, int64_t now_ns)
{
	const struct copy *copy;
	size_t size = store->retain.copy_size;
	bool same;

	if (!(atomic_load(&store->middle) & FRESH))
		return;
	store->front = atomic_exchange(&store->middle, store->front) & ~FRESH;
	copy = &store->copy[store->front];
	same = store->any && memcmp(store->seen.value, copy->value, size) == 0;
	store->any = true;
	if (same)
		return;
	memcpy(store->seen.value, copy->value, size);
	store->seen.clock_ns = copy->clock_ns;
	store->changed_ns = now_ns;
}

static void save(struct store *store)
{
	int error;

	retain_fill(&store->retain, store->seen.value, store->seen.clock_ns);
	atomic_store(&store->since_ms, (uint32_t)(clock_now() / 1000000) | 1);
	error = store_file_write(&store->file, &store->retain);
	atomic_store(&store->since_ms, 0);
	store->wrote_ns = clock_now();
	atomic_store(&store->error, -error);
	if (error) {
		atomic_fetch_add(&store->failures, 1);
		if (!store->failing)
			control_tell_error("retained values are not stored",
					   strerror(-error));
		store->failing = true;
		return;
	}
	if (store->failing)
		control_tell("retained values are stored again");
	store->failing = false;
	memcpy(store->stored.value, store->seen.value, store->retain.copy_size);
	store->up_to_date = true;
	atomic_store(&store->seq, store->file.seq);
	atomic_fetch_add(&store->writes, 1);
}

/* A period after the last write, and when the values have not changed for a while or have
 * been changing for a period. */
static bool is_due(struct store *store, int64_t now_ns)
{
	int64_t quiet = store->period_ns / 10;

	if (quiet > QUIET_NS)
		quiet = QUIET_NS;
	if (now_ns - store->wrote_ns < store->period_ns)
		return false;
	return now_ns - store->changed_ns >= quiet ||
	       now_ns - store->dirty_ns >= store->period_ns;
}

static void step(struct store *store, bool now)
{
	int64_t now_ns = clock_now();

	look(store, now_ns);
	if (!store->any ||
	    (store->up_to_date && memcmp(store->seen.value, store->stored.value,
					 store->retain.copy_size) == 0)) {
		store->dirty_ns = now_ns;
		return;
	}
	if (now || is_due(store, now_ns))
		save(store);
}

static void *write_values(void *argument)
{
	struct store *store = argument;
	int64_t tick_ns = store->period_ns / 10;
	bool stop = false;

	if (tick_ns > TICK_NS)
		tick_ns = TICK_NS;
	while (!stop) {
		struct pollfd ready = { .fd = store->wake, .events = POLLIN };
		uint64_t count;

		if (poll(&ready, 1, (int)(tick_ns / 1000000)) == 1 &&
		    read(store->wake, &count, sizeof(count)) < 0)
			count = 0;
		stop = atomic_load(&store->stop);
		step(store, atomic_exchange(&store->hurry, 0) != 0 || stop);
	}
	return NULL;
}

/* The scan's thread handles all signals except those of a crash. */
static int start_thread(struct store *store, pthread_attr_t *attr)
{
	static const int own[] = { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT };
	sigset_t all, before;
	int error;

	sigfillset(&all);
	for (size_t i = 0; i < sizeof(own) / sizeof(own[0]); i++)
		sigdelset(&all, own[i]);
	pthread_sigmask(SIG_SETMASK, &all, &before);
	error = pthread_create(&store->thread, attr, write_values, store);
	pthread_sigmask(SIG_SETMASK, &before, NULL);
	return error;
}

int store_begin(struct store *store)
{
	const long least = PTHREAD_STACK_MIN; /* not constant in glibc */
	pthread_attr_t attr;
	int error;

	store->dirty_ns = clock_now();
	store->wrote_ns = store->dirty_ns - store->period_ns;
	error = pthread_attr_init(&attr);
	if (error)
		return -error;
	/* A small stack, because memory may be locked; and not the priority of the scan. */
	pthread_attr_setstacksize(&attr, least > (long)STACK_LEAST ?
				  (size_t)least : STACK_LEAST);
	pthread_attr_setinheritsched(&attr, PTHREAD_EXPLICIT_SCHED);
	error = start_thread(store, &attr);
	pthread_attr_destroy(&attr);
	store->runs = !error;
	return -error;
}

void store_close(struct store *store)
{
	if (store->runs) {
		atomic_store(&store->stop, true);
		wake(store);
		pthread_join(store->thread, NULL);
	}
	close(store->wake);
	store_file_close(&store->file);
}

/* ---- at the start ---- */

static void tell_name(const char *text, uint32_t len)
{
	for (uint32_t i = 0; i < len; i++)
		fputc((unsigned char)text[i] < ' ' || text[i] == 127 ?
		      '?' : text[i], stderr);
}

/* Control characters are replaced: the name comes from a file and may go to a terminal. */
static void tell_lost(const struct retain_record *record, enum retain_fate fate)
{
	fputs("ladderd: retained value lost: ", stderr);
	tell_name(record->name, record->name_len);
	fputc(' ', stderr);
	tell_name(record->type, record->type_len);
	fputs(fate == RETAIN_NO_TYPE ? ": now of another type\n" :
	      ": no such retained variable now\n", stderr);
}

static void tell_new(const struct store *store, int *told)
{
	for (int i = 0; i < store->retain.count; i++) {
		struct retain_record record;

		if (store->retain.taken[i] || ++*told > TOLD_MOST)
			continue;
		record = retain_record_of(&store->retain, i);
		fputs("ladderd: retained value new: ", stderr);
		tell_name(record.name, record.name_len);
		fputc('\n', stderr);
	}
}

/* Takes the values of the newest copy in the file into the copy that store_restore() reads. */
static void take_payload(struct store *store, const struct retain_found *found)
{
	struct copy *copy = &store->copy[store->last];
	struct retain_record record;
	uint32_t at = RETAIN_HEAD, kept = 0, lost = 0;
	int told = 0;

	while (retain_next(found->payload, found->len, &at, &record)) {
		enum retain_fate fate = retain_take(&store->retain, &record,
						    copy->value);

		if (fate == RETAIN_KEPT) {
			kept++;
			continue;
		}
		lost++;
		if (++told <= TOLD_MOST)
			tell_lost(&record, fate);
	}
	tell_new(store, &told);
	if (told > TOLD_MOST)
		fprintf(stderr, "ladderd: %d more values\n", told - TOLD_MOST);
	copy->clock_ns = retain_clock(found->payload);
	store->lost = lost > 0;
	store->old_copy = found->old_copy;
	store->warm = kept > 0;
	/* The file has exactly these variables, so it need not be written. */
	store->up_to_date = store->file.fits && lost == 0 && !found->old_copy &&
			    kept == (uint32_t)store->retain.count;
	memcpy(store->stored.value, copy->value, store->retain.copy_size);
	if (store->quiet)
		return;
	fprintf(stderr, "ladderd: warm start: %u values of copy %u%s%s\n",
		(unsigned)kept, (unsigned)found->seq,
		store->old_copy ? "; a copy beside it cannot be read and may "
		"have been newer" : "", store->lost ? "; values were lost" : "");
}

static void start_values(struct store *store, const struct store_wish *wish,
			 const uint8_t *bytes, size_t len, int error)
{
	struct retain_found found;

	retain_find(bytes ? bytes : (const uint8_t *)"", bytes ? len : 0,
		    &found);
	store_file_adopt(&store->file, &found,
			 retain_room(store->retain.payload_size));
	atomic_store(&store->seq, store->file.seq);
	if (wish->cold && !wish->quiet) {
		fprintf(stderr, "ladderd: cold start: the values in %s are "
			"not used\n", wish->path);
	} else if (found.best >= 0) {
		take_payload(store, &found);
	} else if (store->file.exists) {
		store->lost = true;
		fprintf(stderr, "ladderd: %s: %s; all retained values are "
			"lost\n", wish->path, error ? strerror(-error) :
			"no copy in it can be read");
	} else if (!wish->quiet) {
		fprintf(stderr, "ladderd: %s: a new file, no values yet\n",
			wish->path);
	}
}

bool store_measure(const struct program *program, struct arena *arena,
		   uint32_t *values, uint32_t *bytes)
{
	struct image *image = arena_alloc(arena, sizeof(*image));
	struct retain retain;

	if (!image)
		return false;
	image->program = program;
	if (!retain_plan(&retain, image, arena))
		return false;
	*values = (uint32_t)retain.count;
	*bytes = retain.bytes;
	return true;
}

static bool allocate(struct store *store, const struct image *image,
		     struct arena *arena)
{
	struct copy *copy[5] = { &store->copy[0], &store->copy[1],
				 &store->copy[2], &store->seen, &store->stored };

	if (!retain_plan(&store->retain, image, arena))
		return false;
	for (int i = 0; i < 5; i++) {
		copy[i]->value = arena_alloc(arena, store->retain.copy_size);
		if (!copy[i]->value)
			return false;
	}
	retain_copy(&store->retain, image, store->copy[0].value);
	store->front = store->last = 0;
	store->back = 1;
	atomic_store(&store->middle, 2);
	return true;
}

static struct store *refuse(const struct store_wish *wish, const char *why)
{
	fprintf(stderr, "ladderd: --retain %s: %s\n", wish->path, why);
	return NULL;
}

static struct store *refuse_file(const struct store_wish *wish, int error)
{
	if (error == -EWOULDBLOCK)
		return refuse(wish, "another ladderd has it");
	if (error == -ENOTSUP)
		return refuse(wish, "not a file");
	fprintf(stderr, "ladderd: --retain %s: %s; %s\n", wish->path, strerror(-error), disk_hint(error));
	return NULL;
}

/* Is the error one of the command line, not of the disk? */
static bool is_mistake(int error)
{
	return error == -ENOENT || error == -ENOTDIR || error == -ENOTSUP ||
	       error == -ENAMETOOLONG || error == -EWOULDBLOCK ||
	       error == -ENOMEM;
}

struct store *store_open(const struct store_wish *wish,
			 const struct image *image, struct arena *arena,
			 int *status)
{
	struct store *store = arena_alloc(arena, sizeof(*store));
	uint8_t *bytes = NULL;
	size_t len = 0;
	int error, ready;

	*status = 1;
	if (image->program->string_bytes == 0)
		return refuse(wish, "this image has no names to keep values "
			      "by: build it without --small");
	if (!store || !allocate(store, image, arena))
		return refuse(wish, store && store->retain.payload_size >
			      LIMIT_RETAIN ? "too many retained values" :
			      "out of memory");
	store->period_ns = wish->period_ns;
	store->quiet = wish->quiet;
	store->wake = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
	if (store->wake < 0)
		return refuse(wish, strerror(errno));
	error = store_file_open(&store->file, wish->path, arena, &bytes, &len);
	if (!is_mistake(error)) {
		start_values(store, wish, bytes, len, error);
		ready = store_file_prepare(&store->file);
		if (ready && !is_mistake(ready))
			fprintf(stderr, "ladderd: %s: %s; values are not "
				"stored; %s\n", wish->path, strerror(-ready), disk_hint(ready));
		atomic_store(&store->error, -ready);
		error = is_mistake(ready) ? ready : 0;
	}
	free(bytes);
	if (!error)
		return store;
	*status = error == -EWOULDBLOCK ? 1 : 2;
	store_close(store);
	return refuse_file(wish, error);
}
