/* SPDX-License-Identifier: MIT
 *
 * st_why - why a condition of Structured Text is TRUE or FALSE: its parts between AND and OR that
 * decide, each with its values.
 *
 * The values are those at the end of the scan that is shown. It draws nothing.
 */
#ifndef EDITOR_ST_WHY_H
#define EDITOR_ST_WHY_H

#include "editor-gtk/sim/sim.h"

/**
 * st_why - the reasons as a sentence
 * @pou:  the name of the POU
 * @text: its text; @line: from 0, that of an IF, ELSIF, WHILE, UNTIL, or of a BOOL that is stored
 * Owns: the caller, g_free().   Fails: NULL: no such condition is there, or its values are unknown.
 */
char *st_why(LadderSim *sim, const char *pou, const char *text, int line);
/** st_why_network - the same of a value in a network; @text: the value alone; @network: 0-based, of which wires are
 * names. */
char *st_why_network(LadderSim *sim, const char *pou, int network, const char *text);

#endif
