/* SPDX-License-Identifier: MIT
 *
 * finder - the find bar of a window; see finder.h.
 */
#include "editor-gtk/window/finder.h"

#include "editor-gtk/document/find.h"
#include "editor-gtk/panels/symbols_view.h"
#include "editor-gtk/window/front.h"

/* The current hit; NULL: none. */
static const struct find_hit *hit_of(struct finder *finder)
{
	LadderFindBar *bar = finder->bar;
	const struct find *find = ladder_find_bar_find(bar);
	const int current = ladder_find_bar_current(bar);

	return find && current >= 0 ? find->hit->pdata[current] : NULL;
}

/* The symbol table, if it is in front, else NULL. */
static LadderSymbolsView *symbols_of(AdwTabPage *page)
{
	GtkWidget *place = page ? page_content(page) : NULL;
	GtkWidget *symbols = ADW_IS_BIN(place) ? adw_bin_get_child(ADW_BIN(place)) : NULL;

	return LADDER_IS_SYMBOLS_VIEW(symbols) ? LADDER_SYMBOLS_VIEW(symbols) : NULL;
}

/* Marks the hits in what is in front; while the bar is closed, only the one that F3 went to. */
static void mark_hits(struct finder *finder)
{
	LadderFindBar *bar = finder->bar;
	const struct find_seen seen = { ladder_find_bar_find(bar), ladder_find_bar_current(bar),
					ladder_find_bar_is_open(bar) };
	LadderGridView *sheet = front_rungs(finder->core->front);
	LadderSfcView *chart = front_chart(finder->core->front);
	LadderFbdView *networks = front_networks(finder->core->front);
	LadderTextView *text = front_list(finder->core->front);
	LadderSymbolsView *symbols = symbols_of(front_tab(finder->core->front));

	if (networks)
		ladder_fbd_view_set_found(networks, &seen);
	if (chart)
		ladder_sfc_view_set_found(chart, &seen);
	if (sheet)
		ladder_grid_view_set_found(sheet, &seen);
	if (text)
		ladder_text_view_set_found(text, &seen);
	if (symbols)
		ladder_symbols_view_set_found(symbols, &seen);
}

/* Focuses the place of the hit, else the page in front. */
static void give_keys(struct finder *finder)
{
	const struct find_hit *hit = hit_of(finder);
	LadderSfcView *chart = front_chart(finder->core->front);
	LadderFbdView *networks = front_networks(finder->core->front);
	LadderGridView *sheet = chart && (!hit || hit->rung < 0) ? NULL :
				front_rungs(finder->core->front);
	AdwTabPage *page = front_tab(finder->core->front);

	if (networks)
		gtk_widget_grab_focus(GTK_WIDGET(networks));
	else if (sheet || chart)
		gtk_widget_grab_focus(sheet ? GTK_WIDGET(sheet) : GTK_WIDGET(chart));
	else if (page)
		gtk_widget_child_focus(page_content(page), GTK_DIR_TAB_FORWARD);
	if (symbols_of(page))
		ladder_symbols_view_enter(symbols_of(page));
}

static void closed(struct finder *finder)
{
	if (ladder_find_bar_has_keys(finder->bar))
		give_keys(finder);
}

/* Is the cursor of the chart at the current hit? */
static bool is_at_hit(struct finder *finder, LadderSfcView *chart)
{
	const int *place = ladder_find_bar_place(finder->bar);

	return place[0] == ladder_canvas_pou(LADDER_CANVAS(chart)) && place[1] < 0 &&
	       ladder_sfc_view_is_at(chart, place[2]);
}

/* The same of networks. */
static bool is_in_networks(struct finder *finder, LadderFbdView *networks)
{
	const int *place = ladder_find_bar_place(finder->bar);

	return place[0] == ladder_canvas_pou(LADDER_CANVAS(networks)) && place[1] < 0 &&
	       ladder_fbd_view_is_at(networks, place[2]);
}

/* The cursor of a text; in the table of symbols the first declaration is the next hit. */
static void tell_texts(struct finder *finder)
{
	LadderTextView *text = front_list(finder->core->front);
	const int *place = ladder_find_bar_place(finder->bar);
	const int pou = text ? ladder_text_view_pou(text) : -1;

	if (symbols_of(front_tab(finder->core->front)) && (!hit_of(finder) || place[0] >= 0))
		ladder_find_bar_set_place(finder->bar, -2, -1, -1, -1);
	if (text && (place[0] != pou || place[1] >= 0 || !ladder_text_view_is_at(text, place[2] + 1)))
		ladder_find_bar_set_place(finder->bar, pou, -1, ladder_text_view_row(text), -1);
}

static void tell_place(struct finder *finder)
{
	LadderGridView *sheet = front_sheet(finder->core->front);
	LadderSfcView *chart = sheet ? NULL : front_chart(finder->core->front);
	LadderFbdView *networks = front_networks(finder->core->front);
	struct grid_cursor cursor;

	if (ladder_find_bar_has_keys(finder->bar))
		return; /* the cursor moved from hit to hit */
	tell_texts(finder);
	if (networks && !is_in_networks(finder, networks))
		ladder_find_bar_set_place(finder->bar, ladder_canvas_pou(LADDER_CANVAS(networks)), -1,
					  ladder_fbd_view_row(networks), -1);
	if (chart && !is_at_hit(finder, chart))
		ladder_find_bar_set_place(finder->bar, ladder_canvas_pou(LADDER_CANVAS(chart)), -1,
					  ladder_sfc_view_row(chart), -1);
	if (!sheet)
		return;
	cursor = ladder_grid_view_cursor(sheet);
	ladder_find_bar_set_place(finder->bar, ladder_canvas_pou(LADDER_CANVAS(sheet)),
				  ladder_grid_view_first(sheet) + cursor.rung, cursor.row,
				  cursor.col);
}

void finder_do(struct finder *finder, enum verb verb)
{
	LadderFindBar *bar = finder->bar;

	tell_place(finder);
	if (verb == VERB_find || verb == VERB_replace)
		ladder_find_bar_open(bar, verb == VERB_replace, NULL);
	else
		ladder_find_bar_next(bar, verb == VERB_find_previous);
	mark_hits(finder);
}

bool finder_close(struct finder *finder)
{
	LadderFindBar *bar = finder->bar;
	const bool open = ladder_find_bar_is_open(bar);

	ladder_find_bar_close(bar);
	return open;
}

/* Esc closes the bar if no other widget used the key. */
static gboolean key_pressed(GtkEventControllerKey *controller, guint key, guint code,
			    GdkModifierType state, struct finder *finder)
{
	(void)controller;
	(void)code;
	return key == GDK_KEY_Escape && !(state & gtk_accelerator_get_default_mod_mask()) &&
	       finder_close(finder);
}

void finder_init(struct finder *finder, struct core *core)
{
	GtkWidget *bar = ladder_find_bar_new();
	GtkEventController *keys = gtk_event_controller_key_new();

	finder->core = core;
	finder->bar = LADDER_FIND_BAR(bar);
	gtk_box_append(finder->place, bar);
	ladder_find_bar_set_document(finder->bar, core->document);
	core_connect(core, bar, "hits-changed", G_CALLBACK(mark_hits), finder,
		     G_CONNECT_SWAPPED);
	core_connect(core, core->window, "page-changed", G_CALLBACK(mark_hits), finder,
		     G_CONNECT_SWAPPED);
	core_connect(core, bar, "closed", G_CALLBACK(closed), finder, G_CONNECT_SWAPPED);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), finder);
	gtk_widget_add_controller(GTK_WIDGET(core->window), keys);
}
