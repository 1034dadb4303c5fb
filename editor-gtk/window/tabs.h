/* SPDX-License-Identifier: MIT
 *
 * tabs - the open pages of a window, and going to a place in one of them.
 */
#ifndef EDITOR_TABS_H
#define EDITOR_TABS_H

#include "editor-gtk/text/file_view.h"
#include "editor-gtk/window/front.h"

struct tabs {
	struct core *core;
	AdwTabView *view;  /* belongs to front                                   */
	int pou_count;     /* of the project at the last update                  */
	GPtrArray *parts;  /* files that the project may include: undo needs them when their pages
			      are closed */
};

void tabs_init(struct tabs *tabs, struct core *core);
/** tabs_open_anew - opens the pages of a file that replaced the untouched document. */
void tabs_open_anew(struct tabs *tabs);
/** tabs_show - brings the page of a POU to the front; opens it if need be. */
void tabs_show(struct tabs *tabs, int pou);
/** tabs_show_as - the page that shows POU @pou in language @to. */
void tabs_show_as(struct tabs *tabs, int pou, enum pou_language to);
/** tabs_show_task - the page of the tasks, with this one selected; NULL: none. */
void tabs_show_task(struct tabs *tabs, const char *task);
/** tabs_new_task - makes a task in that page. */
void tabs_new_task(struct tabs *tabs);
/** tabs_show_widget - a page without a POU: "symbols", "tasks", "types", "addresses", "device", "compare",
 * "welcome", "text". */
GtkWidget *tabs_show_widget(struct tabs *tabs, const char *name);
/** tabs_find_widget - the same if it is open; NULL: it is not. */
GtkWidget *tabs_find_widget(struct tabs *tabs, const char *name);
/** tabs_show_type - the page of data types, with the type of this name; NULL: any. */
void tabs_show_type(struct tabs *tabs, const char *name);
/** tabs_show_value - the same, with the cursor on a value of the enumeration. */
void tabs_show_value(struct tabs *tabs, const char *type, const char *value);
/** tabs_show_file - the page of a text file beside the project. */
void tabs_show_file(struct tabs *tabs, const char *path);
/** tabs_put_file - the page of a file that is not open yet. */
void tabs_put_file(struct tabs *tabs, LadderSideFile *file);
/** tabs_find_file - the page of the file at @path; NULL: not open. */
LadderFileView *tabs_find_file(struct tabs *tabs, const char *path);
/** tabs_clear - frees what it holds. */
void tabs_clear(struct tabs *tabs);
/** tabs_each_file - calls @act for each open LadderSideFile. */
void tabs_each_file(struct tabs *tabs, void (*act)(gpointer file));
/** tabs_unsaved - the unsaved ones, of LadderSideFile *. Caller: g_ptr_array_unref(). */
GPtrArray *tabs_unsaved(struct tabs *tabs);
/** tabs_save_file - false: it could not be saved, and a banner says why. */
bool tabs_save_file(struct tabs *tabs, LadderSideFile *file);
/** tabs_save_files - saves all unsaved ones; stops at the first that fails. */
bool tabs_save_files(struct tabs *tabs);
/** tabs_save_parts - the same, of files that the project may include. */
bool tabs_save_parts(struct tabs *tabs);
/** tabs_close - closes the page in front; asks first if its file has unsaved changes. */
void tabs_close(struct tabs *tabs);
/** tabs_go - goes to the place of a diagnostic or a use; -1: the whole. */
/** tabs_go_line - the same for line @line, from 0, of the text of a POU; a chart shows its text below. */
void tabs_go_line(struct tabs *tabs, int pou, int line);
void tabs_go(struct tabs *tabs, int pou, int rung, int row, int col);
/** tabs_step - undoes or redoes a step, and shows what it changed. */
void tabs_step(struct tabs *tabs, bool redo);

#endif
