/* SPDX-License-Identifier: MIT
 *
 * window_enter - the page in front of a window gets the keys.
 */
#include "editor-gtk/window/window_inside.h"

/* NULL: there is none. */
static GtkWidget *in_front(LadderWindow *window)
{
	GtkWidget *older = window_older_page(window);
	AdwTabPage *page = adw_tab_view_get_selected_page(window->tabs);

	return older ? older : page ? adw_tab_page_get_child(page) : NULL;
}

bool tabs_enter_program(LadderWindow *window)
{
	LadderGridView *sheet = tabs_seen_sheet(window);
	LadderSfcView *chart = tabs_seen_chart(window);
	GtkWidget *page = in_front(window);

	if (sheet)
		gtk_widget_grab_focus(GTK_WIDGET(sheet));
	else if (chart)
		gtk_widget_grab_focus(GTK_WIDGET(chart));
	else if (LADDER_IS_TEXT_VIEW(page))
		gtk_widget_grab_focus(page);
	else
		return false;
	return true;
}

void tabs_enter(LadderWindow *window)
{
	GtkWidget *focus = gtk_window_get_focus(GTK_WINDOW(window)), *page = in_front(window);
	const bool inside = focus && page && gtk_widget_is_ancestor(focus, page);

	/* A cell that is edited goes on. */
	if (page && !inside && !tabs_enter_program(window))
		gtk_widget_child_focus(page, GTK_DIR_TAB_FORWARD);
}
