/* SPDX-License-Identifier: MIT
 *
 * types_view - the page of data types: one structure with its members, edited in place.
 *
 * Actions of the window that it activates: win.new_structure, and with the name of the
 * structure win.rename-type, win.duplicate-type, win.delete-type, win.show-uses.
 * Its own: types.add, types.delete, types.up, types.down for members.
 */
#ifndef EDITOR_TYPES_VIEW_H
#define EDITOR_TYPES_VIEW_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_TYPES_VIEW (ladder_types_view_get_type())
G_DECLARE_FINAL_TYPE(LadderTypesView, ladder_types_view, LADDER, TYPES_VIEW, GtkBox)

GtkWidget *ladder_types_view_new(LadderDocument *document);
/** ladder_types_view_show - shows a structure by its number; -1: the one it shows. */
void ladder_types_view_show(LadderTypesView *view, int structure);
/** ladder_types_view_enter - gives the first member the keys. */
void ladder_types_view_enter(LadderTypesView *view);

#endif
