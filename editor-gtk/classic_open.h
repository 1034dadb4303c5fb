/* SPDX-License-Identifier: MIT
 *
 * classic_open - a project of ClassicLadder becomes the text of a new document.
 *
 * The engine converts it; here is what a person is told of that.
 */
#ifndef EDITOR_CLASSIC_OPEN_H
#define EDITOR_CLASSIC_OPEN_H

#include <gio/gio.h>

/** classic_is_project - is there a project of ClassicLadder at @path, file or folder? */
gboolean classic_is_project(const char *path);
/**
 * classic_import - its text as a rung file
 * @told: gets what became of it, a line for each thing; caller frees
 * Owns: the caller, g_free().   Fails: NULL, and @error says why.
 */
char *classic_import(const char *path, gsize *len, char **told, GError **error);
#endif
