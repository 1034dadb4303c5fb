/* SPDX-License-Identifier: MIT
 *
 * cells - refusals, focus and pending edits in the cells of tables.
 */
#ifndef EDITOR_CELLS_H
#define EDITOR_CELLS_H

#include <gtk/gtk.h>

#include "editor-gtk/kit/panel_row.h"

#include <stdbool.h>

/** cells_refuse - marks a cell as refused, with the reason; NULL: removes the mark. Takes @why. */
void cells_refuse(GtkWidget *cell, char *why);
/** cells_refused - marks a cell after a failed edit; @why NULL: "Refused". Takes @why. */
void cells_refused(GtkWidget *cell, char *why);
/** cells_icon - the icon at the end of a cell; NULL: none. */
void cells_icon(GtkEntry *cell, const char *icon, const char *tip);
/** cells_add - adds a controller to @cell, and as its data @name. */
void cells_add(GtkWidget *cell, const char *name, GtkEventController *controller);

/** cells_stand - sets the row (NULL: none) and the column of @cell. */
void cells_stand(GtkWidget *cell, GtkListItem *item, int field);
/** cells_enter - moves the focus to a cell of the selected row @row, selects its text and
 * scrolls to it; later, if the table has not made the cell yet. A later call takes the place of one that
 * still waits. */
void cells_enter(GtkColumnView *table, const LadderPanelRow *row, int field);
/** cells_shown - the text of the row that @cell shows; NULL: none. */
void cells_shown(GtkWidget *cell, const char *text);
/** cells_is_typed - has somebody typed another text since? */
bool cells_is_typed(GtkWidget *cell);
/** cells_keep_cursor - somebody was typing in @cell: the next cells_enter() selects nothing and puts the cursor
 * there, in characters. */
void cells_keep_cursor(GtkEntry *cell, int cursor);
/** cells_focused - the row and @field of the cell that has the focus; NULL: none. Borrowed. */
LadderPanelRow *cells_focused(GtkColumnView *table, int *field);

/** cells_on_take - sets the function that ends an edit in @cell, as before saving. It returns
 * false if it refused the edit and marked the cell. NULL: none. */
void cells_on_take(GtkWidget *cell, bool (*take)(GtkWidget *cell, GtkListItem *item),
		   GtkListItem *item);
/** cells_take - ends the edit that has the focus in @window, if there is one; false: it was refused. */
bool cells_take(GtkWindow *window);

#endif
