/* SPDX-License-Identifier: MIT
 *
 * classic - opens a ClassicLadder project as the text of a new document, and writes a
 * document as one, as `ladder export` does.
 *
 * The engine converts. classic_origin.h keeps the original, so that each rung can be shown
 * as it was.
 */
#ifndef EDITOR_CLASSIC_H
#define EDITOR_CLASSIC_H

#include "editor-gtk/document/document.h"

/** classic_is_project - is the file or folder @path a project of ClassicLadder, or of another tool
 * that the engine imports? */
gboolean classic_is_project(const char *path);
/**
 * classic_import - such a project as the text of a rung file
 * @path:   must live as long as *@from
 * @from:   gets the engine that loaded it; caller: ladder_free()
 *
 * Owns: the caller, g_free().   Fails: NULL, *@from is NULL, and @error says why.
 */
char *classic_import(const char *path, gsize *len, struct ladder **from, GError **error);

/** classic_save_is - does @path end like a ClassicLadder project? */
gboolean classic_save_is(const char *path);
/**
 * classic_save - writes it: .clprj, .clprjz packed, .clp for LinuxCNC, .txt bare rungs
 * @lines: gets what was changed or refused (struct left_line)
 *
 * An interrupted save leaves the old file or the new one. Fails: false: nothing was
 * written, and @error or @lines say why.
 */
gboolean classic_save(LadderDocument *document, const char *path, GPtrArray *lines,
		      GError **error);

#endif
