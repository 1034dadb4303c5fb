/* SPDX-License-Identifier: MIT
 *
 * board_download - brings a program to a board: sends it, learns what it would change, and has it
 * replace the one that runs when a person has agreed.
 *
 * Until then nothing changes on the board. It shows nothing.
 *
 * Signal: changed (): state or progress.
 */
#ifndef EDITOR_BOARD_DOWNLOAD_H
#define EDITOR_BOARD_DOWNLOAD_H

#include "editor-gtk/online/board_copy.h"

#define LADDER_TYPE_BOARD_DOWNLOAD (ladder_board_download_get_type())
G_DECLARE_FINAL_TYPE(LadderBoardDownload, ladder_board_download, LADDER, BOARD_DOWNLOAD, GObject)

enum download_state {
	DOWNLOAD_SENDS,
	DOWNLOAD_ASKS,         /* the board has it; ladder_board_download_commit() */
	DOWNLOAD_COMMITS,
	DOWNLOAD_DONE,
	DOWNLOAD_FAILED,       /* ladder_board_download_why()                  */
};

/** ladder_board_download_new - begins to send. @program: referenced. */
LadderBoardDownload *ladder_board_download_new(LadderBoardLink *link,
					       struct board_program *program);
enum download_state ladder_board_download_state(LadderBoardDownload *download);
/** ladder_board_download_part - how much of it the board has, 0 to 1. */
double ladder_board_download_part(LadderBoardDownload *download);
/** ladder_board_download_why - why it failed, and what to do. Borrowed. */
const char *ladder_board_download_why(LadderBoardDownload *download);
/** ladder_board_download_needs_restart - another I/O map: the board begins again with it. */
bool ladder_board_download_needs_restart(LadderBoardDownload *download);
/** ladder_board_download_losses - a text for each value that does not go on, translated. Of
 * char *; borrowed. */
GPtrArray *ladder_board_download_losses(LadderBoardDownload *download);
/** ladder_board_download_more - how many more the board did not name. */
guint ladder_board_download_more(LadderBoardDownload *download);
/** ladder_board_download_commit - in DOWNLOAD_ASKS: the program replaces the one that runs.
 * @restart: from its beginning, with initial and retained values. */
void ladder_board_download_commit(LadderBoardDownload *download, bool restart);
/** ladder_board_download_cancel - the board forgets what has come. Not while it commits. */
void ladder_board_download_cancel(LadderBoardDownload *download);

#endif
