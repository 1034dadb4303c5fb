/* SPDX-License-Identifier: MIT
 *
 * sim_bar - the simulation in the window: its switch, its buttons, the subtitle, the panel
 * at the right.
 *
 * Sheets and panels show values by themselves.
 */
#ifndef EDITOR_SIM_BAR_H
#define EDITOR_SIM_BAR_H

#include "editor-gtk/kit/verbs.h"
#include "editor-gtk/window/origin.h"

struct sim_bar {
	struct core *core;
	struct origin *origin;
	GtkBox *right, *buttons;
	GtkWidget *side;        /* the left side of the window                   */
	bool board;             /* the values of a board are shown               */
	bool side_hidden;       /* while this simulates, for want of room         */
	GtkToggleButton *edit_mode, *simulate_mode;
	GtkButton *run_button, *forces_button;
	GtkMenuButton *pace_button;
	AdwWindowTitle *title;
	int refused;            /* errors that the banner reports                */
	guint when_timer;      /* updates the subtitle when it elapses; 0: none */
};

void sim_bar_init(struct sim_bar *bar, struct core *core, struct origin *origin);
void sim_bar_clear(struct sim_bar *bar);
/** sim_bar_show_panel - shows the panel at the right. */
void sim_bar_show_panel(struct sim_bar *bar);
/** sim_bar_do - does a command of the simulation; false: @verb is none. */
bool sim_bar_do(struct sim_bar *bar, enum verb verb);

#endif
