/* SPDX-License-Identifier: MIT
 *
 * tree_rows - the rows of the project tree.
 *
 * project_tree.c does what a person does with them.
 */
#ifndef EDITOR_TREE_ROWS_H
#define EDITOR_TREE_ROWS_H

#include "editor-gtk/document/document.h"

#define LADDER_TYPE_TREE_ROW (ladder_tree_row_get_type())
G_DECLARE_FINAL_TYPE(LadderTreeRow, ladder_tree_row, LADDER, TREE_ROW, GObject)

enum row_kind { ROW_HEADING, ROW_BOOKMARK, ROW_POU, ROW_SYMBOLS, ROW_FILE,
		ROW_STRUCTURE, ROW_VARIABLE, ROW_TEXT, ROW_TASKS, ROW_TASK, ROW_TYPES,
		ROW_ADDRESSES, ROW_RUNS, ROW_CHART, ROW_BOARD };

struct _LadderTreeRow {
	GObject parent_instance;
	enum row_kind kind;
	int pou, rung;      /* pou of a STRUCTURE: its index                   */
	int what;           /* TASK, RUNS (a program below one): enum task_what */
	char *text, *note;
	char *path;         /* TEXT: file; CHART: name in the project; BOARD: where it is */
	bool parent;        /* it has children                                 */
	bool missing;       /* the board runs without it as it is              */
	GListStore *rows;   /* the children, once asked for                    */
};

/** tree_rows_update - makes @root the rows of the project; without a project it becomes
 * empty. A row that stays is the same object, with its children; its index may change, and
 * "changed" is emitted if its note did. */
void tree_rows_update(GListStore *root, LadderDocument *document);
/** tree_row_set_missing - emits "changed" if it is news. */
void tree_row_set_missing(LadderTreeRow *row, bool missing);
/** tree_row_children - the children of a row; variables come from the project. NULL: it has
 * none. Caller: g_object_unref(). */
GListModel *tree_row_children(LadderTreeRow *row, LadderDocument *document);
#endif
