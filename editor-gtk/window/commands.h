/* SPDX-License-Identifier: MIT
 *
 * commands - a dialog that finds a command by name, and the window of all keys.
 */
#ifndef EDITOR_COMMANDS_H
#define EDITOR_COMMANDS_H

#include <gtk/gtk.h>

/** commands_show - opens the dialog; a command is activated as an action of @window. @with: the
 * facts that hold, WITH_… of verbs.h; a command that needs others says so. The rows follow
 * "facts-changed" of @window. */
void commands_show(GtkWindow *window, unsigned with);
/** keys_show - opens the window of all keys. */
void keys_show(GtkWindow *window);

#endif
