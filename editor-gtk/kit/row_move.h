/* SPDX-License-Identifier: MIT
 *
 * row_move - moving the rows of a list by drag and by Alt+Up and Alt+Down. A line shows where a
 * dragged row would go. Rows of another list are not taken.
 *
 * The owner says which rows can be moved, and where; it does the edit.
 */
#ifndef EDITOR_ROW_MOVE_H
#define EDITOR_ROW_MOVE_H

#include <gtk/gtk.h>
#include <stdbool.h>

/* Rows are the items of the list; in a tree, the items of its GtkTreeListRows. */
struct row_move {
	const char *up, *down;  /* actions of Alt+Up and Alt+Down                 */
	bool before_cells;      /* these keys do not open the choices of a cell   */
	/* The name of a row, borrowed; NULL: it cannot be moved. */
	const char *(*name)(gpointer owner, gpointer row);
	/* Can @row go beside @target? @below: it is over the lower half of @target; the function
	 * may set the side on which it would go. */
	bool (*fits)(gpointer owner, gpointer row, gpointer target, bool *below);
	void (*move)(gpointer owner, gpointer row, gpointer target, bool below);
	/* A drag of a row begins or ends; NULL: nothing to do. */
	void (*dragging)(gpointer owner, bool is);
};

/**
 * row_move_add - makes the rows of @list, a GtkListView or GtkColumnView, movable
 * @how, @owner: outlive the list
 *
 * A GtkColumnView gets a column of handles behind its first column.
 */
void row_move_add(GtkWidget *list, const struct row_move *how, gpointer owner);
/** row_move_add_place - rows of @list can also be dropped on @place, a widget in the same window;
 * fits() and move() get @target, not below it. It has the class "drop-here" while a row is over
 * it. @target: outlives @place. After row_move_add(). */
void row_move_add_place(GtkWidget *list, GtkWidget *place, gpointer target);
/** row_move_stand - names the list item that @cell shows. A GtkListView needs it in each row. */
void row_move_stand(GtkWidget *cell, GtkListItem *item);
/** row_move_at - the list item at a point of @list; NULL: none. Borrowed. */
GtkListItem *row_move_at(GtkWidget *list, double x, double y);

#endif
