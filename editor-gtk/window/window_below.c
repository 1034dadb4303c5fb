/* SPDX-License-Identifier: MIT
 *
 * window_below - the panels below the sheets. Most are never looked at while a window is
 * open: one is made when it is first seen, or asked for. It knows how each is made, and not
 * what is in it.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/live/timing_view.h"
#include "editor-gtk/panels/panels.h"
#include "editor-gtk/panels/problems.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/panels/uses_view.h"
#include "editor-gtk/live/watch_view.h"

#include <string.h>

struct panel {
	const char *name, *title;
	GtkWidget *(*make)(LadderWindow *window);
	bool at_once; /* it hears from the beginning what it shows              */
};

/* ---- how each is made ---- */

/* A tab whose name tells how much is in it. */
static void show_problems_title(LadderWindow *window, LadderProblems *problems)
{
	GtkWidget *place = gtk_stack_get_child_by_name(window->below_stack, "problems");

	gtk_stack_page_set_title(gtk_stack_get_page(window->below_stack, place),
				 ladder_problems_title(problems));
}

static GtkWidget *make_problems(LadderWindow *window)
{
	GtkWidget *problems = ladder_problems_new();

	g_signal_connect_object(problems, "title-changed", G_CALLBACK(show_problems_title),
				window, G_CONNECT_SWAPPED);
	ladder_problems_set_document(LADDER_PROBLEMS(problems), window->document);
	return problems;
}

static GtkWidget *make_uses(LadderWindow *window)
{
	GtkWidget *uses = ladder_uses_view_new();

	ladder_uses_view_set_document(LADDER_USES_VIEW(uses), window->document);
	g_signal_connect_object(uses, "map", G_CALLBACK(names_uses_seen), window, 0);
	g_signal_connect_object(uses, "lost", G_CALLBACK(names_uses_seen), window, 0);
	return uses;
}

static GtkWidget *make_watch(LadderWindow *window)
{
	return ladder_watch_view_new(window->document, window->sim);
}

static GtkWidget *make_chart(LadderWindow *window)
{
	return ladder_timing_view_new(window->sim);
}

static GtkWidget *make_list(LadderWindow *window)
{
	GtkWidget *list = ladder_code_view_new(window->document);
	LadderGridView *sheet = tabs_sheet(window);

	if (sheet)
		ladder_code_view_set_pou(list, ladder_grid_view_pou(sheet));
	return list;
}

static GtkWidget *make_log(LadderWindow *window)
{
	return ladder_log_view_new(window->document);
}

static const struct panel panels[] = {
	{ "problems", N_("Problems"), make_problems, true },
	{ "uses", N_("Cross reference"), make_uses, false },
	{ "watch", N_("Status chart"), make_watch, false },
	{ "chart", N_("Timing chart"), make_chart, false },
	{ "scenarios", N_("Scenarios"), window_scenario_new, false },
	{ "list", N_("Instruction list"), make_list, false },
	{ "log", N_("Log"), make_log, true },
	{ "report", N_("Report"), window_report_new, false },
	{ "board", N_("Board"), window_board_new, false },
};

/* ---- where they stand ---- */

static AdwBin *place_of(LadderWindow *window, const char *name)
{
	return ADW_BIN(gtk_stack_get_child_by_name(window->below_stack, name));
}

GtkWidget *below_made(LadderWindow *window, const char *name)
{
	return adw_bin_get_child(place_of(window, name));
}

GtkWidget *below_panel(LadderWindow *window, const char *name)
{
	GtkWidget *panel = below_made(window, name);

	for (gsize i = 0; !panel && i < G_N_ELEMENTS(panels); i++) {
		if (strcmp(panels[i].name, name) != 0)
			continue;
		panel = panels[i].make(window);
		adw_bin_set_child(place_of(window, name), panel);
		spoken_parts(panel);
	}
	return panel;
}

GtkWidget *below_show(LadderWindow *window, const char *name)
{
	gtk_widget_set_visible(GTK_WIDGET(window->below), TRUE);
	gtk_stack_set_visible_child_name(window->below_stack, name);
	return below_panel(window, name);
}

void below_offer(LadderWindow *window, const char *name, bool offered)
{
	gtk_stack_page_set_visible(gtk_stack_get_page(window->below_stack,
		GTK_WIDGET(place_of(window, name))), offered);
}

/* ---- tabs that have no room ---- */

static void fill_more(GtkMenuButton *button, gpointer data)
{
	LadderWindow *window = data;
	GMenu *menu = g_menu_new();

	for (gsize i = 0; i < G_N_ELEMENTS(panels); i++) {
		GtkStackPage *page = gtk_stack_get_page(window->below_stack,
			GTK_WIDGET(place_of(window, panels[i].name)));
		GMenuItem *row = g_menu_item_new(gtk_stack_page_get_title(page), NULL);

		g_menu_item_set_action_and_target(row, "win.show-panel", "s", panels[i].name);
		if (gtk_stack_page_get_visible(page))
			g_menu_append_item(menu, row);
		g_object_unref(row);
	}
	gtk_menu_button_set_menu_model(button, G_MENU_MODEL(menu));
	g_object_unref(menu);
}

/* The tab of the panel that is shown is seen. */
static void reveal_tab(LadderWindow *window)
{
	GtkWidget *tab = gtk_widget_get_first_child(window->below_switcher);
	GtkAdjustment *along = gtk_scrolled_window_get_hadjustment(window->below_tabs);
	graphene_rect_t bounds;

	while (tab && !gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(tab)))
		tab = gtk_widget_get_next_sibling(tab);
	if (tab && gtk_widget_compute_bounds(tab, window->below_switcher, &bounds))
		gtk_adjustment_clamp_page(along, bounds.origin.x,
					  bounds.origin.x + bounds.size.width);
}

static void show_more(LadderWindow *window)
{
	GtkWidget *more = GTK_WIDGET(window->below_more);
	GtkAdjustment *along = gtk_scrolled_window_get_hadjustment(window->below_tabs);
	const int button = gtk_widget_get_visible(more) ? gtk_widget_get_width(more) : 0;

	gtk_widget_set_visible(more, gtk_adjustment_get_upper(along) >
			       gtk_adjustment_get_page_size(along) + button + 1);
	reveal_tab(window);
}

static gboolean look_at_room(gpointer data)
{
	LadderWindow *window = data;

	if (window->below_tabs) /* else it was closed meanwhile                  */
		show_more(window);
	g_object_unref(window);
	return G_SOURCE_REMOVE;
}

/* Nothing may be shown or hidden while the window gives out its room. */
static void room_changed(LadderWindow *window)
{
	g_idle_add(look_at_room, g_object_ref(window));
}

static void init_more(LadderWindow *window)
{
	GtkAdjustment *along = gtk_scrolled_window_get_hadjustment(window->below_tabs);

	gtk_menu_button_set_create_popup_func(window->below_more, fill_more, window, NULL);
	g_signal_connect_object(along, "changed", G_CALLBACK(room_changed), window,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(window->below_stack, "notify::visible-child",
				G_CALLBACK(room_changed), window, G_CONNECT_SWAPPED);
}

static void seen(GtkWidget *place, const struct panel *panel)
{
	below_panel(LADDER_WINDOW(gtk_widget_get_root(place)), panel->name);
}

void below_init(LadderWindow *window)
{
	for (gsize i = 0; i < G_N_ELEMENTS(panels); i++) {
		GtkWidget *place = adw_bin_new();

		gtk_stack_add_titled(window->below_stack, place, panels[i].name,
				     _(panels[i].title));
		g_signal_connect(place, "map", G_CALLBACK(seen), (gpointer)&panels[i]);
		if (panels[i].at_once)
			below_panel(window, panels[i].name);
	}
	below_offer(window, "report", false);
	init_more(window);
}
