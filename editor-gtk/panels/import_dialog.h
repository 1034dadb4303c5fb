/* SPDX-License-Identifier: MIT
 *
 * import_dialog - lists what an import of symbols would change, and does it after a click.
 */
#ifndef EDITOR_IMPORT_DIALOG_H
#define EDITOR_IMPORT_DIALOG_H

#include <gtk/gtk.h>

#include "editor-gtk/document/csv.h"

#define LADDER_TYPE_IMPORT_DIALOG (ladder_import_dialog_get_type())
G_DECLARE_FINAL_TYPE(LadderImportDialog, ladder_import_dialog, LADDER, IMPORT_DIALOG, GtkWindow)

/** ladder_import_dialog_new - @plan: taken over; @from: file name, for the title. Actions:
 * import.apply (also closes it), import.cancel; Enter imports, Escape cancels. */
GtkWidget *ladder_import_dialog_new(struct csv_plan *plan, const char *from);

#endif
