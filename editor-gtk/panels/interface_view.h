/* SPDX-License-Identifier: MIT
 *
 * interface_view - what a program or block declares, above its sheet: of a function or block
 * the box as callers see it, and a table of its pins and own variables; of a chart its variables.
 * It can be folded, which is remembered; pins are folded at first on a low screen, variables of
 * charts on any. Above the sheets of other programs it is hidden.
 *
 * Actions: interface.fold, .add-input, .add-output, .add-in-out, .add-local, .add-temp, .delete,
 * .up, .down.
 */
#ifndef EDITOR_INTERFACE_VIEW_H
#define EDITOR_INTERFACE_VIEW_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_INTERFACE_VIEW (ladder_interface_view_get_type())
G_DECLARE_FINAL_TYPE(LadderInterfaceView, ladder_interface_view, LADDER, INTERFACE_VIEW,
		     GtkWidget)

/** ladder_interface_view_new - of the POU that @sheet shows, a LadderCanvas or LadderTextView;
 * F6 goes there. @sheet: stays in the same page, so it lives as long. */
GtkWidget *ladder_interface_view_new(LadderDocument *document, GtkWidget *sheet);

#endif
