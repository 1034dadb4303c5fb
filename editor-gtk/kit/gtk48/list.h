/* SPDX-License-Identifier: MIT
 *
 * list - scrolling a list to one of its rows, the focus of replaced rows, Tab in a list.
 *
 * Mends in GTK 4.8.3:
 * - A list can be scrolled to a row only through an action of GtkListBase, which
 *   GtkColumnView hides in a child. GTK 4.12 has gtk_list_view_scroll_to() and
 *   gtk_column_view_scroll_to(): use them when the floor rises to 4.12.
 * - When the row that has the focus is removed, the window keeps that row as its focus until
 *   the next frame; a key pressed in this time is lost, Ctrl+S too. To see it: remove the
 *   call of list_mend_focus() in tree_update(), delete a POU in the tree and press Ctrl+Z
 *   at once. Try without it on each new floor.
 * - Tab stops at each row of a list. GTK 4.12 has the property "tab-behavior" of lists: use it
 *   when the floor rises to 4.12.
 * - A fold may unbind the expander that folds: if it was the last to refer to its
 *   GtkTreeListRow, gtk_tree_list_row_set_expanded() goes on with freed memory. To see it: set
 *   the row of the expander to NULL in unbind_name() of init_dialog.c without list_drop_row(),
 *   select a value of an array and fold the array by a click. Try so on each new floor.
 * - A hidden column with a fixed width, or that expands, still takes its width: other columns are
 *   narrower, and the right end shows the glow of a list that is drawn too far, for good. To see it: open a function
 *   block without list_show_column() in interface_view.c. Test: test_hidden_column.c.
 */
#ifndef EDITOR_GTK48_LIST_H
#define EDITOR_GTK48_LIST_H

#include <gtk/gtk.h>
#include <stdbool.h>

/** list_scroll_to - scrolls @view, a GtkListView or GtkColumnView, to row @at. A new row can
 * be scrolled to from the next frame on. */
void list_scroll_to(GtkWidget *view, guint at);
/** list_mend_focus - after widgets inside @list were replaced: if the focus was in one that
 * is gone, the window gets the keys. */
void list_mend_focus(GtkWidget *list);
/** list_drop_row - the expander has no row any more; the row lives on until the next idle. */
void list_drop_row(GtkTreeExpander *expander);
/** list_show_column - shows or hides a column, which keeps its fixed width, and whether it expands,
 * for when it is shown again. While it is hidden, gtk_column_view_column_get_fixed_width() is -1. */
void list_show_column(GtkColumnViewColumn *column, bool shown);
/** list_column_width - its fixed width, also while list_show_column() hides it. */
int list_column_width(GtkColumnViewColumn *column);
/** list_set_column_width - sets it; of a hidden column for when it is shown again. */
void list_set_column_width(GtkColumnViewColumn *column, int width);
/** list_tab_stop_new - a container in which Tab leaves @child, a list, and arrows go from row to
 * row. */
GtkWidget *list_tab_stop_new(GtkWidget *child);

#endif
