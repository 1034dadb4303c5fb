/* SPDX-License-Identifier: MIT
 *
 * alarm_view - the alarms of the connected board, or of the simulation.
 *
 * A board keeps a list: what came, went and was acknowledged, and by whom. Of the simulation the
 * blocks of the scan that is shown are listed, with the simulated time; so it also shows the past.
 */
#ifndef EDITOR_ALARM_VIEW_H
#define EDITOR_ALARM_VIEW_H

#include "editor-gtk/online/board_link.h"
#include "editor-gtk/sim/sim.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_ALARM_VIEW (ladder_alarm_view_get_type())
G_DECLARE_FINAL_TYPE(LadderAlarmView, ladder_alarm_view, LADDER, ALARM_VIEW, GtkWidget)

/** ladder_alarm_view_new - @sim, @link: referenced. */
GtkWidget *ladder_alarm_view_new(LadderSim *sim, LadderBoardLink *link);
#endif
