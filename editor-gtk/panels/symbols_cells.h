/* SPDX-License-Identifier: MIT
 *
 * symbols_cells - cells of the symbol table that can be edited: text, and yes or no.
 * Only symbols_view.c uses it.
 */
#ifndef EDITOR_SYMBOLS_CELLS_H
#define EDITOR_SYMBOLS_CELLS_H

#include "editor-gtk/document/panel.h"
#include "editor-gtk/document/symbols.h"

/* Texts of a row behind its fields, which have their own numbers. */
enum { SYMBOLS_SCOPE = SYMBOL_FIELDS, SYMBOLS_USES };
/* LadderPanelRow.flags. */
enum { SYMBOLS_FIXED = 1, SYMBOLS_MEMBER = 2 };

/**
 * symbols_cells - a factory of cells for one field
 * @set: is told what a person made of it; false: refused, and @why, which the cell shows
 */
GtkListItemFactory *symbols_cells(enum field field,
				  bool (*set)(gpointer owner, LadderPanelRow *row,
					      enum field field, const char *text,
					      char **why),
				  gpointer owner);

#endif
