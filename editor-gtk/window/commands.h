/* SPDX-License-Identifier: MIT
 *
 * commands - all verbs by name: a line to find one, and a window of all keys.
 */
#ifndef EDITOR_COMMANDS_H
#define EDITOR_COMMANDS_H

#include "editor-gtk/window/window.h"

/** commands_show - a dialog in which a verb is found and done. */
void commands_show(LadderWindow *window);
/** keys_show - the window of all keys, by group. */
void keys_show(LadderWindow *window);

#endif
