/* SPDX-License-Identifier: MIT
 *
 * guarded - packets for ladder-guard (guard/say.h).
 */
#include "ladderd/guarded.h"

#include "guard/say.h"
#include "hal/channels.h"
#include "hal/request.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#define TAKE_MS 2000

/* A signal handler sends heartbeats. */
static struct {
	volatile int fd;       /* + 1; 0: no guard                            */
	int64_t heartbeat_ms, last_ms;
	int how;
	unsigned ends;
	struct guard_page *page; /* NULL: the guard sees none                 */
} to;

struct guard_page *guarded_page(void)
{
	static struct guard_page unseen;

	return to.page ? to.page : &unseen;
}

static void open_page(int fd)
{
	void *page = mmap(NULL, sizeof(*to.page), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);

	if (page != MAP_FAILED)
		to.page = page;
	close(fd);
}

const char *guarded_begin(void)
{
	const char *text = getenv(GUARD_VARIABLE);
	char *end;
	long fd, ms, stopped, ends, how, page;

	if (!text)
		return NULL;
	fd = strtol(text, &end, 10);
	ms = strtol(end, &end, 10);
	stopped = strtol(end, &end, 10);
	ends = strtol(end, &end, 10);
	how = strtol(end, &end, 10);
	page = strtol(end, &end, 10);
	unsetenv(GUARD_VARIABLE);
	if (*end || fd <= STDERR_FILENO || fd > 65535 || ms < 1 || ms > GUARD_LONGEST / 2 ||
	    fcntl((int)fd, F_SETFD, FD_CLOEXEC) != 0)
		return NULL;
	if (page > STDERR_FILENO)
		open_page((int)page);
	to.heartbeat_ms = ms;
	to.ends = (unsigned)ends;
	to.how = (int)how;
	to.fd = (int)fd + 1;
	return stopped == 1 ? GUARDED_MANY : NULL;
}

int guarded_again(unsigned *count)
{
	const int how = to.how;

	to.how = 0;
	*count = to.ends;
	return how;
}

static void say(const void *packet, size_t len)
{
	send(to.fd - 1, packet, len, MSG_NOSIGNAL | MSG_DONTWAIT);
}

void guarded_beat(int64_t next_ms, bool now)
{
	struct guard_head beat = { .magic = GUARD_MAGIC, .kind = GUARD_BEAT };
	struct timespec time;
	int64_t time_ms;

	if (!to.fd)
		return;
	clock_gettime(CLOCK_MONOTONIC, &time);
	time_ms = (int64_t)time.tv_sec * 1000 + time.tv_nsec / 1000000;
	if (!now && time_ms - to.last_ms < to.heartbeat_ms / 4)
		return;
	to.last_ms = time_ms;
	next_ms += to.heartbeat_ms;
	beat.within_ms = (uint32_t)(next_ms < GUARD_LONGEST ? next_ms : GUARD_LONGEST);
	say(&beat, sizeof(beat));
}

/* The next line of an output that has a place; those of a table are in this order. */
struct guard_place {
	struct hal_request *request, *end;
	uint32_t line;         /* + 1                                         */
};

static struct guard_place first_place(const struct hal *hal)
{
	return (struct guard_place){ hal->request, hal->request + hal->request_count, 0 };
}

static bool next_place(struct guard_place *at)
{
	for (; at->request < at->end; at->request++, at->line = 0)
		while (at->request->ask.output && at->line < at->request->ask.count)
			if (at->request->ask.line[at->line++].at.chip >= 0)
				return true;
	return false;
}

static bool bit_of(uint64_t bits, const struct guard_place *at)
{
	return bits >> (at->line - 1) & 1;
}

static void add_line(struct guard_line *out, const struct guard_place *at)
{
	static const uint8_t bias[] = {
		[BIAS_AS_IS] = 0, [BIAS_NONE] = 1, [BIAS_UP] = 2, [BIAS_DOWN] = 3,
	};
	static const uint8_t drive[] = {
		[DRIVE_AS_IS] = 0, [DRIVE_PUSH_PULL] = 1, [DRIVE_OPEN_DRAIN] = 2,
		[DRIVE_OPEN_SOURCE] = 3,
	};
	const struct hal_request *request = at->request;
	const struct request_line *line = &request->ask.line[at->line - 1];

	*out = (struct guard_line){
		.chip = (uint16_t)line->at.chip, .offset = (uint16_t)line->at.offset,
		.level = bit_of(request_levels(request, request_safe(request)), at),
		.bias = bias[line->point->bias], .drive = drive[line->point->drive],
		.hold = !bit_of(request->hold, at) ? GUARD_SAFE :
			request->is_open ? GUARD_HOLD : GUARD_KNOWN,
	};
}

/* @fresh: only the lines that are not open in another map. */
static bool send_table(struct guard_table *table, enum guard_kind kind, const struct hal *hal,
		       bool fresh)
{
	struct guard_place at = first_place(hal);
	uint16_t count = 0;
	unsigned dropped = 0;

	memset(table, 0, sizeof(*table));
	while (next_place(&at))
		if (fresh && at.request->twin)
			continue;
		else if (count == GUARD_LINES)
			dropped++;
		else
			add_line(&table->line[count++], &at);
	table->head = (struct guard_head){ .magic = GUARD_MAGIC, .kind = (uint16_t)kind,
					   .count = count };
	if (strlen(hal->map->dev) < sizeof(table->dev))
		memcpy(table->dev, hal->map->dev, strlen(hal->map->dev));
	if (dropped)
		fprintf(stderr, "ladderd: ladder-guard holds %d outputs; %u are not made safe by it\n",
			GUARD_LINES, dropped);
	if (send(to.fd - 1, table, offsetof(struct guard_table, line) +
		 count * sizeof(table->line[0]), MSG_NOSIGNAL | MSG_DONTWAIT) < 0) {
		fprintf(stderr, "ladderd: ladder-guard does not listen; it knows no outputs\n");
		return false;
	}
	return dropped == 0;
}

/* The packet, and the bytes of its records so far. */
struct records {
	struct guard_files *files;
	size_t len;
};

static bool add_file(void *context, const char *path, int64_t number)
{
	struct records *all = context;
	struct guard_files *files = all->files;
	const size_t len = strlen(path) + 1;

	if (len > GUARD_PATH)
		return true;
	if (files->head.count == GUARD_FILES || all->len + sizeof(number) + len > sizeof(files->record)) {
		fprintf(stderr, "ladderd: ladder-guard knows %d outputs of converters; the others are not made safe by it\n",
			(int)files->head.count);
		return false;
	}
	memcpy(files->record + all->len, &number, sizeof(number));
	memcpy(files->record + all->len + sizeof(number), path, len);
	all->len += sizeof(number) + len;
	files->head.count++;
	return true;
}

/* Of a map without channels: none. @fresh: as send_table(). */
static bool send_files(struct guard_files *files, enum guard_kind kind, const struct hal *hal, bool fresh)
{
	struct records all = { .files = files };

	files->head = (struct guard_head){ .magic = GUARD_MAGIC, .kind = (uint16_t)kind };
	channels_safe_files(hal_channels(hal), fresh, add_file, &all);
	return send(to.fd - 1, files, offsetof(struct guard_files, record) + all.len,
		    MSG_NOSIGNAL | MSG_DONTWAIT) >= 0;
}

/* Before the write: if ladderd dies between them, the line gets what the program wants. */
static void tell_levels(const struct hal *hal, const struct hal_request *request, uint64_t value)
{
	struct guard_levels levels = { .head = { .magic = GUARD_MAGIC, .kind = GUARD_LEVELS } };
	struct guard_place at = first_place(hal);

	for (uint32_t i = 0; i < GUARD_LINES && next_place(&at); i++) {
		const uint64_t of = at.request == request ? value : at.request->value;

		levels.bit[i / 8] |= (uint8_t)(bit_of(request_levels(at.request, of), &at) << i % 8);
	}
	say(&levels, sizeof(levels));
}

bool guarded_lines(struct hal *hal)
{
	static struct guard_table table; /* no stack of ladderd is so large */
	static struct guard_files files;
	bool good;

	if (!to.fd)
		return true;
	hal->holds = tell_levels;
	good = send_table(&table, GUARD_TABLE, hal, false);
	return send_files(&files, GUARD_VALUES, hal, false) && good;
}

bool guarded_more(const struct hal *next)
{
	static const struct iomap no_map = { .dev = "/" };
	static struct guard_table table; /* another thread than that of guarded_lines() */
	static struct guard_files files;
	const struct hal empty = { .map = &no_map };
	bool good;

	if (!to.fd)
		return true;
	good = send_table(&table, GUARD_MORE, next ? next : &empty, true);
	return send_files(&files, GUARD_VALUES_MORE, next ? next : &empty, true) && good;
}

void guarded_take(struct hal *hal)
{
	struct guard_levels levels = { .head = { .magic = GUARD_MAGIC, .kind = GUARD_TAKE } };
	struct pollfd answer = { .fd = to.fd - 1, .events = POLLIN };
	struct guard_place at = first_place(hal);
	int ready;

	if (!to.fd)
		return;
	say(&levels.head, sizeof(levels.head));
	do
		ready = poll(&answer, 1, TAKE_MS);
	while (ready < 0 && errno == EINTR);
	if (ready != 1 ||
	    recv(to.fd - 1, &levels, sizeof(levels), MSG_DONTWAIT) != sizeof(levels))
		return;
	for (uint32_t i = 0; i < GUARD_LINES && next_place(&at); i++) {
		const uint64_t mask = UINT64_C(1) << (at.line - 1) & at.request->hold;
		const bool level = levels.bit[i / 8] >> i % 8 & 1;

		if (level != bit_of(at.request->invert, &at))
			at.request->value |= mask;
	}
}

void guarded_tell(const char *state)
{
	struct guard_tell tell = { .head = { .magic = GUARD_MAGIC, .kind = GUARD_TELL } };
	const size_t len = strlen(state);

	if (!to.fd || len >= sizeof(tell.text))
		return;
	memcpy(tell.text, state, len);
	say(&tell, sizeof(tell));
}
