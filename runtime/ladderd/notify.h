/* SPDX-License-Identifier: MIT
 *
 * notify - sends READY, STOPPING, WATCHDOG and STATUS to a service manager, by the protocol
 * of sd_notify(3). Without NOTIFY_SOCKET it does nothing.
 */
#ifndef LADDERD_NOTIFY_H
#define LADDERD_NOTIFY_H

#include <stdint.h>
#include <sys/socket.h>
#include <sys/un.h>

struct notify {
	int fd;                /* -1: no socket                               */
	struct sockaddr_un to;
	socklen_t to_len;
	int64_t every_ns;      /* between two WATCHDOG=1; 0: none             */
	int64_t fed_ns;        /* last WATCHDOG=1                             */
};

/** notify_open - reads the environment, opens the socket. Scan-safe: no. Fails: -errno. */
int notify_open(struct notify *notify);
void notify_close(struct notify *notify);
/** notify_send - sends a state such as "READY=1"; never waits. Scan-safe: yes. */
void notify_send(const struct notify *notify, const char *state);
/** notify_feed - sends WATCHDOG=1 if it is due. Scan-safe: yes. */
void notify_feed(struct notify *notify, int64_t now_ns);
#endif
