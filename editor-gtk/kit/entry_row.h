/* SPDX-License-Identifier: MIT
 *
 * entry_row - what a candidate of a line says, in three columns, as one widget.
 *
 * A list of them is filled at each key: three labels each would be measured again and
 * again. It is as wide as its texts within bounds; what is longer ends in an ellipsis and
 * is told by its tooltip.
 */
#ifndef EDITOR_ENTRY_ROW_H
#define EDITOR_ENTRY_ROW_H

#include <gtk/gtk.h>

#define LADDER_TYPE_ENTRY_ROW (ladder_entry_row_get_type())
G_DECLARE_FINAL_TYPE(LadderEntryRow, ladder_entry_row, LADDER, ENTRY_ROW, GtkWidget)

/** ladder_entry_row_new - it says nothing yet. */
GtkWidget *ladder_entry_row_new(void);
/** ladder_entry_row_say - copies the texts, which are valid UTF-8. */
void ladder_entry_row_say(LadderEntryRow *row, const char *text, const char *address,
			  const char *note);

#endif
