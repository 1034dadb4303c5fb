/* SPDX-License-Identifier: MIT
 *
 * ask - questions over a window.
 */
#ifndef EDITOR_ASK_H
#define EDITOR_ASK_H

#include "editor-gtk/document/document.h"

#include <adwaita.h>

/** ask_new - a question with two answers, "cancel" and @answer, which Enter gives. @body:
 * plain text; NULL: none. The caller presents it; it owns itself. */
AdwMessageDialog *ask_new(GtkWindow *window, const char *heading, const char *body,
			  const char *answer, const char *label,
			  AdwResponseAppearance appearance);
/** ask_save - shall the changes of @name be saved? Shown; its response is "save", "discard"
 * or "cancel". It owns itself. */
AdwMessageDialog *ask_save(GtkWindow *window, const char *name);
/** ask_entry - an entry that stands in a question; Enter in it answers the question. @name:
 * as a screen reader says it. */
GtkWidget *ask_entry(const char *name);
/** ask_rung_file - a file dialog for rung files beside @document. The caller shows it; its
 * response is ask_take_path()'s. */
GtkFileChooserNative *ask_rung_file(GtkWindow *window, LadderDocument *document,
				    const char *title, GtkFileChooserAction action,
				    const char *accept);
/** ask_take_path - what a file dialog that answered @response chose; the dialog goes. NULL:
 * no file of this machine. Caller frees. */
char *ask_take_path(GtkNativeDialog *dialog, int response);

#endif
