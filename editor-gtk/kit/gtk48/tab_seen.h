/* SPDX-License-Identifier: MIT
 *
 * tab_seen - keeps the selected tab in sight when its bar becomes narrower.
 *
 * Mends in libadwaita 1.2: AdwTabBar scrolls to a tab when it is selected, not when a panel takes
 * room from the bar; a tab that is cut has no close button. To see it: remove tab_seen_keep(),
 * open tabs until they fill a window of 1024 px, select the last one and simulate;
 * tests/editor/person/panes.py does. When the floor rises, try it without.
 */
#ifndef EDITOR_GTK_TAB_SEEN_H
#define EDITOR_GTK_TAB_SEEN_H

#include <adwaita.h>

/** tab_seen_keep - once for each bar. Without a list of tabs that scrolls, it does nothing. */
void tab_seen_keep(AdwTabBar *bar);

#endif
