/* SPDX-License-Identifier: MIT
 *
 * tab_seen - keeps the selected tab in sight when its bar becomes narrower, or its tabs wider.
 *
 * Mends in libadwaita 1.2: AdwTabBar scrolls to a tab when it is selected, not when a panel takes
 * room from the bar; a tab that is cut has no close button. To see it: remove tab_seen_keep(),
 * open tabs until they fill a window of 1024 px, and simulate while the last one still grows;
 * tests/editor/person/looks.py does. When the floor rises, try it without.
 */
#ifndef EDITOR_GTK_TAB_SEEN_H
#define EDITOR_GTK_TAB_SEEN_H

#include <adwaita.h>

/** tab_seen_keep - once for each bar. Without a list of tabs that scrolls, it does nothing. */
void tab_seen_keep(AdwTabBar *bar);

#endif
