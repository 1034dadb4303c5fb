/* SPDX-License-Identifier: MIT
 *
 * board_link - a session with a board: a thread moves the bytes, the main thread gives requests
 * and gets answers, in its main loop.
 *
 * No function waits for the board. A request without a connection is answered with DESK_GONE.
 * The link shows nothing and knows no program.
 *
 * Signals:
 *   state-changed ()                      state or reason
 *   status ()                             ladder_board_link_status() is new; twice a second
 *   program-changed ()                    another program runs; publish requests have ended,
 *                                         places of variables are void. Also after a reconnect
 *   told (gpointer frame)                 a struct frame that was not asked for (publish); read
 *                                         it in the handler
 *   asks (const char *question, gboolean yes_no)  ssh has a question:
 *                                         ladder_board_link_answer() once
 *   failed (const char *service, const char *text)  a request was refused or got no answer
 */
#ifndef EDITOR_BOARD_LINK_H
#define EDITOR_BOARD_LINK_H

#include "online/desk.h"
#include "online/report.h"
#include "online/status.h"

#include <gio/gio.h>

#define LADDER_TYPE_BOARD_LINK (ladder_board_link_get_type())
G_DECLARE_FINAL_TYPE(LadderBoardLink, ladder_board_link, LADDER, BOARD_LINK, GObject)

enum link_state {
	LINK_OFF,
	LINK_CONNECTING,     /* for the first time                            */
	LINK_CONNECTED,
	LINK_LOST,           /* was connected; tries again by itself, unless the board said no */
	LINK_FAILED,         /* could not connect, or gave up                 */
};

LadderBoardLink *ladder_board_link_new(void);
/** ladder_board_link_connect - @where: as stream_parse() reads it; ends another session. Fails:
 * false: @where is wrong, and *why says how; caller frees it. */
bool ladder_board_link_connect(LadderBoardLink *link, const char *where, char **why);
/** ladder_board_link_reconnect - tries the same board again, now. */
void ladder_board_link_reconnect(LadderBoardLink *link);
void ladder_board_link_disconnect(LadderBoardLink *link);

/** ladder_board_link_answer - to the question of `asks`; NULL: none, so it does not connect. */
void ladder_board_link_answer(LadderBoardLink *link, const char *text);

enum link_state ladder_board_link_state(LadderBoardLink *link);
/** ladder_board_link_where - of the last connect; NULL: none. Borrowed. */
const char *ladder_board_link_where(LadderBoardLink *link);
/** ladder_board_link_reason - why LOST or FAILED, and what to do. "": neither. Borrowed. */
const char *ladder_board_link_reason(LadderBoardLink *link);
/** ladder_board_link_board - its name, for people; if it has none, where it is. Borrowed. */
const char *ladder_board_link_board(LadderBoardLink *link);
enum role ladder_board_link_role(LadderBoardLink *link);
/** ladder_board_link_may - whether the role of the session is enough for the service. */
bool ladder_board_link_may(LadderBoardLink *link, enum service service);
/** ladder_board_link_why_not - the same in words: what role it needs, and how to get it; NULL: it
 * may. Translated; lives for ever. */
const char *ladder_board_link_why_not(LadderBoardLink *link, enum service service);
/** ladder_board_link_needs - likewise, of something that needs @role. */
const char *ladder_board_link_needs(LadderBoardLink *link, enum role role);
/** ladder_board_link_status - the last one; NULL: not connected, or none yet. Borrowed until the
 * next `status`. */
const struct board_status *ladder_board_link_status(LadderBoardLink *link);
/** ladder_board_link_values - likewise, of the values of its I/O map. */
const struct values_status *ladder_board_link_values(LadderBoardLink *link);
/** ladder_board_link_gateways - likewise, of the programs that serve some of them. */
const struct gateways_status *ladder_board_link_gateways(LadderBoardLink *link);
/** ladder_board_link_look - asks for the status now; `status` comes soon. */
void ladder_board_link_look(LadderBoardLink *link);

/* ---- requests ---- */

struct board_answer {
	enum desk_end end;         /* DESK_GOOD: `body` has the fields         */
	uint16_t request;          /* its number: frames of a publish have it  */
	uint16_t refusal;          /* enum refusal, with DESK_REFUSED          */
	const char *text;          /* why it failed, translated; "": it did not */
	struct wire_reader body;   /* valid in the handler                     */
};
typedef void (*board_answered)(gpointer data, struct board_answer *answer);

/** ladder_board_link_begin - a writer for the fields of a request. */
struct wire_writer ladder_board_link_begin(LadderBoardLink *link);
/**
 * ladder_board_link_send - sends the request whose fields @fields has; requests are answered one
 * after the other, in order
 * @owner: if it is disposed before, @answered is not called; NULL: always call it
 * @answered: called once, in the main loop, never before this returns; NULL: none
 */
void ladder_board_link_send(LadderBoardLink *link, enum service service,
			    struct wire_writer *fields, gpointer owner, board_answered answered,
			    gpointer data);
/** ladder_board_link_work - has @work done in turn with the requests, in the session's thread: it
 * calls @desk and touches only @data. @answered as above, with @data. @free: frees @data, in any thread, when neither @work nor @answered uses it any more;
 * NULL: borrowed for ever. */
void ladder_board_link_work(LadderBoardLink *link,
			    enum desk_end (*work)(struct desk *desk, gpointer data), gpointer owner,
			    board_answered answered, gpointer data, GDestroyNotify free);
/** ladder_board_link_expect - what a person sees now: the program and the mode of the last status.
 * A change that carries it is refused when the board has another one by then. */
struct expect ladder_board_link_expect(LadderBoardLink *link);
/** ladder_board_link_mode - run, stop, reset. @expect: as it was when a person decided. */
void ladder_board_link_mode(LadderBoardLink *link, const struct expect *expect,
			    enum mode_wish wish, gpointer owner, board_answered answered,
			    gpointer data);

#endif
