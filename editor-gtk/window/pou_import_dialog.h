/* SPDX-License-Identifier: MIT
 *
 * pou_import_dialog - asks for another project and which of its POUs to import.
 */
#ifndef EDITOR_POU_IMPORT_DIALOG_H
#define EDITOR_POU_IMPORT_DIALOG_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

/** pou_import_ask - asks for a file and its POUs, and imports them. The result is reported
 * by the actions "win.tell" and "win.warn" of @widget. */
void pou_import_ask(GtkWidget *widget, LadderDocument *document);

#endif
