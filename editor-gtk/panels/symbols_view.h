/* SPDX-License-Identifier: MIT
 *
 * symbols_view - the table of all symbols: sort, filter, edit in place, tables of other
 * programs in and out.
 *
 * Actions: symbols.add, symbols.delete, symbols.import, symbols.uses (goes to win.show-uses
 * with the name, if the window has it); the window's win.export_symbols writes one. What a field refuses is told in the row and below the table.
 */
#ifndef EDITOR_SYMBOLS_VIEW_H
#define EDITOR_SYMBOLS_VIEW_H

#include <gtk/gtk.h>

#include "editor-gtk/document/document.h"

#define LADDER_TYPE_SYMBOLS_VIEW (ladder_symbols_view_get_type())
G_DECLARE_FINAL_TYPE(LadderSymbolsView, ladder_symbols_view, LADDER, SYMBOLS_VIEW, GtkWidget)

GtkWidget *ladder_symbols_view_new(void);
void ladder_symbols_view_set_document(LadderSymbolsView *view, LadderDocument *document);
/** ladder_symbols_view_show - selects a symbol, by table and index of xref/xref.h. */
bool ladder_symbols_view_show(LadderSymbolsView *view, int table, int index);
/** ladder_symbols_view_enter - the name of the row that is selected has the keys. */
void ladder_symbols_view_enter(LadderSymbolsView *view);
/** ladder_symbols_view_list - the rows shown (LadderPanelRow). Borrowed. */
GListModel *ladder_symbols_view_list(LadderSymbolsView *view);
/** ladder_symbols_view_refresh - now, seen or not. */
void ladder_symbols_view_refresh(LadderSymbolsView *view);
/** ladder_symbols_view_message - what was refused last; "": nothing. Borrowed. */
const char *ladder_symbols_view_message(LadderSymbolsView *view);
/** ladder_symbols_view_import - asks, with a list of what would change. @from: a name for
 * the title. Returns the dialog; it owns itself. */
GtkWidget *ladder_symbols_view_import(LadderSymbolsView *view, const char *from,
				      const char *text, gsize len);

#endif
