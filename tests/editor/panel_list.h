/* SPDX-License-Identifier: MIT
 *
 * panel_list - what a panel with a list shows, found in its widgets, for tests.
 */
#ifndef TESTS_EDITOR_PANEL_LIST_H
#define TESTS_EDITOR_PANEL_LIST_H

#include <gtk/gtk.h>

/* The first descendant that has this id in its .ui file; NULL: none. */
static inline GtkWidget *panel_part(GtkWidget *from, const char *id)
{
	GtkWidget *found = NULL, *child = gtk_widget_get_first_child(from);

	for (; child && !found; child = gtk_widget_get_next_sibling(child))
		found = g_strcmp0(gtk_buildable_get_buildable_id(GTK_BUILDABLE(child)), id) == 0 ?
			child : panel_part(child, id);
	return found;
}

/* Its rows, as they are listed; the list is a selection model, too. */
static inline GListModel *panel_items(gpointer panel)
{
	GtkWidget *view = panel_part(GTK_WIDGET(panel), "view");

	return G_LIST_MODEL(gtk_column_view_get_model(GTK_COLUMN_VIEW(view)));
}

static inline const char *panel_text(gpointer panel, const char *id)
{
	return gtk_label_get_text(GTK_LABEL(panel_part(GTK_WIDGET(panel), id)));
}

static inline gboolean panel_elapsed(gpointer over)
{
	*(bool *)over = true;
	return G_SOURCE_REMOVE;
}

/* Returns when each timer of at most a tenth of a second that runs now has elapsed: panels refresh then. */
static inline void panel_settle(void)
{
	bool over = false;

	g_timeout_add(101, panel_elapsed, &over);
	while (!over)
		g_main_context_iteration(NULL, TRUE);
}

#endif
