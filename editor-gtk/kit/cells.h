/* SPDX-License-Identifier: MIT
 *
 * cells - what the cells of tables that can be edited share. What a cell means, and how
 * it is edited, is the table's business.
 */
#ifndef EDITOR_CELLS_H
#define EDITOR_CELLS_H

#include <gtk/gtk.h>

#include "editor-gtk/kit/panel_row.h"

#include <stdbool.h>

/** cells_refuse - marks a cell as refused, and says @why; NULL: it is not. Takes @why. */
void cells_refuse(GtkWidget *cell, char *why);
/** cells_refused - the same of an edit that did not succeed; @why may be NULL. Takes it. */
void cells_refused(GtkWidget *cell, char *why);
/** cells_add - a controller of @cell, to be found as its data @name. */
void cells_add(GtkWidget *cell, const char *name, GtkEventController *controller);

/** cells_stand - where @cell stands: the item of its row (NULL: nowhere), its column. */
void cells_stand(GtkWidget *cell, GtkListItem *item, int field);
/** cells_enter - the cell of @table in its selected row @row gets the focus, its text
 * selected, and is scrolled to; if the table has yet to make it, then. */
void cells_enter(GtkColumnView *table, const LadderPanelRow *row, int field);
/** cells_focused - the row of the cell that has the keys, and its @field; NULL: none has.
 * Borrowed. */
LadderPanelRow *cells_focused(GtkColumnView *table, int *field);

/** cells_on_take - what ends an edit in @cell where it stands, as before saving. @take:
 * false: refused, and it told why in the cell; NULL: the cell is no one's any more. */
void cells_on_take(GtkWidget *cell, bool (*take)(GtkWidget *cell, GtkListItem *item),
		   GtkListItem *item);
/** cells_take - ends the edit that has the focus, if one has; false: it was refused. */
bool cells_take(GtkWidget *focus);

#endif
