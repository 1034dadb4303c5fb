/* SPDX-License-Identifier: MIT
 *
 * link_serial - the serial line of a small board, without a thread.
 *
 * It is served between two scans: a turn reads at most TURN_BYTES, serves one request and writes
 * what the line takes. In between the scan sleeps until a byte comes, but always wakes up for its
 * own time.
 */
#include "ladderd/link.h"
#include "hal/clock.h"
#include "ladderd/control.h"
#include "ladderd/nameless.h"

#include "online/port.h"
#include "online/serial.h"

#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define SECOND     INT64_C(1000000000)
#define MS         INT64_C(1000000)
#define TURN_BYTES 256u

struct link {
	const char *text;              /* TTY,BAUD                             */
	int fd;                        /* -1: the line has gone                */
	bool open, more;               /* a session; there is more to do at once */
	int64_t tried_ns;              /* when it was opened, or tried         */
	struct serial serial;
	struct nameless nameless;
};

/* ---- the line ---- */

static int open_port(struct link *link)
{
	uint32_t baud;

	link->fd = port_open(link->text, &baud);
	link->tried_ns = clock_now();
	link->open = false;
	if (link->fd < 0)
		return link->fd;
	serial_init(&link->serial, SERIAL_BOARD, baud);
	return 0;
}

static void lose_port(struct link *link)
{
	close(link->fd);
	link->fd = -1;
	link->open = false;
	control_tell("the serial line has gone; trying again");
}

static bool hear(struct link *link)
{
	uint8_t bytes[TURN_BYTES];
	const ssize_t got = read(link->fd, bytes, sizeof(bytes));
	const int64_t now_ns = clock_now();

	for (ssize_t i = 0; i < got; i++)
		switch (serial_byte(&link->serial, bytes[i], now_ns)) {
		case SERIAL_BEGUN:
			nameless_begin(&link->nameless);
			link->open = true;
			break;
		case SERIAL_CAME: /* a piece that finds no room comes again */
			if (link->open && nameless_take(&link->nameless, link->serial.piece,
							link->serial.piece_len))
				serial_take(&link->serial);
			break;
		case SERIAL_ENDED:
			link->open = false;
			break;
		case SERIAL_NOTHING:
		case SERIAL_TAKEN:
			break;
		}
	return got > 0 || (got < 0 && (errno == EAGAIN || errno == EINTR));
}

static bool say(struct link *link)
{
	const uint8_t *bytes;
	ssize_t sent = 0;
	size_t len;

	bytes = nameless_pending(&link->nameless, &len);
	if (link->open && len && serial_is_free(&link->serial))
		nameless_sent(&link->nameless, serial_send(&link->serial, bytes, len, clock_now()));
	nameless_pending(&link->nameless, &len);
	if (link->open && link->nameless.over && !len && serial_is_free(&link->serial)) {
		serial_end(&link->serial);
		link->open = false;
	}
	bytes = serial_pending(&link->serial, &len);
	if (len)
		sent = write(link->fd, bytes, len);
	if (sent > 0)
		serial_wrote(&link->serial, (size_t)sent);
	return sent >= 0 || errno == EAGAIN || errno == EINTR;
}

void link_serve(struct link *link)
{
	const int64_t now_ns = clock_now();

	if (link->fd < 0 && now_ns - link->tried_ns > SECOND && open_port(link) == 0)
		control_tell("the serial line is there again");
	if (link->fd < 0)
		return;
	if (!hear(link)) {
		lose_port(link);
		return;
	}
	link->more = link->open && nameless_step(&link->nameless, now_ns);
	if (!serial_step(&link->serial, now_ns))
		link->open = false;
	if (!say(link))
		lose_port(link);
}

/* ---- sleeping ---- */

/* When something is to be done, if no byte comes. */
static int64_t due(const struct link *link)
{
	const int64_t line_ns = serial_due(&link->serial);
	const int64_t told_ns = link->open ? publish_due(&link->nameless.publications) : INT64_MAX;

	return line_ns < told_ns ? line_ns : told_ns;
}

/* poll() is only as exact as a millisecond, so the last one is slept by the caller. */
bool link_doze(struct link *link, int64_t until_ns)
{
	struct pollfd line = { .fd = link->fd, .events = POLLIN };
	const int64_t now_ns = clock_now(), last_ns = until_ns - MS;
	const int64_t wake_ns = due(link) < last_ns ? due(link) : last_ns;
	size_t waits;

	if (link->fd < 0 || last_ns - now_ns < MS)
		return false;
	if (link->more || wake_ns <= now_ns)
		return true;
	serial_pending(&link->serial, &waits);
	if (waits)
		line.events |= POLLOUT;
	return poll(&line, 1, (int)((wake_ns - now_ns + MS - 1) / MS)) != 0 || wake_ns < last_ns;
}

void link_wake(struct link *link)
{
	(void)link;
}

/* ---- start and end ---- */

static struct link *refuse(struct link *link, const char *option, const char *value, const char *why)
{
	fprintf(stderr, "ladderd: %s %s: %s\n", option, value, why);
	link_free(link);
	return NULL;
}

struct link *link_open(const struct options *options, struct cycle *cycle,
		       const struct link_store *store)
{
	struct link *link = calloc(1, sizeof(*link));
	struct nameless *nameless = link ? &link->nameless : NULL;
	int error;

	if (!link)
		return refuse(NULL, "--serial", options->serial, "out of memory");
	link->text = options->serial;
	link->fd = -1;
	nameless->cycle = cycle;
	nameless->slots = store->slots;
	nameless->began_ns = clock_now();
	for (enum role role = ROLE_VIEW; role < ROLE_PERSONS; role++)
		if (strcmp(role_word(role), options->serial_role) == 0)
			nameless->role = role;
	if (nameless->role == ROLE_NONE)
		return refuse(link, "--serial-role", options->serial_role, "is not view, oper or eng");
	if (options->slots)
		nameless->download.pool = malloc(SLOT_HEAD + NAMELESS_MOST + 4);
	if (options->slots && !nameless->download.pool)
		return refuse(link, "--slots", options->slots, "out of memory");
	error = open_port(link);
	return error ? refuse(link, "--serial", options->serial, port_why(error)) : link;
}

int link_begin(struct link *link)
{
	(void)link;
	return 0;
}

void link_show(struct link *link, int64_t now_ns)
{
	(void)link, (void)now_ns;
}

void link_note(struct link *link, enum link_note note, int64_t now_ns)
{
	(void)link, (void)note, (void)now_ns;
}

/* The last packet ends the session of the desk, if the line takes it. */
void link_close(struct link *link)
{
	if (link->fd < 0)
		return;
	say(link); /* the answer to `commit` */
	serial_end(&link->serial);
	say(link);
	close(link->fd);
	link->fd = -1;
}

void link_free(struct link *link)
{
	if (!link)
		return;
	free(link->nameless.download.pool);
	free(link);
}
