/* SPDX-License-Identifier: MIT
 *
 * find_bar - the bar that finds and replaces in all texts of the document.
 *
 * Signals: hits-changed (): ladder_find_bar_find() is another, or the hit it stands on, for
 * marks on the sheet;
 * closed (): it was, the focus may go back to the hit, which is known still.
 * Actions: find.next, find.previous, find.replace, find.replace-all, find.close. It goes
 * to a hit by the action win.go-to (iiii), as panel_go_to() tells. If it had the keys it
 * keeps them.
 */
#ifndef EDITOR_FIND_BAR_H
#define EDITOR_FIND_BAR_H

#include <gtk/gtk.h>

#include "editor-gtk/document/find.h"

#define LADDER_TYPE_FIND_BAR (ladder_find_bar_get_type())
G_DECLARE_FINAL_TYPE(LadderFindBar, ladder_find_bar, LADDER, FIND_BAR, GtkWidget)

GtkWidget *ladder_find_bar_new(void);
void ladder_find_bar_set_document(LadderFindBar *bar, LadderDocument *document);
/** ladder_find_bar_open - shows it and puts the focus there
 * @replace: with the row to replace; @text: NULL: what was looked for last */
void ladder_find_bar_open(LadderFindBar *bar, bool replace, const char *text);
void ladder_find_bar_close(LadderFindBar *bar);
bool ladder_find_bar_is_open(LadderFindBar *bar);
/** ladder_find_bar_has_keys - the focus is inside of it. */
bool ladder_find_bar_has_keys(LadderFindBar *bar);
/** ladder_find_bar_set_place - where the cursor is, from which the next hit is looked for.
 * 0-based, -1: the whole. */
void ladder_find_bar_set_place(LadderFindBar *bar, int pou, int rung, int row, int col);
/** ladder_find_bar_place - the same four numbers: of the last hit, also when it is closed,
 * or as they were set. Borrowed. */
const int *ladder_find_bar_place(LadderFindBar *bar);
/** ladder_find_bar_next - goes to the next hit, or the one before, of what was looked for
 * last also while the bar is closed. False: none. */
bool ladder_find_bar_next(LadderFindBar *bar, bool back);
/** ladder_find_bar_find - all hits; NULL: nothing is looked for. Borrowed until
 * hits-changed. */
const struct find *ladder_find_bar_find(LadderFindBar *bar);
/** ladder_find_bar_current - number of the hit it stands on; -1: none. */
int ladder_find_bar_current(LadderFindBar *bar);
/** ladder_find_bar_message - "2 of 7", or why nothing was replaced. Borrowed. */
const char *ladder_find_bar_message(LadderFindBar *bar);

#endif
