/* SPDX-License-Identifier: MIT
 *
 * panel_cells - editable cells of a panel's list: text, text with a list of choices, yes or
 * no.
 *
 * The owner gives cells their meaning: it sets an edit or refuses it, with a reason that
 * the cell shows. Esc restores the text.
 */
#ifndef EDITOR_PANEL_CELLS_H
#define EDITOR_PANEL_CELLS_H

#include "editor-gtk/document/panel.h"

/* Fields are numbers of LadderPanelRow.text, below 32. Text 0 names the row. */
struct panel_cells {
	GObject *owner;
	unsigned int checks;    /* a bit for each field that is yes ("1") or no ("") */
	unsigned int choosable; /* a bit for each field that has choices       */
	unsigned int completing; /* a bit for each field with choices that are completed while
				    they are typed */
	bool later;             /* the owner makes all rows anew when an edit is set, which is always
				   after the focus has moved: see kit/left.h */
	bool keeps;             /* rows are never made anew: a row with a refused text keeps it,
				   and the reason, as its data "refused" and "why" */
	/* Translated. */
	const char *(*name)(int field);
	/* Sets a field to @text. False: refused; @why (or NULL) says why. */
	bool (*set)(GObject *owner, LadderPanelRow *row, int field, const char *text,
		    char **why);
	/* The text before the edit, to restore it. NULL: the owner restores by itself. */
	void (*given_up)(GObject *owner);
	/* NULL: all rows can be edited. */
	bool (*is_fixed)(const LadderPanelRow *row, int field);
	/* Style of a cell, which shows one row after another. NULL: none. */
	void (*dress)(GtkWidget *cell, const LadderPanelRow *row, int field);
	/* Pairs of a text and its explanation (or ""). Caller: g_ptr_array_unref. */
	GPtrArray *(*choices)(GObject *owner, int field);
	/* Can the text also be made in a form? NULL: none can. */
	bool (*has_form)(const LadderPanelRow *row, int field);
	/* "Array…", translated. */
	const char *(*form_name)(int field);
	/* Opens the form, at @cell; it sets the text by panel_cells_take() or otherwise. */
	void (*open_form)(GObject *owner, LadderPanelRow *row, int field, GtkWidget *cell);
};

/** panel_cells_add - a column of cells of one field. @cells: outlives the list. @flags,
 * @width: as for panel_list_add(). */
void panel_cells_add(struct panel_list *list, const struct panel_cells *cells, int field,
		     unsigned int flags, int width);
/** panel_cells_update - as panel_list_update(); if the row of the focus or the selected row was
 * replaced, the row with its table and name follows. */
void panel_cells_update(struct panel_list *list, GPtrArray *rows);
/** panel_cells_row - the row that a cell shows; NULL: none. Borrowed. */
LadderPanelRow *panel_cells_row(GtkWidget *cell);
/** panel_cells_take - sets the text of a cell as if it had been typed; a refusal is shown in
 * the cell. False: refused. */
bool panel_cells_take(GtkWidget *cell, const char *text);
/** panel_cells_commit - ends the edit in the cell of @view that has the focus. False: it is
 * refused, and the cell shows why. */
bool panel_cells_commit(GtkColumnView *view);
/** panel_cells_focus - focuses the cell of a row (its index) and field. @within: a list, or
 * a parent of one. False: it is not visible. */
bool panel_cells_focus(GtkWidget *within, int row, int field);

#endif
