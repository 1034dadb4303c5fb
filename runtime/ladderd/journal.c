/* SPDX-License-Identifier: MIT
 *
 * journal - event number n lies in place n % EVENT_RING.
 */
#include "ladderd/journal.h"

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
	bool dirty, failing;
	int64_t synced_ns;
	uint32_t last;         /* number of the newest event                  */
	uint8_t record[EVENT_BYTES];
	struct event event[EVENT_RING];
};

static void load(struct journal *journal)
{
	for (uint32_t i = 0; i < EVENT_RING; i++) {
		struct event event;

		if (pread(journal->fd, journal->record, EVENT_BYTES, (off_t)i * EVENT_BYTES) !=
		    (ssize_t)EVENT_BYTES)
			continue;
		if (!event_open(journal->record, &event) || event.seq % EVENT_RING != i)
			continue;
		journal->event[i] = event;
		if (event.seq > journal->last)
			journal->last = event.seq;
	}
}

struct journal *journal_open(const char *folder)
{
	struct journal *journal = calloc(1, sizeof(*journal));
	char path[512];

	if (!journal)
		return NULL;
	journal->fd = -1;
	if (!folder)
		return journal;
	if (snprintf(path, sizeof(path), "%s/events", folder) < (int)sizeof(path))
		journal->fd = open(path, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0640);
	if (journal->fd < 0)
		fprintf(stderr, "ladderd: %s/events: %s; events are not stored\n", folder,
			strerror(errno));
	else
		load(journal);
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

static void store(struct journal *journal, const struct event *event)
{
	bool good;

	if (journal->fd < 0)
		return;
	event_seal(event, journal->record);
	good = pwrite(journal->fd, journal->record, EVENT_BYTES,
		      (off_t)(event->seq % EVENT_RING) * EVENT_BYTES) == (ssize_t)EVENT_BYTES;
	if (!good && !journal->failing)
		fprintf(stderr, "ladderd: events are not stored: %s\n", strerror(errno));
	journal->failing = !good;
	journal->dirty |= good;
}

/* Whole characters of UTF-8. */
static void copy(char *out, size_t size, const char *text)
{
	size_t len = strlen(text);

	if (len >= size) {
		len = size - 1;
		while (len && ((unsigned char)text[len] & 0xc0) == 0x80)
			len--;
	}
	memcpy(out, text, len);
	out[len] = '\0';
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
	copy(event->user, sizeof(event->user), user);
	copy(event->arg[0], sizeof(event->arg[0]), one);
	copy(event->arg[1], sizeof(event->arg[1]), two);
	store(journal, event);
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
	if (!journal->dirty || now_ns - journal->synced_ns < SYNC_NS)
		return;
	journal->synced_ns = now_ns;
	journal->dirty = fdatasync(journal->fd) != 0;
}
