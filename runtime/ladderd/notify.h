/* SPDX-License-Identifier: MIT
 *
 * notify - tells a service manager how it is: READY, STOPPING, WATCHDOG,
 * STATUS, in the public protocol of sd_notify(3). Without NOTIFY_SOCKET it does
 * nothing.
 */
#ifndef LADDERD_NOTIFY_H
#define LADDERD_NOTIFY_H

#include <stdint.h>
#include <sys/socket.h>
#include <sys/un.h>

struct notify {
	int fd;                /* -1: nobody listens                          */
	struct sockaddr_un to;
	socklen_t to_len;
	int64_t every_ns;      /* WATCHDOG=1 so often; 0: not wanted          */
	int64_t fed_ns;
};

/** notify_open - as the environment says. Scan-safe: no. Fails: -errno. */
int notify_open(struct notify *notify);
void notify_close(struct notify *notify);
/** notify_send - a state such as "READY=1"; never waits. Scan-safe: yes. */
void notify_send(const struct notify *notify, const char *state);
/** notify_feed - WATCHDOG=1 if it is time. Scan-safe: yes. */
void notify_feed(struct notify *notify, int64_t now_ns);
#endif
