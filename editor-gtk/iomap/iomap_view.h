/* SPDX-License-Identifier: MIT
 *
 * iomap_view - an I/O map as a table, or as its text: one row a point, edited in place.
 *
 * The text of the buffer is the only state; each edit is one step of its undo. A row shows its
 * error, or that this machine lacks its line; points missing in the map are listed below. Lines
 * and devices to choose from are those of this machine, or of the connected board. It reads no file except the
 * chips' lists of lines, and writes none.
 */
#ifndef EDITOR_IOMAP_VIEW_H
#define EDITOR_IOMAP_VIEW_H

#include "editor-gtk/document/side_file.h"
#include "editor-gtk/online/board_link.h"
#include "editor-gtk/sim/sim.h"

#define LADDER_TYPE_IOMAP_VIEW (ladder_iomap_view_get_type())
G_DECLARE_FINAL_TYPE(LadderIomapView, ladder_iomap_view, LADDER, IOMAP_VIEW, GtkBox)

/** ladder_iomap_view_new - a table of @file. @text: the widget that shows it as text, on the
 * other page of the table. */
GtkWidget *ladder_iomap_view_new(LadderSideFile *file, GtkWidget *text);
/** ladder_iomap_view_follow - shows the present values of @sim while it is on, once. */
void ladder_iomap_view_follow(LadderIomapView *view, LadderSim *sim);
/** ladder_iomap_view_connect - while @link is connected, lines and devices are those of its board; once. */
void ladder_iomap_view_connect(LadderIomapView *view, LadderBoardLink *link);
/** ladder_iomap_view_is_text - does it show the text, not the table? Signal "turned" when
 * that changes. */
bool ladder_iomap_view_is_text(LadderIomapView *view);

#endif
