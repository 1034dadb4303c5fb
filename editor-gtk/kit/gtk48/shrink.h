/* SPDX-License-Identifier: MIT
 *
 * shrink - buttons that become narrower where there is little room.
 *
 * Mends in GTK 4.8: a button is never narrower than its text, so that a long translation makes
 * the window wider than the screen. GTK 4.12 has gtk_button_set_can_shrink(). To see it: remove
 * the calls and run all_panels of tests/editor/person/below.py.
 */
#ifndef EDITOR_SHRINK_H
#define EDITOR_SHRINK_H

#include <gtk/gtk.h>

/** shrink_buttons - texts of buttons and drop-downs that are @root or below it now may end in an ellipsis;
 * except in popups. */
void shrink_buttons(GtkWidget *root);

#endif
