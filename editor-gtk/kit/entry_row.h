/* SPDX-License-Identifier: MIT
 *
 * entry_row - a candidate of a line, in three columns, as one widget.
 *
 * A list of them is filled at each key; three labels for each would be measured again and
 * again. Columns have bounds; a longer text ends in an ellipsis and is shown by a tooltip.
 */
#ifndef EDITOR_ENTRY_ROW_H
#define EDITOR_ENTRY_ROW_H

#include <gtk/gtk.h>

#define LADDER_TYPE_ENTRY_ROW (ladder_entry_row_get_type())
G_DECLARE_FINAL_TYPE(LadderEntryRow, ladder_entry_row, LADDER, ENTRY_ROW, GtkWidget)

/** ladder_entry_row_new - without texts. */
GtkWidget *ladder_entry_row_new(void);
/** ladder_entry_row_say - sets the texts, which must be valid UTF-8; copied. @mark: stands
 * behind the text in a frame; "": no mark. */
void ladder_entry_row_say(LadderEntryRow *row, const char *text, const char *address,
			  const char *note, const char *mark);

#endif
