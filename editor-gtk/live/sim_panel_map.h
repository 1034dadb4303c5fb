/* SPDX-License-Identifier: MIT
 *
 * sim_panel_map - what the I/O map beside the project calls the panel's inputs and outputs.
 */
#ifndef EDITOR_SIM_PANEL_MAP_H
#define EDITOR_SIM_PANEL_MAP_H

#include "editor-gtk/live/sim_panel_row.h"

/** sim_map_take - gives each input and output of @rows, which have none yet, its place and
 * its pin. @path: of the project; NULL, or no map beside it: nothing happens. */
void sim_map_take(const char *path, GPtrArray *rows);

#endif
