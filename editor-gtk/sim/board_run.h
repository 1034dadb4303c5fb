/* SPDX-License-Identifier: MIT
 *
 * board_run - ladderd as a child process of the editor: starts, reads its status, stops it.
 *
 * It runs on the pins of this machine. Its standard input is a pipe from the editor: however
 * the editor ends, the pipe closes, and ladderd stops with safe outputs (`--attended`). It is
 * never sent SIGKILL, because only SIGTERM makes the outputs safe.
 *
 * Signals: changed () state or status; told (char *line) a line of its log; ended (int exit)
 * with its exit status, or -1 after a signal.
 */
#ifndef EDITOR_BOARD_RUN_H
#define EDITOR_BOARD_RUN_H

#include <gio/gio.h>
#include <stdbool.h>

#define LADDER_TYPE_BOARD_RUN (ladder_board_run_get_type())
G_DECLARE_FINAL_TYPE(LadderBoardRun, ladder_board_run, LADDER, BOARD_RUN, GObject)

enum board_state { BOARD_OFF, BOARD_STARTING, BOARD_RUNNING, BOARD_STOPPING };

/* Its last status: the values of the lines that runtime/ladderd/control.c writes. */
struct run_status {
	char state[8];          /* "RUN", "STOP", "FAULT"; "": not known yet   */
	char fault[200];        /* "none", or what and where                   */
	char scans[24], period[24];
	char mean[24], worst[24]; /* of scans                                  */
	char late[24], errors[160], io[160], stop[160];
};

/** board_status_line - reads one line of its status, without newline; unknown words are
 * skipped. True: it was the last line of a block. */
bool board_status_line(struct run_status *status, const char *line);

LadderBoardRun *ladder_board_run_new(void);
/** ladder_board_run_start - @file with @map, both paths; the state must be BOARD_OFF.
 * Fails: false, and @error says why: no ladderd. Refusals of ladderd come by the signal told. */
bool ladder_board_run_start(LadderBoardRun *run, const char *file, const char *map,
			    GError **error);
/** ladder_board_run_where - where its link listens, as runtime/online/stream.h reads it: a socket
 * that only this user can reach. NULL: it does not run. Borrowed until it ends. */
const char *ladder_board_run_where(LadderBoardRun *run);
/** ladder_board_run_stop - asks it to end; `ended` comes when outputs are safe. */
void ladder_board_run_stop(LadderBoardRun *run);
/** ladder_board_run_reset - out of a FAULT. */
void ladder_board_run_reset(LadderBoardRun *run);
enum board_state ladder_board_run_state(LadderBoardRun *run);
/** ladder_board_run_status - its last status. Borrowed. */
const struct run_status *ladder_board_run_status(LadderBoardRun *run);
/** board_ended_text - what `ended` with that status means. Caller: g_free. */
char *board_ended_text(int status);

#endif
