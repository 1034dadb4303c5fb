/* SPDX-License-Identifier: MIT
 *
 * pou_import_dialog - asks for another project: which of its POUs to import, or where a POU
 * of this project is copied or moved to.
 */
#ifndef EDITOR_POU_IMPORT_DIALOG_H
#define EDITOR_POU_IMPORT_DIALOG_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

/** pou_import_ask - asks for a file and its POUs, and imports them. The result is reported
 * by the actions "win.tell" and "win.warn" of @widget. */
void pou_import_ask(GtkWidget *widget, LadderDocument *document);
/** pou_export_ask - lists what POU @pou needs, asks for a file and copies it there; @moves: and
 * deletes it here, if nothing uses it. Results are reported as above. */
void pou_export_ask(GtkWidget *widget, LadderDocument *document, int pou, bool moves);

#endif
