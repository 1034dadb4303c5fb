/* SPDX-License-Identifier: MIT
 *
 * recent - the projects opened or saved last, as the desktop keeps them for all programs.
 *
 * Their order is that of the last time this editor had them, newest first. Others' files,
 * and files beside a project, are none of it.
 */
#ifndef EDITOR_RECENT_H
#define EDITOR_RECENT_H

#include <gtk/gtk.h>

/** recent_add - it is the newest now. @path: absolute; NULL: nothing is done. */
void recent_add(const char *path);
/** recent_paths - of char *, some at most, newest first; what is gone from the disk is left
 * out. Caller: g_ptr_array_unref. */
GPtrArray *recent_paths(void);
/** recent_follow - has a menu "Open recent" at @index of @menu from now on, as long as there
 * is something in it; its rows do win.open-path. */
void recent_follow(GMenu *menu, int index);

#endif
