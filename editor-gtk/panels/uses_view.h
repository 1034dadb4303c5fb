/* SPDX-License-Identifier: MIT
 *
 * uses_view - the cross reference: uses of a symbol, all symbols, unused symbols, and
 * memory with two names.
 *
 * Activating a row goes to its place by win.go-to (iiii). Signal "lost" (): the symbol does
 * not exist any more, for example after a rename; the window may set another.
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
/** ladder_uses_view_set_symbol - the name as a cell has it; @pou: in which POU, -1: among
 * the globals. NULL: none. */
void ladder_uses_view_set_symbol(LadderUsesView *view, int pou, const char *symbol);
/** ladder_uses_view_symbol - the last one that was set; NULL: none. Borrowed. */
const char *ladder_uses_view_symbol(LadderUsesView *view);
void ladder_uses_view_set_mode(LadderUsesView *view, enum uses_mode mode);
/** ladder_uses_view_is_lost - are the uses of a symbol shown that does not exist? */
bool ladder_uses_view_is_lost(LadderUsesView *view);

#endif
