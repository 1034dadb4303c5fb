/* SPDX-License-Identifier: MIT
 *
 * sim_panel_view_inside - what the files of a line of the simulation panel share.
 */
#ifndef EDITOR_SIM_PANEL_VIEW_INSIDE_H
#define EDITOR_SIM_PANEL_VIEW_INSIDE_H

#include "editor-gtk/live/sim_panel_view.h"

#include <math.h>

struct _LadderSimRowView {
	GtkWidget parent;
	LadderSim *sim;          /* borrowed                                    */
	GtkListItem *item;       /* likewise                                    */
	LadderSimRow *row;       /* NULL: none                                  */
	LadderSimRow *held;      /* pressed with the pointer                    */
	/* What is shown now. */
	bool known, forced;
	union iec_value last[3]; /* value, preset, done                         */
	GString *text;           /* of a STRING; NULL: none yet                 */
	bool telling;            /* a change of a widget is no person's         */
	double sent;             /* by the slider                               */
	int waiting;             /* so many looks more until that must be shown */
	GtkWidget *heading, *arrow, *title, *where;
	GtkWidget *line, *lamp, *address, *name, *pin, *tag, *badge, *value, *toggle, *push;
	GtkWidget *entry;        /* NULL: none yet                              */
	enum sim_edit editing;
	GtkWidget *bar, *scale;
};

/* ---- sim_panel_edit.c ---- */
/** sim_view_can_edit - a click on the value opens the field. */
void sim_view_can_edit(LadderSimRowView *view);
/** sim_view_end_edit - the field goes, whatever was typed. */
void sim_view_end_edit(LadderSimRowView *view);

#endif
