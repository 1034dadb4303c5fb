/* SPDX-License-Identifier: MIT
 *
 * revision - a project as it was in a revision of git: its file, the files that it names, and its
 * I/O map, all of that revision. Nothing waits: the result comes from the main loop.
 */
#ifndef EDITOR_REVISION_H
#define EDITOR_REVISION_H

#include <gio/gio.h>

#include "editor-gtk/document/comparison.h"

/** revision_take - @side: its texts are taken over; NULL: @why (translated, borrowed) says why it
 * cannot be read. A named file that the revision does not have is an error of the project. */
typedef void revision_take(gpointer data, struct compare_side *side, const char *why);
/**
 * revision_read - reads a revision
 * @path: of the project now; @hash, @name: as in struct git_revision
 * @title: the name of the side
 *
 * @take is not called after @cancel was cancelled.
 */
void revision_read(const char *path, const char *hash, const char *name, const char *title,
		   GCancellable *cancel, revision_take *take, gpointer data);

#endif
