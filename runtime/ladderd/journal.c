/* SPDX-License-Identifier: MIT
 *
 * journal - event number n lies in place n % EVENT_RING.
 */
#include "ladderd/journal.h"
#include "ladderd/disk.h"
#include "online/wire.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define SYNC_NS INT64_C(1000000000)

struct journal {
	int fd;                /* -1: no file                                 */
	int error;             /* an errno: why events are not stored; 0: they are */
	int64_t synced_ns;
	uint32_t last;         /* number of the newest event                  */
	uint32_t written;      /* the newest one that is in the file          */
	uint32_t synced;       /* the newest one that is on the disk          */
	char path[512];        /* "": no file                                 */
	uint8_t record[EVENT_BYTES];
	struct event event[EVENT_RING];
};

/* The record in place @i. Fails: -errno; 1: the file ends before it. */
static int read_record(struct journal *journal, int fd, uint32_t i)
{
	ssize_t got = -1;

	for (int tries = 0; got < 0 && tries < 2; tries++) /* an error may be of the moment */
		got = pread(fd, journal->record, EVENT_BYTES, (off_t)i * EVENT_BYTES);
	return got < 0 ? -errno : got != (ssize_t)EVENT_BYTES;
}

static void load(struct journal *journal, int fd)
{
	static const uint8_t never_written[EVENT_BYTES];
	unsigned damaged = 0;
	int error = 0;

	for (uint32_t i = 0; i < EVENT_RING && error <= 0; i++) {
		struct event event;

		error = read_record(journal, fd, i);
		if (error < 0)
			fprintf(stderr, "ladderd: %s: %s; an event cannot be read\n", journal->path,
				strerror(-error));
		if (error)
			continue;
		if (!event_open(journal->record, &event) || event.seq % EVENT_RING != i) {
			damaged += memcmp(journal->record, never_written, EVENT_BYTES) != 0;
			continue;
		}
		journal->event[i] = event;
		if (event.seq > journal->last)
			journal->last = event.seq;
	}
	journal->written = journal->synced = journal->last;
	if (damaged)
		fprintf(stderr, "ladderd: %s: damaged events, which are lost: %u\n", journal->path, damaged);
}

/* Tells it once. */
static void fail(struct journal *journal, int error)
{
	if (!journal->error)
		fprintf(stderr, "ladderd: %s: %s; events are not stored; %s\n", journal->path,
			strerror(error), disk_hint(error));
	journal->error = error;
}

static int open_file(struct journal *journal)
{
	journal->fd = open(journal->path, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0640);
	return journal->fd >= 0 ? 0 : errno;
}

struct journal *journal_open(const char *folder)
{
	struct journal *journal = calloc(1, sizeof(*journal));
	int error, fd;

	if (!journal)
		return NULL;
	journal->fd = -1;
	if (!folder)
		return journal;
	if (snprintf(journal->path, sizeof(journal->path), "%s/events", folder) >=
	    (int)sizeof(journal->path)) {
		journal->path[0] = '\0';
		fprintf(stderr, "ladderd: %s: %s; events are not stored; %s\n", folder,
			strerror(ENAMETOOLONG), disk_hint(ENAMETOOLONG));
		return journal;
	}
	error = open_file(journal);
	if (error == EIO || error == EINTR) /* it may be of the moment */
		error = open_file(journal);
	if (!error) {
		load(journal, journal->fd);
		return journal;
	}
	/* What stands in it can be read all the same. */
	fd = open(journal->path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
	if (fd >= 0) {
		load(journal, fd);
		close(fd);
	}
	fail(journal, error);
	return journal;
}

void journal_close(struct journal *journal)
{
	if (!journal)
		return;
	journal_sync(journal, INT64_MAX);
	if (journal->fd >= 0)
		close(journal->fd);
	free(journal);
}

/* Writes what is not in the file yet: also what could not be written earlier. */
static void store(struct journal *journal)
{
	int error = journal->fd >= 0 ? 0 : open_file(journal);

	if (journal->last - journal->written > EVENT_RING)
		journal->written = journal->last - EVENT_RING;
	while (!error && journal->written != journal->last) {
		const uint32_t seq = journal->written + 1;
		const struct event *event = &journal->event[seq % EVENT_RING];

		if (event->seq == seq) {
			event_seal(event, journal->record);
			error = -disk_write(journal->fd, journal->record, EVENT_BYTES,
					    (off_t)(seq % EVENT_RING) * EVENT_BYTES);
		}
		if (!error)
			journal->written = seq;
	}
	if (error)
		fail(journal, error);
}

void journal_add(struct journal *journal, enum event_id id, uint8_t role, const char *user,
		 const char *one, const char *two)
{
	struct event *event = &journal->event[++journal->last % EVENT_RING];
	struct timespec now;

	clock_gettime(CLOCK_REALTIME, &now);
	*event = (struct event){
		.seq = journal->last, .id = (uint8_t)id, .role = role,
		.time_ns = now.tv_sec * INT64_C(1000000000) + now.tv_nsec,
	};
	wire_cut(event->user, sizeof(event->user), user, strlen(user));
	wire_cut(event->arg[0], sizeof(event->arg[0]), one, strlen(one));
	wire_cut(event->arg[1], sizeof(event->arg[1]), two, strlen(two));
	if (*journal->path)
		store(journal);
}

bool journal_next(const struct journal *journal, uint32_t seq, struct event *out)
{
	const uint32_t first = journal->last >= EVENT_RING ? journal->last - EVENT_RING + 1 : 1;

	for (seq = seq < first ? first : seq; seq <= journal->last; seq++) {
		*out = journal->event[seq % EVENT_RING];
		if (out->seq == seq)
			return true; /* a damaged record leaves a gap */
	}
	return false;
}

void journal_sync(struct journal *journal, int64_t now_ns)
{
	if (!*journal->path || journal->synced == journal->last ||
	    now_ns - journal->synced_ns < SYNC_NS)
		return;
	journal->synced_ns = now_ns;
	store(journal);
	if (journal->written != journal->last)
		return;
	if (fdatasync(journal->fd) != 0) {
		fail(journal, errno);
		journal->written = journal->synced; /* the kernel may have dropped them */
		return;
	}
	journal->synced = journal->last;
	if (journal->error)
		fputs("ladderd: events are stored again\n", stderr);
	journal->error = 0;
}

int journal_error(const struct journal *journal)
{
	return journal->error;
}
