/* SPDX-License-Identifier: MIT
 *
 * preferences - what a person chooses once: light or dark, colour of power, names, keys.
 *
 * All of it is kept in the settings, and holds at once in all windows.
 */
#ifndef EDITOR_PREFERENCES_H
#define EDITOR_PREFERENCES_H

#include <adwaita.h>

/** preferences_follow - what was chosen holds, now and when it changes; once a start. */
void preferences_follow(AdwApplication *application);
/** preferences_show - asks. */
void preferences_show(GtkWindow *window);

#endif
