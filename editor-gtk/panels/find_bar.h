/* SPDX-License-Identifier: MIT
 *
 * find_bar - the bar that finds and replaces in all texts of the document; find.h does the
 * search.
 *
 * Signals: hits-changed (): ladder_find_bar_find() or the current hit changed, for marks on
 * the sheet; closed (): the focus may return to the last hit.
 *
 * Actions: find.next, find.previous, find.replace, find.replace-all, find.close. It goes to
 * a hit by panel_go_to(), and keeps the focus if it had it.
 */
#ifndef EDITOR_FIND_BAR_H
#define EDITOR_FIND_BAR_H

#include <gtk/gtk.h>

#include "editor-gtk/document/find.h"

#define LADDER_TYPE_FIND_BAR (ladder_find_bar_get_type())
G_DECLARE_FINAL_TYPE(LadderFindBar, ladder_find_bar, LADDER, FIND_BAR, GtkWidget)

GtkWidget *ladder_find_bar_new(void);
void ladder_find_bar_set_document(LadderFindBar *bar, LadderDocument *document);
/** ladder_find_bar_open - shows and focuses the bar
 * @replace: with the row to replace; @text: NULL: the text of the last search */
void ladder_find_bar_open(LadderFindBar *bar, bool replace, const char *text);
void ladder_find_bar_close(LadderFindBar *bar);
bool ladder_find_bar_is_open(LadderFindBar *bar);
/** ladder_find_bar_has_keys - is the focus in the bar? */
bool ladder_find_bar_has_keys(LadderFindBar *bar);
/** ladder_find_bar_set_place - the cursor, where the search begins. 0-based, -1: the whole. */
void ladder_find_bar_set_place(LadderFindBar *bar, int pou, int rung, int row, int col);
/** ladder_find_bar_place - the place of the last hit, or as it was set. Borrowed. */
const int *ladder_find_bar_place(LadderFindBar *bar);
/** ladder_find_bar_next - goes to the next or previous hit, also of the last search while
 * the bar is closed. False: none. */
bool ladder_find_bar_next(LadderFindBar *bar, bool back);
/** ladder_find_bar_find - all hits; NULL: no search. Borrowed until hits-changed. */
const struct find *ladder_find_bar_find(LadderFindBar *bar);
/** ladder_find_bar_current - index of the current hit; -1: none. */
int ladder_find_bar_current(LadderFindBar *bar);

#endif
