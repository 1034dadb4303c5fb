/* SPDX-License-Identifier: MIT
 *
 * window_find - the find bar in its window: where it begins, what it marks.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/window/sfc_page.h"
#include "editor-gtk/document/find.h"
#include "editor-gtk/panels/find_bar.h"
#include "editor-gtk/panels/symbols_view.h"

static LadderFindBar *bar_of(LadderWindow *window)
{
	return LADDER_FIND_BAR(gtk_widget_get_first_child(GTK_WIDGET(window->find_place)));
}

/* NULL: it stands on none. */
static const struct find_hit *hit_of(LadderWindow *window)
{
	LadderFindBar *bar = bar_of(window);
	const struct find *find = ladder_find_bar_find(bar);
	const int current = ladder_find_bar_current(bar);

	return find && current >= 0 ? find->hit->pdata[current] : NULL;
}

/* The sheet in front; of a chart the rungs below it, also while the bar has the keys. */
static LadderGridView *sheet_of(LadderWindow *window)
{
	LadderGridView *sheet = tabs_sheet(window);
	AdwTabPage *page = adw_tab_view_get_selected_page(window->tabs);

	if (sheet || !tabs_chart(window) || !LADDER_IS_SFC_PAGE(tabs_content(page)))
		return sheet;
	return ladder_sfc_page_rungs(LADDER_SFC_PAGE(tabs_content(page)));
}

/* The hit it stands on is marked on its sheet. */
static void mark_hit(LadderWindow *window)
{
	LadderGridView *sheet = sheet_of(window);
	LadderSfcView *chart = tabs_chart(window);
	const struct find_hit *hit = hit_of(window);

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

/* NULL: there is no table of symbols in front. */
static LadderSymbolsView *symbols_of(AdwTabPage *page)
{
	GtkWidget *place = page ? tabs_content(page) : NULL;
	GtkWidget *symbols = ADW_IS_BIN(place) ? adw_bin_get_child(ADW_BIN(place)) : NULL;

	return LADDER_IS_SYMBOLS_VIEW(symbols) ? LADDER_SYMBOLS_VIEW(symbols) : NULL;
}

/* To where the hit is; else to what is in front. */
static void give_keys(LadderWindow *window)
{
	const struct find_hit *hit = hit_of(window);
	LadderSfcView *chart = tabs_chart(window);
	LadderGridView *sheet = chart && (!hit || hit->rung < 0) ? NULL : sheet_of(window);
	AdwTabPage *page = adw_tab_view_get_selected_page(window->tabs);

	if (sheet || chart)
		gtk_widget_grab_focus(sheet ? GTK_WIDGET(sheet) : GTK_WIDGET(chart));
	else if (page)
		gtk_widget_child_focus(tabs_content(page), GTK_DIR_TAB_FORWARD);
	if (symbols_of(page))
		ladder_symbols_view_enter(symbols_of(page));
}

static void closed(LadderWindow *window)
{
	LadderGridView *sheet = sheet_of(window);
	LadderSfcView *chart = tabs_chart(window);

	if (chart)
		ladder_sfc_view_set_found(chart, -1);
	if (sheet)
		ladder_grid_view_set_found(sheet, -1, 0, 0);
	if (ladder_find_bar_has_keys(bar_of(window)))
		give_keys(window);
}

/* The cursor of a chart still is where find left it. */
static bool is_at_hit(LadderWindow *window, LadderSfcView *chart)
{
	const int *place = ladder_find_bar_place(bar_of(window));

	return place[0] == ladder_sfc_view_pou(chart) && place[1] < 0 &&
	       ladder_sfc_view_is_at(chart, place[2]);
}

static void tell_place(LadderWindow *window)
{
	LadderGridView *sheet = tabs_sheet(window);
	LadderSfcView *chart = sheet ? NULL : tabs_chart(window);
	struct grid_cursor cursor;

	if (ladder_find_bar_has_keys(bar_of(window)))
		return; /* from hit to hit */
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

bool window_find_close(LadderWindow *window)
{
	LadderFindBar *bar = bar_of(window);
	const bool open = ladder_find_bar_is_open(bar);

	ladder_find_bar_close(bar);
	return open;
}

/* Esc that nobody else had a use for. */
static gboolean key_pressed(GtkEventControllerKey *controller, guint key, guint code,
			    GdkModifierType state, LadderWindow *window)
{
	(void)controller;
	(void)code;
	return key == GDK_KEY_Escape && !(state & gtk_accelerator_get_default_mod_mask()) &&
	       window_find_close(window);
}

void window_find_init(LadderWindow *window)
{
	GtkWidget *bar = ladder_find_bar_new();
	GtkEventController *keys = gtk_event_controller_key_new();

	gtk_box_append(window->find_place, bar);
	ladder_find_bar_set_document(LADDER_FIND_BAR(bar), window->document);
	g_signal_connect_object(bar, "hits-changed", G_CALLBACK(mark_hit), window,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(bar, "closed", G_CALLBACK(closed), window,
				G_CONNECT_SWAPPED);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), window);
	gtk_widget_add_controller(GTK_WIDGET(window), keys);
}
