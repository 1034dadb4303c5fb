/* SPDX-License-Identifier: MIT
 *
 * panel_cells - cells of a panel's list that can be edited: text, text with a list of
 * choices, yes or no.
 *
 * What a cell means is the owner's: an edit is set by it, or refused with a reason that the
 * cell shows. Esc gives an edit up.
 */
#ifndef EDITOR_PANEL_CELLS_H
#define EDITOR_PANEL_CELLS_H

#include "editor-gtk/document/panel.h"

/* Fields are numbers of LadderPanelRow.text, below 32. Text 0 names the row. */
struct panel_cells {
	GObject *owner;
	unsigned int checks;    /* a bit for each field that is yes ("1") or no ("") */
	unsigned int choosable; /* a bit for each field that has choices       */
	bool later;             /* set when the keys have gone where they go: the owner makes
				   all rows anew                               */
	/* Translated. */
	const char *(*name)(int field);
	/* A person made @text of a field. False: refused; @why (or NULL) says why. */
	bool (*set)(GObject *owner, LadderPanelRow *row, int field, const char *text,
		    char **why);
	/* A cell shows what it had before the edit. NULL: then that is set again if the edit
	 * was refused. */
	void (*given_up)(GObject *owner);
	/* NULL: all can be edited. */
	bool (*is_fixed)(const LadderPanelRow *row, int field);
	/* Pairs of a text and what is said of it (or ""). Caller: g_ptr_array_unref. */
	GPtrArray *(*choices)(GObject *owner, int field);
};

/** panel_cells_add - a column of cells of one field. @cells: outlives the list. @flags,
 * @width: as of panel_list_add(). */
void panel_cells_add(struct panel_list *list, const struct panel_cells *cells, int field,
		     unsigned int flags, int width);
/** panel_cells_commit - the edit in the cell of @view that has the focus is done now. */
void panel_cells_commit(GtkColumnView *view);
/** panel_cells_focus - the cell of a row (its index) and field gets the focus. @within: a list,
 * or what has one in it. False: it is not to be seen. */
bool panel_cells_focus(GtkWidget *within, int row, int field);

#endif
