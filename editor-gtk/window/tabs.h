/* SPDX-License-Identifier: MIT
 *
 * tabs - the pages of a window: which are open, and going to a place in one.
 */
#ifndef EDITOR_TABS_H
#define EDITOR_TABS_H

#include "editor-gtk/text/file_view.h"
#include "editor-gtk/window/front.h"

struct tabs {
	struct core *core;
	AdwTabView *view;  /* the front's                                        */
	int pou_count;     /* of the project when the tabs were updated          */
};

void tabs_init(struct tabs *tabs, struct core *core);
/** tabs_open_anew - the untouched document became a file: its sheets open. */
void tabs_open_anew(struct tabs *tabs);
/** tabs_show - brings a POU to the front, and opens it if need be. */
void tabs_show(struct tabs *tabs, int pou);
/** tabs_show_widget - a page of no POU: "symbols", "welcome", "text". */
GtkWidget *tabs_show_widget(struct tabs *tabs, const char *name);
/** tabs_show_file - a text file beside the project. */
void tabs_show_file(struct tabs *tabs, const char *path);
/** tabs_put_file - the same of a file that is not open yet. */
void tabs_put_file(struct tabs *tabs, LadderSideFile *file);
/** tabs_find_file - of that path; NULL: it is not open. */
LadderFileView *tabs_find_file(struct tabs *tabs, const char *path);
/** tabs_each_file - @act of each open LadderSideFile. */
void tabs_each_file(struct tabs *tabs, void (*act)(gpointer file));
/** tabs_unsaved - those that are not saved, of LadderSideFile *. Caller: g_ptr_array_unref. */
GPtrArray *tabs_unsaved(struct tabs *tabs);
/** tabs_save_file - false: it could not be saved, which a banner tells. */
bool tabs_save_file(struct tabs *tabs, LadderSideFile *file);
/** tabs_save_files - all that are not saved; stops at the first that cannot be. */
bool tabs_save_files(struct tabs *tabs);
/** tabs_close - the page in front; asks first if a file in it is not saved. */
void tabs_close(struct tabs *tabs);
/** tabs_go - to the place of a diagnostic or a use; -1: the whole. */
void tabs_go(struct tabs *tabs, int pou, int rung, int row, int col);
/** tabs_step - undoes a step, or does it again, and shows what it changed. */
void tabs_step(struct tabs *tabs, bool redo);

#endif
