/* SPDX-License-Identifier: MIT
 *
 * classic - a project of ClassicLadder becomes the text of a new document, and a document is
 * written as one, as `ladder export` does.
 *
 * The engine converts. What was opened is kept, so that each rung can be shown as it was
 * (classic_origin.h). What is written leaves the document as it is.
 */
#ifndef EDITOR_CLASSIC_H
#define EDITOR_CLASSIC_H

#include "editor-gtk/document/document.h"

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

/** classic_save_is - has @path the ending of a project of ClassicLadder? */
gboolean classic_save_is(const char *path);
/**
 * classic_save - writes it: .clprj, .clprjz packed, .clp for LinuxCNC, .txt bare rungs
 * @lines: gets what was changed, or refused (struct left_line)
 *
 * The file is the old one or the new one. Fails: false: nothing was written, and @error
 * says why, or @lines do.
 */
gboolean classic_save(LadderDocument *document, const char *path, GPtrArray *lines,
		      GError **error);

#endif
