/* SPDX-License-Identifier: MIT
 *
 * sim_panel_inside - what the files of the simulation panel share. Only editor-gtk/sim_panel*.c
 * include it.
 */
#ifndef EDITOR_SIM_PANEL_INSIDE_H
#define EDITOR_SIM_PANEL_INSIDE_H

#include "editor-gtk/sim_panel.h"
#include "editor-gtk/sim_panel_view.h"

struct _LadderSimPanel {
	GtkWidget parent;
	LadderSim *sim;
	GPtrArray *rows;          /* all, of LadderSimRow                       */
	GListStore *store;        /* those that stand there, and headings       */
	GtkSingleSelection *selection;
	GPtrArray *views;         /* widgets that show one; borrowed            */
	char *wanted;             /* never NULL                                 */
	bool folded[SIM_GROUPS];
	bool on;
	LadderSimRow *held;       /* by the space bar                           */
	GtkWidget *menu;          /* NULL: none yet                             */
	GtkWidget *stack, *found, *search, *list;
};

/* ---- sim_panel.c ---- */
/** sim_panel_view_of - the widget of a line; NULL: none shows it. Borrowed. */
LadderSimRowView *sim_panel_view_of(LadderSimPanel *panel, const LadderSimRow *row);

/* ---- sim_panel_keys.c ---- */
void sim_panel_install_keys(GtkWidgetClass *class);
void sim_panel_begin_keys(LadderSimPanel *panel);
void sim_panel_end_keys(LadderSimPanel *panel);
/** sim_panel_let_go - of a push button that a key holds. */
void sim_panel_let_go(LadderSimPanel *panel);

#endif
