/* SPDX-License-Identifier: MIT
 *
 * window_find - the find bar in its window: where it begins, what it marks.
 */
#include "editor-gtk/window_inside.h"

#include "editor-gtk/find.h"
#include "editor-gtk/find_bar.h"

static LadderFindBar *bar_of(LadderWindow *window)
{
	return LADDER_FIND_BAR(gtk_widget_get_first_child(GTK_WIDGET(window->find_place)));
}

/* The hit it stands on is marked on its sheet. */
static void mark_hit(LadderWindow *window)
{
	LadderFindBar *bar = bar_of(window);
	const struct find *find = ladder_find_bar_find(bar);
	const int current = ladder_find_bar_current(bar);
	LadderGridView *sheet = tabs_sheet(window);
	const struct find_hit *hit;

	if (!sheet)
		return;
	hit = find && current >= 0 ? find->hit->pdata[current] : NULL;
	if (hit && hit->pou == ladder_grid_view_pou(sheet))
		ladder_grid_view_set_found(sheet, hit->rung, hit->row, hit->col);
	else
		ladder_grid_view_set_found(sheet, -1, 0, 0);
}

static void closed(LadderWindow *window)
{
	LadderGridView *sheet = tabs_sheet(window);

	if (!sheet)
		return;
	ladder_grid_view_set_found(sheet, -1, 0, 0);
	gtk_widget_grab_focus(GTK_WIDGET(sheet));
}

static void tell_place(LadderWindow *window)
{
	LadderGridView *sheet = tabs_sheet(window);
	struct grid_cursor cursor;

	if (!sheet)
		return;
	cursor = ladder_grid_view_cursor(sheet);
	ladder_find_bar_set_place(bar_of(window), ladder_grid_view_pou(sheet), cursor.rung,
				  cursor.row, cursor.col);
}

void window_find(LadderWindow *window, enum verb verb)
{
	LadderFindBar *bar = bar_of(window);

	tell_place(window);
	if (verb == VERB_find || verb == VERB_replace)
		ladder_find_bar_open(bar, verb == VERB_replace, NULL);
	else
		ladder_find_bar_next(bar, verb == VERB_find_previous);
	mark_hit(window);
}

void window_find_init(LadderWindow *window)
{
	GtkWidget *bar = ladder_find_bar_new();

	gtk_box_append(window->find_place, bar);
	ladder_find_bar_set_document(LADDER_FIND_BAR(bar), window->document);
	g_signal_connect_object(bar, "hits-changed", G_CALLBACK(mark_hit), window,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(bar, "closed", G_CALLBACK(closed), window,
				G_CONNECT_SWAPPED);
}
