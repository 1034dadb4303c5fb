/* SPDX-License-Identifier: MIT
 *
 * tab_home - keeps tabs in their bar: a tab shows a sheet of one project, with its undo, its
 * problems and its simulation.
 *
 * Mends in libadwaita 1.2: a tab that is dragged out of its AdwTabBar leaves its view, other
 * windows take it, and a window is made for it when it is dropped outside. The program ends
 * when the drag cannot begin, because something else holds the pointer. A tab that is dragged
 * while a key closes pages is put at a place behind the last one. To see it: remove
 * tab_home_make() and drag a tab down; tests/editor/person/windows.py does. When the floor
 * rises, look for a property of AdwTabView or AdwTabBar that forbids it.
 */
#ifndef EDITOR_GTK_TAB_HOME_H
#define EDITOR_GTK_TAB_HOME_H

#include <adwaita.h>

/** tab_home_make - a tab of @bar is dragged only along it, to reorder, and the drag ends
 * when a page closes. Once for each bar, which has its view. */
void tab_home_make(AdwTabBar *bar);

#endif
