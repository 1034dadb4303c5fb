/* SPDX-License-Identifier: MIT
 *
 * text_live - the values of the variables in a line of a list while it is simulated.
 */
#ifndef EDITOR_TEXT_LIVE_H
#define EDITOR_TEXT_LIVE_H

#include "editor-gtk/sim/sim.h"

/** text_live_line - "Start = TRUE · Level = 12"; NULL: nothing is simulated, or the line has
 * no variable. @pou: whose list it is. Caller frees. */
char *text_live_line(LadderSim *sim, const char *pou, const char *line);

#endif
