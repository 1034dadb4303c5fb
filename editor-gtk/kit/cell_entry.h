/* SPDX-License-Identifier: MIT
 *
 * cell_entry - a line in a table, to be typed in.
 *
 * While nobody types in it, a text that has no room ends with an ellipsis, as that of a
 * label does: `ARRAY[0..99]` would be another type than `ARRAY[0..99] OF DINT`.
 */
#ifndef EDITOR_CELL_ENTRY_H
#define EDITOR_CELL_ENTRY_H

#include <gtk/gtk.h>
#include <stdbool.h>

#define LADDER_TYPE_CELL_ENTRY (ladder_cell_entry_get_type())
G_DECLARE_FINAL_TYPE(LadderCellEntry, ladder_cell_entry, LADDER, CELL_ENTRY, GtkEntry)

/** cell_entry_new - without a frame, of style class field. Undo is not its own: that is the
 * document's, of what was typed before, too. */
GtkWidget *cell_entry_new(void);
/** cell_entry_is_cut - whether its text ends with an ellipsis now. */
bool cell_entry_is_cut(LadderCellEntry *entry);

#endif
