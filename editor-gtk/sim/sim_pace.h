/* SPDX-License-Identifier: MIT
 *
 * sim_pace - how fast a simulation goes, and how it starts: the popover of its button.
 */
#ifndef EDITOR_SIM_PACE_H
#define EDITOR_SIM_PACE_H

#include "editor-gtk/sim/sim.h"

#include <gtk/gtk.h>

/** sim_pace_new - a popover: period, slow motion, what it pauses at, cold and warm start.
 * @sim: referenced. */
GtkWidget *sim_pace_new(LadderSim *sim);

#endif
