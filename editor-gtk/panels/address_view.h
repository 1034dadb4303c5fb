/* SPDX-License-Identifier: MIT
 *
 * address_view - the page of the address map: bytes and their bits, what is free, used, or
 * used by several.
 *
 * A click or Enter on a cell activates win.go-to for its variable, or win.show-uses.
 */
#ifndef EDITOR_ADDRESS_VIEW_H
#define EDITOR_ADDRESS_VIEW_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_ADDRESS_VIEW (ladder_address_view_get_type())
G_DECLARE_FINAL_TYPE(LadderAddressView, ladder_address_view, LADDER, ADDRESS_VIEW, GtkBox)

GtkWidget *ladder_address_view_new(LadderDocument *document);
/** ladder_address_view_enter - gives the first cell the keys. */
void ladder_address_view_enter(LadderAddressView *view);

#endif
