/* SPDX-License-Identifier: MIT
 *
 * line_values - the values of an instruction list while it is simulated: a column at the right
 * edge of the text, with the value of the operand of each line at the scan that is shown.
 *
 * Only the lines on the screen are looked at. It changes nothing; the column is hidden while
 * nothing is simulated.
 */
#ifndef EDITOR_LINE_VALUES_H
#define EDITOR_LINE_VALUES_H

#include "editor-gtk/sim/sim.h"

#include <gtksourceview/gtksource.h>

#define LADDER_TYPE_LINE_VALUES (ladder_line_values_get_type())
G_DECLARE_FINAL_TYPE(LadderLineValues, ladder_line_values, LADDER, LINE_VALUES,
		     GtkSourceGutterRendererText)

/** line_values_add - the column of @view. @sim: referenced. Borrowed: lives with @view. */
LadderLineValues *line_values_add(GtkSourceView *view, LadderSim *sim);
/** line_values_set_pou - the POU whose list is shown; "": none. */
void line_values_set_pou(LadderLineValues *values, const char *pou);
/** line_values_text - of a line, from 0: "3.2 s / 5 s"; NULL: none. Borrowed until the list,
 * the program or the scan changes. */
const char *line_values_text(LadderLineValues *values, int line);

#endif
