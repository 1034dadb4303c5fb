/* SPDX-License-Identifier: MIT
 *
 * test_board_link - a session of the editor with a real ladderd: requests and answers, a board
 * that goes and comes back, places where no board is.
 */
#include "tests/editor/online/board.h"

#include "engine/scan/resource.h"

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
	struct test_board board;
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
	struct test_board board;
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

/* More than a pipe holds: if nobody reads it, the command waits, and the board with it. */
static void hears_a_command_that_says_much(void)
{
	static const char text[] = "#!/bin/sh\nhead -c 300000 /dev/zero | tr '\\0' x >&2\n"
				   "echo >&2\necho the last words >&2\nexit 3\n";
	LadderBoardLink *link = ladder_board_link_new();
	char *path = g_build_filename(g_get_tmp_dir(), "says-much-XXXXXX", NULL);
	const int fd = g_mkstemp(path);
	char *where, *why = NULL;

	CHECK(fd >= 0 && write(fd, text, sizeof(text) - 1) == (ssize_t)sizeof(text) - 1);
	close(fd);
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
	struct test_board board;
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
	g_free(last_text);
	return tap_done();
}
