/* SPDX-License-Identifier: MIT
 *
 * list - scrolling, focus and Tab of lists in GTK 4.8; see list.h.
 */
#include "editor-gtk/kit/gtk48/list.h"

#include <adwaita.h>

#define SCROLL "list.scroll-to-item" /* of GtkListBase */

void list_scroll_to(GtkWidget *view, guint at)
{
	if (GTK_IS_LIST_VIEW(view)) {
		gtk_widget_activate_action(view, SCROLL, "u", at);
		return;
	}
	for (GtkWidget *child = gtk_widget_get_first_child(view); child;
	     child = gtk_widget_get_next_sibling(child))
		if (gtk_widget_activate_action(child, SCROLL, "u", at))
			return;
}

void list_mend_focus(GtkWidget *list)
{
	GtkRoot *root = gtk_widget_get_root(list);
	GtkWidget *focus = root ? gtk_root_get_focus(root) : NULL;

	if (focus && gtk_widget_get_root(focus) != root)
		gtk_root_set_focus(root, NULL);
}

static gboolean forget_row(gpointer row)
{
	(void)row;
	return G_SOURCE_REMOVE;
}

void list_drop_row(GtkTreeExpander *expander)
{
	GtkTreeListRow *row = gtk_tree_expander_get_list_row(expander);

	if (row)
		g_idle_add_full(G_PRIORITY_DEFAULT_IDLE, forget_row, g_object_ref(row),
				g_object_unref);
	gtk_tree_expander_set_list_row(expander, NULL);
}

int list_column_width(GtkColumnViewColumn *column)
{
	return gtk_column_view_column_get_visible(column) ?
	       gtk_column_view_column_get_fixed_width(column) :
	       GPOINTER_TO_INT(g_object_get_data(G_OBJECT(column), "width"));
}

void list_set_column_width(GtkColumnViewColumn *column, int width)
{
	if (gtk_column_view_column_get_visible(column))
		gtk_column_view_column_set_fixed_width(column, width);
	else /* GTK would leave room for it */
		g_object_set_data(G_OBJECT(column), "width", GINT_TO_POINTER(width));
}

void list_show_column(GtkColumnViewColumn *column, bool shown)
{
	const int width = gtk_column_view_column_get_fixed_width(column);

	if (shown == gtk_column_view_column_get_visible(column))
		return;
	if (!shown) {
		g_object_set_data(G_OBJECT(column), "width", GINT_TO_POINTER(width));
		g_object_set_data(G_OBJECT(column), "expand", GINT_TO_POINTER(
			gtk_column_view_column_get_expand(column)));
	}
	gtk_column_view_column_set_expand(column, shown &&
		GPOINTER_TO_INT(g_object_get_data(G_OBJECT(column), "expand")));
	gtk_column_view_column_set_fixed_width(column, shown ?
		GPOINTER_TO_INT(g_object_get_data(G_OBJECT(column), "width")) : -1);
	gtk_column_view_column_set_visible(column, shown);
}

/* ---- one stop of Tab ---- */

struct _LadderTabStop {
	AdwBin parent_instance;
};

#define LADDER_TYPE_TAB_STOP (ladder_tab_stop_get_type())
G_DECLARE_FINAL_TYPE(LadderTabStop, ladder_tab_stop, LADDER, TAB_STOP, AdwBin)
G_DEFINE_FINAL_TYPE(LadderTabStop, ladder_tab_stop, ADW_TYPE_BIN)

static gboolean stop_focus(GtkWidget *stop, GtkDirectionType direction)
{
	if ((direction == GTK_DIR_TAB_FORWARD || direction == GTK_DIR_TAB_BACKWARD) &&
	    gtk_widget_get_focus_child(stop))
		return FALSE;
	return GTK_WIDGET_CLASS(ladder_tab_stop_parent_class)->focus(stop, direction);
}

static void ladder_tab_stop_class_init(LadderTabStopClass *class)
{
	GTK_WIDGET_CLASS(class)->focus = stop_focus;
}

static void ladder_tab_stop_init(LadderTabStop *stop)
{
	(void)stop;
}

GtkWidget *list_tab_stop_new(GtkWidget *child)
{
	GtkWidget *stop = g_object_new(LADDER_TYPE_TAB_STOP, NULL);

	adw_bin_set_child(ADW_BIN(stop), child);
	gtk_widget_set_vexpand(stop, TRUE);
	return stop;
}
