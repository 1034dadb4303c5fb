/* SPDX-License-Identifier: MIT
 *
 * sim_panel_inside - what the files of the simulation panel share. Only editor-gtk/sim_panel*.c
 * include it.
 */
#ifndef EDITOR_SIM_PANEL_INSIDE_H
#define EDITOR_SIM_PANEL_INSIDE_H

#include "editor-gtk/live/sim_panel.h"
#include "editor-gtk/live/sim_panel_view.h"

struct _LadderSimPanel {
	GtkWidget parent;
	LadderSim *sim;
	GPtrArray *rows;          /* all, of LadderSimRow                       */
	GListStore *store;        /* those that stand there, and headings       */
	GtkSingleSelection *selection;
	GPtrArray *views;         /* widgets that show one; borrowed            */
	guint behind;             /* so many of them are looked at later         */
	guint behind_timer;
	bool again;               /* there was something new meanwhile          */
	char *wanted;             /* never NULL                                 */
	GHashTable *folded;       /* sections that are, sim_row_section()        */
	bool on;
	LadderSimRow *held;       /* by the space bar                           */
	GPtrArray *bound;         /* lines that keys of their own hold, struct held */
	GtkEventController *root_keys; /* of `root`; borrowed                   */
	GtkRoot *root;            /* it stands in; NULL: none                   */
	gulong root_active;
	guint last_code;          /* of the key that is down; 0: none           */
	GtkWidget *menu;          /* NULL: none yet                             */
	GtkWidget *asking;        /* for a key or a range; NULL: nothing        */
	GtkWidget *stack, *found, *search, *list;
};

/* ---- sim_panel.c ---- */
/** sim_panel_view_of - the widget of a line; NULL: none shows it. Borrowed. */
LadderSimRowView *sim_panel_view_of(LadderSimPanel *panel, const LadderSimRow *row);
/** sim_panel_selected - NULL: no line is, or a heading. Borrowed. */
LadderSimRow *sim_panel_selected(LadderSimPanel *panel);
/** sim_panel_read_choices - as the document keeps them now. */
void sim_panel_read_choices(LadderSimPanel *panel);

/* ---- sim_panel_keys.c ---- */
void sim_panel_install_keys(GtkWidgetClass *class);
void sim_panel_begin_keys(LadderSimPanel *panel);
void sim_panel_end_keys(LadderSimPanel *panel);
/** sim_panel_let_go - of a push button that a key holds. */
void sim_panel_let_go(LadderSimPanel *panel);

/* ---- sim_panel_bound.c: keys that are bound to a line, wherever the focus is ---- */
void sim_panel_bind_root(LadderSimPanel *panel, GtkRoot *root);
void sim_panel_unbind_root(LadderSimPanel *panel);
/** sim_panel_let_go_bound - of all that such keys hold. */
void sim_panel_let_go_bound(LadderSimPanel *panel);
/** sim_panel_can_bind - letters, digits, function keys, the keypad. */
bool sim_panel_can_bind(guint key);

/* ---- sim_panel_choose.c: what a person chooses for a line ---- */
void sim_panel_install_choices(GtkWidgetClass *class);
/** sim_panel_choices - what can be chosen for a line, for its menu. Caller unrefs. */
GMenuModel *sim_panel_choices(LadderSimPanel *panel, const LadderSimRow *row);
void sim_panel_end_asking(LadderSimPanel *panel);

#endif
