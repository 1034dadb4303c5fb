/* SPDX-License-Identifier: MIT
 *
 * sim_panel_kept - what a person chose for lines of the panel, kept in the project.
 *
 * Lines `panel NAME push`, `panel NAME hold F6`, `panel NAME toggle F6`, `panel NAME range 0
 * 100` of the VIEW part, and any of these together; `panel-plant` of a plant. It changes texts,
 * nothing else.
 */
#ifndef EDITOR_SIM_PANEL_KEPT_H
#define EDITOR_SIM_PANEL_KEPT_H

#include "editor-gtk/live/sim_panel_row.h"

/** sim_kept_read - @rows, of LadderSimRow, are as @view says. True: one of them is other than
 * it was. */
bool sim_kept_read(const char *view, GPtrArray *rows);
/** sim_kept_write - @view, where @row's choices are what it says of it. Caller frees. */
char *sim_kept_write(const char *view, const LadderSimRow *row);

#endif
