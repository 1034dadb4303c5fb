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
	LadderSfcView *chart = tabs_chart(window);
	const struct find_hit *hit = find && current >= 0 ? find->hit->pdata[current] :
				     NULL;

	if (chart)
		ladder_sfc_view_set_found(chart, hit && hit->rung < 0 &&
			hit->pou == ladder_sfc_view_pou(chart) ? hit->row : -1);
	if (!sheet)
		return;
	if (hit && hit->rung >= 0 && hit->pou == ladder_grid_view_pou(sheet))
		ladder_grid_view_set_found(sheet, hit->rung - ladder_grid_view_first(sheet),
					   hit->row, hit->col);
	else
		ladder_grid_view_set_found(sheet, -1, 0, 0);
}

static void closed(LadderWindow *window)
{
	LadderGridView *sheet = tabs_sheet(window);
	LadderSfcView *chart = tabs_chart(window);

	if (chart)
		ladder_sfc_view_set_found(chart, -1);
	if (sheet)
		ladder_grid_view_set_found(sheet, -1, 0, 0);
	if (sheet || chart)
		gtk_widget_grab_focus(sheet ? GTK_WIDGET(sheet) : GTK_WIDGET(chart));
}

/* The cursor of a chart still is where find left it. */
static bool is_at_hit(LadderWindow *window, LadderSfcView *chart)
{
	const struct find *find = ladder_find_bar_find(bar_of(window));
	const int current = ladder_find_bar_current(bar_of(window));
	const struct find_hit *hit = find && current >= 0 ? find->hit->pdata[current] :
				     NULL;

	return hit && hit->pou == ladder_sfc_view_pou(chart) && hit->rung < 0 &&
	       ladder_sfc_view_is_at(chart, hit->row);
}

static void tell_place(LadderWindow *window)
{
	LadderGridView *sheet = tabs_sheet(window);
	LadderSfcView *chart = sheet ? NULL : tabs_chart(window);
	struct grid_cursor cursor;

	if (chart && !is_at_hit(window, chart))
		ladder_find_bar_set_place(bar_of(window), ladder_sfc_view_pou(chart), -1,
					  ladder_sfc_view_row(chart), -1);
	if (!sheet)
		return;
	cursor = ladder_grid_view_cursor(sheet);
	ladder_find_bar_set_place(bar_of(window), ladder_grid_view_pou(sheet),
				  ladder_grid_view_first(sheet) + cursor.rung, cursor.row,
				  cursor.col);
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
