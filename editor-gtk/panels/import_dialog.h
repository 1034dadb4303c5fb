/* SPDX-License-Identifier: MIT
 *
 * import_dialog - shows what the import of a table of symbols would do, line by line, and
 * does it or not.
 */
#ifndef EDITOR_IMPORT_DIALOG_H
#define EDITOR_IMPORT_DIALOG_H

#include <gtk/gtk.h>

#include "editor-gtk/document/csv.h"

#define LADDER_TYPE_IMPORT_DIALOG (ladder_import_dialog_get_type())
G_DECLARE_FINAL_TYPE(LadderImportDialog, ladder_import_dialog, LADDER, IMPORT_DIALOG, GtkWindow)

/** ladder_import_dialog_new - @plan: taken over; @from: where the table came from.
 * Actions: import.apply (which closes it), import.cancel; Escape cancels. */
GtkWidget *ladder_import_dialog_new(struct csv_plan *plan, const char *from);

#endif
