/* SPDX-License-Identifier: MIT
 *
 * task_delete - deletes a task, or takes a program out of one; asks first if programs of the
 * task then run in each scan.
 */
#ifndef EDITOR_TASK_DELETE_H
#define EDITOR_TASK_DELETE_H

#include <gtk/gtk.h>

#include "editor-gtk/document/task_rows.h"

/**
 * task_delete_ask - deletes a row, at once or after the question
 * @window: of the question
 * @name: of the row; it is looked up again after the answer
 * @done: gets the outcome: whether it was deleted, else @why, translated, which it frees. Not
 *        called if the answer is "cancel".
 * @data: referenced until then
 */
void task_delete_ask(GtkWindow *window, LadderDocument *document, enum task_what what,
		     const char *name, void (*done)(gpointer data, bool good, char *why),
		     GObject *data);

#endif
