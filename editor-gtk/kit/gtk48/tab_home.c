/* SPDX-License-Identifier: MIT
 *
 * tab_home - keeps tabs in their bar; see tab_home.h.
 *
 * The bar reorders its tabs by a GtkGestureDrag. When the pointer is far outside, it begins a
 * drag to elsewhere. It never hears that the pointer is outside: its handler of "drag-update"
 * gets the nearest place inside. A libadwaita without such a handler behaves as if this file
 * did not exist.
 */
#include "editor-gtk/kit/gtk48/tab_home.h"

/* The offset from @start to the nearest place of @size that @offset does not leave. */
static double inside(double start, double offset, int size)
{
	return CLAMP(start + offset, 0, MAX(size - 1, 0)) - start;
}

static guint update_signal(void)
{
	return g_signal_lookup("drag-update", GTK_TYPE_GESTURE_DRAG);
}

/* The bar's own handler; 0: none. */
static gulong own_handler(gpointer gesture, GtkWidget *widget)
{
	return g_signal_handler_find(gesture, G_SIGNAL_MATCH_ID | G_SIGNAL_MATCH_DATA,
				     update_signal(), 0, NULL, NULL, widget);
}

/* Tabs of closed pages stay for a moment, and the bar counts them among the places. */
static bool is_closing(GtkWidget *box)
{
	AdwTabBar *bar = ADW_TAB_BAR(gtk_widget_get_ancestor(box, ADW_TYPE_TAB_BAR));
	int tabs = 0;

	for (GtkWidget *child = gtk_widget_get_first_child(box); child;
	     child = gtk_widget_get_next_sibling(child))
		tabs += strcmp(gtk_widget_get_css_name(child), "tabboxchild") == 0;
	return bar && tabs > adw_tab_view_get_n_pages(adw_tab_bar_get_view(bar));
}

/* @own is blocked except here. */
static void update(GtkGestureDrag *gesture, double dx, double dy, gpointer unused)
{
	GtkWidget *widget = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(gesture));
	gulong own = own_handler(gesture, widget);
	double x, y;

	(void)unused;
	if (!gtk_gesture_drag_get_start_point(gesture, &x, &y) || is_closing(widget))
		return;
	g_signal_handlers_block_by_func(gesture, update, NULL);
	g_signal_handler_unblock(gesture, own);
	g_signal_emit(gesture, update_signal(), 0,
		      inside(x, dx, gtk_widget_get_width(widget)),
		      inside(y, dy, gtk_widget_get_height(widget)));
	g_signal_handler_block(gesture, own);
	g_signal_handlers_unblock_by_func(gesture, update, NULL);
}

/* The drag ends where the tab is now, as long as the place is one of the view. */
static gboolean end_drag(GtkEventController *gesture)
{
	gtk_event_controller_reset(gesture);
	return FALSE; /* other handlers close the page */
}

static void keep(GtkWidget *widget, AdwTabView *view)
{
	GListModel *controllers = gtk_widget_observe_controllers(widget);

	for (guint i = 0; i < g_list_model_get_n_items(controllers); i++) {
		gpointer each = g_list_model_get_item(controllers, i);
		gulong own = GTK_IS_GESTURE_DRAG(each) ? own_handler(each, widget) : 0;

		if (own) {
			g_signal_handler_block(each, own);
			g_signal_connect(each, "drag-update", G_CALLBACK(update), NULL);
			g_signal_connect_object(view, "close-page", G_CALLBACK(end_drag), each,
						G_CONNECT_SWAPPED);
		}
		g_object_unref(each);
	}
	g_object_unref(controllers);
}

static void keep_inside(GtkWidget *widget, AdwTabView *view)
{
	keep(widget, view);
	for (GtkWidget *child = gtk_widget_get_first_child(widget); child;
	     child = gtk_widget_get_next_sibling(child))
		keep_inside(child, view);
}

void tab_home_make(AdwTabBar *bar)
{
	keep_inside(GTK_WIDGET(bar), adw_tab_bar_get_view(bar));
}
