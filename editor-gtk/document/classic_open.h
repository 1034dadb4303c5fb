/* SPDX-License-Identifier: MIT
 *
 * classic_open - a project of ClassicLadder becomes the text of a new document.
 *
 * The engine converts it; what it was is kept, so that each rung can be shown as it was
 * (classic_origin.h).
 */
#ifndef EDITOR_CLASSIC_OPEN_H
#define EDITOR_CLASSIC_OPEN_H

#include <gio/gio.h>

#include "engine/ladder.h"

/** classic_is_project - is there a project of ClassicLadder at @path, file or folder? */
gboolean classic_is_project(const char *path);
/**
 * classic_import - its text as a rung file
 * @path:   must live as long as *@from
 * @from:   gets what has loaded it; the caller's, ladder_free()
 *
 * Owns: the caller, g_free().   Fails: NULL, *@from is NULL, and @error says why.
 */
char *classic_import(const char *path, gsize *len, struct ladder **from, GError **error);
#endif
