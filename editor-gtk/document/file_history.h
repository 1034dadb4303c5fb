/* SPDX-License-Identifier: MIT
 *
 * file_history - what is done to a text file beside a document becomes steps of the
 * document's history. It shows nothing and saves nothing.
 */
#ifndef EDITOR_FILE_HISTORY_H
#define EDITOR_FILE_HISTORY_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

struct file_history;

/**
 * file_history_new - of @buffer as it is now
 * @name: of the file, for "Change pump.io"
 * @undone: told when a step was undone or done again, with the text then
 *
 * Keeps @document alive and has @buffer borrowed until file_history_free().
 */
struct file_history *file_history_new(GtkTextBuffer *buffer, LadderDocument *document,
				      const char *name,
				      void (*undone)(gpointer data, const char *text),
				      gpointer data);
/** file_history_saved - it can be undone to what stands there now. */
void file_history_saved(struct file_history *history);
/** file_history_free - its steps are forgotten. NULL: nothing. */
void file_history_free(struct file_history *history);

#endif
