/* SPDX-License-Identifier: MIT
 *
 * board_view - the page below the sheets that shows what runs on this machine: with which
 * I/O map, its state and times, its log.
 *
 * It starts nothing by itself: its buttons do win.run_board and win.stop_board.
 */
#ifndef EDITOR_BOARD_VIEW_H
#define EDITOR_BOARD_VIEW_H

#include "editor-gtk/sim/board_run.h"
#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_BOARD_VIEW (ladder_board_view_get_type())
G_DECLARE_FINAL_TYPE(LadderBoardView, ladder_board_view, LADDER, BOARD_VIEW, GtkBox)

/** ladder_board_view_new - follows @run; its maps are those beside @document. */
GtkWidget *ladder_board_view_new(LadderBoardRun *run, LadderDocument *document);
/** ladder_board_view_map - path of the one that is chosen; NULL: there is none. Borrowed
 * until the next call. */
const char *ladder_board_view_map(LadderBoardView *view);
/** ladder_board_view_set_map - chooses one, also one that lies elsewhere. */
void ladder_board_view_set_map(LadderBoardView *view, const char *path);
/** ladder_board_view_put - a line of the log, with the time. */
void ladder_board_view_put(LadderBoardView *view, const char *text);

#endif
