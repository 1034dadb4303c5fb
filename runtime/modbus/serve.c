/* SPDX-License-Identifier: MIT
 *
 * serve - connections, frames and limits of servers.
 */
#define _DEFAULT_SOURCE
#include "modbus/serve.h"

#include "hal/buses.h"

#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#define MBAP     7
#define IDLE_NS  30000000000 /* a connection that was idle so long makes room for a new one */
#define QUIET_NS 30000000    /* on a serial line: what has come is a frame or nothing */
#define AGAIN_NS 1000000000  /* a serial line that was lost is opened again     */
#define BURST_NS 1000000000  /* requests of this time may come at once        */

/* ---- serial lines ---- */

/* Bytes of the request at the begin; 0: more must come to know; -1: another function. */
static int request_length(const uint8_t *byte, int len)
{
	switch (len > 1 ? byte[1] : 0) {
	case 0:
		return len > 1 ? -1 : 0;
	case PDU_COILS:
	case PDU_DISCRETE_INPUTS:
	case PDU_HOLDING_REGISTERS:
	case PDU_INPUT_REGISTERS:
	case PDU_SET_COIL:
	case PDU_SET_REGISTER:
		return 8;
	case PDU_MASK:
		return 10;
	case PDU_SET_COILS:
	case PDU_SET_REGISTERS:
		return len > 6 ? 9 + byte[6] : 0;
	case PDU_BOTH:
		return len > 10 ? 13 + byte[10] : 0;
	default:
		return -1;
	}
}

/* The same for the answer of another unit. */
static int answer_length(const uint8_t *byte, int len)
{
	if (len < 3)
		return 0;
	switch (byte[1]) {
	case PDU_COILS:
	case PDU_DISCRETE_INPUTS:
	case PDU_HOLDING_REGISTERS:
	case PDU_INPUT_REGISTERS:
	case PDU_BOTH:
		return 5 + byte[2];
	case PDU_SET_COIL:
	case PDU_SET_REGISTER:
	case PDU_SET_COILS:
	case PDU_SET_REGISTERS:
		return 8;
	case PDU_MASK:
		return 10;
	default:
		return byte[1] & 0x80 ? 5 : -1;
	}
}

static bool is_whole(const uint8_t *byte, int len)
{
	return len >= 4 && pdu_crc(byte, len - 2) == (byte[len - 2] | byte[len - 1] << 8);
}

/* Bytes before the next whole request to us; 0: there is none. */
static int damaged(const uint8_t *byte, int len, uint8_t unit)
{
	for (int at = 1; at + 8 <= len; at++) {
		const int length = request_length(byte + at, len - at);

		if (byte[at] == unit && length > 0 && length <= len - at && is_whole(byte + at, length))
			return at;
	}
	return 0;
}

int serve_rtu(const uint8_t *byte, int len, uint8_t unit, bool quiet, int *take)
{
	const int length[2] = { request_length(byte, len), answer_length(byte, len) };
	const bool ours = len && (byte[0] == unit || byte[0] == 0);
	bool more = false;

	*take = 0;
	for (int i = 0; i < 2; i++) {
		/* An answer is of another unit. */
		if (i == 1 && ours)
			break;
		more = more || length[i] == 0 || length[i] > len;
		if (length[i] <= 0 || length[i] > len || !is_whole(byte, length[i]))
			continue;
		*take = length[i];
		return ours ? length[i] : 0;
	}
	if (quiet) {
		*take = len;
		return ours && length[0] < 0 && is_whole(byte, len) ? len : 0;
	}
	/* Behind a damaged frame a good one may have come. A function that we do not know ends with silence. */
	if (!more)
		*take = damaged(byte, len, unit);
	if (!more && length[0] > 0 && !*take)
		*take = 1;
	return 0;
}

/* ---- places ---- */

static bool open_place(struct serve *serve, int number)
{
	const struct io_serve *it = &serve->net->serve[number];
	struct serve_place *place = &serve->place[number];

	if (it->at.kind == BUS_MODBUS_TCP) {
		place->fd = buses_listen(&it->at);
		return place->fd >= 0;
	}
	return line_init(&place->line, &it->at) && line_open(&place->line);
}

static int room_for(const struct io_serve *it)
{
	return it->at.kind == BUS_MODBUS_TCP ? (it->connections ? it->connections : 1) : 1;
}

bool serve_open(struct serve *serve, const struct io_net *net, struct answer_image image, int *bad)
{
	*serve = (struct serve){ .net = net, .image = image };
	*bad = -1;
	for (int i = 0; i < net->serve_count; i++)
		serve->clients += room_for(&net->serve[i]);
	serve->place = calloc((size_t)net->serve_count + 1, sizeof(*serve->place));
	serve->client = calloc((size_t)serve->clients + 1, sizeof(*serve->client));
	serve->ready = calloc((size_t)(serve->clients + net->serve_count) + 1, sizeof(*serve->ready));
	if (!serve->place || !serve->client || !serve->ready)
		return false;
	for (int i = 0; i < net->serve_count; i++)
		serve->place[i].fd = -1;
	for (int i = 0, n = 0; i < net->serve_count; i++)
		for (int left = room_for(&net->serve[i]); left > 0; left--, n++)
			serve->client[n] = (struct serve_client){ .fd = -1, .serve = i };
	for (int i = 0; i < net->serve_count; i++) {
		*bad = i;
		if (!open_place(serve, i))
			return false;
	}
	return true;
}

static void drop(struct serve *serve, struct serve_client *client)
{
	close(client->fd);
	client->fd = -1;
	client->len = 0;
	serve->place[client->serve].clients--;
}

void serve_close(struct serve *serve)
{
	for (int i = 0; serve->client && i < serve->clients; i++)
		if (serve->client[i].fd >= 0)
			drop(serve, &serve->client[i]);
	for (int i = 0; serve->place && i < serve->net->serve_count; i++) {
		if (serve->place[i].fd >= 0)
			close(serve->place[i].fd);
		line_close(&serve->place[i].line);
	}
	free(serve->place);
	free(serve->client);
	free(serve->ready);
	*serve = (struct serve){ .clients = 0 };
}

static bool is_serial(const struct serve *serve, const struct serve_client *client)
{
	return serve->net->serve[client->serve].at.kind != BUS_MODBUS_TCP;
}

/* ---- rate ---- */

static int64_t cost_ns(const struct serve *serve, int number)
{
	return serve->net->serve[number].rate ? 1000000000 / serve->net->serve[number].rate : 0;
}

/* When the next request may be answered. */
static int64_t allowed_ns(struct serve *serve, int number, int64_t now_ns)
{
	struct serve_place *place = &serve->place[number];

	place->credit_ns += place->at_ns ? now_ns - place->at_ns : BURST_NS;
	place->at_ns = now_ns;
	if (place->credit_ns > BURST_NS)
		place->credit_ns = BURST_NS;
	return now_ns + (place->credit_ns < cost_ns(serve, number) ?
			 cost_ns(serve, number) - place->credit_ns : 0);
}

/* ---- requests ---- */

static bool answer(struct serve *serve, struct serve_client *client, const struct pdu *request,
		   struct pdu *out)
{
	answer_make(serve->net, client->serve, &serve->image, request, out);
	serve->place[client->serve].credit_ns -= cost_ns(serve, client->serve);
	if (out->byte[0] & 0x80)
		serve->refusals++;
	else
		serve->answers++;
	return true;
}

static void forget(struct serve_client *client, int len)
{
	client->len -= len;
	memmove(client->byte, client->byte + len, (size_t)client->len);
}

/* Without unit= all are ours. So is a number that is no unit (0, 255): in TCP the address says who is meant. */
static bool is_ours(const struct io_serve *it, uint8_t unit)
{
	return !it->unit_id || unit == it->unit_id || unit == 0 || unit == 255;
}

/* Bytes of the frame at the begin; 0: more must come; -1: no Modbus. */
static int tcp_length(const struct serve_client *client)
{
	int len;

	if (client->len < MBAP)
		return 0;
	len = pdu_word(client->byte + 4);
	if (pdu_word(client->byte + 2) != 0 || len < 2 || len > PDU_MOST + 1)
		return -1;
	return client->len >= len + 6 ? len + 6 : 0;
}

/* False: the connection is of no use. */
static bool answer_tcp(struct serve *serve, struct serve_client *client, int len)
{
	struct pdu request = { .len = len - MBAP }, out = { .len = 2 };
	uint8_t frame[MBAP + PDU_MOST];

	memcpy(request.byte, client->byte + MBAP, (size_t)request.len);
	if (is_ours(&serve->net->serve[client->serve], client->byte[6])) {
		answer(serve, client, &request, &out);
	} else {
		out.byte[0] = request.byte[0] | 0x80;
		out.byte[1] = PDU_NO_TARGET;
		serve->refusals++;
	}
	memcpy(frame, client->byte, MBAP);
	frame[4] = (uint8_t)((out.len + 1) >> 8);
	frame[5] = (uint8_t)(out.len + 1);
	memcpy(frame + MBAP, out.byte, (size_t)out.len);
	forget(client, len);
	return send(client->fd, frame, (size_t)(MBAP + out.len), MSG_NOSIGNAL | MSG_DONTWAIT) ==
	       MBAP + out.len;
}

static void serve_tcp(struct serve *serve, struct serve_client *client, int64_t now_ns)
{
	while (client->fd >= 0 && allowed_ns(serve, client->serve, now_ns) <= now_ns) {
		const int len = tcp_length(client);

		if (len == 0)
			return;
		if (len < 0 || !answer_tcp(serve, client, len))
			drop(serve, client);
	}
}

static void serve_serial(struct serve *serve, struct serve_client *client, int64_t now_ns)
{
	const struct io_serve *it = &serve->net->serve[client->serve];
	struct line *line = &serve->place[client->serve].line;
	int take;

	while (client->len && allowed_ns(serve, client->serve, now_ns) <= now_ns) {
		const int len = serve_rtu(client->byte, client->len, it->unit_id,
					  now_ns - client->heard_ns >= QUIET_NS, &take);

		if (len) {
			struct pdu request = { .len = len - 3 }, out;

			memcpy(request.byte, client->byte + 1, (size_t)request.len);
			if (answer(serve, client, &request, &out) && client->byte[0])
				line_say(line, it->unit_id, &out);
		}
		if (!take)
			return;
		forget(client, take);
	}
}

/* ---- what has come ---- */

static struct serve_client *room(struct serve *serve, int number, int64_t now_ns)
{
	struct serve_client *oldest = NULL;

	for (int i = 0; i < serve->clients; i++) {
		struct serve_client *client = &serve->client[i];

		if (client->serve != number)
			continue;
		if (client->fd < 0)
			return client;
		if (!oldest || client->heard_ns < oldest->heard_ns)
			oldest = client;
	}
	if (!oldest || now_ns - oldest->heard_ns < IDLE_NS)
		return NULL;
	drop(serve, oldest);
	return oldest;
}

static void take_in(struct serve *serve, int number, int64_t now_ns)
{
	const int fd = accept(serve->place[number].fd, NULL, NULL), on = 1;
	struct serve_client *client = fd >= 0 ? room(serve, number, now_ns) : NULL;

	if (!client) {
		if (fd >= 0)
			close(fd);
		return;
	}
	fcntl(fd, F_SETFD, FD_CLOEXEC);
	setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
	client->fd = fd;
	client->len = 0;
	client->heard_ns = now_ns;
	serve->place[number].clients++;
}

static void hear(struct serve *serve, struct serve_client *client, int fd, int64_t now_ns)
{
	const ssize_t got = read(fd, client->byte + client->len, sizeof(client->byte) - (size_t)client->len);

	if (got > 0) {
		client->len += (int)got;
		client->heard_ns = now_ns;
		return;
	}
	if (got < 0 && (errno == EAGAIN || errno == EINTR))
		return;
	if (!is_serial(serve, client))
		drop(serve, client);
	else
		line_close(&serve->place[client->serve].line);
}

/* An adapter that was pulled may be back. */
static void open_again(struct serve *serve, struct serve_client *client, int64_t now_ns)
{
	struct line *line = &serve->place[client->serve].line;

	if (line->open || now_ns - client->heard_ns < AGAIN_NS)
		return;
	client->heard_ns = now_ns;
	client->len = 0;
	line_close(line);
	if (line_init(line, &serve->net->serve[client->serve].at))
		line_open(line);
}

static int fd_of(struct serve *serve, const struct serve_client *client)
{
	const struct line *line = &serve->place[client->serve].line;

	return !is_serial(serve, client) ? client->fd : line->open ? line_fd(line) : -1;
}

int64_t serve_poll(struct serve *serve, int64_t now_ns)
{
	int64_t until_ns = INT64_MAX;
	int n = 0;

	for (int i = 0; i < serve->clients; i++) {
		const struct serve_client *client = &serve->client[i];
		const int64_t ns = allowed_ns(serve, client->serve, now_ns);
		int64_t then_ns = INT64_MAX;

		/* A client that asks too often waits in the kernel. */
		serve->ready[n++] = (struct pollfd){
			.fd = ns <= now_ns && client->len < SERVE_FRAME ? fd_of(serve, client) : -1,
			.events = POLLIN };
		if (is_serial(serve, client) && !serve->place[client->serve].line.open)
			then_ns = client->heard_ns + AGAIN_NS;
		else if (client->len && is_serial(serve, client))
			then_ns = client->heard_ns + QUIET_NS > ns ? client->heard_ns + QUIET_NS : ns;
		else if (client->fd >= 0 && ns > now_ns)
			then_ns = ns;
		if (then_ns < until_ns)
			until_ns = then_ns;
	}
	for (int i = 0; serve->net && i < serve->net->serve_count; i++)
		serve->ready[n++] = (struct pollfd){ .fd = serve->place[i].fd, .events = POLLIN };
	serve->readies = n;
	return until_ns;
}

void serve_step(struct serve *serve, int64_t now_ns)
{
	for (int i = 0; i < serve->clients; i++) {
		struct serve_client *client = &serve->client[i];

		if (serve->ready[i].fd >= 0 && serve->ready[i].revents)
			hear(serve, client, serve->ready[i].fd, now_ns);
		if (is_serial(serve, client)) {
			open_again(serve, client, now_ns);
			serve_serial(serve, client, now_ns);
		} else if (client->fd >= 0) {
			serve_tcp(serve, client, now_ns);
		}
	}
	for (int i = 0; serve->net && i < serve->net->serve_count; i++)
		if (serve->ready[serve->clients + i].revents)
			take_in(serve, i, now_ns);
}
