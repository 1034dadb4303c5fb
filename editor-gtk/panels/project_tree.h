/* SPDX-License-Identifier: MIT
 *
 * project_tree - programs, blocks, symbols and files of a project.
 *
 * To go somewhere it does the action "win.go-to" with (pou, rung, row, col), 0-based, -1 for
 * the whole.
 */
#ifndef EDITOR_PROJECT_TREE_H
#define EDITOR_PROJECT_TREE_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

GtkWidget *ladder_project_tree_new(LadderDocument *document);
/** ladder_project_tree_look - at the files beside the project: there may be another. */
void ladder_project_tree_look(GtkWidget *tree);

#endif
