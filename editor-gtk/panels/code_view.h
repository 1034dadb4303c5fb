/* SPDX-License-Identifier: MIT
 *
 * code_view - the instruction list of the sheet in front, read-only, with its values while it is
 * simulated, or watched on a board.
 *
 * The list is made when the panel is shown: for a large program that takes long, and a text
 * widget needs many times its size.
 *
 * A simulation runs this list with further instructions, which keep the result after each line:
 * code_listed(). A board keeps the power of each cell alone. So there a line of a ladder's list has
 * a result where that is the power at an end of a contact or coil, and no line has one in a
 * program with jumps: nobody knows which of its rungs have run.
 */
#ifndef EDITOR_CODE_VIEW_H
#define EDITOR_CODE_VIEW_H

#include "editor-gtk/sim/sim.h"

#include <gtk/gtk.h>

/** ladder_code_view_new - shows the first program; beside its lines the values of @sim. */
GtkWidget *ladder_code_view_new(LadderDocument *document, LadderSim *sim);
void ladder_code_view_set_pou(GtkWidget *view, int pou);
/** ladder_code_view_set_rung - shows the lines of @rung, 0-based, now and when the panel opens. */
void ladder_code_view_set_rung(GtkWidget *view, int rung);

#endif
