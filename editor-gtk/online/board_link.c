/* SPDX-License-Identifier: MIT
 *
 * board_link - see board_link.h.
 *
 * A session is a thread with its desk. The main thread puts requests into `asked`; the thread
 * puts answers and frames into `come`, and wakes the main loop when that was empty. To end a
 * session, the main thread shuts its stream down, and forgets it: the thread closes and frees
 * it, however long its command needs to end.
 */
#include "editor-gtk/online/board_link.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/online/ssh_ask.h"

#include "engine/base/version.h"

#include <errno.h>
#include <fcntl.h>
#include <glib-unix.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#define DESK_NAME  "ladder-editor " LADDER_VERSION
#define STATUS_MS  500     /* between two requests for its status, at least    */
#define STATUS_MOST_MS 5000
#define STATUS_PART 4      /* of the time of a slow line, that requests for the status take */
#define ASK_MS     600000  /* that a person has for the questions of ssh       */
#define SAID_MOST  4096    /* bytes of what a command said at last             */
#define RETRY_MS   500     /* before the first attempt to connect again        */
#define RETRY_MOST 15000   /* between two attempts                             */
#define BUSY_MS    100     /* before the next attempt at a port that is in use */
#define BUSY_MOST  30      /* attempts: the session before may be ending       */
#define COME_MOST  256     /* frames that the main thread has not taken yet: then the thread
			      reads no more, and the board sends less          */

/* A request. The thread reads `service`, `fields`, `work`, and what `data` is for it; the rest is
 * the main thread's. */
struct asked {
	gint refs;             /* of `pending`, and of the session            */
	bool given;            /* a session has it, or had it                 */
	enum service service;
	GByteArray *fields;
	enum desk_end (*work)(struct desk *desk, gpointer data); /* instead of fields; or NULL */
	GDestroyNotify free;   /* of `data`; NULL: none                        */
	gpointer owner;        /* weak                                         */
	bool owned;
	board_answered answered;
	gpointer data;
};

enum come_kind { COME_OPENED, COME_ANSWER, COME_FRAME, COME_ENDED };
struct come {
	enum come_kind kind;
	/* Answer. */
	struct asked *asked;
	uint16_t request, refusal;
	GBytes *body;          /* of an answer or a frame                      */
	struct frame frame;
	/* Opened: who is there. */
	enum role role;
	char board[64], software[32];
	/* Answer, and ended, also if it could not be opened. */
	enum desk_end end;
	struct diag why;
	int error;             /* of stream_open(), -errno                     */
	char *said;            /* what the command printed                     */
};

struct session {
	gint refs;             /* the link's, the thread's, that of the source of errors, one
				* while the main loop is woken                */
	GMutex lock;
	GCond taken;           /* the main thread has taken what had come      */
	LadderBoardLink *link; /* NULL: forgotten; main thread only            */
	char *where;
	char *ssh, **environment; /* of its command                            */
	bool patient;          /* ssh may ask a person                         */
	int errors[2];         /* a pipe: what the command says                */
	guint hears;           /* the source of errors[0]; 0: none. Main thread only */
	int wake[2];           /* a pipe: the main thread has a request or an end */
	/* Under the lock. */
	GQueue asked, come;
	GString *said;         /* the last bytes of what the command said      */
	bool quit, woken;
	int fd;                /* of its stream; -1: none                      */
	/* The thread's. */
	struct desk desk;
};

struct _LadderBoardLink {
	GObject parent;
	enum link_state state;
	char *where, *reason;
	struct ssh_ask *ask;     /* while it connects by ssh; NULL: not          */
	struct session *session; /* NULL: none                                 */
	char board[64], software[32];
	enum role role;
	struct board_status status;
	struct gateways_status gateways; /* of the last status                 */
	struct values_status values;
	bool has_status, asks;   /* a request for the status is on its way     */
	gint64 asked_us;         /* when the last one was asked for            */
	gint64 every_us;         /* between two of them                        */
	guint timer, retry;
	guint retry_ms;
	guint busy;              /* attempts that found the port in use        */
	GList *pending;          /* of struct asked, which the session has     */
	uint8_t *fields;         /* WIRE_FRAME_MOST bytes: of the next request   */
};

G_DEFINE_FINAL_TYPE(LadderBoardLink, ladder_board_link, G_TYPE_OBJECT)

enum { STATE_CHANGED, STATUS, PROGRAM_CHANGED, TOLD, ASKS, FAILED, SIGNALS };
static guint signals[SIGNALS];

/* ---- messages between the threads ---- */

static void asked_unref(gpointer data)
{
	struct asked *asked = data;

	if (!g_atomic_int_dec_and_test(&asked->refs))
		return;
	if (asked->free)
		asked->free(asked->data);
	if (asked->service == SERVICE_PASSWORD)
		memset(asked->fields->data, 0, asked->fields->len);
	g_byte_array_unref(asked->fields);
	g_free(asked);
}

static void come_free(struct come *come)
{
	g_clear_pointer(&come->asked, asked_unref);
	g_clear_pointer(&come->body, g_bytes_unref);
	g_free(come->said);
	g_free(come);
}

static void session_unref(struct session *session)
{
	struct come *come;

	if (!g_atomic_int_dec_and_test(&session->refs))
		return;
	while ((come = g_queue_pop_head(&session->come)))
		come_free(come);
	g_queue_clear_full(&session->asked, asked_unref);
	g_string_free(session->said, TRUE);
	g_free(session->ssh);
	g_strfreev(session->environment);
	close(session->errors[0]);
	if (session->errors[1] >= 0)
		close(session->errors[1]);
	close(session->wake[0]);
	close(session->wake[1]);
	g_mutex_clear(&session->lock);
	g_cond_clear(&session->taken);
	g_free(session->where);
	g_free(session);
}

static void session_wake(struct session *session)
{
	/* A full pipe wakes it as well. */
	while (write(session->wake[1], "", 1) < 0 && errno == EINTR)
		continue;
}

static gboolean take_come(gpointer data);

/* The thread gives @come to the main thread. */
static void put_come(struct session *session, struct come *come)
{
	g_mutex_lock(&session->lock);
	g_queue_push_tail(&session->come, come);
	if (!session->woken) {
		session->woken = true;
		g_atomic_int_inc(&session->refs);
		g_idle_add_full(G_PRIORITY_DEFAULT, take_come, session, NULL);
	}
	g_mutex_unlock(&session->lock);
}

static struct come *come_new(enum come_kind kind)
{
	struct come *come = g_new0(struct come, 1);

	come->kind = kind;
	return come;
}

/* ---- the thread ---- */

static void frame_told(void *context, const struct frame *frame)
{
	struct session *session = context;
	struct come *come = come_new(COME_FRAME);
	const size_t len = wire_left(&frame->body);

	come->body = g_bytes_new(frame->body.at, len);
	come->frame = *frame;
	come->frame.body = wire_read(g_bytes_get_data(come->body, NULL), len);
	put_come(session, come);
}

static bool session_quits(struct session *session)
{
	bool quit;

	g_mutex_lock(&session->lock);
	quit = session->quit;
	g_mutex_unlock(&session->lock);
	return quit;
}

static struct asked *next_asked(struct session *session)
{
	struct asked *asked;

	g_mutex_lock(&session->lock);
	asked = session->quit ? NULL : g_queue_pop_head(&session->asked);
	g_mutex_unlock(&session->lock);
	return asked;
}

/* The main thread has more frames than it can take: waits until it has taken them. */
static void wait_for_room(struct session *session)
{
	g_mutex_lock(&session->lock);
	while (session->come.length > COME_MOST && !session->quit)
		g_cond_wait(&session->taken, &session->lock);
	g_mutex_unlock(&session->lock);
}

static enum desk_end call(struct session *session, struct asked *asked)
{
	struct wire_reader in = wire_read(NULL, 0);
	struct come *come = come_new(COME_ANSWER);
	struct wire_writer out;
	enum desk_end end;

	if (asked->work) {
		end = asked->work(&session->desk, asked->data);
	} else {
		out = desk_ask(&session->desk, asked->service);
		if (asked->fields->len)
			wire_put_bytes(&out, asked->fields->data, asked->fields->len);
		end = desk_call(&session->desk, &out, &in);
	}
	come->end = end;
	come->request = session->desk.request;
	come->refusal = session->desk.refusal;
	if (end == DESK_GOOD && !asked->work)
		come->body = g_bytes_new(in.at, wire_left(&in));
	else
		come->why = desk_diag(&session->desk, end);
	come->asked = asked;
	put_come(session, come);
	return end;
}

static bool is_over(enum desk_end end)
{
	return end == DESK_GONE || end == DESK_NONSENSE;
}

/* Takes what the board has sent already. */
static enum desk_end listen_now(struct session *session)
{
	enum desk_end end;

	do {
		wait_for_room(session);
		end = session_quits(session) ? DESK_GONE : desk_listen(&session->desk, 0);
	} while (end == DESK_GOOD);
	return end;
}

static void wait_for_more(struct session *session)
{
	struct pollfd of[] = {
		{ .fd = session->desk.stream.fd, .events = POLLIN },
		{ .fd = session->wake[0], .events = POLLIN },
	};
	char drained[64];

	if (poll(of, G_N_ELEMENTS(of), -1) > 0 && of[1].revents)
		while (read(session->wake[0], drained, sizeof(drained)) < 0 && errno == EINTR)
			continue;
}

/* Requests, one after the other, and frames that were not asked for. */
static enum desk_end serve(struct session *session)
{
	for (;;) {
		enum desk_end end = DESK_LATE;
		struct asked *asked;

		while (!is_over(end) && (asked = next_asked(session)))
			end = call(session, asked);
		if (!is_over(end))
			end = listen_now(session);
		if (is_over(end))
			return end;
		if (!session_quits(session))
			wait_for_more(session);
	}
}

/* False: the session is to end, and nobody will shut this stream down. */
static bool session_set_fd(struct session *session, int fd)
{
	bool quit;

	g_mutex_lock(&session->lock);
	session->fd = fd;
	quit = session->quit;
	g_mutex_unlock(&session->lock);
	return !quit;
}

static enum desk_end open_desk(struct session *session, struct come *ended)
{
	struct stream_where where;
	struct stream_how how;
	struct stream stream;
	struct come *come;
	enum desk_end end;

	if (stream_parse(session->where, &where))
		return DESK_GONE;
	how = (struct stream_how){ session->ssh, session->environment, session->errors[1] };
	ended->error = stream_open_alone(&where, &how, &stream);
	close(session->errors[1]);
	session->errors[1] = -1;
	if (ended->error)
		return DESK_GONE;
	session->desk.stream = stream;
	if (!session_set_fd(session, stream.fd))
		return DESK_GONE;
	end = session->patient ? desk_open_within(&session->desk, &stream, DESK_NAME, ASK_MS) :
				 desk_open(&session->desk, &stream, DESK_NAME);
	if (end != DESK_GOOD)
		return end;
	session->desk.told = frame_told;
	session->desk.context = session;
	come = come_new(COME_OPENED);
	come->role = session->desk.role == ROLE_IO ? ROLE_NONE : session->desk.role; /* of no person */
	g_strlcpy(come->board, session->desk.board, sizeof(come->board));
	g_strlcpy(come->software, session->desk.software, sizeof(come->software));
	put_come(session, come);
	return DESK_GOOD;
}

/* Takes what the command has said; of that, the last bytes stay. False: it says no more. */
static bool take_errors(struct session *session)
{
	char part[512];
	gssize got;

	g_mutex_lock(&session->lock);
	while ((got = read(session->errors[0], part, sizeof(part))) > 0) {
		g_string_append_len(session->said, part, got);
		if (session->said->len > SAID_MOST)
			g_string_erase(session->said, 0,
				       (gssize)(session->said->len - SAID_MOST));
	}
	g_mutex_unlock(&session->lock);
	return got < 0 && (errno == EAGAIN || errno == EINTR);
}

/* A command whose pipe is full waits, and the board with it. */
static gboolean hear_errors(gint fd, GIOCondition condition, gpointer data)
{
	struct session *session = data;

	(void)fd, (void)condition;
	if (take_errors(session))
		return G_SOURCE_CONTINUE;
	session->hears = 0;
	return G_SOURCE_REMOVE;
}

static void session_unref_data(gpointer data)
{
	session_unref(data);
}

/* What the command said. Caller frees. */
static char *all_errors(struct session *session)
{
	char *said;

	take_errors(session);
	g_mutex_lock(&session->lock);
	said = g_strdup(session->said->str);
	g_mutex_unlock(&session->lock);
	return said;
}

static gpointer session_thread(gpointer data)
{
	struct session *session = data;
	struct come *ended = come_new(COME_ENDED);

	session->desk.stream.fd = -1;
	ended->end = open_desk(session, ended);
	if (ended->end == DESK_GOOD)
		ended->end = serve(session);
	ended->why = desk_diag(&session->desk, ended->end);
	session_set_fd(session, -1);
	/* A command that asks for a password, or says nothing, does not end by itself. */
	if (session->desk.stream.child && (session_quits(session) || ended->end != DESK_GONE))
		kill(session->desk.stream.child, SIGTERM);
	desk_close(&session->desk);
	ended->said = all_errors(session);
	put_come(session, ended);
	session_unref(session);
	return NULL;
}

/* @ask: of the questions of ssh; NULL: they are not asked. */
static struct session *session_new(LadderBoardLink *link, const char *where,
				   const struct ssh_ask *ask)
{
	struct session *session = g_new0(struct session, 1);
	const char *ssh = g_getenv("RUNGBOARD_SSH");

	if (!g_unix_open_pipe(session->wake, FD_CLOEXEC, NULL)) {
		g_free(session);
		return NULL;
	}
	if (!g_unix_open_pipe(session->errors, FD_CLOEXEC, NULL)) {
		close(session->wake[0]);
		close(session->wake[1]);
		g_free(session);
		return NULL;
	}
	g_unix_set_fd_nonblocking(session->errors[0], TRUE, NULL);
	session->patient = ask != NULL;
	session->environment = ask ? ssh_ask_environment(ask) :
		g_environ_setenv(g_get_environ(), "LC_ALL", "C", TRUE);
	session->ssh = g_strdup_printf("%s%s", ssh ? ssh : "ssh", ask ? "" : " -o BatchMode=yes");
	g_unix_set_fd_nonblocking(session->wake[0], TRUE, NULL);
	g_unix_set_fd_nonblocking(session->wake[1], TRUE, NULL);
	session->refs = 3;
	session->link = link;
	session->where = g_strdup(where);
	session->fd = -1;
	g_mutex_init(&session->lock);
	g_cond_init(&session->taken);
	g_queue_init(&session->asked);
	g_queue_init(&session->come);
	session->said = g_string_new(NULL);
	session->hears = g_unix_fd_add_full(G_PRIORITY_DEFAULT, session->errors[0],
					    G_IO_IN | G_IO_HUP | G_IO_ERR, hear_errors, session,
					    session_unref_data);
	g_thread_unref(g_thread_new("board link", session_thread, session));
	return session;
}

/* The thread ends by itself and frees what it has. */
static void session_forget(struct session *session)
{
	session->link = NULL;
	g_clear_handle_id(&session->hears, g_source_remove);
	g_mutex_lock(&session->lock);
	session->quit = true;
	g_queue_clear_full(&session->asked, asked_unref);
	if (session->fd >= 0)
		shutdown(session->fd, SHUT_RDWR);
	g_cond_signal(&session->taken);
	g_mutex_unlock(&session->lock);
	session_wake(session);
	session_unref(session);
}

/* ---- answers, in the main thread ---- */

/* @come: its answer. The request is not in `pending` any more. */
static void answer(LadderBoardLink *link, struct asked *asked, const struct come *come)
{
	char *text = come->end == DESK_GOOD ? NULL : diag_said_whole(&come->why);
	gsize len = 0;
	const void *bytes = come->body ? g_bytes_get_data(come->body, &len) : NULL;
	struct board_answer answer = {
		.end = come->end, .request = come->request, .refusal = come->refusal,
		.text = text ? text : "", .body = wire_read(bytes, len),
	};
	const bool wanted = asked->answered && (asked->owner || !asked->owned);

	if (asked->owned && asked->owner)
		g_object_remove_weak_pointer(asked->owner, &asked->owner);
	if (text && come->end != DESK_GONE && asked->service != SERVICE_STATUS)
		g_signal_emit(link, signals[FAILED], 0,
			      service_row((uint8_t)asked->service)->word, text);
	if (wanted)
		asked->answered(asked->data, &answer);
	g_free(text);
	asked_unref(asked);
}

/* Requests that will get no answer. @requests: taken over. */
static void answer_none(LadderBoardLink *link, GList *requests)
{
	const struct come gone = { .end = DESK_GONE, .why = { .id = DIAG_LINK_GONE } };

	for (GList *at = requests; at; at = at->next)
		answer(link, at->data, &gone);
	g_list_free(requests);
}

/* The session has ended. */
static void answer_gone(LadderBoardLink *link)
{
	answer_none(link, g_steal_pointer(&link->pending));
}

static void set_state(LadderBoardLink *link, enum link_state state, char *reason)
{
	link->state = state;
	g_free(link->reason);
	link->reason = reason;
	g_signal_emit(link, signals[STATE_CHANGED], 0);
}

/* ---- its status ---- */

/* A board may send any bytes; views need UTF-8. */
static void make_valid(char *text)
{
	const char *bad;

	while (!g_utf8_validate(text, -1, &bad))
		text[bad - text] = '?';
}

static void make_status_valid(struct board_status *status)
{
	make_valid(status->board);
	make_valid(status->version);
	make_valid(status->fault);
	make_valid(status->error);
	make_valid(status->stop);
	make_valid(status->next_why);
	make_valid(status->disk);
	for (guint i = 0; i < status->task_count; i++)
		make_valid(status->task[i].name);
}

static void status_came(gpointer data, struct board_answer *got)
{
	LadderBoardLink *link = data;
	struct board_status *status;
	bool other;

	link->asks = false;
	link->every_us = CLAMP((g_get_monotonic_time() - link->asked_us) * STATUS_PART,
			       STATUS_MS * 1000, STATUS_MOST_MS * 1000);
	if (got->end != DESK_GOOD)
		return;
	status = g_new0(struct board_status, 1);
	status_take(&got->body, status);
	gateways_take(&got->body, &link->gateways);
	values_take(&got->body, &link->values);
	if (!got->body.failed) {
		other = link->has_status &&
			memcmp(link->status.program, status->program, sizeof(status->program)) != 0;
		make_status_valid(status);
		link->status = *status;
		link->has_status = true;
		if (*status->board)
			g_strlcpy(link->board, status->board, sizeof(link->board));
		if (other)
			g_signal_emit(link, signals[PROGRAM_CHANGED], 0);
		g_signal_emit(link, signals[STATUS], 0);
	}
	g_free(status);
}

static void ask_status(LadderBoardLink *link)
{
	struct wire_writer fields = ladder_board_link_begin(link);

	if (link->asks || link->state != LINK_CONNECTED)
		return;
	link->asks = true;
	link->asked_us = g_get_monotonic_time();
	ladder_board_link_send(link, SERVICE_STATUS, &fields, link, status_came, link);
}

void ladder_board_link_look(LadderBoardLink *link)
{
	ask_status(link);
}

/* A slow line has time for other things, too. */
static gboolean status_due(gpointer data)
{
	LadderBoardLink *link = data;

	if (g_get_monotonic_time() - link->asked_us >= link->every_us - STATUS_MS * 500)
		ask_status(link);
	return G_SOURCE_CONTINUE;
}

/* ---- begin and end ---- */

static void drop_session(LadderBoardLink *link)
{
	g_clear_pointer(&link->ask, ssh_ask_free);
	g_clear_handle_id(&link->timer, g_source_remove);
	g_clear_handle_id(&link->retry, g_source_remove);
	if (link->session)
		session_forget(g_steal_pointer(&link->session));
	link->asks = false;
	answer_gone(link);
}

static void asks(gpointer data, const char *question, bool yes_no)
{
	g_signal_emit(data, signals[ASKS], 0, question, yes_no);
}

/* @person: waits for it, so ssh may ask; not when a lost connection is tried again. */
static bool begin(LadderBoardLink *link, bool person)
{
	struct stream_where at;

	drop_session(link);
	if (person && !stream_parse(link->where, &at) && at.kind == STREAM_SSH)
		link->ask = ssh_ask_new(asks, link, NULL);
	link->session = session_new(link, link->where, link->ask);
	return link->session != NULL;
}

void ladder_board_link_answer(LadderBoardLink *link, const char *text)
{
	if (link->ask)
		ssh_ask_answer(link->ask, text);
}

static void retry_later(LadderBoardLink *link);

static gboolean retry_due(gpointer data)
{
	LadderBoardLink *link = data;

	link->retry = 0;
	if (!begin(link, false))
		retry_later(link);
	return G_SOURCE_REMOVE;
}

static void retry_later(LadderBoardLink *link)
{
	link->retry = g_timeout_add(link->retry_ms, retry_due, link);
	link->retry_ms = MIN(link->retry_ms * 2, RETRY_MOST);
}

static void opened(LadderBoardLink *link, const struct come *come)
{
	const bool again = link->state == LINK_LOST;

	link->role = come->role;
	g_strlcpy(link->board, come->board, sizeof(link->board));
	g_strlcpy(link->software, come->software, sizeof(link->software));
	make_valid(link->board);
	make_valid(link->software);
	g_clear_pointer(&link->ask, ssh_ask_free);
	link->retry_ms = RETRY_MS;
	link->has_status = false;
	link->timer = g_timeout_add(STATUS_MS, status_due, link);
	set_state(link, LINK_CONNECTED, NULL);
	if (again)
		g_signal_emit(link, signals[PROGRAM_CHANGED], 0);
	ask_status(link);
}

/* What a person can do when nothing answers there. */
static char *unreachable(const char *where, int error)
{
	struct stream_where at;

	if (stream_parse(where, &at) == NULL && at.kind == STREAM_UNIX)
		return error == -EACCES ?
			g_strdup_printf(_("“%s”: you may not open this socket. Add your user to "
					  "the group ladder-view, ladder-oper or ladder-eng, and "
					  "log in again."), at.rest) :
			g_strdup_printf(_("No ladderd listens at “%s”. Start it with --link, or "
					  "connect to another board."), at.rest);
	if (error == -EBUSY)
		return g_strdup_printf(_("%s: another program or window uses this line."), where);
	if (error == -ENOTTY)
		return g_strdup_printf(_("%s: this is no serial line."), where);
	return g_strdup_printf(_("%s: %s"), where, g_strerror(-error));
}

/* The last line that a command said. Caller frees. */
static char *last_line(const char *said_last)
{
	char *text = g_strchomp(g_utf8_make_valid(said_last, -1));
	const char *line = strrchr(text, '\n');
	char *last = g_strdup(line ? line + 1 : text);

	g_free(text);
	return g_strstrip(last);
}

/* What ssh, or another command, said before it ended. NULL: nothing. Caller frees. */
static char *why_command(LadderBoardLink *link, const char *said_last)
{
	char *line = last_line(said_last), *why = NULL;
	const char *where = g_str_has_prefix(link->where, "ssh:") ? link->where + 4 : link->where;
	const char *at = strrchr(where, '@');

	if (strstr(said_last, "HOST IDENTIFICATION HAS CHANGED"))
		why = g_strdup_printf(_("“%s” shows another key than before, so nothing was sent: "
			"somebody else may answer in its place. If the board was installed anew, "
			"remove the old key with “ssh-keygen -R %s” and connect again."), where,
			at ? at + 1 : where);
	else if (strstr(said_last, "Host key verification failed"))
		why = g_strdup_printf(_("The key of “%s” was not accepted; nothing was sent."),
				      where);
	else if (strstr(said_last, "Permission denied"))
		why = g_strdup_printf(_("“%s” does not let this user in. Check the user's name, "
			"and the password or key."), where);
	else if (strstr(said_last, "ladder-attach") && strstr(said_last, "not found"))
		why = g_strdup_printf(_("“%s” has no ladder-attach. Install Rungboard there."),
				      where);
	else if (*line)
		why = g_strdup_printf(_("%s: %s"), where, line);
	g_free(line);
	return why;
}

static char *why_ended(LadderBoardLink *link, const struct come *come)
{
	char *why = come->said && *come->said && come->end != DESK_REFUSED ?
		why_command(link, come->said) : NULL;

	if (why)
		return why;
	if (come->error)
		return unreachable(link->where, come->error);
	if (come->end == DESK_GONE && link->state == LINK_CONNECTED)
		return g_strdup(_("The connection has ended: the cable, the network, or ladderd "
				  "itself. The board goes on without it."));
	return diag_said_whole(&come->why);
}

static void ended(LadderBoardLink *link, struct come *come)
{
	/* A board that refuses hello will not change its mind. */
	const bool was = link->state == LINK_CONNECTED || link->state == LINK_LOST;
	const bool again = was && come->end != DESK_REFUSED && come->end != DESK_NONSENSE;
	const bool busy = come->error == -EBUSY && !was && link->busy++ < BUSY_MOST;
	char *reason = why_ended(link, come);

	drop_session(link);
	if (busy) {
		link->retry = g_timeout_add(BUSY_MS, retry_due, link);
		g_free(reason);
		return;
	}
	if (again)
		retry_later(link);
	set_state(link, again ? LINK_LOST : LINK_FAILED, reason);
}

static void take_one(LadderBoardLink *link, struct come *come)
{
	switch (come->kind) {
	case COME_OPENED:
		opened(link, come);
		break;
	case COME_ANSWER:
		link->pending = g_list_remove(link->pending, come->asked);
		answer(link, come->asked, come);
		break;
	case COME_FRAME:
		if (come->frame.service == SERVICE_COMMIT) {
			g_signal_emit(link, signals[PROGRAM_CHANGED], 0);
			ask_status(link);
		}
		g_signal_emit(link, signals[TOLD], 0, &come->frame);
		break;
	case COME_ENDED:
		ended(link, come);
		break;
	}
}

/* Everything that had come when this began. A handler may end the session. */
static gboolean take_come(gpointer data)
{
	struct session *session = data;
	LadderBoardLink *link = session->link ? g_object_ref(session->link) : NULL;
	GQueue come = G_QUEUE_INIT;
	struct come *one;

	g_mutex_lock(&session->lock);
	session->woken = false;
	come = session->come;
	g_queue_init(&session->come);
	g_cond_signal(&session->taken);
	g_mutex_unlock(&session->lock);
	while ((one = g_queue_pop_head(&come))) {
		if (session->link)
			take_one(session->link, one);
		come_free(one);
	}
	g_clear_object(&link);
	session_unref(session);
	return G_SOURCE_REMOVE;
}

bool ladder_board_link_connect(LadderBoardLink *link, const char *where, char **why)
{
	struct stream_where at;

	if (stream_parse(where, &at)) {
		*why = g_strdup_printf(_("“%s” is no board. Write USER@BOARD, unix:SOCKET, "
					 "serial:TTY or exec:COMMAND."), where);
		return false;
	}
	if (where != link->where) {
		g_free(link->where);
		link->where = g_strdup(where);
	}
	link->has_status = false;
	link->role = ROLE_NONE;
	link->board[0] = '\0';
	link->retry_ms = RETRY_MS;
	link->busy = 0;
	if (begin(link, true))
		set_state(link, LINK_CONNECTING, NULL);
	else
		set_state(link, LINK_FAILED, g_strdup(g_strerror(errno)));
	return true;
}

void ladder_board_link_reconnect(LadderBoardLink *link)
{
	char *why = NULL;

	if (link->where)
		ladder_board_link_connect(link, link->where, &why);
	g_free(why);
}

void ladder_board_link_disconnect(LadderBoardLink *link)
{
	if (link->state == LINK_OFF)
		return;
	drop_session(link);
	link->has_status = false;
	link->role = ROLE_NONE;
	set_state(link, LINK_OFF, NULL);
}

/* ---- state of the link ---- */

enum link_state ladder_board_link_state(LadderBoardLink *link)
{
	return link->state;
}

const char *ladder_board_link_where(LadderBoardLink *link)
{
	return link->where;
}

const char *ladder_board_link_reason(LadderBoardLink *link)
{
	return link->reason ? link->reason : "";
}

const char *ladder_board_link_board(LadderBoardLink *link)
{
	return *link->board ? link->board : link->where ? link->where : "";
}

enum role ladder_board_link_role(LadderBoardLink *link)
{
	return link->role;
}

bool ladder_board_link_may(LadderBoardLink *link, enum service service)
{
	return ladder_board_link_why_not(link, service) == NULL;
}

const char *ladder_board_link_needs(LadderBoardLink *link, enum role role)
{
	const char *why;
	char *text;

	if (link->state != LINK_CONNECTED)
		return _("Not connected to the board");
	if (link->role >= role)
		return NULL;
	text = g_strdup_printf(_("This needs the role “%s” on the board; yours is “%s”. Ask for the "
				 "group ladder-%s there"), role_word(role), role_word(link->role),
			       role_word(role));
	why = g_intern_string(text);
	g_free(text);
	return why;
}

const char *ladder_board_link_why_not(LadderBoardLink *link, enum service service)
{
	return ladder_board_link_needs(link, service_row((uint8_t)service)->role);
}

const struct values_status *ladder_board_link_values(LadderBoardLink *link)
{
	return ladder_board_link_status(link) ? &link->values : NULL;
}

const struct gateways_status *ladder_board_link_gateways(LadderBoardLink *link)
{
	return ladder_board_link_status(link) ? &link->gateways : NULL;
}

const struct board_status *ladder_board_link_status(LadderBoardLink *link)
{
	return link->has_status && link->state == LINK_CONNECTED ? &link->status : NULL;
}

/* ---- requests ---- */

struct wire_writer ladder_board_link_begin(LadderBoardLink *link)
{
	return wire_write(link->fields, WIRE_FRAME_MOST);
}

/* Requests that came while there was no session; one may have begun since. */
static gboolean answer_late(gpointer data)
{
	LadderBoardLink *link = data;
	GList *late = NULL;

	for (GList *at = link->pending, *next; at; at = next) {
		next = at->next;
		if (((struct asked *)at->data)->given)
			continue;
		link->pending = g_list_remove_link(link->pending, at);
		late = g_list_concat(late, at);
	}
	answer_none(link, late);
	return G_SOURCE_REMOVE;
}

/* Of the link, in `pending`. */
static struct asked *asked_new(LadderBoardLink *link, gpointer owner, board_answered answered,
			       gpointer data)
{
	struct asked *asked = g_new0(struct asked, 1);

	asked->refs = 1;
	asked->fields = g_byte_array_new();
	asked->owner = owner;
	asked->owned = owner != NULL;
	if (owner)
		g_object_add_weak_pointer(owner, &asked->owner);
	asked->answered = answered;
	asked->data = data;
	link->pending = g_list_append(link->pending, asked);
	return asked;
}

static void give(LadderBoardLink *link, struct asked *asked)
{
	if (!link->session) {
		g_idle_add_full(G_PRIORITY_DEFAULT, answer_late, g_object_ref(link),
				g_object_unref);
		return;
	}
	g_atomic_int_inc(&asked->refs);
	asked->given = true;
	g_mutex_lock(&link->session->lock);
	g_queue_push_tail(&link->session->asked, asked);
	g_mutex_unlock(&link->session->lock);
	session_wake(link->session);
}

void ladder_board_link_send(LadderBoardLink *link, enum service service,
			    struct wire_writer *fields, gpointer owner, board_answered answered,
			    gpointer data)
{
	struct asked *asked = asked_new(link, owner, answered, data);

	asked->service = service;
	g_byte_array_append(asked->fields, link->fields, (guint)wire_len(fields));
	if (service == SERVICE_PASSWORD)
		memset(link->fields, 0, wire_len(fields));
	if (fields->failed) /* the desk says that it is too long for a frame */
		g_byte_array_set_size(asked->fields, WIRE_FRAME_MOST);
	give(link, asked);
}

void ladder_board_link_work(LadderBoardLink *link,
			    enum desk_end (*work)(struct desk *desk, gpointer data), gpointer owner,
			    board_answered answered, gpointer data, GDestroyNotify free)
{
	struct asked *asked = asked_new(link, owner, answered, data);

	asked->service = SERVICE_DOWNLOAD;
	asked->work = work;
	asked->free = free;
	give(link, asked);
}

struct expect ladder_board_link_expect(LadderBoardLink *link)
{
	struct expect expect = { .mode = link->status.mode };

	memcpy(expect.program, link->status.program, sizeof(expect.program));
	return expect;
}

void ladder_board_link_mode(LadderBoardLink *link, const struct expect *expect,
			    enum mode_wish wish, gpointer owner, board_answered answered,
			    gpointer data)
{
	struct wire_writer fields = ladder_board_link_begin(link);

	wire_put_expect(&fields, expect);
	wire_put_u8(&fields, (uint8_t)wish);
	ladder_board_link_send(link, SERVICE_MODE, &fields, owner, answered, data);
}

/* ---- life ---- */

static void ladder_board_link_dispose(GObject *object)
{
	LadderBoardLink *link = LADDER_BOARD_LINK(object);

	drop_session(link);
	g_clear_pointer(&link->where, g_free);
	g_clear_pointer(&link->reason, g_free);
	G_OBJECT_CLASS(ladder_board_link_parent_class)->dispose(object);
}

static void ladder_board_link_finalize(GObject *object)
{
	g_free(LADDER_BOARD_LINK(object)->fields);
	G_OBJECT_CLASS(ladder_board_link_parent_class)->finalize(object);
}

static void ladder_board_link_class_init(LadderBoardLinkClass *class)
{
	const GType type = G_TYPE_FROM_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = ladder_board_link_dispose;
	G_OBJECT_CLASS(class)->finalize = ladder_board_link_finalize;
	signals[STATE_CHANGED] = g_signal_new("state-changed", type, G_SIGNAL_RUN_LAST, 0, NULL,
					      NULL, NULL, G_TYPE_NONE, 0);
	signals[STATUS] = g_signal_new("status", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
				       G_TYPE_NONE, 0);
	signals[PROGRAM_CHANGED] = g_signal_new("program-changed", type, G_SIGNAL_RUN_LAST, 0,
						NULL, NULL, NULL, G_TYPE_NONE, 0);
	signals[TOLD] = g_signal_new("told", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
				     G_TYPE_NONE, 1, G_TYPE_POINTER);
	signals[ASKS] = g_signal_new("asks", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
				     G_TYPE_NONE, 2, G_TYPE_STRING, G_TYPE_BOOLEAN);
	signals[FAILED] = g_signal_new("failed", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
				       G_TYPE_NONE, 2, G_TYPE_STRING, G_TYPE_STRING);
}

static void ladder_board_link_init(LadderBoardLink *link)
{
	link->state = LINK_OFF;
	link->retry_ms = RETRY_MS;
	link->fields = g_malloc(WIRE_FRAME_MOST);
}

LadderBoardLink *ladder_board_link_new(void)
{
	return g_object_new(LADDER_TYPE_BOARD_LINK, NULL);
}
