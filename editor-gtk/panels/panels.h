/* SPDX-License-Identifier: MIT
 *
 * panels - the small widgets round the sheets, and what the window asks of them.
 *
 * Each is made for a document and follows it. To go somewhere they do the action
 * "win.go-to" with (pou, rung, row, col), 0-based, -1 for the whole.
 */
#ifndef EDITOR_PANELS_H
#define EDITOR_PANELS_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

/** ladder_project_tree_new - programs, blocks, symbols, files of a project. */
GtkWidget *ladder_project_tree_new(LadderDocument *document);
/** ladder_project_tree_look - at the files beside the project: there may be another. */
void ladder_project_tree_look(GtkWidget *tree);
/** ladder_code_view_new - the instruction list that a program becomes; the one that
 * ladder_code_view_set_pou() says. */
GtkWidget *ladder_code_view_new(LadderDocument *document);
void ladder_code_view_set_pou(GtkWidget *view, int pou);
/** ladder_log_view_new - what happened, with the time: opened, saved, checked. */
GtkWidget *ladder_log_view_new(LadderDocument *document);
/** ladder_log_view_put - a line with the time. @kind: "system", "operator" …, translated. */
void ladder_log_view_put(GtkWidget *view, const char *kind, const char *what);

#endif
