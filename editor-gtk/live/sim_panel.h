/* SPDX-License-Identifier: MIT
 *
 * sim_panel - the panel beside the sheets while a program is simulated: inputs as switches,
 * outputs as lamps, timers, counters, numbers.
 *
 * It shows ladder_sim_twin() and changes it with ladder_sim_act(). While the simulation is off
 * it says what it is for.
 */
#ifndef EDITOR_SIM_PANEL_H
#define EDITOR_SIM_PANEL_H

#include "editor-gtk/live/sim_panel_row.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_SIM_PANEL (ladder_sim_panel_get_type())
G_DECLARE_FINAL_TYPE(LadderSimPanel, ladder_sim_panel, LADDER, SIM_PANEL, GtkWidget)

/** ladder_sim_panel_new - @sim: referenced. */
GtkWidget *ladder_sim_panel_new(LadderSim *sim);

/** ladder_sim_panel_select - selects the line of that name and scrolls to it; false: none. */
bool ladder_sim_panel_select(LadderSimPanel *panel, const char *name);

#endif
