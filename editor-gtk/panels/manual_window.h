/* SPDX-License-Identifier: MIT
 *
 * manual_window - a window with the pages of the manual: contents and search at the left,
 * the page at the right, back and forward, find in the page.
 *
 * Actions: manual.back, manual.forward, manual.find, manual.search, manual.next,
 * manual.previous (of the matches in the page).
 */
#ifndef EDITOR_MANUAL_WINDOW_H
#define EDITOR_MANUAL_WINDOW_H

#include "editor-gtk/document/manual.h"

#include <adwaita.h>

#define LADDER_TYPE_MANUAL_WINDOW (ladder_manual_window_get_type())
G_DECLARE_FINAL_TYPE(LadderManualWindow, ladder_manual_window, LADDER, MANUAL_WINDOW, AdwWindow)

/** ladder_manual_window_new - takes @manual. The caller presents it; it frees itself. */
GtkWidget *ladder_manual_window_new(struct manual *manual);
/** ladder_manual_window_manual - borrowed. */
struct manual *ladder_manual_window_manual(LadderManualWindow *window);
/** ladder_manual_window_show - a block of a page at the top; -1: the page from its begin. */
void ladder_manual_window_show(LadderManualWindow *window, int page, int block);

#endif
