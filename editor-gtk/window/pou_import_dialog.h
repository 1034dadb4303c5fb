/* SPDX-License-Identifier: MIT
 *
 * pou_import_dialog - asks which programs and blocks of which project come.
 */
#ifndef EDITOR_POU_IMPORT_DIALOG_H
#define EDITOR_POU_IMPORT_DIALOG_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

/** pou_import_ask - asks for a file, then for its POUs, then does it. The result is told by
 * the actions "win.tell" and "win.warn" of @widget. */
void pou_import_ask(GtkWidget *widget, LadderDocument *document);

#endif
