/* SPDX-License-Identifier: MIT
 *
 * uses_view - the cross reference: where a symbol is used, all symbols, those that are
 * never used, and memory that has two names.
 *
 * To activate a row goes to its place by win.go-to (iiii). Signal "lost" (): nothing is
 * called so any more, as after a rename; what stands at the cursor may be asked for.
 */
#ifndef EDITOR_USES_VIEW_H
#define EDITOR_USES_VIEW_H

#include <gtk/gtk.h>

#include "editor-gtk/document/document.h"

enum uses_mode { USES_SYMBOL, USES_ALL, USES_UNUSED, USES_DOUBLE };

#define LADDER_TYPE_USES_VIEW (ladder_uses_view_get_type())
G_DECLARE_FINAL_TYPE(LadderUsesView, ladder_uses_view, LADDER, USES_VIEW, GtkWidget)

GtkWidget *ladder_uses_view_new(void);
void ladder_uses_view_set_document(LadderUsesView *view, LadderDocument *document);
/** ladder_uses_view_set_symbol - what stands at the cursor, as the cell says it; @pou: in
 * which POU, -1: among the globals. NULL: nothing. */
void ladder_uses_view_set_symbol(LadderUsesView *view, int pou, const char *symbol);
void ladder_uses_view_set_mode(LadderUsesView *view, enum uses_mode mode);
/** ladder_uses_view_is_lost - uses of a symbol are asked for, and there is no such symbol. */
bool ladder_uses_view_is_lost(LadderUsesView *view);
/** ladder_uses_view_list - the rows shown (LadderPanelRow). Borrowed. */
GListModel *ladder_uses_view_list(LadderUsesView *view);
/** ladder_uses_view_refresh - now, seen or not. */
void ladder_uses_view_refresh(LadderUsesView *view);

#endif
