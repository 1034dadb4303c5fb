/* SPDX-License-Identifier: MIT
 *
 * sim_panel_view - a line of the simulation panel as a widget, used again for other lines.
 */
#ifndef EDITOR_SIM_PANEL_VIEW_H
#define EDITOR_SIM_PANEL_VIEW_H

#include "editor-gtk/live/sim_panel_row.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_SIM_ROW_VIEW (ladder_sim_row_view_get_type())
G_DECLARE_FINAL_TYPE(LadderSimRowView, ladder_sim_row_view, LADDER, SIM_ROW_VIEW, GtkWidget)

/** ladder_sim_row_view_new - @sim: borrowed longer than the widget; @item: it is the child
 * of, borrowed likewise. */
GtkWidget *ladder_sim_row_view_new(LadderSim *sim, GtkListItem *item);
/** ladder_sim_row_view_bind - NULL: it shows nothing. */
void ladder_sim_row_view_bind(LadderSimRowView *view, LadderSimRow *row);
/** ladder_sim_row_view_update - shows what changed. Cheap if nothing did. */
void ladder_sim_row_view_update(LadderSimRowView *view);
/** ladder_sim_row_view_row - borrowed; NULL: none. */
LadderSimRow *ladder_sim_row_view_row(LadderSimRowView *view);

enum sim_edit { SIM_EDIT_VALUE, SIM_EDIT_PRESET };
/** ladder_sim_row_view_edit - a field for the value, or the preset. */
void ladder_sim_row_view_edit(LadderSimRowView *view, enum sim_edit what);

/** ladder_sim_row_view_text - what it shows now: of a bit "0" or "1" as switch or lamp
 * stand, of a timer "1.00s / 2.00s", else the value. Caller frees. For tests. */
char *ladder_sim_row_view_text(LadderSimRowView *view);

/** ladder_sim_row_view_fold - folds or unfolds the section that @heading is of, in the panel
 * that @from is, or stands in. */
void ladder_sim_row_view_fold(GtkWidget *from, const LadderSimRow *heading);

#endif
