/* SPDX-License-Identifier: MIT
 *
 * online_move - programs that go between the window and its board: download, upload, comparison.
 */
#ifndef EDITOR_ONLINE_MOVE_H
#define EDITOR_ONLINE_MOVE_H

#include "editor-gtk/online/board_download.h"
#include "editor-gtk/window/compare.h"

struct online_move {
	struct core *core;
	struct compare *compare;
	LadderBoardDownload *download;  /* NULL: none                          */
	AdwMessageDialog *dialog;       /* of the download; NULL: none         */
	GtkWidget *progress;            /* in it                               */
	struct board_copy *copy;        /* to be written; NULL: none           */
	/* Of the upload that was begun last. */
	void (*copied)(struct online_move *move, struct board_copy *copy, const char *why);
};

void online_move_init(struct online_move *move, struct core *core, struct compare *compare);
void online_move_clear(struct online_move *move);
/** online_move_compare - shows the document against what the board stores. */
void online_move_compare(struct online_move *move);
/** online_move_download - sends the document, says what that changes, and asks. */
void online_move_download(struct online_move *move);
/** online_move_upload - writes what the board stores into a folder, and opens it in a window that is
 * connected to that board. */
void online_move_upload(struct online_move *move);

#endif
