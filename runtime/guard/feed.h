/* SPDX-License-Identifier: MIT
 *
 * feed - the watchdog device, and the service manager by the protocol of sd_notify(3).
 */
#ifndef GUARD_FEED_H
#define GUARD_FEED_H

#include <stdbool.h>
#include <stdint.h>
#include <sys/socket.h>
#include <sys/un.h>

struct feed {
	const char *path;      /* of the watchdog device; NULL: none          */
	int device;            /* -1: none is open                            */
	bool lost;             /* reported: the device takes no byte          */
	int socket;            /* -1: no service manager                      */
	struct sockaddr_un to;
	socklen_t to_len;
	int64_t every_ms;      /* between two feeds; at most a second         */
	int64_t fed_ms;
};

/** feed_open - opens what @device (borrowed; NULL: none) and the environment name. Fails: false, after a message. */
bool feed_open(struct feed *feed, const char *device);
/** feed_give - feeds both if it is time. A device that takes no byte any more is reported once and opened
 * again at each feed. */
void feed_give(struct feed *feed, int64_t now_ms);
/** feed_tell - sends a state such as "READY=1"; never waits. */
void feed_tell(const struct feed *feed, const char *state);
/** feed_close - an orderly end: the device does not restart the machine. */
void feed_close(struct feed *feed);
#endif
