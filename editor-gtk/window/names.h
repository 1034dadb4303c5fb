/* SPDX-License-Identifier: MIT
 *
 * names - commands on the name at the cursor: go to its definition or what drives it, show its uses, add it
 * to the status chart, rename it.
 *
 * The engine's cross reference decides what a name means.
 */
#ifndef EDITOR_NAMES_H
#define EDITOR_NAMES_H

#include "editor-gtk/window/core.h"

/** names_add_panel - adds the cross reference. */
void names_add_panel(struct core *core);
/** names_go_driver - goes to the next place that drives the name, and from the last to the
 * first. */
void names_go_driver(struct core *core);
/** names_go_definition - goes to where the name is declared; from there to what drives it. */
void names_go_definition(struct core *core);
/** names_at_cursor - the name at the cursor; NULL: none, and the status bar says so. Caller
 * frees. */
char *names_at_cursor(struct core *core);
/** names_watch - adds the name to the status chart and shows it. */
void names_watch(struct core *core);
void names_watch_this(struct core *core, const char *name);
/** names_show_uses - shows the uses in the cross reference. */
void names_show_uses(struct core *core);
void names_show_uses_of(struct core *core, const char *name);
/** names_rename - asks for a new name and changes all uses. The dialog shows why a name is
 * refused; the engine decides that. */
void names_rename(struct core *core);
/** names_delete_pou - deletes a POU; if it is used, asks first, with its uses. */
void names_delete_pou(struct core *core, int pou);
/** names_rename_pou - the same for a POU. */
void names_rename_pou(struct core *core, int pou);
/** names_delete_type, names_rename_type - the same for a data type, by its number
 * (type_edit.h). */
void names_delete_type(struct core *core, int type);
void names_rename_type(struct core *core, int type);
/** names_delete_task, names_rename_task - the same for a task, by its name. */
void names_delete_task(struct core *core, const char *name);
void names_rename_task(struct core *core, const char *name);

#endif
