/* SPDX-License-Identifier: MIT
 *
 * tree_rows - the rows of the project tree: what they are of, and how they are made.
 *
 * What a person does with them is project_tree.c's.
 */
#ifndef EDITOR_TREE_ROWS_H
#define EDITOR_TREE_ROWS_H

#include "editor-gtk/document.h"

#define LADDER_TYPE_TREE_ROW (ladder_tree_row_get_type())
G_DECLARE_FINAL_TYPE(LadderTreeRow, ladder_tree_row, LADDER, TREE_ROW, GObject)

enum row_kind { ROW_HEADING, ROW_BOOKMARK, ROW_POU, ROW_SYMBOLS, ROW_FILE,
		ROW_STRUCTURE, ROW_VARIABLE, ROW_TEXT };

struct _LadderTreeRow {
	GObject parent;
	enum row_kind kind;
	int pou, rung;      /* pou of a STRUCTURE: its number                  */
	char *text, *note, *path;
	GListStore *rows;   /* below it; NULL: none                            */
};

/** tree_rows_fill - adds the rows of a project, which must be there, to @root. */
void tree_rows_fill(GListStore *root, LadderDocument *document);
/** tree_row_children - what stands below a row: variables are asked of the project.
 * Owns: the caller.   Fails: NULL: nothing does. */
GListModel *tree_row_children(LadderTreeRow *row, LadderDocument *document);
#endif
