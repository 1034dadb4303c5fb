/* SPDX-License-Identifier: MIT
 *
 * desk - requests and answers over one stream. A frame that is told is given away when it
 * comes, also between a request and its answer.
 */
#include "online/desk.h"

#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

static int64_t now_ms(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return now.tv_sec * INT64_C(1000) + now.tv_nsec / 1000000;
}

static bool ready(int fd, short events, int64_t until_ms)
{
	for (;;) {
		struct pollfd one = { .fd = fd, .events = events };
		const int64_t left = until_ms - now_ms();
		const int got = poll(&one, 1, left > 0 ? (int)left : 0);

		if (got > 0)
			return true;
		if (got == 0 && left <= 0)
			return false;
		if (got < 0 && errno != EINTR)
			return false;
	}
}

static ssize_t put(int fd, const uint8_t *bytes, size_t len)
{
	const ssize_t done = send(fd, bytes, len, MSG_NOSIGNAL);

	return done < 0 && errno == ENOTSOCK ? write(fd, bytes, len) : done;
}

static enum desk_end send_all(struct desk *desk, size_t len, int64_t until_ms)
{
	const uint8_t *at = desk->out;

	while (len) {
		ssize_t done;

		if (!ready(desk->stream.fd, POLLOUT, until_ms))
			return DESK_LATE;
		done = put(desk->stream.fd, at, len);
		if (done < 0 && (errno == EINTR || errno == EAGAIN))
			continue;
		if (done <= 0)
			return DESK_GONE;
		at += done;
		len -= (size_t)done;
	}
	return DESK_GOOD;
}

/* The next whole frame; it lies in desk->in until the next call. */
static enum desk_end next_frame(struct desk *desk, struct frame *frame, int64_t until_ms)
{
	memmove(desk->in, desk->in + desk->used, desk->in_len - desk->used);
	desk->in_len -= desk->used;
	desk->used = 0;
	for (;;) {
		const enum frame_state state = frame_next(desk->in, desk->in_len, frame,
							  &desk->used);
		ssize_t got;

		if (state == FRAME_GOOD)
			return DESK_GOOD;
		if (state == FRAME_BAD)
			return DESK_NONSENSE;
		if (!ready(desk->stream.fd, POLLIN, until_ms))
			return DESK_LATE;
		got = read(desk->stream.fd, desk->in + desk->in_len,
			   sizeof(desk->in) - desk->in_len);
		if (got < 0 && (errno == EINTR || errno == EAGAIN))
			continue;
		if (got <= 0)
			return DESK_GONE;
		desk->in_len += (size_t)got;
	}
}

static void take_refusal(struct desk *desk, struct wire_reader *in)
{
	const uint16_t refusal = wire_u16(in);
	size_t len;
	const char *text = wire_text(in, &len);

	if (len >= sizeof(desk->detail))
		len = sizeof(desk->detail) - 1;
	memcpy(desk->detail, text, len);
	desk->detail[len] = '\0';
	desk->refusal = refusal;
}

struct wire_writer desk_ask(struct desk *desk, enum service service)
{
	struct wire_writer out = wire_write(desk->out, sizeof(desk->out));

	if (++desk->request == 0)
		desk->request = 1; /* 0 is the board's, when it cannot read a frame */
	frame_begin(&out, (uint8_t)service, 0, desk->request);
	return out;
}

static enum desk_end take_answer(struct desk *desk, uint8_t service, int64_t until_ms,
				 struct wire_reader *answer)
{
	for (;;) {
		struct frame frame;
		const enum desk_end end = next_frame(desk, &frame, until_ms);

		if (end != DESK_GOOD)
			return end;
		if (frame.flags & WIRE_TOLD) {
			if (desk->told)
				desk->told(desk->context, &frame);
			continue;
		}
		/* Number 0: the board says why it ends the session. */
		if (frame.request != desk->request && frame.request != 0)
			continue; /* the late answer of a call that was given up */
		if (frame.request == desk->request && frame.service != service)
			return DESK_NONSENSE;
		*answer = frame.body;
		if (!(frame.flags & WIRE_REFUSED))
			return frame.request ? DESK_GOOD : DESK_NONSENSE;
		take_refusal(desk, &frame.body);
		return DESK_REFUSED;
	}
}

enum desk_end desk_call(struct desk *desk, struct wire_writer *request, struct wire_reader *answer)
{
	const size_t len = frame_end(request);
	const uint8_t service = desk->out[4];
	const struct service_row *row = service_row(service);
	const int64_t until_ms = now_ms() + row->limit_ms;
	enum desk_end end;

	desk->refusal = REFUSAL_NONE;
	desk->detail[0] = '\0';
	if (!len)
		return DESK_NO_ROOM;
	end = send_all(desk, len, until_ms);
	/* A board that closed the stream may have said why. */
	return end == DESK_GOOD || end == DESK_GONE ? take_answer(desk, service, until_ms, answer) : end;
}

enum desk_end desk_listen(struct desk *desk, int ms)
{
	struct frame frame;
	const enum desk_end end = next_frame(desk, &frame, now_ms() + ms);

	if (end == DESK_GOOD && frame.flags & WIRE_TOLD && desk->told)
		desk->told(desk->context, &frame);
	return end;
}

enum desk_end desk_open(struct desk *desk, const struct stream *stream, const char *name)
{
	struct wire_writer out;
	struct wire_reader in;
	enum desk_end end;

	memset(desk, 0, sizeof(*desk));
	desk->stream = *stream;
	out = desk_ask(desk, SERVICE_HELLO);
	wire_put_u32(&out, ONLINE_MAGIC);
	wire_put_u16(&out, ONLINE_LOWEST);
	wire_put_u16(&out, ONLINE_HIGHEST);
	wire_put_string(&out, name);
	end = desk_call(desk, &out, &in);
	if (end != DESK_GOOD)
		return end;
	if (wire_u32(&in) != ONLINE_MAGIC)
		return DESK_NONSENSE;
	desk->version = wire_u16(&in);
	desk->role = (enum role)wire_u8(&in);
	wire_u8(&in); /* number of the session */
	wire_copy_text(&in, desk->software, sizeof(desk->software));
	wire_copy_text(&in, desk->board, sizeof(desk->board));
	if (in.failed || desk->role >= ROLE_COUNT || desk->version < ONLINE_LOWEST ||
	    desk->version > ONLINE_HIGHEST)
		return DESK_NONSENSE;
	return DESK_GOOD;
}

void desk_close(struct desk *desk)
{
	stream_close(&desk->stream);
}

struct diag desk_diag(const struct desk *desk, enum desk_end end)
{
	static const enum diag_id ids[] = {
		[DESK_GOOD] = DIAG_COUNT, [DESK_REFUSED] = DIAG_LINK_REFUSED,
		[DESK_LATE] = DIAG_LINK_LATE, [DESK_GONE] = DIAG_LINK_GONE,
		[DESK_NONSENSE] = DIAG_LINK_NONSENSE, [DESK_NO_ROOM] = DIAG_LINK_NO_ROOM,
	};
	struct diag diag = { .id = ids[end] };

	if (end != DESK_REFUSED)
		return diag;
	diag.id = refusal_diag(desk->refusal);
	if (diag.id == DIAG_LINK_REFUSED)
		snprintf(diag.arg, sizeof(diag.arg), "%u", (unsigned)desk->refusal);
	else
		snprintf(diag.arg, sizeof(diag.arg), "%s", desk->detail);
	return diag;
}
