/* SPDX-License-Identifier: MIT
 *
 * desk - requests and answers over one stream. A frame that was not asked for is given away when it
 * comes, also between a request and its answer.
 */
#include "online/desk.h"

#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#define BEGIN_MS 3000 /* for the first packet of a serial line */

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

/* ---- a reliable stream ---- */

static enum desk_end send_stream(struct desk *desk, const uint8_t *at, size_t len)
{
	while (len) {
		ssize_t done;

		if (!ready(desk->stream.fd, POLLOUT, desk->until_ms))
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

static enum desk_end read_stream(struct desk *desk)
{
	ssize_t got;

	if (!ready(desk->stream.fd, POLLIN, desk->until_ms))
		return DESK_LATE;
	got = read(desk->stream.fd, desk->in + desk->in_len, sizeof(desk->in) - desk->in_len);
	if (got < 0 && (errno == EINTR || errno == EAGAIN))
		return DESK_GOOD;
	if (got <= 0)
		return DESK_GONE;
	desk->in_len += (size_t)got;
	return DESK_GOOD;
}

/* ---- a serial line ---- */

static bool take_byte(struct desk *desk, uint8_t byte, int64_t now_ns)
{
	struct serial *serial = &desk->serial;

	switch (serial_byte(serial, byte, now_ns)) {
	case SERIAL_CAME:
		if (serial->piece_len > sizeof(desk->in) - desk->in_len)
			return false;
		memcpy(desk->in + desk->in_len, serial->piece, serial->piece_len);
		desk->in_len += serial->piece_len;
		serial_take(serial);
		return true;
	case SERIAL_ENDED:
		desk->ended = true;
		return true;
	case SERIAL_BEGUN:
	case SERIAL_TAKEN:
		return true;
	case SERIAL_NOTHING:
		break;
	}
	return false;
}

/* Takes what has come. @moved: a piece came or was taken. Fails: false: the line is no more. */
static bool hear_line(struct desk *desk, bool *moved)
{
	uint8_t bytes[256];
	const ssize_t got = read(desk->stream.fd, bytes, sizeof(bytes));
	const int64_t now_ns = now_ms() * 1000000;

	for (ssize_t i = 0; i < got; i++)
		*moved |= take_byte(desk, bytes[i], now_ns);
	return got > 0 || (got < 0 && (errno == EAGAIN || errno == EINTR));
}

static bool say_line(struct desk *desk)
{
	size_t len;
	const uint8_t *bytes = serial_pending(&desk->serial, &len);
	const ssize_t done = len ? write(desk->stream.fd, bytes, len) : 0;

	if (done > 0)
		serial_wrote(&desk->serial, (size_t)done);
	return done >= 0 || errno == EAGAIN || errno == EINTR;
}

/* Waits until a piece has moved. */
static enum desk_end move_line(struct desk *desk)
{
	bool moved = false;

	while (!moved) {
		const int64_t due_ms = serial_due(&desk->serial) / 1000000 + 1;
		const int64_t wake_ms = due_ms < desk->until_ms ? due_ms : desk->until_ms;
		struct pollfd line = { .fd = desk->stream.fd, .events = POLLIN };
		int64_t left_ms = wake_ms - now_ms();
		size_t pending;

		if (desk->ended)
			return DESK_GONE;
		if (!say_line(desk))
			return DESK_GONE;
		serial_pending(&desk->serial, &pending);
		if (pending)
			line.events |= POLLOUT;
		left_ms = left_ms < 0 ? 0 : left_ms;
		if (poll(&line, 1, (int)left_ms) > 0 && line.revents & ~POLLOUT &&
		    !hear_line(desk, &moved))
			return DESK_GONE;
		if (!serial_step(&desk->serial, now_ms() * 1000000) || !say_line(desk))
			return DESK_GONE;
		if (!moved && now_ms() >= desk->until_ms)
			return DESK_LATE;
	}
	if (desk->patience_ms && desk->until_ms < now_ms() + desk->patience_ms)
		desk->until_ms = now_ms() + desk->patience_ms;
	if (desk->until_ms > desk->most_until_ms)
		desk->until_ms = desk->most_until_ms;
	return DESK_GOOD;
}

static enum desk_end send_line(struct desk *desk, const uint8_t *at, size_t len)
{
	while (len) {
		enum desk_end end;

		if (serial_is_free(&desk->serial)) {
			const size_t sent = serial_send(&desk->serial, at, len, now_ms() * 1000000);

			at += sent;
			len -= sent;
			continue;
		}
		end = move_line(desk);
		if (end != DESK_GOOD)
			return end;
	}
	return DESK_GOOD;
}

static enum desk_end begin_line(struct desk *desk)
{
	uint32_t session = 0;

	if (getrandom(&session, sizeof(session), 0) != sizeof(session) || !session)
		session = (uint32_t)now_ms() | 1;
	serial_init(&desk->serial, SERIAL_DESK, desk->stream.baud);
	desk->until_ms = now_ms() + BEGIN_MS;
	desk->most_until_ms = desk->until_ms;
	serial_begin(&desk->serial, session, now_ms() * 1000000);
	while (!desk->serial.open) {
		const enum desk_end end = move_line(desk);

		if (end != DESK_GOOD)
			return end;
	}
	return DESK_GOOD;
}

/* ---- frames ---- */

static void set_limit(struct desk *desk, int64_t ms, bool extends)
{
	/* So long a request and its answer can take on the line. */
	const int64_t line_ms = desk->stream.baud ? 4 * (int64_t)WIRE_FRAME_MOST * 10000 /
						    desk->stream.baud : 0;

	desk->until_ms = now_ms() + ms;
	desk->patience_ms = extends ? ms : 0;
	desk->most_until_ms = desk->until_ms + (extends ? line_ms : 0);
}

/* The next whole frame; it lies in desk->in until the next call. */
static enum desk_end next_frame(struct desk *desk, struct frame *frame)
{
	memmove(desk->in, desk->in + desk->used, desk->in_len - desk->used);
	desk->in_len -= desk->used;
	desk->used = 0;
	for (;;) {
		const enum frame_state state = frame_next(desk->in, desk->in_len, frame,
							  &desk->used);
		enum desk_end end;

		if (state == FRAME_GOOD)
			return DESK_GOOD;
		if (state == FRAME_BAD)
			return DESK_NONSENSE;
		end = desk->stream.baud ? move_line(desk) : read_stream(desk);
		if (end != DESK_GOOD)
			return end;
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

static enum desk_end take_answer(struct desk *desk, uint8_t service, struct wire_reader *answer)
{
	for (;;) {
		struct frame frame;
		const enum desk_end end = next_frame(desk, &frame);

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

static enum desk_end call_within(struct desk *desk, struct wire_writer *request,
				 struct wire_reader *answer, int ms)
{
	const size_t len = frame_end(request);
	const uint8_t service = desk->out[4];
	enum desk_end end;

	set_limit(desk, ms, true);
	desk->refusal = REFUSAL_NONE;
	desk->detail[0] = '\0';
	if (!len)
		return DESK_NO_ROOM;
	end = desk->stream.baud ? send_line(desk, desk->out, len) :
				  send_stream(desk, desk->out, len);
	/* A board that closed the stream may have said why. */
	return end == DESK_GOOD || end == DESK_GONE ? take_answer(desk, service, answer) : end;
}

enum desk_end desk_call(struct desk *desk, struct wire_writer *request, struct wire_reader *answer)
{
	return call_within(desk, request, answer, service_row(desk->out[4])->limit_ms);
}

enum desk_end desk_listen(struct desk *desk, int ms)
{
	struct frame frame;
	enum desk_end end;

	set_limit(desk, ms, false);
	end = next_frame(desk, &frame);
	if (end == DESK_GOOD && frame.flags & WIRE_TOLD && desk->told)
		desk->told(desk->context, &frame);
	return end;
}

enum desk_end desk_open(struct desk *desk, const struct stream *stream, const char *name)
{
	return desk_open_within(desk, stream, name, service_row(SERVICE_HELLO)->limit_ms);
}

static enum desk_end open_as(struct desk *desk, const struct stream *stream, const char *name,
			     enum role role, int ms)
{
	struct wire_writer out;
	struct wire_reader in;
	enum desk_end end;

	memset(desk, 0, sizeof(*desk));
	desk->stream = *stream;
	if (stream->baud) {
		end = begin_line(desk);
		if (end != DESK_GOOD)
			return end;
	}
	out = desk_ask(desk, SERVICE_HELLO);
	wire_put_u32(&out, ONLINE_MAGIC);
	wire_put_u16(&out, ONLINE_LOWEST);
	wire_put_u16(&out, ONLINE_HIGHEST);
	wire_put_string(&out, name);
	if (role != ROLE_NONE)
		wire_put_u8(&out, (uint8_t)role);
	end = call_within(desk, &out, &in, ms);
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

enum desk_end desk_open_within(struct desk *desk, const struct stream *stream, const char *name,
			       int ms)
{
	return open_as(desk, stream, name, ROLE_NONE, ms);
}

enum desk_end desk_open_as(struct desk *desk, const struct stream *stream, const char *name,
			   enum role role)
{
	return open_as(desk, stream, name, role, service_row(SERVICE_HELLO)->limit_ms);
}

void desk_close(struct desk *desk)
{
	if (desk->stream.baud && desk->stream.fd >= 0) {
		serial_end(&desk->serial);
		say_line(desk);
	}
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

	if (end == DESK_LATE && desk->stream.baud && !desk->serial.open) {
		diag.id = desk->serial.noise || desk->serial.in_len ? DIAG_LINK_NOISE : DIAG_LINK_SILENT;
		snprintf(diag.arg, sizeof(diag.arg), "%u", (unsigned)desk->stream.baud);
	}
	if (end != DESK_REFUSED)
		return diag;
	diag.id = refusal_diag(desk->refusal);
	if (diag.id == DIAG_LINK_REFUSED)
		snprintf(diag.arg, sizeof(diag.arg), "%u", (unsigned)desk->refusal);
	else
		snprintf(diag.arg, sizeof(diag.arg), "%s", desk->detail);
	return diag;
}
