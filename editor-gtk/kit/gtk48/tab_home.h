/* SPDX-License-Identifier: MIT
 *
 * tab_home - a tab stays in its window: what it shows is of that project, and so are
 * its undo, its problems and its simulation. AdwTabBar takes those of other windows, too.
 */
#ifndef EDITOR_GTK_TAB_HOME_H
#define EDITOR_GTK_TAB_HOME_H

#include <adwaita.h>

/** tab_home_make - @bar takes no tab that is not one of its own view; its own may be put in
 * another order. Once for each bar. */
void tab_home_make(AdwTabBar *bar);

#endif
