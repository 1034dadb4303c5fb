/* SPDX-License-Identifier: MIT
 *
 * sim_pace - the popover of the clock button: period, speed of the board,
 * slow motion, FAULT on a failed operation,
 * plant, cold and warm start.
 */
#ifndef EDITOR_SIM_PACE_H
#define EDITOR_SIM_PACE_H

#include "editor-gtk/sim/sim.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_SIM_PACE (ladder_sim_pace_get_type())
G_DECLARE_FINAL_TYPE(LadderSimPace, ladder_sim_pace, LADDER, SIM_PACE, GtkPopover)

/** ladder_sim_pace_new - @sim: referenced. */
GtkWidget *ladder_sim_pace_new(LadderSim *sim);

#endif
