/* SPDX-License-Identifier: MIT
 *
 * tab_home - keeps tabs in their window; see tab_home.h.
 *
 * While a tab is dragged out of its bar, libadwaita detaches it from its view. The drop
 * targets of bar and view ask accept() before they take a tab. A libadwaita without such drop
 * targets behaves as if this file did not exist.
 */
#include "editor-gtk/kit/gtk48/tab_home.h"

#include <stdbool.h>

struct home {
	AdwTabView *view; /* only compared, no reference                          */
	AdwTabPage *out;  /* the last tab that was detached; a weak pointer       */
	int place;        /* where it was                                         */
	bool begged;      /* libadwaita asked for a new window: the tab comes back */
};

static void forget(gpointer home)
{
	g_clear_weak_pointer(&((struct home *)home)->out);
}

static void let_go(gpointer home, GClosure *closure)
{
	(void)closure;
	g_rc_box_release_full(home, forget);
}

/* Each signal connection holds a reference to @home. */
static void listen(gpointer to, const char *signal, GCallback act, struct home *home)
{
	g_signal_connect_data(to, signal, act, g_rc_box_acquire(home), let_go, 0);
}

/* ---- which tabs are accepted ---- */

/* The dragged tab; NULL: something else is dragged, or a tab of another program. */
static AdwTabPage *dragged(GdkDrop *drop)
{
	GdkDrag *drag = gdk_drop_get_drag(drop);
	GValue value = G_VALUE_INIT;
	AdwTabPage *page = NULL;

	if (!drag)
		return NULL;
	g_value_init(&value, ADW_TYPE_TAB_PAGE);
	if (gdk_content_provider_get_value(gdk_drag_get_content(drag), &value, NULL))
		page = g_value_get_object(&value); /* the drag has it */
	g_value_unset(&value);
	return page;
}

/* The bar accepts tabs of its view, the view accepts none. */
static gboolean accept(GtkDropTarget *target, GdkDrop *drop, struct home *home)
{
	GtkWidget *widget = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(target));

	return gdk_content_formats_match(gdk_drop_get_formats(drop),
					 gtk_drop_target_get_formats(target)) &&
	       widget != GTK_WIDGET(home->view) && dragged(drop) == home->out;
}

static void ask_first(GtkWidget *widget, struct home *home)
{
	GListModel *controllers = gtk_widget_observe_controllers(widget);

	for (guint i = 0; i < g_list_model_get_n_items(controllers); i++) {
		GObject *each = g_list_model_get_item(controllers, i);

		if (GTK_IS_DROP_TARGET(each) && gdk_content_formats_contain_gtype(
			    gtk_drop_target_get_formats(GTK_DROP_TARGET(each)),
			    ADW_TYPE_TAB_PAGE))
			listen(each, "accept", G_CALLBACK(accept), home);
		g_object_unref(each);
	}
	g_object_unref(controllers);
}

static void ask_first_inside(GtkWidget *widget, struct home *home)
{
	ask_first(widget, home);
	for (GtkWidget *child = gtk_widget_get_first_child(widget); child;
	     child = gtk_widget_get_next_sibling(child))
		ask_first_inside(child, home);
}

/* ---- a tab dropped elsewhere comes back ---- */

static void taken_out(AdwTabView *view, AdwTabPage *page, int place, struct home *home)
{
	(void)view;
	g_set_weak_pointer(&home->out, page);
	home->place = place;
}

/* Handler of "create-window": the first handler decides which view gets the tab. */
static AdwTabView *back(AdwTabView *view, struct home *home)
{
	home->begged = true;
	return view;
}

static void came(AdwTabView *view, AdwTabPage *page, int place, struct home *home)
{
	(void)place;
	if (home->begged)
		adw_tab_view_reorder_page(view, page, home->place);
	home->begged = false;
}

void tab_home_make(AdwTabBar *bar)
{
	struct home *home = g_rc_box_new0(struct home);

	home->view = adw_tab_bar_get_view(bar);
	ask_first_inside(GTK_WIDGET(bar), home);
	ask_first(GTK_WIDGET(home->view), home);
	listen(home->view, "page-detached", G_CALLBACK(taken_out), home);
	listen(home->view, "create-window", G_CALLBACK(back), home);
	listen(home->view, "page-attached", G_CALLBACK(came), home);
	let_go(home, NULL);
}
