/* SPDX-License-Identifier: MIT
 *
 * below - the panels below the sheets; see below.h.
 */
#include "editor-gtk/window/below.h"

#include "editor-gtk/kit/gtk48/shrink.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/panels/problems.h"

#define PANEL_ROOM  195 /* px of a panel that is shown, if the sheets keep       */
#define HEAD_ROOM   48  /* px of a list above its rows and below them            */
#define ROW_MORE    4   /* px of a row, more than its letters                    */
#define SHEET_ROOM  180
#define SHEET_FIRST 620 /* px of the sheets before the window has a size         */

/* How to make the panel of a page of the stack. */
struct maker {
	below_make *make;
	gpointer part;
};

static AdwBin *place_of(struct below *below, const char *name)
{
	return ADW_BIN(gtk_stack_get_child_by_name(below->stack, name));
}

static GtkStackPage *page_of(struct below *below, const char *name)
{
	return gtk_stack_get_page(below->stack, GTK_WIDGET(place_of(below, name)));
}

GtkWidget *below_made(struct below *below, const char *name)
{
	return adw_bin_get_child(place_of(below, name));
}

static GtkWidget *panel_in(AdwBin *place)
{
	const struct maker *maker = g_object_get_data(G_OBJECT(place), "maker");

	if (!adw_bin_get_child(place)) {
		adw_bin_set_child(place, maker->make(maker->part));
		spoken_parts(adw_bin_get_child(place));
		shrink_buttons(adw_bin_get_child(place));
	}
	return adw_bin_get_child(place);
}

GtkWidget *below_panel(struct below *below, const char *name)
{
	return panel_in(place_of(below, name));
}

static void set_shown(struct below *below, bool shown)
{
	below->away = false;
	gtk_widget_set_visible(GTK_WIDGET(below->box), shown);
}

void below_toggle(struct below *below)
{
	set_shown(below, !gtk_widget_get_visible(GTK_WIDGET(below->box)));
}

bool below_is_wanted(const struct below *below)
{
	return below->away || gtk_widget_get_visible(GTK_WIDGET(below->box));
}

void below_leave(struct below *below, bool away)
{
	if (below->away == away || !below_is_wanted(below))
		return;
	set_shown(below, !away);
	below->away = away;
}

GtkWidget *below_show(struct below *below, const char *name)
{
	set_shown(below, true);
	gtk_stack_set_visible_child_name(below->stack, name);
	below_open(below);
	return below_panel(below, name);
}

void below_show_error(struct below *below)
{
	ladder_problems_show_error(LADDER_PROBLEMS(below_show(below, "problems")));
}

void below_offer(struct below *below, const char *name, bool offered)
{
	gtk_stack_page_set_visible(page_of(below, name), offered);
}

void below_set_title(struct below *below, const char *name, const char *title)
{
	gtk_stack_page_set_title(page_of(below, name), title);
}

/* Gives the panels @panel px if @sheet px are left for the sheets. */
static void make_room(struct below *below, int panel, int sheet)
{
	const int height = gtk_widget_get_height(GTK_WIDGET(below->paned));
	const int most = height ? MAX(height - panel, sheet) : SHEET_FIRST;

	if (gtk_paned_get_position(below->paned) > most)
		gtk_paned_set_position(below->paned, most);
}

void below_share_room(struct below *below, int panel, int sheets)
{
	const int height = gtk_widget_get_height(GTK_WIDGET(below->paned));

	make_room(below, panel, height * sheets / (sheets + 1));
}

/* A short list of problems needs no more than its rows. */
static int room_wanted(struct below *below)
{
	int rows, line, tabs;
	PangoLayout *layout;
	GtkWidget *problems = below_made(below, "problems"); /* none: its rows are being made, or none are needed yet */

	if (!problems || g_strcmp0(gtk_stack_get_visible_child_name(below->stack), "problems") != 0)
		return PANEL_ROOM;
	rows = ladder_problems_count(LADDER_PROBLEMS(problems), false);
	layout = gtk_widget_create_pango_layout(GTK_WIDGET(below->box), "X");
	pango_layout_get_pixel_size(layout, NULL, &line);
	g_object_unref(layout);
	gtk_widget_measure(GTK_WIDGET(below->tabs), GTK_ORIENTATION_VERTICAL, -1, NULL, &tabs,
			   NULL, NULL);
	return MIN(tabs + HEAD_ROOM + rows * (line + ROW_MORE), PANEL_ROOM);
}

void below_open(struct below *below)
{
	make_room(below, room_wanted(below), SHEET_ROOM);
}

/* Another tab was pressed. */
static void panel_changed(struct below *below)
{
	if (gtk_widget_get_mapped(GTK_WIDGET(below->box)))
		below_open(below);
}

void below_rest(struct below *below)
{
	const char *name = gtk_stack_get_visible_child_name(below->stack);

	if (g_strcmp0(name, "problems") == 0 &&
	    !ladder_problems_count(LADDER_PROBLEMS(below_panel(below, name)), false))
		gtk_paned_set_position(below->paned, G_MAXINT16);
}

void below_add(struct below *below, const char *name, const char *title, below_make *make,
	       gpointer part)
{
	GtkWidget *place = adw_bin_new();
	struct maker *maker = g_new(struct maker, 1);

	*maker = (struct maker){ make, part };
	g_object_set_data_full(G_OBJECT(place), "maker", maker, g_free);
	gtk_stack_add_titled(below->stack, place, name, _(title));
	g_signal_connect(place, "map", G_CALLBACK(panel_in), NULL);
}

/* ---- tabs that have no room ---- */

static void fill_more(GtkMenuButton *button, gpointer data)
{
	const struct below *below = data;
	GListModel *pages = G_LIST_MODEL(gtk_stack_get_pages(below->stack));
	GMenu *menu = g_menu_new();

	for (guint i = 0; i < g_list_model_get_n_items(pages); i++) {
		GtkStackPage *page = g_list_model_get_item(pages, i);
		GMenuItem *row = g_menu_item_new(gtk_stack_page_get_title(page), NULL);

		g_menu_item_set_action_and_target(row, "win.show-panel", "s",
						  gtk_stack_page_get_name(page));
		if (gtk_stack_page_get_visible(page))
			g_menu_append_item(menu, row);
		g_object_unref(row);
		g_object_unref(page);
	}
	gtk_menu_button_set_menu_model(button, G_MENU_MODEL(menu));
	g_object_unref(pages);
	g_object_unref(menu);
}

/* A tab that is cut by the edge is not drawn: it is in the menu. @full: not all have room. */
static void draw_whole_tabs(struct below *below, bool full)
{
	GtkAdjustment *along = gtk_scrolled_window_get_hadjustment(below->tabs);
	const double left = gtk_adjustment_get_value(along) - 1;
	const double right = left + gtk_adjustment_get_page_size(along) + 2;
	graphene_rect_t at;

	for (GtkWidget *tab = gtk_widget_get_first_child(below->switcher); tab;
	     tab = gtk_widget_get_next_sibling(tab)) {
		const bool whole = !full || (gtk_widget_compute_bounds(tab, below->switcher, &at) &&
			at.origin.x >= left && at.origin.x + at.size.width <= right);

		if (whole == gtk_widget_get_child_visible(tab))
			continue;
		gtk_widget_set_child_visible(tab, whole);
		if (whole) /* GTK lays out no tab that is not drawn */
			gtk_widget_queue_resize(tab);
	}
}

/* Scrolls as little as shows the tab of the current panel; the first tab drawn is whole. */
static void reveal_tab(struct below *below)
{
	GtkAdjustment *along = gtk_scrolled_window_get_hadjustment(below->tabs);
	GtkWidget *first = gtk_widget_get_first_child(below->switcher), *tab = first;
	graphene_rect_t at, from;

	while (tab && !gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(tab)))
		tab = gtk_widget_get_next_sibling(tab);
	if (!tab || !gtk_widget_compute_bounds(tab, below->switcher, &at))
		return;
	while (first != tab && gtk_widget_compute_bounds(first, below->switcher, &from) &&
	       at.origin.x + at.size.width - from.origin.x > gtk_adjustment_get_page_size(along))
		first = gtk_widget_get_next_sibling(first);
	if (gtk_widget_compute_bounds(first, below->switcher, &from))
		gtk_adjustment_set_value(along, from.origin.x);
}

static int widest_tab(struct below *below)
{
	int widest = 0;

	for (GtkWidget *tab = gtk_widget_get_first_child(below->switcher); tab;
	     tab = gtk_widget_get_next_sibling(tab))
		widest = MAX(widest, gtk_widget_get_width(tab));
	return widest;
}

static bool is_full(struct below *below)
{
	GtkWidget *more = GTK_WIDGET(below->more);
	GtkAdjustment *along = gtk_scrolled_window_get_hadjustment(below->tabs);
	const int button = gtk_widget_get_visible(more) ? gtk_widget_get_width(more) : 0;

	return gtk_widget_get_width(below->switcher) > gtk_adjustment_get_page_size(along) + button + 1;
}

static void show_more(struct below *below)
{
	const bool full = is_full(below);

	gtk_widget_set_visible(GTK_WIDGET(below->more), full);
	/* Room to scroll the last tab to where a tab begins. */
	gtk_widget_set_margin_end(below->switcher, full ? widest_tab(below) : 0);
	reveal_tab(below);
	draw_whole_tabs(below, full);
}

static gboolean look_at_room(gpointer data)
{
	struct below *below = data;

	if (below->tabs) /* NULL: the window was closed meanwhile              */
		show_more(below);
	g_object_unref(below->core->window);
	return G_SOURCE_REMOVE;
}

static gboolean look_at_tabs(gpointer data)
{
	struct below *below = data;

	if (below->tabs)
		draw_whole_tabs(below, is_full(below));
	g_object_unref(below->core->window);
	return G_SOURCE_REMOVE;
}

/* By the wheel over the tabs, or because another tab has the focus. */
static void scrolled(struct below *below)
{
	g_object_ref(below->core->window);
	g_idle_add_full(G_PRIORITY_HIGH_IDLE, look_at_tabs, below, NULL);
}

/* GTK forbids to show or hide widgets during layout, so it is done in an idle call. */
static void room_changed(struct below *below)
{
	g_object_ref(below->core->window);
	g_idle_add(look_at_room, below);
}

void below_init(struct below *below, struct core *core)
{
	GtkAdjustment *along = gtk_scrolled_window_get_hadjustment(below->tabs);

	below->core = core;
	core_on_press(below->switcher, G_CALLBACK(below_open), below);
	gtk_paned_set_position(below->paned, G_MAXINT16);
	gtk_menu_button_set_create_popup_func(below->more, fill_more, below, NULL);
	core_connect(core, along, "changed", G_CALLBACK(room_changed), below,
		     G_CONNECT_SWAPPED);
	core_connect(core, along, "value-changed", G_CALLBACK(scrolled), below, G_CONNECT_SWAPPED);
	core_connect(core, below->stack, "notify::visible-child",
		     G_CALLBACK(room_changed), below, G_CONNECT_SWAPPED);
	core_connect(core, below->stack, "notify::visible-child",
		     G_CALLBACK(panel_changed), below, G_CONNECT_SWAPPED);
}
