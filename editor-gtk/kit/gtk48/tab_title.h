/* SPDX-License-Identifier: MIT
 *
 * tab_title - a title that is wider than its tab ends in an ellipsis.
 *
 * Mends in libadwaita 1.2: AdwTab fades a long title out with a shader. Where GTK draws without OpenGL there
 * are no shaders, and the title is cut in the middle of a letter. To see it: remove tab_titles_mend(), and open
 * Data types and Print preview in French in a window of 1024 px, with GSK_RENDERER=cairo;
 * tests/editor/kit/gtk48/test_tab_title.c. When the floor rises, try it without.
 */
#ifndef EDITOR_GTK48_TAB_TITLE_H
#define EDITOR_GTK48_TAB_TITLE_H

#include <adwaita.h>

/** tab_titles_mend - once for each bar. Without labels that fade, it does nothing. */
void tab_titles_mend(AdwTabBar *bar);

#endif
