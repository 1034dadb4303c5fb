/* SPDX-License-Identifier: MIT
 *
 * ask - dialogs of a window: a question with two answers, a file chooser.
 */
#ifndef EDITOR_ASK_H
#define EDITOR_ASK_H

#include "editor-gtk/document/document.h"

#include <adwaita.h>

/** ask_new - a dialog with "cancel" and @answer; Enter gives @answer. @body: plain text, or
 * NULL. The caller presents it; it frees itself. */
AdwMessageDialog *ask_new(GtkWindow *window, const char *heading, const char *body,
			  const char *answer, const char *label,
			  AdwResponseAppearance appearance);
/** ask_save - presents the question whether to save @name; the response is "save",
 * "discard" or "cancel". It frees itself. */
AdwMessageDialog *ask_save(GtkWindow *window, const char *name);
/** ask_entry - an entry for a dialog; Enter gives the default answer. @name: its accessible
 * name. */
GtkWidget *ask_entry(const char *name);
/** ask_secret - likewise for a password. */
GtkWidget *ask_secret(const char *name);
/** ask_rung_file - a file chooser for rung files that starts in the folder of @document.
 * The caller shows it and passes its response to ask_take_path(). */
GtkFileChooserNative *ask_rung_file(GtkWindow *window, LadderDocument *document,
				    const char *title, GtkFileChooserAction action,
				    const char *accept);
/** ask_take_path - the chosen path; frees the dialog. NULL: cancelled, or not a local file.
 * Caller frees. */
char *ask_take_path(GtkNativeDialog *dialog, int response);

#endif
