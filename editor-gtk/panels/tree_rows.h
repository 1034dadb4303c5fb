/* SPDX-License-Identifier: MIT
 *
 * tree_rows - the rows of the project tree: what they are of, and how they are made.
 *
 * What a person does with them is project_tree.c's.
 */
#ifndef EDITOR_TREE_ROWS_H
#define EDITOR_TREE_ROWS_H

#include "editor-gtk/document/document.h"

#define LADDER_TYPE_TREE_ROW (ladder_tree_row_get_type())
G_DECLARE_FINAL_TYPE(LadderTreeRow, ladder_tree_row, LADDER, TREE_ROW, GObject)

enum row_kind { ROW_HEADING, ROW_BOOKMARK, ROW_POU, ROW_SYMBOLS, ROW_FILE,
		ROW_STRUCTURE, ROW_VARIABLE, ROW_TEXT };

struct _LadderTreeRow {
	GObject parent_instance;
	enum row_kind kind;
	int pou, rung;      /* pou of a STRUCTURE: its number                  */
	char *text, *note, *path;
	bool parent;        /* something stands below it                       */
	GListStore *rows;   /* that, once somebody asked for it                */
};

/**
 * tree_rows_update - @root becomes the rows of the project as it is; without one: none
 *
 * A row that stays is the same one, with what is open below it; its number may be another,
 * and "changed" tells that its note is.
 */
void tree_rows_update(GListStore *root, LadderDocument *document);
/** tree_row_children - what stands below a row: variables are asked of the project.
 * Owns: the caller.   Fails: NULL: nothing does. */
GListModel *tree_row_children(LadderTreeRow *row, LadderDocument *document);
#endif
