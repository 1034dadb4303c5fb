/* SPDX-License-Identifier: MIT
 *
 * recent - the projects opened or saved last, from the list that the desktop keeps for all
 * programs.
 *
 * The newest is first, by when this editor used them. Files of other programs and files
 * beside a project are not listed.
 */
#ifndef EDITOR_RECENT_H
#define EDITOR_RECENT_H

#include <gtk/gtk.h>

/** recent_add - makes @path the newest. @path: absolute; NULL: ignored. */
void recent_add(const char *path);
/** recent_paths - of char *, newest first; deleted files are left out. Caller:
 * g_ptr_array_unref(). */
GPtrArray *recent_paths(void);
/** recent_follow - keeps a submenu "Open recent" at @index of @menu while there are
 * projects; its items activate win.open-path. */
void recent_follow(GMenu *menu, int index);

#endif
