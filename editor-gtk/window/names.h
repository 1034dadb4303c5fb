/* SPDX-License-Identifier: MIT
 *
 * names - what is done with the name at the cursor: where it is driven, where it is used,
 * its value in the status chart, another name for it.
 *
 * The engine's cross reference says what a name means.
 */
#ifndef EDITOR_NAMES_H
#define EDITOR_NAMES_H

#include "editor-gtk/window/core.h"

/** names_add_panel - the cross reference. */
void names_add_panel(struct core *core);
/** names_go_driver - to the next place that drives the name, round and round. */
void names_go_driver(struct core *core);
/** names_at_cursor - of the element there; NULL: there is none, and that is told. Caller
 * frees. */
char *names_at_cursor(struct core *core);
/** names_watch - adds it to the status chart, which is shown. */
void names_watch(struct core *core);
void names_watch_this(struct core *core, const char *name);
/** names_show_uses - in the panel of the cross reference. */
void names_show_uses(struct core *core);
void names_show_uses_of(struct core *core, const char *name);
/** names_rename - asks for the new name of what is at the cursor, and writes it wherever it
 * is used. While it is typed the question says why it cannot be taken; the engine decides. */
void names_rename(struct core *core);
/** names_rename_pou - the same of a POU. */
void names_rename_pou(struct core *core, int pou);

#endif
