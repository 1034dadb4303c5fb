/* SPDX-License-Identifier: MIT
 *
 * tab_home - keeps tabs in their window: a tab shows one project, with its undo, its problems
 * and its simulation.
 *
 * Mends in libadwaita 1.2: AdwTabBar accepts tabs that are dragged from other windows, and
 * makes a window for a tab that is dropped outside. To see it: remove tab_home_make() and
 * drag a tab from one window to another; tests/editor/person/windows.py does. When the floor
 * rises, look for a property of AdwTabView or AdwTabBar that forbids it.
 */
#ifndef EDITOR_GTK_TAB_HOME_H
#define EDITOR_GTK_TAB_HOME_H

#include <adwaita.h>

/** tab_home_make - @bar accepts only tabs of its own view, to reorder them. Once for each bar. */
void tab_home_make(AdwTabBar *bar);

#endif
