/* SPDX-License-Identifier: MIT
 *
 * sim_panel_view - the widget of a line of the simulation panel. The list reuses it for other
 * lines.
 */
#ifndef EDITOR_SIM_PANEL_VIEW_H
#define EDITOR_SIM_PANEL_VIEW_H

#include "editor-gtk/live/sim_panel_row.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_SIM_ROW_VIEW (ladder_sim_row_view_get_type())
G_DECLARE_FINAL_TYPE(LadderSimRowView, ladder_sim_row_view, LADDER, SIM_ROW_VIEW, GtkWidget)

/** ladder_sim_row_view_new - @sim, and @item, whose child it is: both live longer than it. */
GtkWidget *ladder_sim_row_view_new(LadderSim *sim, GtkListItem *item);
/** ladder_sim_row_view_bind - @row: NULL: shows nothing. */
void ladder_sim_row_view_bind(LadderSimRowView *view, LadderSimRow *row);
/** ladder_sim_row_view_update - shows what changed; cheap if nothing did. */
void ladder_sim_row_view_update(LadderSimRowView *view);
/** ladder_sim_row_view_row - borrowed; NULL: none. */
LadderSimRow *ladder_sim_row_view_row(LadderSimRowView *view);

/** ladder_sim_row_view_refuse - what a person did with the value at @at was refused: its line says
 * @why, and any other line says nothing any more. */
void ladder_sim_row_view_refuse(LadderSimRowView *view, struct location at, const char *why);

enum sim_edit { SIM_EDIT_VALUE, SIM_EDIT_PRESET };
/** ladder_sim_row_view_edit - opens an entry for the value or the preset. */
void ladder_sim_row_view_edit(LadderSimRowView *view, enum sim_edit what);

/** ladder_sim_row_view_fold - folds or unfolds the section of @heading; @from: the panel or a
 * widget in it. */
void ladder_sim_row_view_fold(GtkWidget *from, const LadderSimRow *heading);

#endif
