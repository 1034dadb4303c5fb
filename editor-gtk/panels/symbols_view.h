/* SPDX-License-Identifier: MIT
 *
 * symbols_view - the table of all symbols: sort, filter, edit, import and export.
 *
 * Actions: symbols.add, symbols.delete, symbols.import, symbols.uses (activates win.show-
 * uses with the name). win.export_symbols exports. A refusal is shown in the row and below
 * the table.
 */
#ifndef EDITOR_SYMBOLS_VIEW_H
#define EDITOR_SYMBOLS_VIEW_H

#include <gtk/gtk.h>

#include "editor-gtk/document/find.h"

#define LADDER_TYPE_SYMBOLS_VIEW (ladder_symbols_view_get_type())
G_DECLARE_FINAL_TYPE(LadderSymbolsView, ladder_symbols_view, LADDER, SYMBOLS_VIEW, GtkWidget)

GtkWidget *ladder_symbols_view_new(void);
void ladder_symbols_view_set_document(LadderSymbolsView *view, LadderDocument *document);
/** ladder_symbols_view_show - selects a symbol, by table and index of xref/xref.h. */
bool ladder_symbols_view_show(LadderSymbolsView *view, int table, int index);
/** ladder_symbols_view_enter - focuses the name in the selected row. */
void ladder_symbols_view_enter(LadderSymbolsView *view);
/** ladder_symbols_view_set_found - marks the cells with hits of a search. */
void ladder_symbols_view_set_found(LadderSymbolsView *view, const struct find_seen *seen);
/** ladder_symbols_view_import - opens a dialog with the changes of an import. @from: file
 * name, for the title. Returns the dialog; it frees itself. */
GtkWidget *ladder_symbols_view_import(LadderSymbolsView *view, const char *from,
				      const char *text, gsize len);

#endif
