/* SPDX-License-Identifier: MIT
 *
 * preferences - light or dark, colour of power, names, keys, simulation.
 *
 * All are GSettings; a change applies to all windows at once.
 */
#ifndef EDITOR_PREFERENCES_H
#define EDITOR_PREFERENCES_H

#include <adwaita.h>

/** preferences_follow - applies the settings, now and whenever they change; call it once. */
void preferences_follow(AdwApplication *application);
/** preferences_show - opens the dialog. */
void preferences_show(GtkWindow *window);

#endif
