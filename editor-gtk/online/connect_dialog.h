/* SPDX-License-Identifier: MIT
 *
 * connect_dialog - asks which board to connect to: one of a list that changes as boards come and
 * go, or one that is typed.
 *
 * Signal: chosen (const char *where), good for ladder_board_link_connect(); the dialog closes
 * itself before it.
 */
#ifndef EDITOR_CONNECT_DIALOG_H
#define EDITOR_CONNECT_DIALOG_H

#include <gtk/gtk.h>

#define LADDER_TYPE_CONNECT_DIALOG (ladder_connect_dialog_get_type())
G_DECLARE_FINAL_TYPE(LadderConnectDialog, ladder_connect_dialog, LADDER, CONNECT_DIALOG, GtkWindow)

/** ladder_connect_dialog_new - @last: what the line has at first; NULL: nothing. The caller
 * presents it; it frees itself. */
GtkWidget *ladder_connect_dialog_new(GtkWindow *parent, const char *last);

#endif
