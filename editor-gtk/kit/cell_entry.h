/* SPDX-License-Identifier: MIT
 *
 * cell_entry - an entry in a cell of a table.
 *
 * Without the focus, a text that is too long ends with an ellipsis as in a label, because
 * `ARRAY[0..99]` would be another type than `ARRAY[0..99] OF DINT`.
 */
#ifndef EDITOR_CELL_ENTRY_H
#define EDITOR_CELL_ENTRY_H

#include <gtk/gtk.h>
#include <stdbool.h>

#define LADDER_TYPE_CELL_ENTRY (ladder_cell_entry_get_type())
G_DECLARE_FINAL_TYPE(LadderCellEntry, ladder_cell_entry, LADDER, CELL_ENTRY, GtkEntry)

/** cell_entry_new - without a frame, with style class "field". It has no undo of its own: the
 * document has. */
GtkWidget *cell_entry_new(void);
/** cell_entry_is_cut - does its text end with an ellipsis now? */
bool cell_entry_is_cut(LadderCellEntry *entry);

#endif
