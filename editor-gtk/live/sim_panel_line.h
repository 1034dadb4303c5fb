/* SPDX-License-Identifier: MIT
 *
 * sim_panel_line - how the parts of a line of the simulation panel share its width. A name is not cut
 * while the line has room for it: where all parts do not fit side by side, the name stands above the others.
 *
 * It knows no variable; sim_panel_view.c fills the parts.
 */
#ifndef EDITOR_SIM_PANEL_LINE_H
#define EDITOR_SIM_PANEL_LINE_H

#include <gtk/gtk.h>

#define LADDER_TYPE_SIM_LINE (ladder_sim_line_get_type())
G_DECLARE_FINAL_TYPE(LadderSimLine, ladder_sim_line, LADDER, SIM_LINE, GtkWidget)

/* From left to right where there is room for all. */
enum line_part {
	LINE_LEAD,     /* arrow, lamp                                       */
	LINE_ADDRESS,
	LINE_NAME,
	LINE_ABOUT,    /* pin, tag                                          */
	LINE_END,      /* marks, value, switch                              */
	LINE_PARTS
};

/** ladder_sim_line_new - with empty parts. */
GtkWidget *ladder_sim_line_new(void);
/** ladder_sim_line_part - the box of a part; borrowed. */
GtkBox *ladder_sim_line_part(LadderSimLine *line, enum line_part part);
/** ladder_sim_line_begin - it shows another variable now: forgets how wide its value was. */
void ladder_sim_line_begin(LadderSimLine *line);

#endif
