/* SPDX-License-Identifier: MIT
 *
 * classic_save - a document is written as a project of ClassicLadder, as `ladder export`
 * does. The document stays what it is.
 */
#ifndef EDITOR_CLASSIC_SAVE_H
#define EDITOR_CLASSIC_SAVE_H

#include "editor-gtk/document/document.h"

/** classic_save_is - does the name say that a project of ClassicLadder is meant? */
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
