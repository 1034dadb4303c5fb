/* SPDX-License-Identifier: MIT
 *
 * types_view - the page of data types: one type, edited in place: a structure with its members, an
 * enumeration with its values, a subrange, an array, another name of a type.
 *
 * Actions of the window that it activates: win.new_type, and with the name of the type
 * win.rename-type, win.duplicate-type, win.delete-type, win.show-uses.
 * Its own: types.add, types.delete, types.up, types.down for members and values.
 */
#ifndef EDITOR_TYPES_VIEW_H
#define EDITOR_TYPES_VIEW_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_TYPES_VIEW (ladder_types_view_get_type())
G_DECLARE_FINAL_TYPE(LadderTypesView, ladder_types_view, LADDER, TYPES_VIEW, GtkBox)

GtkWidget *ladder_types_view_new(LadderDocument *document);
/** ladder_types_view_show - shows a type by its number (type_edit.h); -1: the one it shows. */
void ladder_types_view_show(LadderTypesView *view, int type);
/** ladder_types_view_enter - gives the first member, value or field the keys. */
void ladder_types_view_enter(LadderTypesView *view);
/** ladder_types_view_enter_value - gives the value of this name the keys. */
void ladder_types_view_enter_value(LadderTypesView *view, const char *name);

#endif
