/* SPDX-License-Identifier: MIT
 *
 * test_board_link - a session of the editor with a real ladderd: requests and answers, a board
 * that goes and comes back, places where no board is.
 */
#include "tests/editor/online/board.h"

#include "engine/scan/resource.h"

#include <fcntl.h>
#include <poll.h>
#include <string.h>
#include <sys/file.h>
#include <sys/ioctl.h>

static struct board_answer last;
static char *last_text;
static int answers, others, frames;

static void answered(gpointer data, struct board_answer *answer)
{
	(void)data;
	last = *answer;
	g_free(last_text);
	last_text = g_strdup(answer->text);
	answers++;
}

static void changed(LadderBoardLink *link, int *count)
{
	(void)link;
	++*count;
}

static void told(LadderBoardLink *link, struct frame *frame)
{
	(void)link;
	if (frame->service == SERVICE_PUBLISH && frame->request == last.request)
		frames++;
}

static int mode_of(LadderBoardLink *link)
{
	const struct board_status *status = ladder_board_link_status(link);

	return status ? status->mode : -1;
}

static void begins_and_orders(void)
{
	LadderBoardLink *link = ladder_board_link_new();
	struct test_board board = { .empty = false };
	struct wire_writer fields;
	struct expect seen;
	char *why = NULL;

	board_open(&board, "eng");
	g_signal_connect(link, "told", G_CALLBACK(told), NULL);
	CHECK(ladder_board_link_connect(link, board.where, &why));
	CHECK(ladder_board_link_state(link) == LINK_CONNECTING);
	CHECK_SOON(mode_of(link) == STATE_RUN);
	CHECK_TEXT(ladder_board_link_board(link), "table");
	CHECK(ladder_board_link_role(link) == ROLE_ENG && ladder_board_link_may(link, SERVICE_FORCE));
	answers = 0;
	seen = ladder_board_link_expect(link);
	ladder_board_link_mode(link, &seen, MODE_STOP, link, answered, NULL);
	CHECK_AS(answers == 0, "an answer never comes before the request returns");
	CHECK_SOON(answers == 1 && last.end == DESK_GOOD);
	CHECK_SOON(mode_of(link) == STATE_STOP);
	ladder_board_link_mode(link, &seen, MODE_STOP, link, answered, NULL);
	CHECK_SOON(answers == 2 && last.end == DESK_REFUSED && last.refusal == REFUSAL_CONFLICT);
	answers = 1;
	fields = ladder_board_link_begin(link);
	wire_put_u32(&fields, 20000);
	wire_put_u8(&fields, 0);
	wire_put_u16(&fields, 1);
	wire_put_name(&fields, "Count");
	ladder_board_link_send(link, SERVICE_PUBLISH, &fields, link, answered, NULL);
	CHECK_SOON(answers == 2 && last.end == DESK_GOOD && frames == 1);
	fields = ladder_board_link_begin(link);
	wire_put_u16(&fields, 1);
	wire_put_name(&fields, "Nothing");
	ladder_board_link_send(link, SERVICE_READ, &fields, link, answered, NULL);
	CHECK_SOON(answers == 3);
	CHECK(last.end == DESK_REFUSED && last.refusal == REFUSAL_NO_NAME);
	CHECK_TEXT(last_text, "\"Nothing\" is not in the program that runs on the board");
	fields = ladder_board_link_begin(link);
	fields.at = fields.end;
	ladder_board_link_send(link, SERVICE_READ, &fields, link, answered, NULL);
	CHECK_SOON(answers == 4 && last.end == DESK_NO_ROOM);
	ladder_board_link_disconnect(link);
	CHECK(ladder_board_link_state(link) == LINK_OFF && !ladder_board_link_status(link));
	ladder_board_link_mode(link, &seen, MODE_STOP, link, answered, NULL);
	CHECK_SOON(answers == 5 && last.end == DESK_GONE);
	g_object_unref(link);
	board_close(&board);
}

static void goes_and_comes_back(void)
{
	LadderBoardLink *link = ladder_board_link_new();
	struct test_board board = { .empty = false };
	GObject *owner = g_object_new(G_TYPE_OBJECT, NULL);
	struct expect seen;
	char *why = NULL;

	board_open(&board, "eng");
	g_signal_connect(link, "program-changed", G_CALLBACK(changed), &others);
	ladder_board_link_connect(link, board.where, &why);
	CHECK_SOON(mode_of(link) == STATE_RUN);
	board_stop(&board);
	CHECK_SOON(ladder_board_link_state(link) == LINK_LOST);
	CHECK(*ladder_board_link_reason(link) && !ladder_board_link_may(link, SERVICE_STATUS));
	answers = 0;
	seen = ladder_board_link_expect(link);
	ladder_board_link_mode(link, &seen, MODE_STOP, owner, answered, NULL);
	g_object_unref(owner);
	others = 0;
	board_start(&board);
	CHECK_SOON(mode_of(link) == STATE_RUN);
	CHECK_AS(others == 1, "what a board runs after a break may be another program");
	CHECK_AS(answers == 0, "nobody is called who has gone");
	g_object_unref(link);
	board_close(&board);
}

static void asks_once_more(gpointer link, struct board_answer *answer)
{
	struct wire_writer fields = ladder_board_link_begin(link);

	CHECK(answer->end == DESK_GONE);
	wire_put_u16(&fields, 0);
	ladder_board_link_send(link, SERVICE_READ, &fields, NULL, answered, NULL);
}

/* A request that is made while a session gives way to the next one is answered, too. */
static void answers_between_two_sessions(void)
{
	LadderBoardLink *link = ladder_board_link_new();
	struct wire_writer fields;
	char *why = NULL;

	ladder_board_link_connect(link, "exec:sleep 1000", &why);
	fields = ladder_board_link_begin(link);
	wire_put_u16(&fields, 0);
	ladder_board_link_send(link, SERVICE_READ, &fields, NULL, asks_once_more, link);
	answers = 0;
	ladder_board_link_reconnect(link);
	CHECK_SOON(answers == 1);
	CHECK(last.end == DESK_GONE && ladder_board_link_state(link) == LINK_CONNECTING);
	g_object_unref(link);
}

/* A port that another session still has: it may be ending, so the link tries for a while. */
static void waits_for_a_port(void)
{
	LadderBoardLink *link = ladder_board_link_new();
	const int other_end = open("/dev/ptmx", O_RDWR | O_NOCTTY | O_CLOEXEC);
	struct pollfd hello = { .fd = other_end, .events = POLLIN };
	char *path, *where, *why = NULL;
	int port, locked = 0, number = 0;

	CHECK(ioctl(other_end, TIOCSPTLCK, &locked) == 0 && ioctl(other_end, TIOCGPTN, &number) == 0);
	path = g_strdup_printf("/dev/pts/%d", number);
	where = g_strdup_printf("serial:%s,115200", path);
	port = open(path, O_RDWR | O_NOCTTY | O_CLOEXEC);
	CHECK(port >= 0 && flock(port, LOCK_EX | LOCK_NB) == 0);
	CHECK(ladder_board_link_connect(link, where, &why));
	turn(300);
	CHECK(ladder_board_link_state(link) == LINK_CONNECTING && poll(&hello, 1, 0) == 0);
	flock(port, LOCK_UN);
	CHECK_SOON(poll(&hello, 1, 0) == 1 && hello.revents & POLLIN);
	CHECK(ladder_board_link_state(link) == LINK_CONNECTING);
	g_object_unref(link);
	close(port);
	close(other_end);
	g_free(where);
	g_free(path);
}

static char *question;

static void keep_question(LadderBoardLink *link, const char *text, gboolean yes_no)
{
	CHECK(!yes_no);
	g_free(question);
	question = g_strdup(text);
	ladder_board_link_answer(link, NULL);
}

/* A script in a file of its own. Caller: unlink() and g_free(). */
static char *script_new(const char *text)
{
	char *path = g_build_filename(g_get_tmp_dir(), "script-XXXXXX", NULL);
	const int fd = g_mkstemp(path);

	CHECK(fd >= 0 && write(fd, text, strlen(text)) == (ssize_t)strlen(text));
	close(fd);
	return path;
}

/* Nobody is asked for a password while a lost connection is tried again. A person who connects then,
 * here or elsewhere, is. */
static void asks_a_person_after_a_break(void)
{
	LadderBoardLink *link = ladder_board_link_new();
	const char *build = g_getenv("BUILD");
	char *text = g_strdup_printf("case \"$*\" in *BatchMode*) exit 1;; esac\n"
				     "exec '%s/ladder-editor' 'Password of pi?'\n",
				     build ? build : "build");
	char *script = script_new(text);
	char *ssh = g_strdup_printf("sh %s", script), *why = NULL;
	struct test_board board = { .empty = false };

	g_setenv("RUNGBOARD_SSH", ssh, TRUE);
	g_signal_connect(link, "asks", G_CALLBACK(keep_question), NULL);
	board_open(&board, "eng");
	ladder_board_link_connect(link, board.where, &why);
	CHECK_SOON(mode_of(link) == STATE_RUN);
	board_stop(&board);
	CHECK_SOON(ladder_board_link_state(link) == LINK_LOST);
	ladder_board_link_connect(link, "pi@far", &why);
	CHECK_SOON(ladder_board_link_state(link) == LINK_FAILED);
	CHECK_TEXT(question ? question : "none", "Password of pi?");
	g_unsetenv("RUNGBOARD_SSH");
	unlink(script);
	g_free(question);
	g_free(script);
	g_free(text);
	g_free(ssh);
	g_object_unref(link);
	board_close(&board);
}

/* More than a pipe holds: if nobody reads it, the command waits, and the board with it. */
static void hears_a_command_that_says_much(void)
{
	LadderBoardLink *link = ladder_board_link_new();
	char *path = script_new("head -c 300000 /dev/zero | tr '\\0' x >&2\n"
				"echo >&2\necho the last words >&2\nexit 3\n");
	char *where, *why = NULL;

	where = g_strdup_printf("exec:sh %s", path);
	CHECK(ladder_board_link_connect(link, where, &why));
	CHECK_SOON(ladder_board_link_state(link) == LINK_FAILED);
	CHECK_AS(strstr(ladder_board_link_reason(link), "the last words") != NULL,
		 "the reason is what the command said last");
	unlink(path);
	g_free(where);
	g_free(path);
	g_object_unref(link);
}

static void finds_no_board(void)
{
	LadderBoardLink *link = ladder_board_link_new();
	struct test_board board = { .empty = false };
	char *why = NULL;

	CHECK(!ladder_board_link_connect(link, "pi@-oProxyCommand=x", &why));
	CHECK_TEXT(why, "“pi@-oProxyCommand=x” is no board. Write USER@BOARD, unix:SOCKET, serial:TTY "
		   "or exec:COMMAND.");
	g_free(why);
	CHECK(ladder_board_link_connect(link, "unix:/nowhere", &why));
	CHECK_SOON(ladder_board_link_state(link) == LINK_FAILED);
	CHECK_TEXT(ladder_board_link_reason(link), "No ladderd listens at “/nowhere”. Start it with "
		   "--link, or connect to another board.");
	ladder_board_link_connect(link, "exec:echo this is no board", &why);
	CHECK_SOON(ladder_board_link_state(link) == LINK_FAILED);
	CHECK_TEXT(ladder_board_link_reason(link),
		   "what answers there is not ladderd, or another version of it");
	ladder_board_link_connect(link, "exec:sleep 1000", &why);
	ladder_board_link_disconnect(link);
	CHECK_AS(ladder_board_link_state(link) == LINK_OFF, "one that does not answer can be left");
	board_open(&board, "none");
	ladder_board_link_connect(link, board.where, &why);
	CHECK_SOON(ladder_board_link_state(link) == LINK_CONNECTED);
	CHECK(ladder_board_link_role(link) == ROLE_NONE && !ladder_board_link_may(link, SERVICE_STATUS));
	g_object_unref(link);
	board_close(&board);
}

int main(void)
{
	begins_and_orders();
	goes_and_comes_back();
	finds_no_board();
	hears_a_command_that_says_much();
	answers_between_two_sessions();
	waits_for_a_port();
	asks_a_person_after_a_break();
	g_free(last_text);
	return tap_done();
}
