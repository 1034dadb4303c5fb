/* SPDX-License-Identifier: MIT
 *
 * project_tree - programs, blocks, types, symbols, tasks and files of a project, with a menu to
 * add, rename and delete.
 *
 * It goes to a row by the action "win.go-to" with (pou, rung, row, col), 0-based, -1: the
 * whole. tree_rows.h makes the rows.
 */
#ifndef EDITOR_PROJECT_TREE_H
#define EDITOR_PROJECT_TREE_H

#include "editor-gtk/sim/sim.h"

#include <gtk/gtk.h>

GtkWidget *ladder_project_tree_new(LadderDocument *document);
/** ladder_project_tree_select - selects the row of POU @pou, else of the file @path, else of
 * another page by its name, " symbols"; -1 and NULL: none. The focus stays. */
void ladder_project_tree_select(GtkWidget *tree, int pou, const char *path, const char *page);
/** ladder_project_tree_set_sim - marks what the board of @sim runs without. @sim: referenced. */
void ladder_project_tree_set_sim(GtkWidget *tree, LadderSim *sim);
/** ladder_project_tree_look - looks for new files beside the project. */
void ladder_project_tree_look(GtkWidget *tree);

#endif
