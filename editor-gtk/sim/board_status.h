/* SPDX-License-Identifier: MIT
 *
 * board_status - what a running ladderd tells of itself, read line by line.
 *
 * The block of runtime/ladderd/control.c: `word: value`, ended by an empty line. A word
 * that is not known is stepped over. No toolkit.
 */
#ifndef EDITOR_BOARD_STATUS_H
#define EDITOR_BOARD_STATUS_H

#include <stdbool.h>

struct board_status {
	char state[8];          /* "RUN", "STOP", "FAULT"; "": not told yet    */
	char fault[200];        /* "none", or what and where                   */
	char scans[24], period[24];
	char mean[24], worst[24]; /* of scans                                  */
	char late[24], errors[160], io[160], stop[160];
};

/** board_status_line - @status takes in a line, without its newline.
 * Returns true if it was the last one of a block. */
bool board_status_line(struct board_status *status, const char *line);

#endif
