/* SPDX-License-Identifier: MIT
 *
 * type_cells - the cells of a declaration that need more than a line: its type, with choices
 * and a form for arrays, and the initial value of something with parts.
 *
 * Lists of symbols and of members share them. The fields are those of symbols.h.
 */
#ifndef EDITOR_TYPE_CELLS_H
#define EDITOR_TYPE_CELLS_H

#include "editor-gtk/document/panel_cells.h"

/* In LadderPanelRow.flags: its initial value has parts. */
#define TYPE_CELLS_PARTS (1u << 16)

/** type_cells_join - adds the choices and forms to @cells of a list of declarations. */
void type_cells_join(struct panel_cells *cells);
/** type_cells_flags - TYPE_CELLS_PARTS, or 0, of variable @index of a table. */
unsigned int type_cells_flags(LadderDocument *document, int table, int index);
/** type_cells_choices - the types that a variable can have, or a @member of a structure: pairs
 * of a type and its description. Caller: g_ptr_array_unref. */
GPtrArray *type_cells_choices(LadderDocument *document, bool member);
/** type_cells_open - the form of a field, at @cell. */
void type_cells_open(LadderDocument *document, LadderPanelRow *row, int field,
		     GtkWidget *cell);

#endif
