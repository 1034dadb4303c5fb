/* SPDX-License-Identifier: MIT
 *
 * peer - who is at the other end of a local socket, and what its groups let it do.
 *
 * The kernel answers, not the peer: SO_PEERCRED and SO_PEERGROUPS. Names of groups come from
 * /etc/group, read once at the start.
 */
#ifndef LADDERD_PEER_H
#define LADDERD_PEER_H

#include "online/service.h"

#include <sys/types.h>

struct peer_groups {
	gid_t gid[ROLE_COUNT]; /* of ladder-view, ladder-oper, ladder-eng, ladder-io */
	bool known[ROLE_COUNT];
};

struct peer {
	enum role role;        /* of a person; ROLE_IO: of a gateway and nothing else */
	bool may_io;           /* it may be a gateway, if it asks for that    */
	uid_t uid;
	char user[32];         /* "pi", "uid 1000"; for the log               */
};

/** peer_groups_read - @path: "/etc/group". Groups that do not exist give nobody a role. */
void peer_groups_read(struct peer_groups *groups, const char *path);
/**
 * peer_ask - the role of the process that connected to @fd
 *
 * The highest of its groups. The user that ladderd runs as has all rights, unless this is
 * root: that user could also end ladderd and start another one. Root has no role without a
 * group. Fails: -errno.
 */
int peer_ask(int fd, const struct peer_groups *groups, struct peer *out);
#endif
