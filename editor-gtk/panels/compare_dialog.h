/* SPDX-License-Identifier: MIT
 *
 * compare_dialog - asks which version the document is compared with: as saved, another file,
 * a revision in git.
 *
 * Signals: "saved" (), "file" (), "files" (): two others, "revision" (hash, name of the file then, name
 * for a person). The dialog closes before.
 */
#ifndef EDITOR_COMPARE_DIALOG_H
#define EDITOR_COMPARE_DIALOG_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_COMPARE_DIALOG (ladder_compare_dialog_get_type())
G_DECLARE_FINAL_TYPE(LadderCompareDialog, ladder_compare_dialog, LADDER, COMPARE_DIALOG,
		     GtkWindow)

/** ladder_compare_dialog_new - the caller presents it; it frees itself. */
GtkWidget *ladder_compare_dialog_new(GtkWindow *parent, LadderDocument *document);

#endif
