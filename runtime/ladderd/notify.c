/* SPDX-License-Identifier: MIT
 *
 * notify - sends datagrams to the service manager. One that cannot be sent at once is lost,
 * so that a scan never waits.
 */
#include "ladderd/notify.h"

#include "engine/base/ascii.h"
#include "ladderd/guarded.h"

#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define US_LONGEST 86400000000 /* a day */

/* -1: not a number. */
static int64_t number(const char *text)
{
	int64_t value = 0;

	if (!text || !*text)
		return -1;
	for (; ascii_digit(*text); text++)
		if (__builtin_mul_overflow(value, 10, &value) ||
		    __builtin_add_overflow(value, *text - '0', &value))
			return -1;
	return *text ? -1 : value;
}

/* Half of the watchdog time of the manager; 0: it does not watch this process. */
static int64_t feed_interval(void)
{
	int64_t pid = number(getenv("WATCHDOG_PID"));
	int64_t us = number(getenv("WATCHDOG_USEC"));

	if (us <= 0 || us > US_LONGEST || (pid >= 0 && pid != getpid()))
		return 0;
	return us * 1000 / 2;
}

int notify_open(struct notify *notify)
{
	const char *path = getenv("NOTIFY_SOCKET");
	size_t len = path ? strlen(path) : 0;

	memset(notify, 0, sizeof(*notify));
	notify->fd = -1;
	if (len == 0)
		return 0;
	if (len >= sizeof(notify->to.sun_path) ||
	    (path[0] != '/' && path[0] != '@'))
		return -EINVAL;
	notify->to.sun_family = AF_UNIX;
	memcpy(notify->to.sun_path, path, len);
	if (path[0] == '@')
		notify->to.sun_path[0] = 0; /* abstract, without a NUL */
	notify->to_len = (socklen_t)(offsetof(struct sockaddr_un, sun_path) +
				     len + (path[0] == '/'));
	notify->fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
	if (notify->fd < 0)
		return -errno;
	notify->every_ns = feed_interval();
	return 0;
}

void notify_close(struct notify *notify)
{
	if (notify->fd >= 0)
		close(notify->fd);
	notify->fd = -1;
}

void notify_send(const struct notify *notify, const char *state)
{
	guarded_tell(state);
	if (notify->fd >= 0)
		sendto(notify->fd, state, strlen(state),
		       MSG_NOSIGNAL | MSG_DONTWAIT,
		       (const struct sockaddr *)&notify->to, notify->to_len);
}

void notify_feed(struct notify *notify, int64_t now_ns)
{
	if (!notify->every_ns || now_ns - notify->fed_ns < notify->every_ns)
		return;
	notify->fed_ns = now_ns;
	notify_send(notify, "WATCHDOG=1");
}
