/* SPDX-License-Identifier: MIT
 *
 * server - sessions: bytes in, one request after another, bytes out.
 *
 * One order at a time: the server waits until the scan thread has done it. If that takes too
 * long, the order stays where it is, and a session that asks meanwhile hears that the board is busy.
 */
#include "online/serve.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void refuse(struct asked *asked, enum refusal refusal)
{
	asked_begin(asked, WIRE_REFUSED);
	wire_put_u16(&asked->out, (uint16_t)refusal);
	wire_put_string(&asked->out, asked->detail);
}

void server_changed(struct server *server, const struct program *program, const char *why)
{
	server->verified = false; /* beside a program that has gone */
	snprintf(server->why, sizeof(server->why), "%s", why);
	server_renew(server, program);
	server_learn_forces(server);
}

const struct image *server_image(const struct server *server)
{
	return &server->mirror;
}

/* ---- requests ---- */

static enum refusal serve(struct asked *asked)
{
	switch ((enum service)asked->row->number) {
	case SERVICE_HELLO:
		return serve_hello(asked);
	case SERVICE_STATUS:
		return wire_done(&asked->frame.body) ? serve_status(asked) : REFUSAL_BAD_FRAME;
	case SERVICE_SYMBOLS:
		return serve_symbols(asked);
	case SERVICE_READ:
		return serve_read(asked);
	case SERVICE_PUBLISH:
		return serve_publish(asked);
	case SERVICE_UNPUBLISH:
		return serve_unpublish(asked);
	case SERVICE_WRITE:
		return serve_change(asked, ORDER_WRITE);
	case SERVICE_FORCE:
		return serve_change(asked, ORDER_FORCE);
	case SERVICE_UNFORCE:
		return serve_change(asked, ORDER_UNFORCE);
	case SERVICE_FORCES:
		return wire_done(&asked->frame.body) ? serve_forces(asked) : REFUSAL_BAD_FRAME;
	case SERVICE_MODE:
		return serve_mode(asked);
	case SERVICE_DOWNLOAD:
		return serve_download(asked);
	case SERVICE_BLOCK:
		return serve_block(asked);
	case SERVICE_SUMS:
		return serve_sums(asked);
	case SERVICE_PIECES:
		return serve_pieces(asked);
	case SERVICE_VERIFY:
		return serve_verify(asked);
	case SERVICE_COMMIT:
		return serve_commit(asked);
	case SERVICE_ABORT:
		return serve_abort(asked);
	case SERVICE_UPLOAD:
		return serve_upload(asked);
	case SERVICE_EVENTS:
		return serve_events(asked);
	case SERVICE_CONFIG:
		return serve_config(asked);
	case SERVICE_RETAIN:
		return serve_retain(asked);
	case SERVICE_PASSWORD:
		return serve_password(asked);
	case SERVICE_RECORD:
		return serve_record(asked);
	case SERVICE_ALARMS:
		return serve_alarms(asked);
	case SERVICE_ACK:
		return serve_ack(asked);
	case SERVICE_TIME:
		return serve_time(asked);
	case SERVICE_IO_BEGIN:
		return serve_io_begin(asked);
	case SERVICE_IO_MAP:
		return serve_io_map(asked);
	case SERVICE_IO_PUT:
		return serve_io_put(asked);
	case SERVICE_IO_OUTPUTS:
		return serve_io_outputs(asked);
	case SERVICE_IO_WINDOW:
		return serve_io_window(asked);
	case SERVICE_IO_REPORT:
		return serve_io_report(asked);
	case SERVICE_DEVICES:
		return serve_devices(asked);
	}
	return REFUSAL_NO_SERVICE;
}

static bool is_change(const struct service_row *row)
{
	return row->number == SERVICE_WRITE || row->number == SERVICE_FORCE ||
	       row->number == SERVICE_UNFORCE || row->number == SERVICE_MODE ||
	       row->number == SERVICE_COMMIT || row->number == SERVICE_CONFIG ||
	       row->number == SERVICE_RETAIN || row->number == SERVICE_ACK || row->number == SERVICE_PASSWORD ||
	       row->number == SERVICE_TIME;
}

/* Gives the answer of the same request again; it is not done again. */
static bool repeat(struct asked *asked)
{
	struct session *session = asked->session;

	for (int i = 0; i < KEPT; i++) {
		const struct kept *kept = &session->kept[i];

		if (!kept->number || kept->request != asked->frame.request ||
		    kept->service != asked->frame.service ||
		    session->requests - kept->number > KEPT_FOR)
			continue;
		memcpy(session->out, kept->bytes, kept->len);
		session->out_len = kept->len;
		return true;
	}
	return false;
}

static void keep(struct asked *asked)
{
	struct session *session = asked->session;
	struct kept *oldest = &session->kept[0];

	for (int i = 1; i < KEPT; i++)
		if (session->kept[i].number < oldest->number)
			oldest = &session->kept[i];
	if (session->out_len > KEPT_BYTES)
		return;
	oldest->request = asked->frame.request;
	oldest->service = asked->frame.service;
	oldest->number = session->requests;
	oldest->len = session->out_len;
	memcpy(oldest->bytes, session->out, session->out_len);
}

/* A gateway may do what it needs, and only a gateway. */
static bool may(enum role role, const struct service_row *row)
{
	if (row->role == ROLE_NONE)
		return true;
	if (role != ROLE_IO)
		return row->role != ROLE_IO && role >= row->role;
	return row->role == ROLE_IO || row->number == SERVICE_STATUS ||
	       row->number == SERVICE_PUBLISH || row->number == SERVICE_UNPUBLISH;
}

static enum refusal judge(struct asked *asked)
{
	struct session *session = asked->session;

	if (!asked->row)
		return REFUSAL_NO_SERVICE;
	if (!session->greeted && asked->row->number != SERVICE_HELLO)
		return REFUSAL_NO_HELLO;
	if (!may(session->role, asked->row))
		return asked_refuse_role(asked, asked->row->role);
	return serve(asked);
}

static void answer(struct server *server, struct session *session, const struct frame *frame)
{
	struct asked asked = { .server = server, .session = session, .frame = *frame,
			       .row = service_row(frame->service) };
	const bool change = asked.row && is_change(asked.row);
	enum refusal refusal;

	session->requests++;
	if (change && repeat(&asked))
		return;
	refusal = judge(&asked);
	if (refusal == REFUSAL_NONE && asked.out.failed)
		refusal = REFUSAL_TOO_MANY;
	/* Once a session: a desk that asks again and again must not fill the log. */
	if ((refusal == REFUSAL_ROLE || refusal == REFUSAL_EXPORTED) && !session->told_role) {
		asked_tell(&asked, EVENT_REFUSED, asked.row->word, "");
		session->told_role = true;
	}
	if (refusal != REFUSAL_NONE)
		refuse(&asked, refusal);
	session->out_len = frame_end(&asked.out);
	if (change)
		keep(&asked);
}

static void give_up(struct session *session)
{
	struct wire_writer out = wire_write(session->out, sizeof(session->out));

	frame_begin(&out, 0, WIRE_ANSWER | WIRE_REFUSED, 0);
	wire_put_u16(&out, REFUSAL_BAD_FRAME);
	wire_put_string(&out, "the length of a frame");
	session->out_len = frame_end(&out);
	session->out_sent = 0;
	session->over = true;
}

/* The next request, if it is whole and the answer before it has gone. */
static bool serve_next(struct server *server, struct session *session)
{
	struct frame frame;
	size_t used;

	if (session->over || session->out_len)
		return false;
	switch (frame_next(session->in, session->in_len, &frame, &used)) {
	case FRAME_PART:
		return false;
	case FRAME_BAD:
		give_up(session);
		return true;
	case FRAME_GOOD:
		break;
	}
	answer(server, session, &frame);
	session->in_len -= used;
	memmove(session->in, session->in + used, session->in_len);
	/* A password must not stay in memory. */
	memset(session->in + session->in_len, 0, used);
	return true;
}

/* The publish requests of the session have ended. */
static void tell_changed(const struct server *server, struct session *session)
{
	struct wire_writer out = wire_write(session->out, sizeof(session->out));

	frame_begin(&out, SERVICE_COMMIT, WIRE_TOLD, 0);
	if (*server->why)
		wire_put_string(&out, server->why);
	session->out_len = frame_end(&out);
	session->changed = false;
}

static void publish_next(struct server *server, struct session *session, int64_t now_ns)
{
	const struct view *view;
	struct view with_quality;
	struct wire_writer out;

	if (session->changed && session->greeted && !session->over && !session->out_len) {
		tell_changed(server, session);
		return;
	}
	if (session->over)
		return;
	if (session->gateway.outputs && !session->out_len)
		session->out_len = io_give(server, session);
	if (publish_due(&session->publications) > now_ns)
		return;
	if (session->out_len) {
		publish_lose(&session->publications, now_ns);
		return;
	}
	view = exchange_newest(server->setup.exchange);
	if (view->forces != server->mirror.force_count)
		server_learn_forces(server);
	server->mirror.memory = view->memory;
	with_quality = server_with_quality(server, session, view);
	out = wire_write(session->out, sizeof(session->out));
	session->out_len = publish_write(&session->publications, &with_quality, &server->mirror, now_ns,
					 &out);
}

bool server_step(struct server *server, int64_t now_ns)
{
	bool more = false;

	server->now_ns = now_ns;
	server_settle(server);
	for (int i = 0; i < SERVER_SESSIONS; i++) {
		struct session *session = &server->session[i];

		if (!session->used)
			continue;
		more |= serve_next(server, session);
		publish_next(server, session, now_ns);
	}
	return more;
}

int64_t server_due(const struct server *server)
{
	int64_t due_ns = INT64_MAX;

	for (int i = 0; i < SERVER_SESSIONS; i++) {
		const struct session *session = &server->session[i];

		if (session->used && publish_due(&session->publications) < due_ns)
			due_ns = publish_due(&session->publications);
		if (session->used && session->gateway.more && !session->out_len)
			return 0;
	}
	return due_ns;
}

enum server_wants server_wants(const struct server *server)
{
	const struct server_io *io = server->setup.io;
	enum server_wants wants = WANTS_NOTHING;

	for (int i = 0; i < SERVER_SESSIONS; i++) {
		const struct session *session = &server->session[i];

		if (!session->used || !session->gateway.outputs)
			continue;
		if (io->outputs(io->context, session->gateway.id))
			return WANTS_OUTPUTS;
		wants = WANTS_MODE;
	}
	return wants;
}

/* ---- sessions ---- */

/* The oldest session that has no rights or has not said hello; -1: none. So nobody without
 * rights keeps those away who have some. */
static int idle_session(const struct server *server)
{
	int oldest = -1;

	for (int i = 0; i < SERVER_SESSIONS; i++) {
		const struct session *session = &server->session[i];

		if (session->role != ROLE_NONE && session->greeted)
			continue;
		if (oldest < 0 || session->opened < server->session[oldest].opened)
			oldest = i;
	}
	return oldest;
}

int server_open(struct server *server, enum role role, bool may_io, const char *user, uint32_t who)
{
	const int gone = server_sessions(server) == SERVER_SESSIONS && role != ROLE_NONE ?
				 idle_session(server) : -1;

	if (gone >= 0)
		server_close(server, gone);
	for (int i = 0; i < SERVER_SESSIONS; i++) {
		struct session *session = &server->session[i];

		if (session->used)
			continue;
		session->used = true;
		session->greeted = session->over = session->changed = session->told_role = false;
		session->unlocked = false;
		session->may_io = may_io;
		session->role = role;
		session->gateway = (struct gateway_session){ .begun = false };
		session->who = who;
		session->opened = ++server->opened;
		session->requests = 0;
		session_begin_symbols(session);
		session->in_len = session->out_len = session->out_sent = 0;
		memset(session->kept, 0, sizeof(session->kept));
		publish_init(&session->publications);
		snprintf(session->user, sizeof(session->user), "%s", user);
		return i;
	}
	return -1;
}

void server_close(struct server *server, int session)
{
	io_end(server, &server->session[session]);
	server->session[session].used = false;
	memset(server->session[session].in, 0, server->session[session].in_len);
	if (server->retained.owner == session)
		server->retained.owner = -1;
	if (server->downloading == session)
		server->downloading = -1; /* what has come stays; it may go on */
	if (publish_due(&server->session[session].publications) != INT64_MAX)
		server_watch_again(server);
}

uint8_t *server_room(struct server *server, int number, size_t *len)
{
	struct session *session = &server->session[number];

	*len = session->over ? 0 : sizeof(session->in) - session->in_len;
	return session->in + session->in_len;
}

void server_got(struct server *server, int session, size_t len)
{
	server->session[session].in_len += len;
}

const uint8_t *server_pending(struct server *server, int number, size_t *len)
{
	const struct session *session = &server->session[number];

	*len = session->out_len - session->out_sent;
	return session->out + session->out_sent;
}

void server_sent(struct server *server, int number, size_t len)
{
	struct session *session = &server->session[number];

	session->out_sent += len;
	if (session->out_sent == session->out_len)
		session->out_len = session->out_sent = 0;
}

bool server_is_over(const struct server *server, int session)
{
	return server->session[session].over && !server->session[session].out_len;
}

/* ---- all of it ---- */

struct server *server_new(const struct server_setup *setup)
{
	struct server *server = calloc(1, sizeof(*server));
	const size_t size = image_memory_size(setup->program);
	bool good;

	if (!server)
		return NULL;
	server->setup = *setup;
	server->downloading = -1;
	server->map = 1;
	retained_init(&server->retained);
	server->mirror.program = setup->program;
	server->look.memory = calloc(1, size);
	server->mirror.memory = server->look.memory;
	for (int i = 0; i < 2; i++)
		server->ranges[i] = calloc(RANGES_MOST, sizeof(struct range));
	good = server->look.memory && server->ranges[0] && server->ranges[1];
	if (good)
		return server;
	server_free(server);
	return NULL;
}

void server_free(struct server *server)
{
	if (!server)
		return;
	retained_free(&server->retained);
	free(server->look.memory);
	free(server->ranges[0]);
	free(server->ranges[1]);
	free(server);
}
