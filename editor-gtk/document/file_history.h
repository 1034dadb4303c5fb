/* SPDX-License-Identifier: MIT
 *
 * file_history - makes edits of a text file beside a document steps of the document's
 * history. It shows nothing and saves nothing.
 */
#ifndef EDITOR_FILE_HISTORY_H
#define EDITOR_FILE_HISTORY_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

struct file_history;

/**
 * file_history_new - for @buffer as it is now
 * @path: of the file, whose name stands in "Change pump.io"
 * @part: an INCLUDE of the document reads the present text
 * @undone: called when a step was undone or redone, with the new text
 *
 * Keeps @document alive and has @buffer borrowed until file_history_free().
 */
struct file_history *file_history_new(GtkTextBuffer *buffer, LadderDocument *document,
				      const char *path, bool part,
				      void (*undone)(gpointer data, const char *text),
				      gpointer data);
/** file_history_saved - keeps the present text reachable by undo: later edits are new
 * steps. */
void file_history_saved(struct file_history *history);
/** file_history_free - forgets its steps. NULL is allowed. */
void file_history_free(struct file_history *history);

#endif
