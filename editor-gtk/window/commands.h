/* SPDX-License-Identifier: MIT
 *
 * commands - all verbs by name: a line to find one, and a window of all keys.
 */
#ifndef EDITOR_COMMANDS_H
#define EDITOR_COMMANDS_H

#include <gtk/gtk.h>

/** commands_show - a dialog that finds a verb and does its action of @window. */
void commands_show(GtkWindow *window);
/** keys_show - the window of all keys, by group. */
void keys_show(GtkWindow *window);

#endif
