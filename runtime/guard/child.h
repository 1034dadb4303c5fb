/* SPDX-License-Identifier: MIT
 *
 * child - starts ladderd with the socket of the guard, and sees its end.
 */
#ifndef GUARD_CHILD_H
#define GUARD_CHILD_H

#include <stdbool.h>
#include <stdint.h>
#include <sys/types.h>

#define CHILD_NO_PROGRAM 127 /* status of a child that could not be started  */

struct guard_page;
struct child {
	struct guard_page *page; /* of the present ladderd; NULL: the kernel has no such memory */
	int page_fd;           /* -1: none                                    */
	pid_t pid;             /* 0: none runs                                */
	int pidfd;             /* -1: the kernel has none; SIGCHLD tells      */
	int socket;            /* -1: none                                    */
	int status;            /* of waitpid(), after the end                 */
};

/** child_page - the memory that each ladderd gets; without it only heartbeats tell that one hangs. */
void child_page(struct child *child);
/**
 * child_start - runs @argv with LADDER_GUARD and without the variables of a service manager
 * @stopped: begin in STOP
 * @count, @how: the abnormal ends so far, and the last one, as in guard/say.h
 *
 * The signals that the guard hands on stay blocked, so one that comes before ladderd listens waits
 * for it. The kernel sends the child SIGTERM if the guard dies. Allocates nothing; vfork() does
 * without an MMU. Fails: false, after a message.
 */
bool child_start(struct child *child, char **argv, int heartbeat_ms, bool stopped,
		 unsigned count, int how);
/** child_ended - whether it has ended: then status is set. Its last packets can still be read. */
bool child_ended(struct child *child);
/** child_close - after that: closes pidfd and socket. */
void child_close(struct child *child);
#endif
