/* SPDX-License-Identifier: MIT
 *
 * interface_view - the interface of the function or block above its sheet: the box as callers
 * see it, and a table of its pins. It can be folded, which is remembered; on a low screen it
 * is folded at first. Above the sheet of a program it is hidden.
 *
 * Actions: interface.fold, .add-input, .add-output, .add-in-out, .delete, .up, .down.
 */
#ifndef EDITOR_INTERFACE_VIEW_H
#define EDITOR_INTERFACE_VIEW_H

#include "editor-gtk/canvas/canvas.h"

#define LADDER_TYPE_INTERFACE_VIEW (ladder_interface_view_get_type())
G_DECLARE_FINAL_TYPE(LadderInterfaceView, ladder_interface_view, LADDER, INTERFACE_VIEW,
		     GtkWidget)

/** ladder_interface_view_new - of the POU that @canvas shows; F6 goes there. @canvas: stays
 * in the same page, so it lives as long. */
GtkWidget *ladder_interface_view_new(LadderDocument *document, LadderCanvas *canvas);

#endif
