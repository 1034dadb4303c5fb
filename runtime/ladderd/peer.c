/* SPDX-License-Identifier: MIT
 *
 * peer - reads /etc/group itself: a static C library has no getgrnam() that works without its
 * plug-ins.
 */
#define _GNU_SOURCE /* struct ucred */
#include "ladderd/peer.h"

#include "engine/base/ascii.h"
#include "engine/base/file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#define FILE_MOST (1u << 20)
#define GROUPS_MOST 200 /* of one process that are looked at                  */

/* Of /etc/passwd: `name:x:1000:…`. */
static bool has_uid(const char *line, size_t len, uid_t uid, size_t *name_len)
{
	char number[16];
	const char *colon = memchr(line, ':', len), *end = line + len;
	int digits = snprintf(number, sizeof(number), "%u:", (unsigned)uid);

	if (!colon || colon == line)
		return false;
	*name_len = (size_t)(colon - line);
	colon = memchr(colon + 1, ':', (size_t)(end - colon - 1));
	return colon && end - colon - 1 >= digits &&
	       memcmp(colon + 1, number, (size_t)digits) == 0;
}

static void name_user(struct peer *peer)
{
	size_t len = 0, name_len;
	char *text = file_read("/etc/passwd", FILE_MOST, &len, NULL);

	snprintf(peer->user, sizeof(peer->user), "uid %u", (unsigned)peer->uid);
	for (char *at = text; at && at < text + len;) {
		char *stop = memchr(at, '\n', (size_t)(text + len - at));
		const size_t line = stop ? (size_t)(stop - at) : (size_t)(text + len - at);

		if (has_uid(at, line, peer->uid, &name_len)) {
			snprintf(peer->user, sizeof(peer->user), "%.*s",
				 name_len < 31 ? (int)name_len : 31, at);
			break;
		}
		at += line + 1;
	}
	free(text);
}

/* `name:x:1000:members`. */
static bool read_line(const char *line, size_t len, const char *name, gid_t *gid)
{
	const size_t own = strlen(name);
	const char *end = line + len, *at;
	uint64_t number = 0;

	if (len <= own || memcmp(line, name, own) != 0 || line[own] != ':')
		return false;
	at = memchr(line + own + 1, ':', len - own - 1);
	if (!at || ++at == end || !ascii_digit(*at))
		return false;
	for (; at < end && ascii_digit(*at) && number <= UINT32_MAX; at++)
		number = number * 10 + (uint64_t)(*at - '0');
	if (number > UINT32_MAX || (at < end && *at != ':'))
		return false;
	*gid = (gid_t)number;
	return true;
}

static bool find_group(const char *text, size_t len, const char *name, gid_t *gid)
{
	const char *end = text + len;

	while (text < end) {
		const char *stop = memchr(text, '\n', (size_t)(end - text));

		if (!stop)
			stop = end;
		if (read_line(text, (size_t)(stop - text), name, gid))
			return true;
		text = stop + (stop < end);
	}
	return false;
}

void peer_groups_read(struct peer_groups *groups, const char *path)
{
	size_t len;
	char *text = file_read(path, FILE_MOST, &len, NULL);

	memset(groups, 0, sizeof(*groups));
	for (enum role role = ROLE_VIEW; text && role < ROLE_COUNT; role++) {
		char name[32];

		snprintf(name, sizeof(name), "ladder-%s", role_word(role));
		groups->known[role] = find_group(text, len, name, &groups->gid[role]);
	}
	free(text);
}

static void take_group(const struct peer_groups *groups, gid_t gid, struct peer *peer)
{
	for (enum role i = ROLE_VIEW; i < ROLE_PERSONS; i++)
		if (groups->known[i] && groups->gid[i] == gid && i > peer->role)
			peer->role = i;
	peer->may_io |= groups->known[ROLE_IO] && groups->gid[ROLE_IO] == gid;
}

int peer_ask(int fd, const struct peer_groups *groups, struct peer *out)
{
	gid_t gid[GROUPS_MOST];
	struct ucred who;
	socklen_t len = sizeof(who);

	memset(out, 0, sizeof(*out));
	if (getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &who, &len) != 0)
		return -errno;
	out->uid = who.uid;
	name_user(out);
	take_group(groups, who.gid, out);
	len = sizeof(gid);
	if (getsockopt(fd, SOL_SOCKET, SO_PEERGROUPS, gid, &len) == 0)
		for (size_t i = 0; i < len / sizeof(gid[0]); i++)
			take_group(groups, gid[i], out);
	if (who.uid == geteuid() && who.uid != 0) {
		out->role = ROLE_ENG;
		out->may_io = true;
	}
	if (out->role == ROLE_NONE && out->may_io)
		out->role = ROLE_IO;
	return 0;
}
