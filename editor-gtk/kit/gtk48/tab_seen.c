/* SPDX-License-Identifier: MIT
 *
 * tab_seen - keeps the selected tab in sight; see tab_seen.h.
 */
#include "editor-gtk/kit/gtk48/tab_seen.h"

#include <stdbool.h>
#include <string.h>

/* A list of tabs: the pinned ones, or the others. */
struct seen {
	GtkWidget *tabs;        /* borrowed: @down is its                         */
	double width, upper;    /* px, at the last look                           */
	guint idle;
};

static void seen_free(gpointer data, GClosure *closure)
{
	struct seen *seen = data;

	(void)closure;
	g_clear_handle_id(&seen->idle, g_source_remove);
	g_free(seen);
}

/* The place of the selected tab, which is in it; NULL: it is in another list. */
static GtkWidget *selected(GtkWidget *tabs)
{
	GtkWidget *place = gtk_widget_get_first_child(tabs), *tab;

	for (; place; place = gtk_widget_get_next_sibling(place)) {
		tab = gtk_widget_get_first_child(place);
		if (tab && gtk_widget_get_state_flags(tab) & GTK_STATE_FLAG_SELECTED)
			return place;
	}
	return NULL;
}

/* The tabs have their places only after the layout. */
static gboolean show_selected(gpointer data)
{
	struct seen *seen = data;
	GtkAdjustment *along = gtk_scrollable_get_hadjustment(GTK_SCROLLABLE(seen->tabs));
	GtkWidget *tab = selected(seen->tabs);
	graphene_rect_t box;

	seen->idle = 0;
	if (tab && gtk_widget_compute_bounds(tab, seen->tabs, &box)) {
		const double left = gtk_adjustment_get_value(along) + box.origin.x;

		gtk_adjustment_clamp_page(along, left, left + box.size.width);
	}
	return G_SOURCE_REMOVE;
}

static void along_changed(GtkAdjustment *along, struct seen *seen)
{
	const double width = gtk_adjustment_get_page_size(along);
	const double upper = gtk_adjustment_get_upper(along);

	if ((width < seen->width || upper != seen->upper) && !seen->idle)
		seen->idle = g_idle_add(show_selected, seen);
	seen->width = width;
	seen->upper = upper;
}

static void keep_in(GtkWidget *widget)
{
	for (GtkWidget *child = gtk_widget_get_first_child(widget); child;
	     child = gtk_widget_get_next_sibling(child))
		keep_in(child);
	if (GTK_IS_SCROLLABLE(widget) && gtk_scrollable_get_hadjustment(GTK_SCROLLABLE(widget)) &&
	    strcmp(gtk_widget_get_css_name(widget), "tabbox") == 0) {
		struct seen *seen = g_new0(struct seen, 1);

		seen->tabs = widget;
		g_signal_connect_data(gtk_scrollable_get_hadjustment(GTK_SCROLLABLE(widget)),
				      "changed", G_CALLBACK(along_changed), seen, seen_free, 0);
	}
}

void tab_seen_keep(AdwTabBar *bar)
{
	keep_in(GTK_WIDGET(bar));
}
