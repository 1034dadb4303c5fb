/* SPDX-License-Identifier: MIT
 *
 * link - the thread that moves bytes between desks and the server, and wakes the scan thread.
 *
 * The scan thread sleeps in clock_nanosleep(). A signal ends that sleep, so an order need not
 * wait for the next scan; the handler does nothing, and system calls of a scan that it meets are
 * restarted.
 */
#define _GNU_SOURCE /* accept4() */
#include "ladderd/link.h"
#include "ladderd/conf.h"
#include "ladderd/control.h"
#include "ladderd/disk.h"
#include "ladderd/download.h"
#include "ladderd/gateways.h"
#include "ladderd/machine.h"
#include "ladderd/ends.h"
#include "ladderd/alarm_store.h"
#include "ladderd/clock.h"
#include "ladderd/guarded.h"
#include "ladderd/journal.h"
#include "ladderd/password.h"
#include "ladderd/peer.h"

#include "engine/base/digest.h"
#include "engine/scan/symbol_index.h"
#include "online/serial.h"
#include "online/server.h"
#include "online/port.h"

#include "guard/say.h"
#include "hal/clock.h"

#include <errno.h>
#include <limits.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>

#define SECOND     INT64_C(1000000000)
#define NAP_NS     50000              /* between two looks whether an order is done */
#define NUDGE_NS   1000000            /* between two signals to the scan thread     */
#define PATIENCE_NS (2 * SECOND)      /* for an order                               */
#define STACK_LEAST 262144u
#define REST_NS    SECOND             /* longest time between two looks at the state */
#define FLOOD_NS   (SECOND / 50)      /* the same while alarms wait to be taken */
#define HANGS_NS   (5 * SECOND)      /* without a turn of the thread              */
#define LATE_REST_NS (60 * SECOND)    /* between two events about late scans        */
#define MOVED_NS   SECOND             /* a step of the clock that the log tells     */
#define BACKLOG    128               /* of desks that connect at the same time          */
#define PAGE_LEAST 4096u              /* bytes; touching more often does no harm */
#define OURS       3                  /* polled: the wake-up, the listening socket, the serial line */

/* The serial line. */
struct port {
	const char *text;              /* TTY,BAUD; NULL: none                 */
	enum role role;                /* of who holds the cable               */
	int fd;                        /* -1: the line has gone                */
	int session;                   /* -1: none                             */
	int64_t tried_ns;              /* when it was opened, or tried         */
	struct serial serial;
};

/* How the trial of a program has ended, until the link thread knows it. */
enum trial { TRIAL_NONE, TRIAL_PASSED, TRIAL_BACK };

struct link {
	struct cycle *cycle;
	struct exchange exchange;
	struct exchange_host host;
	struct server *server;
	struct server_store store;
	struct link_store with;
	struct download *download;
	struct store *retain;          /* that of the cycle                    */
	struct arena retain_arena;     /* of the store, if another program has run */
	struct order store_order;      /* given beside those of the server     */
	struct board_status status;    /* of that order                        */
	struct journal *journal;
	struct alarms alarms;
	bool alarms_wait;
	struct alarm_store alarm_store;
	struct gateways gateways;
	_Atomic(struct asks *) asks;   /* of the program and the map that run  */
	struct asks *asks_before;      /* the scan thread may still look at it */
	struct server_io io;
	struct machine *machine;
	struct server_machine devices;
	const struct iomap *first_map; /* of the program that ladderd began with */
	struct channels *first_channels;
	struct server_log log;
	struct server_conf conf;
	struct server_password lock;
	struct password password;
	uint32_t late;                 /* rows of late scans that the log has    */
	int64_t late_ns;               /* of the last event about them           */
	int64_t wall_ns, moved_ns;     /* the clock of the wall less the other one; when the log got a step */
	int state;                     /* that the log tells                   */
	bool disk_bad, disk_told;      /* … and whether the log tells it       */
	int64_t disk_ns;               /* of its last event in the log         */
	struct peer_groups groups;
	uint8_t *views;
	struct recorder recorder;
	uint8_t *record;               /* its memory; NULL: none               */
	char path[108];
	int listening, wake;
	int fd[SERVER_SESSIONS];       /* -1: no session, or that of the port  */
	struct port port;
	int64_t began_ns;
	uint8_t began;                 /* how the start came about, as in struct board_status */
	uint16_t began_how;
	uint32_t began_ends;
	pthread_t thread, scans;
	bool runs;
	_Atomic bool stop, dozes;
	_Atomic int wants;             /* enum server_wants                    */
	int shown;                     /* by the scan thread: the mode that it has shown */
	_Atomic int trial;             /* enum trial                           */
	_Atomic uint32_t turns;        /* of the thread's loop                  */
	uint32_t turns_seen;           /* by the scan thread, and when          */
	int64_t turned_ns;
	bool hangs;                    /* it was reported                      */
};

/* ---- the scan thread ---- */

static void cycle_configure(struct cycle *cycle, const struct options *options)
{
	cycle->late_limit = options->late;
	memcpy(cycle->given, options->name, sizeof(cycle->given));
	cycle_name(cycle, cycle->given, cycle->hal.map->board);
	monitor_limit(cycle_plan(cycle, options->period_ns, options->watchdog));
}

static struct resource *host_resource(void *context)
{
	return &((struct link *)context)->cycle->resource;
}

static const uint8_t *host_identity(void *context)
{
	return ((struct link *)context)->cycle->identity_bytes;
}

static enum refusal host_mode(void *context, enum mode_wish wish)
{
	return cycle_mode(((struct link *)context)->cycle, wish);
}

static void host_status(void *context, struct board_status *status)
{
	control_fill_status(((struct link *)context)->cycle, status);
}

static enum refusal host_swap(void *context, void *other, uint32_t back)
{
	return cycle_swap(((struct link *)context)->cycle, other, back);
}

static void take_store(void *context, void *other)
{
	struct cycle *cycle = ((struct link *)context)->cycle;

	cycle->store = other;
	store_go_on(cycle->store, &cycle->resource);
}

static void take_settings(void *context, void *other)
{
	cycle_configure(((struct link *)context)->cycle, other);
}

static void host_restart(void *context, bool stopped)
{
	struct cycle *cycle = ((struct link *)context)->cycle;

	cycle->restart_stopped = stopped;
	cycle->restart = true;
}

/* The values can be seen at once; the next warm start begins with them. */
static enum refusal host_restore(void *context, const struct order_retain *values)
{
	struct cycle *cycle = ((struct link *)context)->cycle;

	if (!cycle->store)
		return REFUSAL_NO_RETAIN;
	retain_put(values->plan, &cycle->resource.image, values->copy);
	store_put(cycle->store, values->copy, values->clock_ns);
	return REFUSAL_NONE;
}

/* Reports a thread that hangs, in a write to the disk as a rule; the scan goes on. */
static void watch_thread(struct link *link)
{
	const uint32_t turns = atomic_load_explicit(&link->turns, memory_order_relaxed);
	const int64_t now_ns = clock_now();
	bool hangs;

	if (turns != link->turns_seen)
		link->turned_ns = now_ns;
	link->turns_seen = turns;
	hangs = now_ns - link->turned_ns > HANGS_NS;
	if (hangs != link->hangs)
		control_tell(hangs ? "the link does not answer, its disk perhaps hangs; the program goes on" :
				     "the link answers again");
	link->hangs = hangs;
}

void link_serve(struct link *link)
{
	watch_thread(link);
	exchange_serve(&link->exchange);
}

static void wake_up(struct link *link)
{
	const uint64_t one = 1;

	if (write(link->wake, &one, sizeof(one)) < 0)
		errno = 0; /* the counter is full, so the thread is awake */
}

/* A gateway that wants outputs gets them now. */
static void wake_for_gateways(struct link *link)
{
	const int wants = atomic_load_explicit(&link->wants, memory_order_relaxed);
	const int state = (int)link->cycle->resource.state;

	if (wants == WANTS_OUTPUTS || (wants == WANTS_MODE && state != link->shown))
		wake_up(link);
	link->shown = state;
}

void link_show(struct link *link, int64_t now_ns)
{
	exchange_show(&link->exchange, now_ns);
	alarm_look(&link->alarms.ring, &link->cycle->resource);
	asks_look(atomic_load_explicit(&link->asks, memory_order_acquire), &link->cycle->resource.image);
	wake_for_gateways(link);
}

void link_trial_over(struct link *link, bool back)
{
	if (back)
		exchange_forget(&link->exchange);
	atomic_store(&link->trial, back ? TRIAL_BACK : TRIAL_PASSED);
	wake_up(link);
}

/* ---- quality in the record ---- */

static uint64_t quality_serial(void *context)
{
	const struct hal *hal = &((const struct link *)context)->cycle->hal;
	const bool lines = hal_quality(hal) != QUALITY_GOOD;

	return hal_worst(hal) == QUALITY_GOOD ? 0 : 2 * channels_changes(hal_channels(hal)) + 1 + lines;
}

/* As io_quality() tells it to desks: all lines of chips are stale if one does not answer. */
static void each_bad(void *context, struct recorder *recorder)
{
	const struct cycle *cycle = ((const struct link *)context)->cycle;
	const struct hal *hal = &cycle->hal;
	const struct areas *areas = &cycle->resource.image.program->areas;
	const enum hal_quality lines = hal_quality(hal) == QUALITY_GOOD ? QUALITY_GOOD : QUALITY_STALE;

	for (int i = 0; hal->map && i < hal->map->count; i++) {
		const struct io_point *point = &hal->map->point[i];
		const enum hal_quality quality = point->channel ? channels_point(hal_channels(hal), i) : lines;

		if (quality != QUALITY_GOOD && areas_have(areas, point->addr))
			recorder_bad(recorder, 8 * areas_byte(areas, point->addr) + point->addr.bit,
				     point->addr.bits, quality == QUALITY_FAULT);
	}
}

void link_note(struct link *link, enum link_note note, int64_t now_ns)
{
	const struct cycle *cycle = link->cycle;

	if (note == NOTE_START)
		alarm_begin(&link->alarms.ring, &cycle->resource);
	if (!link->record)
		return;
	switch (note) {
	case NOTE_START: case NOTE_SWAP:
		recorder_begin(&link->recorder, &cycle->resource, cycle->identity_bytes,
			       note == NOTE_START ? RECORD_START : RECORD_SWAP);
		return;
	case NOTE_SCAN:
		recorder_scan(&link->recorder, &cycle->resource, now_ns);
		return;
	case NOTE_INTERRUPTING:
		recorder_interrupting(&link->recorder, &cycle->resource);
		return;
	case NOTE_INTERRUPT:
		recorder_interrupt(&link->recorder, &cycle->resource, now_ns);
		return;
	case NOTE_SCANNED:
		recorder_scanned(&link->recorder, &cycle->resource);
		return;
	case NOTE_STOP:
		recorder_stopped(&link->recorder);
		return;
	case NOTE_FAULT:
		recorder_failed(&link->recorder, &cycle->resource);
		return;
	}
}

/* The thread listens meanwhile, and a signal ends the sleep. */
bool link_doze(struct link *link, int64_t until_ns)
{
	(void)until_ns;
	atomic_store(&link->dozes, true);
	return false;
}

void link_wake(struct link *link)
{
	atomic_store(&link->dozes, false);
}

/* ---- the link thread ---- */

static bool wait_for(struct link *link, bool brief)
{
	const struct timespec nap = { .tv_nsec = NAP_NS };
	const int64_t began_ns = clock_now();
	int64_t now_ns = began_ns, nudged_ns = 0;

	while (!exchange_is_done(&link->exchange)) {
		/* After the last scan nobody does an order. */
		if (now_ns - began_ns > PATIENCE_NS || atomic_load(&link->stop) ||
		    (brief && monitor_hangs()))
			return false;
		if (now_ns - nudged_ns > NUDGE_NS && atomic_load(&link->dozes)) {
			pthread_kill(link->scans, SIGURG);
			nudged_ns = now_ns;
		}
		clock_nanosleep(CLOCK_MONOTONIC, 0, &nap, NULL);
		now_ns = clock_now();
	}
	return true;
}

static bool wait_for_scan(void *context)
{
	return wait_for(context, false);
}

static bool wait_unless_hung(void *context)
{
	return wait_for(context, true);
}

/* What a disk does not take now; "": it takes everything. */
static void say_disk(const struct link *link, char *out, size_t size)
{
	const int error[] = { link->retain ? store_error(link->retain) : 0,
			      journal_error(link->journal), link->alarm_store.error };
	static const char *const what[] = { "retained values", "events", "alarms" };
	int bad = (error[0] != 0) + (error[1] != 0) + (error[2] != 0), why = 0;

	*out = '\0';
	for (int i = 0; i < 3; i++) {
		const size_t len = strlen(out);

		if (!error[i])
			continue;
		bad--;
		snprintf(out + len, size - len, "%s%s", what[i], bad > 1 ? ", " : bad ? " and " : "");
		why = why ? why : error[i];
	}
	if (why)
		snprintf(out + strlen(out), size - strlen(out), " are not stored: %s", strerror(why));
}

/* What the scan thread need not find out. */
static void amend_status(void *context, struct board_status *status)
{
	struct link *link = context;
	const struct slots *slots = link->with.slots;
	const int64_t up_ns = clock_now() - link->began_ns;
	struct rusage used;
	int64_t busy_us;

	if (getrusage(RUSAGE_SELF, &used) != 0)
		return;
	busy_us = (used.ru_utime.tv_sec + used.ru_stime.tv_sec) * INT64_C(1000000) +
		  used.ru_utime.tv_usec + used.ru_stime.tv_usec;
	status->up_ms = (uint64_t)(up_ns / 1000000);
	status->cpu_permille = (uint32_t)(up_ns > 1000 ? busy_us * 1000 / (up_ns / 1000) : 0);
	status->memory_bytes = (uint64_t)used.ru_maxrss * 1024;
	status->next = slots->unlike;
	snprintf(status->next_why, sizeof(status->next_why), "%s", slots->why);
	say_disk(link, status->disk, sizeof(status->disk));
	status->began = link->began;
	status->began_how = link->began_how;
	status->began_ends = link->began_ends;
}

static bool scan_hangs(void *context)
{
	(void)context;
	return monitor_hangs();
}

/* ---- the log ---- */

static bool log_next(void *context, uint32_t seq, struct event *out)
{
	return journal_next(((struct link *)context)->journal, seq, out);
}

/* What the board did by itself, such as a FAULT. */
static void log_state(struct link *link)
{
	const int state = atomic_load(&link->exchange.state);

	if (state == link->state)
		return;
	link->state = state;
	link->status.fault[0] = '\0';
	if (state == STATE_FAULT && exchange_is_done(&link->exchange)) {
		link->store_order = (struct order){ .kind = ORDER_STATUS, .status = &link->status };
		exchange_post(&link->exchange, &link->store_order);
		wait_for_scan(link);
	}
	journal_add(link->journal, state == STATE_FAULT ? EVENT_FAULT :
		    state == STATE_RUN ? EVENT_RUN : EVENT_STOP, 0, "", link->status.fault, "");
}

/* A desk that orders STOP and RUN without a pause: the state between them is in the log, too. */
static void log_add(void *context, enum event_id id, uint8_t role, const char *user,
		    const char *one, const char *two)
{
	struct link *link = context;

	journal_add(link->journal, id, role, user, one, two);
	if (id == EVENT_MODE)
		log_state(link);
}

/* At most once a minute: a board that is too slow must not fill its log. */
static void log_late(struct link *link)
{
	const uint32_t late = atomic_load(&link->cycle->late_rows);
	char number[24];

	if (late == link->late || (link->late && clock_now() - link->late_ns < LATE_REST_NS))
		return;
	link->late = late;
	link->late_ns = clock_now();
	snprintf(number, sizeof(number), "%lld", (long long)link->with.conf->now.late);
	journal_add(link->journal, EVENT_LATE, 0, "", number, "");
}

/* ---- the clock ---- */

static void add_times(struct link *link, enum event_id id, int64_t from_ns, int64_t to_ns)
{
	char from[20], to[20];

	board_time_print(from_ns, 0, from);
	board_time_print(to_ns, 0, to);
	journal_add(link->journal, id, 0, "", from, to);
}

/* Whoever set the clock: the times in the log and of alarms jump with it. At most once a minute. */
static void log_moved(struct link *link, int64_t now_ns, int64_t wall_ns)
{
	const int64_t by_ns = wall_ns - now_ns - link->wall_ns;

	if (by_ns < MOVED_NS && by_ns > -MOVED_NS) {
		link->wall_ns += by_ns;
		return;
	}
	if (link->wall_ns && now_ns - link->moved_ns < LATE_REST_NS)
		return;
	if (link->wall_ns)
		add_times(link, EVENT_TIME_MOVED, wall_ns - by_ns, wall_ns);
	link->moved_ns = link->wall_ns ? now_ns : INT64_MIN / 2;
	link->wall_ns += by_ns;
}

static void read_clock(void *context, int64_t at_ns, struct board_time *out)
{
	(void)context;
	clock_read(at_ns, out);
}

static enum refusal set_clock(void *context, int64_t time_ns)
{
	struct link *link = context;
	const enum refusal refusal = clock_set(time_ns);

	if (refusal == REFUSAL_NONE)
		link->wall_ns = time_ns - clock_now(); /* the log tells who did it */
	return refusal;
}

static const struct server_clock wall_clock = { read_clock, set_clock };

/* ---- alarms ---- */

/* If another program runs, its blocks are watched from now on. */
static void watch_blocks(struct link *link)
{
	struct alarms *alarms = &link->alarms;
	const struct image *image = server_image(link->server);

	if (alarms->watch && alarms->watch->program == image->program)
		return;
	if (alarms->watch)
		alarm_list_doubt(&alarms->list, false);
	free(alarms->before);
	alarms->before = alarms->watch;
	alarms->watch = alarm_watch_new(image);
	if (alarms->watch && alarms->before)
		alarm_watch_carry(alarms->watch, alarms->before);
	atomic_store(&alarms->ring.watch, alarms->watch);
}

/* Takes the notes of the scan thread. */
static void follow_alarms(struct link *link)
{
	struct alarms *alarms = &link->alarms;
	const int64_t now_ns = clock_now(), wall_ns = clock_wall();
	struct alarm_note note;
	uint32_t taken = 0;

	log_moved(link, now_ns, wall_ns);
	for (; alarm_take(&alarms->ring, &note); taken++) {
		note.time_ns = note.system ? wall_ns : wall_ns - (now_ns - note.time_ns);
		alarm_list_note(&alarms->list, &note);
	}
	link->alarms_wait = taken >= ALARM_RING; /* the ring was full: the scan has more to tell */
	watch_blocks(link);
	alarm_store_write(&link->alarm_store, &alarms->list, now_ns);
}

/* Tells the program, the list of alarms and the log when the disk begins to fail, and when it is
 * well again; the log at most once a minute. */
static void follow_disk(struct link *link)
{
	char text[STATUS_TEXT];
	bool bad;

	say_disk(link, text, sizeof(text));
	bad = *text != '\0';
	if (bad != link->disk_bad)
		alarm_list_raise(&link->alarms.list, ALARM_DISK, bad, clock_wall());
	link->disk_bad = bad;
	atomic_store(&link->cycle->disk_bad, bad);
	if (bad == link->disk_told ||
	    (bad && link->disk_ns && clock_now() - link->disk_ns < LATE_REST_NS))
		return;
	link->disk_told = bad;
	link->disk_ns = clock_now();
	journal_add(link->journal, bad ? EVENT_DISK_BAD : EVENT_DISK_GOOD, 0, "", text, "");
}

/* ---- downloads ---- */

static enum refusal store_begin_download(void *context, const uint32_t len[STORED_PARTS],
					 const uint8_t sha[32], uint32_t *received)
{
	return download_begin(((struct link *)context)->download, len, sha, received);
}

static enum refusal store_block(void *context, uint32_t offset, const uint8_t *bytes, size_t len,
				uint32_t *received)
{
	return download_block(((struct link *)context)->download, offset, bytes, len, received);
}

static enum refusal store_verify(void *context, struct standby_view *out, char *detail,
				 size_t size)
{
	return download_verify(((struct link *)context)->download, out, detail, size);
}

static enum refusal store_slot(void *context, char *detail, size_t size)
{
	return download_store(((struct link *)context)->download, detail, size);
}

static enum refusal keep_slot(void *context, char *detail, size_t size)
{
	return download_keep(((struct link *)context)->download, detail, size);
}

static void drop_slot(void *context)
{
	download_drop(((struct link *)context)->download);
}

static enum refusal store_open_lines(void *context, char *detail, size_t size)
{
	return download_open_lines(((struct link *)context)->download, detail, size);
}

static void store_close_lines(void *context)
{
	download_close_lines(((struct link *)context)->download);
}

static void store_abort(void *context)
{
	download_abort(((struct link *)context)->download);
}

static const struct stored *store_running(void *context)
{
	return download_running(((struct link *)context)->download);
}

static const uint8_t *store_image(void *context, const uint8_t identity[32], uint32_t *len)
{
	return download_image(((struct link *)context)->download, identity, len);
}

/* Between two scans, and only while @program runs if one is given. It is done when this returns,
 * unless a scan hangs; then the link does nothing that would need its memory until it is done. No
 * other order waits: end_trial(), settle() and a change of a setting have seen to that. */
static void act(struct link *link, void (*what)(void *context, void *other), void *other,
		const struct program *program)
{
	if (!exchange_is_done(&link->exchange))
		return;
	link->store_order = (struct order){ .kind = ORDER_ACT, .act = what, .other = other,
					    .program = program };
	exchange_post(&link->exchange, &link->store_order);
	wait_for_scan(link);
}

/* ---- settings ---- */

static bool conf_read(void *context, uint32_t number, struct setting *out)
{
	return conf_get(((struct link *)context)->with.conf, number, out);
}

static enum refusal conf_write(void *context, const char *key, const char *value,
			       struct setting *changed, char *detail, size_t size)
{
	struct link *link = context;
	const enum refusal refusal = conf_change(link->with.conf, key, value, changed, detail, size);

	if (refusal != REFUSAL_NONE)
		return refusal;
	conf_in_force(link->with.conf);
	act(link, take_settings, &link->with.conf->now, NULL);
	return REFUSAL_NONE;
}

/* ---- the program password ---- */

static bool lock_is_set(void *context)
{
	return ((struct link *)context)->password.set;
}

static enum refusal lock_check(void *context, uint32_t who, const char *text, char *detail,
			       size_t size)
{
	return password_check(&((struct link *)context)->password, who, text, clock_now(), detail,
			      size);
}

static enum refusal lock_change(void *context, uint32_t who, const char *old, const char *text,
				char *detail, size_t size)
{
	return password_change(&((struct link *)context)->password, who, old, text, clock_now(),
			       detail, size);
}

/* ---- retained values ---- */

/* Stores the values of another program in the same file; it has those of the one before, which
 * the scan thread has carried over. */
static void store_retained_again(struct link *link, const struct program *program)
{
	struct arena *arena = &link->retain_arena;
	struct store_wish wish = *link->with.retain;
	struct image *cold = arena_alloc(arena, sizeof(*cold));
	void *memory = arena_alloc(arena, image_memory_size(program));
	int status;

	if (!cold || !memory) {
		control_tell("no memory: retained values are not stored any more");
		return;
	}
	wish.quiet = true;
	image_init(cold, program, memory);
	link->retain = store_open(&wish, cold, arena, &status);
	if (!link->retain || store_begin(link->retain) != 0) {
		control_tell("retained values are not stored any more");
		return;
	}
	act(link, take_store, link->retain, program);
}

/* The views and the program that the link uses now. */
struct used {
	uint8_t *views;
	const struct program *program;
};

static struct used used_of(struct link *link, struct standby *standby)
{
	if (standby)
		return (struct used){ standby->views, &standby->program };
	return (struct used){ link->views, link->with.program };
}

static void use_map(struct link *link, const struct program *program, const struct iomap *map,
		    struct channels *channels)
{
	struct asks *asks = asks_new(program, map);

	gateways_use(&link->gateways, map, channels, asks);
	free(link->asks_before);
	link->asks_before = atomic_exchange(&link->asks, asks);
}

/* Another program runs. The store has names of the one before, so it and its memory go. */
static const struct program *use(struct link *link, struct standby *standby)
{
	const struct used used = used_of(link, standby);
	const bool retains = link->retain;

	if (retains)
		store_close(link->retain);
	link->retain = NULL;
	exchange_renew(&link->exchange, used.views, image_memory_size(used.program));
	use_map(link, used.program, standby ? &standby->map : link->first_map,
		standby ? standby->channels : link->first_channels);
	arena_free(&link->retain_arena);
	arena_init(&link->retain_arena);
	if (retains)
		store_retained_again(link, used.program);
	return used.program;
}

static const struct program *store_swapped(void *context, bool comes_back)
{
	struct link *link = context;
	struct standby *standby = download_swapped(link->download, comes_back);

	return use(link, standby);
}

/* The scan thread went back to the program before. */
static void go_back(struct link *link)
{
	const struct slots *slots = link->with.slots;
	const bool aside = slots_back(link->with.slots);
	struct standby *bad, *standby = download_back(link->download, &bad);
	const struct program *program = use(link, standby);
	char to[65];

	event_program(bad->before_identity, to);
	journal_add(link->journal, EVENT_BACK, 0, "", to, bad->why);
	if (!aside)
		journal_add(link->journal, EVENT_NOT_BACK, 0, "", slots->why, "");
	server_changed(link->server, program, bad->why);
	standby_free(bad);
}

static void end_trial(struct link *link)
{
	enum trial trial;

	/* An order that is late may be the exchange before the trial, or need what going back frees. */
	if (atomic_load(&link->trial) == TRIAL_NONE || !wait_for_scan(link))
		return;
	trial = (enum trial)atomic_exchange(&link->trial, TRIAL_NONE);
	server_settle(link->server); /* the exchange before the trial */
	if (trial == TRIAL_BACK)
		go_back(link);
	else
		download_passed(link->download);
}

static void hang_up(struct link *link, int i)
{
	if (link->fd[i] < 0)
		return;
	server_close(link->server, i);
	close(link->fd[i]);
	link->fd[i] = -1;
}

/* ---- the serial line ---- */

static void end_port_session(struct link *link)
{
	if (link->port.session >= 0)
		server_close(link->server, link->port.session);
	link->port.session = -1;
}

static void lose_port(struct link *link)
{
	end_port_session(link);
	close(link->port.fd);
	link->port.fd = -1;
	control_tell("the serial line has gone; trying again");
}

static int open_port(struct link *link)
{
	struct port *port = &link->port;
	uint32_t baud;
	const int fd = port_open(port->text, &baud);

	port->tried_ns = clock_now();
	port->session = -1;
	port->fd = fd < 0 ? -1 : fd;
	if (fd < 0)
		return fd;
	serial_init(&port->serial, SERIAL_BOARD, baud);
	return 0;
}

/* The stream of a session that had to make room is closed. */
static void drop_stream(struct link *link, int session)
{
	if (link->fd[session] >= 0)
		close(link->fd[session]);
	link->fd[session] = -1;
	if (link->port.session == session) {
		serial_end(&link->port.serial);
		link->port.session = -1;
	}
}

static void begin_port_session(struct link *link)
{
	int session;

	end_port_session(link);
	session = server_open(link->server, link->port.role, false, "serial", UINT32_MAX);
	if (session < 0) {
		serial_end(&link->port.serial);
		return;
	}
	drop_stream(link, session);
	link->port.session = session;
}

/* A piece that finds no room comes again. */
static void take_piece(struct link *link)
{
	struct port *port = &link->port;
	size_t room = 0;
	uint8_t *to;

	if (port->session < 0)
		return;
	to = server_room(link->server, port->session, &room);
	if (room < port->serial.piece_len)
		return;
	memcpy(to, port->serial.piece, port->serial.piece_len);
	server_got(link->server, port->session, port->serial.piece_len);
	serial_take(&port->serial);
}

static bool hear_port(struct link *link)
{
	uint8_t bytes[256];
	const ssize_t got = read(link->port.fd, bytes, sizeof(bytes));
	const int64_t now_ns = clock_now();

	for (ssize_t i = 0; i < got; i++)
		switch (serial_byte(&link->port.serial, bytes[i], now_ns)) {
		case SERIAL_BEGUN:
			begin_port_session(link);
			break;
		case SERIAL_CAME:
			take_piece(link);
			break;
		case SERIAL_ENDED:
			end_port_session(link);
			break;
		case SERIAL_NOTHING:
		case SERIAL_TAKEN:
			break;
		}
	return got > 0 || (got < 0 && (errno == EAGAIN || errno == EINTR));
}

static bool say_port(struct link *link)
{
	struct port *port = &link->port;
	const uint8_t *bytes;
	ssize_t sent = 0;
	size_t len;

	if (port->session >= 0 && server_is_over(link->server, port->session)) {
		end_port_session(link);
		serial_end(&port->serial);
	}
	if (port->session >= 0 && serial_is_free(&port->serial)) {
		bytes = server_pending(link->server, port->session, &len);
		if (len)
			server_sent(link->server, port->session,
				    serial_send(&port->serial, bytes, len, clock_now()));
	}
	bytes = serial_pending(&port->serial, &len);
	if (len)
		sent = write(port->fd, bytes, len);
	if (sent > 0)
		serial_wrote(&port->serial, (size_t)sent);
	return sent >= 0 || errno == EAGAIN || errno == EINTR;
}

/* Once a turn of the thread. @happened: as poll() says. */
static void serve_port(struct link *link, short happened)
{
	struct port *port = &link->port;

	if (port->fd < 0 && port->text && clock_now() - port->tried_ns > REST_NS &&
	    open_port(link) == 0)
		control_tell("the serial line is there again");
	if (port->fd < 0)
		return;
	if (happened & ~POLLOUT && !hear_port(link)) {
		lose_port(link);
		return;
	}
	if (!serial_step(&port->serial, clock_now()))
		end_port_session(link);
	if (!say_port(link))
		lose_port(link);
}

/* The last packet ends the session of the desk, if the line takes it. */
static void close_port(struct link *link)
{
	if (link->port.fd < 0)
		return;
	end_port_session(link);
	serial_end(&link->port.serial);
	say_port(link);
	close(link->port.fd);
	link->port.fd = -1;
}

/* ---- sockets ---- */

/* One session too many gets a refusal, if it listens, and is closed. */
static void send_away(int fd)
{
	uint8_t bytes[128];
	struct wire_writer out = wire_write(bytes, sizeof(bytes));
	size_t len;

	frame_begin(&out, 0, WIRE_ANSWER | WIRE_REFUSED, 0);
	wire_put_u16(&out, REFUSAL_SESSIONS);
	wire_put_string(&out, "");
	len = frame_end(&out);
	/* The socket is new, so the bytes fit; if not, the close says enough. */
	if (send(fd, bytes, len, MSG_NOSIGNAL | MSG_DONTWAIT) < 0)
		errno = 0;
	close(fd);
}

static void take_in(struct link *link)
{
	const int fd = accept4(link->listening, NULL, NULL, SOCK_CLOEXEC | SOCK_NONBLOCK);
	struct peer peer;
	int session;

	if (fd < 0)
		return;
	if (peer_ask(fd, &link->groups, &peer) != 0) {
		close(fd);
		return;
	}
	session = server_open(link->server, peer.role, peer.may_io, peer.user, peer.uid);
	if (session < 0) {
		send_away(fd);
		return;
	}
	drop_stream(link, session);
	link->fd[session] = fd;
}

static bool hear(struct link *link, int i)
{
	size_t room;
	uint8_t *to = server_room(link->server, i, &room);
	ssize_t got;

	if (!room)
		return true;
	got = recv(link->fd[i], to, room, MSG_DONTWAIT);
	if (got > 0)
		server_got(link->server, i, (size_t)got);
	return got > 0 || (got < 0 && (errno == EAGAIN || errno == EINTR));
}

static bool say(struct link *link, int i)
{
	size_t len;
	const uint8_t *from = server_pending(link->server, i, &len);
	ssize_t sent;

	if (!len)
		return !server_is_over(link->server, i);
	sent = send(link->fd[i], from, len, MSG_NOSIGNAL | MSG_DONTWAIT);
	if (sent > 0)
		server_sent(link->server, i, (size_t)sent);
	return (sent > 0 || errno == EAGAIN || errno == EINTR) &&
	       !server_is_over(link->server, i);
}

static int poll_ms(struct link *link, bool more)
{
	const int64_t line_ns = serial_due(&link->port.serial), now_ns = clock_now();
	int64_t due_ns = server_due(link->server);

	if (link->port.fd >= 0 && line_ns < due_ns)
		due_ns = line_ns;
	if (link->alarms_wait && now_ns + FLOOD_NS < due_ns)
		due_ns = now_ns + FLOOD_NS;
	if (more || due_ns <= now_ns)
		return 0;
	return (int)((due_ns - now_ns > REST_NS ? REST_NS : due_ns - now_ns + 999999) / 1000000);
}

/* It counts; what for is found out without it. */
static void stay_awake(struct link *link)
{
	uint64_t count;

	if (read(link->wake, &count, sizeof(count)) < 0)
		errno = 0;
}

static void watch_streams(struct link *link, bool more)
{
	struct pollfd ready[OURS + SERVER_SESSIONS] = {
		{ .fd = link->wake, .events = POLLIN },
		{ .fd = link->listening, .events = POLLIN },
		{ .fd = link->port.fd, .events = POLLIN },
	};
	size_t waits;

	serial_pending(&link->port.serial, &waits);
	if (waits)
		ready[2].events |= POLLOUT;

	for (int i = 0; i < SERVER_SESSIONS; i++) {
		struct pollfd *stream = &ready[OURS + i];
		size_t room = 0, pending = 0;

		stream->fd = link->fd[i];
		if (stream->fd < 0)
			continue;
		server_room(link->server, i, &room);
		server_pending(link->server, i, &pending);
		stream->events = (short)((room ? POLLIN : 0) | (pending ? POLLOUT : 0));
	}
	if (poll(ready, OURS + SERVER_SESSIONS, poll_ms(link, more)) < 0)
		return;
	if (ready[0].revents)
		stay_awake(link);
	if (ready[1].revents)
		take_in(link);
	serve_port(link, ready[2].revents);
	for (int i = 0; i < SERVER_SESSIONS; i++) {
		const short happened = ready[OURS + i].revents;

		if (ready[OURS + i].fd < 0 || !happened)
			continue;
		if ((happened & (POLLERR | POLLNVAL)) ||
		    ((happened & (POLLIN | POLLHUP)) && !hear(link, i)))
			hang_up(link, i);
	}
}

/* Also after a step without a poll: most answers leave at once. */
static void send_all(struct link *link)
{
	for (int i = 0; i < SERVER_SESSIONS; i++)
		if (link->fd[i] >= 0 && !say(link, i))
			hang_up(link, i);
	if (link->port.fd >= 0 && !say_port(link))
		lose_port(link);
}

static void *serve_desks(void *argument)
{
	struct link *link = argument;
	bool more = false;

	while (!atomic_load(&link->stop)) {
		atomic_fetch_add_explicit(&link->turns, 1, memory_order_relaxed);
		watch_streams(link, more);
		end_trial(link);
		more = server_step(link->server, clock_now());
		atomic_store_explicit(&link->wants, (int)server_wants(link->server), memory_order_relaxed);
		send_all(link);
		log_state(link);
		log_late(link);
		follow_disk(link);
		follow_alarms(link);
		journal_sync(link->journal, clock_now());
	}
	exchange_post(&link->exchange, NULL); /* what the last scan did not wait for is not done */
	server_settle(link->server); /* a restart that was late is kept all the same */
	end_trial(link);
	journal_add(link->journal, EVENT_END, 0, "", "", "");
	for (int i = 0; i < SERVER_SESSIONS; i++)
		hang_up(link, i);
	close_port(link);
	return NULL;
}

/* ---- start and end ---- */

static void do_nothing(int signal_number)
{
	(void)signal_number;
}

static int start_thread(struct link *link)
{
	static const int own[] = { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT };
	const long least = PTHREAD_STACK_MIN;
	pthread_attr_t attr;
	sigset_t all, before;
	int error = pthread_attr_init(&attr);

	if (error)
		return error;
	pthread_attr_setstacksize(&attr, least > (long)STACK_LEAST ? (size_t)least : STACK_LEAST);
	pthread_attr_setinheritsched(&attr, PTHREAD_EXPLICIT_SCHED);
	sigfillset(&all);
	for (size_t i = 0; i < sizeof(own) / sizeof(own[0]); i++)
		sigdelset(&all, own[i]);
	pthread_sigmask(SIG_SETMASK, &all, &before);
	error = pthread_create(&link->thread, &attr, serve_desks, link);
	pthread_sigmask(SIG_SETMASK, &before, NULL);
	pthread_attr_destroy(&attr);
	return error;
}

/* Why ladderd has started: what ladder-guard says, or else the record of ends. Orderly ends are not
 * logged. */
static void note_began(struct link *link)
{
	const uint8_t last = ends_begin(link->with.slots->folder);
	char number[12] = "", times[12] = "";
	unsigned count = 0;
	const int how = guarded_again(&count);

	link->began = how >= GUARD_STATUS ? EVENT_FAILED : how == GUARD_HUNG ? EVENT_HUNG :
		      how == GUARD_FROZEN ? EVENT_FROZE : how ? EVENT_DIED : last;
	link->began_how = (uint16_t)(how >= GUARD_STATUS ? how - GUARD_STATUS : how);
	link->began_ends = how ? count : 0;
	if (how) {
		snprintf(number, sizeof(number), "%u", (unsigned)link->began_how);
		snprintf(times, sizeof(times), "%u", count);
	}
	if (link->began == EVENT_FROZE || link->began == EVENT_HUNG)
		*number = '\0';
	if (how || last == EVENT_POWER || last == EVENT_AFTER)
		journal_add(link->journal, (enum event_id)link->began, 0, "", number, times);
	if (last == EVENT_ENDS) {
		link->cycle->begin_stopped = true;
		link->cycle->stopped = GUARDED_MANY;
		control_tell("ended abnormally three times within a minute: STOP");
	}
	if (!link->cycle->stopped)
		return;
	link->began = EVENT_ENDS;
	link->began_ends = 0;
	journal_add(link->journal, EVENT_ENDS, 0, "", "", "");
}

int link_begin(struct link *link)
{
	struct sigaction action;
	int error;

	memset(&action, 0, sizeof(action));
	action.sa_handler = do_nothing;
	action.sa_flags = SA_RESTART;
	sigemptyset(&action.sa_mask);
	sigaction(SIGURG, &action, NULL);
	note_began(link);
	journal_add(link->journal, EVENT_START, 0, "", link->cycle->identity, "");
	if (link->with.conf->damaged)
		journal_add(link->journal, EVENT_CONF_BAD, 0, "", "", "");
	for (int i = 0; i < 2; i++)
		if (link->with.slots->bad[i])
			journal_add(link->journal, EVENT_SLOT_BAD, 0, "", i ? "prog.B" : "prog.A", "");
	link->state = -1;
	atomic_store(&link->exchange.state, -1); /* unknown until the next scan */
	watch_blocks(link); /* before retained values come */
	link->scans = pthread_self();
	link->turned_ns = link->began_ns = clock_now();
	error = start_thread(link);
	link->runs = !error;
	if (error)
		ends_orderly(link->with.slots->folder); /* nothing has run */
	return -error;
}

void link_close(struct link *link)
{
	if (link->runs) {
		atomic_store(&link->stop, true);
		wake_up(link);
		pthread_join(link->thread, NULL);
		ends_orderly(link->with.slots->folder);
		link->cycle->store = link->retain;
	}
	if (link->listening >= 0)
		close(link->listening);
	if (*link->path)
		unlink(link->path);
	if (link->wake >= 0)
		close(link->wake);
	if (link->port.fd >= 0)
		close(link->port.fd); /* there was no thread */
	link->runs = false;
	link->listening = link->wake = link->port.fd = -1;
}

void link_free(struct link *link)
{
	if (!link)
		return;
	server_free(link->server);
	gateways_free(&link->gateways);
	machine_free(link->machine);
	journal_close(link->journal);
	alarm_store_close(&link->alarm_store, &link->alarms.list);
	free(link->alarms.before);
	free(link->alarms.watch);
	free(link->asks_before);
	free(atomic_load(&link->asks));
	download_free(link->download);
	arena_free(&link->retain_arena);
	free(link->views);
	free(link->record);
	free(link);
}

static struct link *refuse(struct link *link, const char *option, const char *value, const char *why)
{
	fprintf(stderr, "ladderd: %s %s: %s\n", option, value, why);
	if (link) {
		link->path[0] = '\0';
		link_close(link);
		link_free(link);
	}
	return NULL;
}

/* Removes the socket of a ladderd that has gone. */
static int clear_path(const struct sockaddr_un *address)
{
	struct stat about;
	int fd, error = 0;

	if (lstat(address->sun_path, &about) != 0)
		return errno == ENOENT ? 0 : -errno;
	if (!S_ISSOCK(about.st_mode))
		return -EEXIST;
	fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
	if (fd < 0)
		return -errno;
	if (connect(fd, (const void *)address, sizeof(*address)) == 0)
		error = -EADDRINUSE;
	close(fd);
	return error ? error : unlink(address->sun_path) == 0 ? 0 : -errno;
}

/* Everyone may connect; roles decide what a client may ask. */
static int listen_at(struct link *link, const char *path)
{
	struct sockaddr_un address = { .sun_family = AF_UNIX };
	int error;

	if (strlen(path) >= sizeof(address.sun_path))
		return -ENAMETOOLONG;
	memcpy(address.sun_path, path, strlen(path));
	error = clear_path(&address);
	if (error)
		return error;
	link->listening = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
	if (link->listening < 0)
		return -errno;
	if (bind(link->listening, (const void *)&address, sizeof(address)) != 0)
		return -errno;
	memcpy(link->path, path, strlen(path) + 1);
	if (chmod(path, 0666) != 0 || listen(link->listening, BACKLOG) != 0)
		return -errno;
	return 0;
}

/* Without mlockall() each page would be a fault of the scan that comes to it. NULL: no memory. */
static void *new_record(size_t len)
{
	volatile uint8_t *record = calloc(1, len);

	for (size_t at = 0; record && at < len; at += PAGE_LEAST)
		record[at] = 0;
	return (void *)record;
}

static bool set_up(struct link *link, struct cycle *cycle)
{
	const struct program *program = cycle->resource.image.program;
	const size_t size = image_memory_size(program);
	const struct server_setup setup = {
		.exchange = &link->exchange, .program = program, .board = &cycle->board,
		.wait = wait_for_scan, .wait_unless_hung = wait_unless_hung, .hangs = scan_hangs, .amend = amend_status, .context = link,
		.store = &link->store, .log = &link->log, .conf = &link->conf, .password = &link->lock,
		.keeps = cycle->store, .alarms = &link->alarms, .clock = &wall_clock,
		.io = &link->io, .machine = &link->devices,
	};

	link->views = calloc(3, size);
	if (!link->views)
		return false;
	link->host = (struct exchange_host){
		.context = link, .resource = host_resource, .identity = host_identity,
		.mode = host_mode, .status = host_status, .swap = host_swap,
		.restart = host_restart, .restore = host_restore,
	};
	link->store = (struct server_store){
		.begin = store_begin_download, .block = store_block, .verify = store_verify,
		.open_lines = store_open_lines, .close_lines = store_close_lines,
		.store = store_slot, .keep = keep_slot, .drop = drop_slot, .swapped = store_swapped,
		.abort = store_abort, .running = store_running, .image = store_image,
	};
	exchange_init(&link->exchange, &link->host, link->views, size);
	link->lock = (struct server_password){
		.is_set = lock_is_set, .check = lock_check, .change = lock_change,
	};
	password_load(&link->password, link->with.slots->folder);
	if (link->with.record_kb) {
		link->record = new_record(RECORDER_BESIDE + (size_t)link->with.record_kb * 1024);
		if (!link->record)
			fprintf(stderr, "ladderd: no memory for --record %u\n",
				(unsigned)link->with.record_kb);
	}
	if (link->record) {
		recorder_init(&link->recorder, link->record, link->with.record_kb * 1024);
		recorder_tell_quality(&link->recorder, &(struct recorder_quality){
			.serial = quality_serial, .each = each_bad, .context = link });
		link->exchange.recorder = &link->recorder;
	}
	link->conf = (struct server_conf){ .get = conf_read, .change = conf_write };
	link->first_map = cycle->hal.map;
	link->first_channels = hal_channels(&cycle->hal);
	use_map(link, cycle->resource.image.program, link->first_map, link->first_channels);
	link->io = gateways_io(&link->gateways);
	link->machine = machine_new(cycle->hal.map->dev, cycle->hal.map->sys);
	link->devices = machine_io(link->machine);
	link->log = (struct server_log){ .add = log_add, .next = log_next };
	link->journal = journal_open(link->with.slots->folder);
	link->alarms.clock_ns = clock_wall;
	alarm_store_open(&link->alarm_store, link->with.slots->folder, &link->alarms.list,
			 clock_wall());
	link->server = server_new(&setup);
	link->download = download_new(link->with.slots, cycle, link->with.map_text,
				      link->with.map_len);
	return link->server && link->machine && link->download && link->journal;
}

static struct link *open_socket(struct link *link, const struct options *options)
{
	const int error = options->link ? listen_at(link, options->link) : 0;
	char why[160];

	if (!error)
		return link;
	snprintf(why, sizeof(why), "%s; %s", strerror(-error), disk_hint(error));
	return refuse(link, "--link", options->link,
		      error == -EADDRINUSE ? "another ladderd listens there" :
		      error == -EEXIST ? "there is a file, and it is no socket" : why);
}

static struct link *open_serial(struct link *link, const struct options *options)
{
	int error;

	link->port.text = options->serial;
	for (enum role role = ROLE_VIEW; role < ROLE_PERSONS; role++)
		if (strcmp(role_word(role), options->serial_role) == 0)
			link->port.role = role;
	if (link->port.role == ROLE_NONE)
		return refuse(link, "--serial-role", options->serial_role, "is not view, oper or eng");
	error = options->serial ? open_port(link) : 0;
	if (!error)
		return link;
	return refuse(link, "--serial", options->serial, port_why(error));
}

struct link *link_open(const struct options *options, struct cycle *cycle,
		       const struct link_store *store)
{
	struct link *link = calloc(1, sizeof(*link));

	if (!link)
		return refuse(link, "--link", "", "out of memory");
	link->cycle = cycle;
	link->with = *store;
	store->program->index = symbol_index_new(store->program, store->arena);
	link->retain = cycle->store;
	arena_init(&link->retain_arena);
	link->alarm_store.fd = -1;
	link->listening = link->wake = link->port.fd = link->port.session = -1;
	for (int i = 0; i < SERVER_SESSIONS; i++)
		link->fd[i] = -1;
	if (!set_up(link, cycle))
		return refuse(link, "--link", "", "out of memory");
	peer_groups_read(&link->groups, options->groups);
	link->wake = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
	if (link->wake < 0)
		return refuse(link, "--link", "", strerror(errno));
	link = open_socket(link, options);
	return link ? open_serial(link, options) : NULL;
}
