/* SPDX-License-Identifier: MIT
 *
 * iomap_cells - cells of the table of an I/O map that can be edited: text, text with a list
 * of what there is, yes or no. Only iomap_view.c uses it.
 */
#ifndef EDITOR_IOMAP_CELLS_H
#define EDITOR_IOMAP_CELLS_H

#include "editor-gtk/document/iomap_text.h"
#include "editor-gtk/document/panel.h"

/* Texts of a row behind its fields, which have their own numbers. */
enum { IOMAP_SYMBOL = IO_FIELDS, IOMAP_STATE };

/* What the cells ask of the table. */
struct iomap_cells {
	gpointer owner;
	/* A person made this of a cell; false: refused, and @why. */
	bool (*set)(gpointer owner, const LadderPanelRow *row, enum io_field field,
		    const char *text, char **why);
	/* What was refused in a cell is given up: it is as it was. */
	void (*given_up)(gpointer owner);
	/* A cell of this row has the focus now. */
	void (*entered)(gpointer owner, const LadderPanelRow *row);
	/* What could stand there: pairs of a text and what is said of it (or ""). Caller:
	 * g_ptr_array_unref. */
	GPtrArray *(*choices)(gpointer owner, const LadderPanelRow *row,
			      enum io_field field);
};

/** iomap_cells - a factory of cells for one field; @cells outlives it. */
GtkListItemFactory *iomap_cells(enum io_field field, const struct iomap_cells *cells);
/** iomap_cells_commit - what stands in the cell with the focus is done now. */
void iomap_cells_commit(GtkWidget *within);
/** iomap_cells_place - of the cell with the focus, LadderPanelRow.index and field; false:
 * none has it. iomap_cells_focus - gives it back; false: it is not to be seen. */
bool iomap_cells_place(GtkWidget *within, int *row, enum io_field *field);
bool iomap_cells_focus(GtkWidget *within, int row, enum io_field field);
/** io_field_name - of a column, translated. */
const char *io_field_name(enum io_field field);

#endif
