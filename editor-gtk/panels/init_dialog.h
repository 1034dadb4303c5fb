/* SPDX-License-Identifier: MIT
 *
 * init_dialog - a dialog with the initial values of an array, a structure or an instance as
 * a tree. It sets them in one step of the history.
 */
#ifndef EDITOR_INIT_DIALOG_H
#define EDITOR_INIT_DIALOG_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

/** init_dialog_open - for the variable @name of a table of xref/xref.h. @from: a widget of
 * the window that opens it; it gets the focus back. Tells by "win.tell" why there is no form. */
void init_dialog_open(GtkWidget *from, LadderDocument *document, int table, const char *name);

#endif
