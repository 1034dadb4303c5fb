/* SPDX-License-Identifier: MIT
 *
 * feed - one byte for the watchdog device and WATCHDOG=1 for the service manager.
 */
#define _DEFAULT_SOURCE
#include "guard/feed.h"

#include "guard/text.h"

#include <errno.h>
#include <fcntl.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define EVERY_MS 1000

static bool open_socket(struct feed *feed)
{
	const char *path = getenv("NOTIFY_SOCKET");
	const size_t len = path ? strlen(path) : 0;

	if (len == 0)
		return true;
	if (len >= sizeof(feed->to.sun_path) || (path[0] != '/' && path[0] != '@')) {
		text_say("NOTIFY_SOCKET: no path of a socket");
		return false;
	}
	feed->to.sun_family = AF_UNIX;
	memcpy(feed->to.sun_path, path, len);
	if (path[0] == '@')
		feed->to.sun_path[0] = 0;
	feed->to_len = (socklen_t)(offsetof(struct sockaddr_un, sun_path) + len +
				   (path[0] == '/'));
	feed->socket = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
	return true;
}

/* Half of the time of the service manager, if that is shorter than a second. */
static int64_t interval(void)
{
	const char *us = getenv("WATCHDOG_USEC");
	const long long wanted = us ? text_number(us) / 2000 : 0;

	return wanted >= 1 && wanted < EVERY_MS ? wanted : EVERY_MS;
}

static const char *what_to_do(int error)
{
	switch (error) {
	case EACCES:
	case EPERM:
		return "give the user of the service the right to write it";
	case EBUSY:
		return "another program feeds it: stop that, such as RuntimeWatchdogSec of systemd";
	default:
		return "name a watchdog device of this machine";
	}
}

static bool open_device(struct feed *feed)
{
	feed->device = open(feed->path, O_WRONLY | O_CLOEXEC | O_NONBLOCK);
	return feed->device >= 0;
}

bool feed_open(struct feed *feed, const char *device)
{
	memset(feed, 0, sizeof(*feed));
	feed->path = device;
	feed->device = feed->socket = -1;
	feed->every_ms = interval();
	if (!open_socket(feed))
		return false;
	if (!device || open_device(feed))
		return true;
	text_say("watchdog \"%s\": %s; %s, or leave --watchdog out", device,
		strerror(errno), what_to_do(errno));
	return false;
}

static void feed_device(struct feed *feed)
{
	const bool good = (feed->device >= 0 || open_device(feed)) && write(feed->device, "", 1) == 1;

	if (good != feed->lost)
		return;
	feed->lost = !good;
	if (good)
		text_say("watchdog \"%s\" is fed again", feed->path);
	else
		text_say("watchdog \"%s\" takes no byte: %s; if it still counts, it "
			"restarts the machine; the guard tries again", feed->path, strerror(errno));
}

void feed_give(struct feed *feed, int64_t now_ms)
{
	if (now_ms - feed->fed_ms < feed->every_ms)
		return;
	feed->fed_ms = now_ms;
	if (feed->path)
		feed_device(feed);
	if (feed->lost && feed->device >= 0) {
		close(feed->device);
		feed->device = -1;
	}
	if (getenv("WATCHDOG_USEC"))
		feed_tell(feed, "WATCHDOG=1");
}

void feed_tell(const struct feed *feed, const char *state)
{
	if (feed->socket >= 0)
		sendto(feed->socket, state, strlen(state), MSG_NOSIGNAL | MSG_DONTWAIT,
		       (const struct sockaddr *)&feed->to, feed->to_len);
}

void feed_close(struct feed *feed)
{
	if (feed->device >= 0 && write(feed->device, "V", 1) < 0)
		text_say("the watchdog was not stopped: %s",
			strerror(errno));
	if (feed->device >= 0)
		close(feed->device);
	if (feed->socket >= 0)
		close(feed->socket);
	feed->device = feed->socket = -1;
}
