/* SPDX-License-Identifier: MIT
 *
 * board_view - the page below the sheets for the program on this machine: its I/O map, state,
 * times and log.
 *
 * It starts nothing itself: its buttons activate win.run_board and win.stop_board.
 */
#ifndef EDITOR_BOARD_VIEW_H
#define EDITOR_BOARD_VIEW_H

#include "editor-gtk/sim/board_run.h"
#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_BOARD_VIEW (ladder_board_view_get_type())
G_DECLARE_FINAL_TYPE(LadderBoardView, ladder_board_view, LADDER, BOARD_VIEW, GtkBox)

/** ladder_board_view_new - shows @run; offers the I/O maps beside @document. */
GtkWidget *ladder_board_view_new(LadderBoardRun *run, LadderDocument *document);
/** ladder_board_view_map - path of the chosen map; NULL: none. Borrowed
 * until the next call. */
const char *ladder_board_view_map(LadderBoardView *view);
/** ladder_board_view_set_map - chooses a map, also one of another folder. */
void ladder_board_view_set_map(LadderBoardView *view, const char *path);
/** ladder_board_view_put - adds a line to the log, with the time. */
void ladder_board_view_put(LadderBoardView *view, const char *text);

#endif
