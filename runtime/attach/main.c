/* SPDX-License-Identifier: MIT
 *
 * ladder-attach - joins standard input and output to the socket of ladderd.
 *
 * ssh runs it on a board. It takes no argument and understands no byte: the socket is always
 * the same one, and the kernel tells ladderd which user it runs as.
 */
#include <errno.h>
#include <poll.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#ifndef LINK_SOCKET
#define LINK_SOCKET "/run/rungboard/link"
#endif

/* One direction. */
struct flow {
	int from, to;
	uint8_t bytes[16384];
	size_t len;
	bool ended;
};

static int connect_board(void)
{
	struct sockaddr_un address = { .sun_family = AF_UNIX, .sun_path = LINK_SOCKET };
	const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);

	if (fd >= 0 && connect(fd, (const void *)&address, sizeof(address)) == 0)
		return fd;
	fprintf(stderr, "ladder-attach: %s: %s\n", LINK_SOCKET,
		errno == ENOENT || errno == ECONNREFUSED ?
		"no ladderd runs on this board, or it runs without --link" : strerror(errno));
	return -1;
}

/* False: the stream has ended or failed. */
static bool fill(struct flow *flow)
{
	const ssize_t got = read(flow->from, flow->bytes, sizeof(flow->bytes));

	if (got > 0)
		flow->len = (size_t)got;
	return got > 0 || (got < 0 && (errno == EINTR || errno == EAGAIN));
}

static bool drain(struct flow *flow)
{
	const ssize_t done = write(flow->to, flow->bytes, flow->len);

	if (done > 0) {
		flow->len -= (size_t)done;
		memmove(flow->bytes, flow->bytes + done, flow->len);
	}
	return done > 0 || errno == EINTR || errno == EAGAIN;
}

static bool step(struct flow *flow, short in, short out)
{
	if (flow->len)
		return !out || drain(flow);
	return !in || fill(flow);
}

/* Until one side ends. What the desk has sent is still handed on. */
static int pump(int board)
{
	static struct flow up, down;

	up.from = STDIN_FILENO;
	up.to = down.from = board;
	down.to = STDOUT_FILENO;
	for (;;) {
		struct pollfd ready[4] = {
			{ .fd = up.len ? -1 : up.from, .events = POLLIN },
			{ .fd = up.len ? up.to : -1, .events = POLLOUT },
			{ .fd = down.len ? -1 : down.from, .events = POLLIN },
			{ .fd = down.len ? down.to : -1, .events = POLLOUT },
		};

		if (poll(ready, 4, -1) < 0 && errno != EINTR)
			return 1;
		if (!step(&up, ready[0].revents, ready[1].revents) ||
		    !step(&down, ready[2].revents, ready[3].revents))
			return 0;
	}
}

int main(int argc, char **argv)
{
	int board;

	(void)argv;
	if (argc > 1) {
		fprintf(stderr, "usage: ladder-attach\n"
			"Joins standard input and output to ladderd on this board; ssh runs it.\n");
		return 2;
	}
	board = connect_board();
	return board < 0 ? 1 : pump(board);
}
