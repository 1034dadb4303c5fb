/* SPDX-License-Identifier: MIT
 *
 * window_tabs - the tabs of a window: a sheet or a list a POU, symbols, a damaged file.
 *
 * A page knows its POU by name, since numbers change when one comes or goes.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/kit/cells.h"
#include "editor-gtk/window/sfc_page.h"
#include "editor-gtk/document/disk.h"
#include "editor-gtk/iomap/iomap_view.h"
#include "editor-gtk/panels/panels.h"
#include "editor-gtk/kit/gtk48/slow_bar.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/panels/symbols_view.h"
#include "editor-gtk/kit/gtk48/tab_home.h"
#include "editor-gtk/text/text_view.h"
#include "editor-gtk/window/welcome.h"

#include <string.h>

#define OPEN_MOST 8 /* POUs that are opened by themselves                      */

/* ---- what a page is ---- */

/* The widget inside of scrolling. */
static GtkWidget *inside(GtkWidget *child)
{
	return GTK_IS_SCROLLED_WINDOW(child) ?
	       gtk_scrolled_window_get_child(GTK_SCROLLED_WINDOW(child)) : child;
}

GtkWidget *tabs_content(AdwTabPage *page)
{
	return inside(adw_tab_page_get_child(page));
}

static const char *name_of(AdwTabPage *page)
{
	return g_object_get_data(G_OBJECT(page), "name");
}

static void set_name(AdwTabPage *page, const char *name, const char *title)
{
	g_object_set_data_full(G_OBJECT(page), "name", g_strdup(name), g_free);
	adw_tab_page_set_title(page, title);
}

static AdwTabPage *find_page(LadderWindow *window, const char *name)
{
	for (int i = 0; i < adw_tab_view_get_n_pages(window->tabs); i++) {
		AdwTabPage *page = adw_tab_view_get_nth_page(window->tabs, i);

		if (g_strcmp0(name_of(page), name) == 0)
			return page;
	}
	return NULL;
}

static int pou_number(const struct project *project, const char *name)
{
	return project ? project_find_pou(project, name, strlen(name)) : -1;
}

/* Of the page that is seen; NULL: there is none. */
static GtkWidget *seen(LadderWindow *window)
{
	GtkWidget *older = window_older_page(window);
	AdwTabPage *page = adw_tab_view_get_selected_page(window->tabs);

	return older ? inside(older) : page ? tabs_content(page) : NULL;
}

LadderGridView *tabs_seen_sheet(LadderWindow *window)
{
	GtkWidget *widget = seen(window);

	/* Of a chart the rungs below it, while somebody works on them. */
	if (widget && LADDER_IS_SFC_PAGE(widget)) {
		LadderGridView *rungs = ladder_sfc_page_rungs(LADDER_SFC_PAGE(widget));
		GtkWidget *focus = gtk_window_get_focus(GTK_WINDOW(window));

		return rungs && focus && (focus == GTK_WIDGET(rungs) ||
			gtk_widget_is_ancestor(focus, GTK_WIDGET(rungs))) ? rungs : NULL;
	}
	return widget && LADDER_IS_GRID_VIEW(widget) ? LADDER_GRID_VIEW(widget) : NULL;
}

LadderSfcView *tabs_seen_chart(LadderWindow *window)
{
	GtkWidget *widget = seen(window);

	return widget && LADDER_IS_SFC_PAGE(widget) ?
	       ladder_sfc_page_chart(LADDER_SFC_PAGE(widget)) : NULL;
}

LadderGridView *tabs_sheet(LadderWindow *window)
{
	return window_older_page(window) ? NULL : tabs_seen_sheet(window);
}

LadderSfcView *tabs_chart(LadderWindow *window)
{
	return window_older_page(window) ? NULL : tabs_seen_chart(window);
}

LadderFileView *tabs_file(LadderWindow *window)
{
	AdwTabPage *page = adw_tab_view_get_selected_page(window->tabs);
	GtkWidget *widget = page ? tabs_content(page) : NULL;

	return widget && LADDER_IS_FILE_VIEW(widget) ? LADDER_FILE_VIEW(widget) : NULL;
}

bool tabs_take_typed(LadderWindow *window)
{
	GtkWidget *focus = gtk_window_get_focus(GTK_WINDOW(window));
	GtkWidget *text = focus ? gtk_widget_get_ancestor(focus, LADDER_TYPE_TEXT_VIEW) : NULL;

	if (text)
		ladder_text_view_take(LADDER_TEXT_VIEW(text));
	return cells_take(focus);
}

GPtrArray *tabs_unsaved(LadderWindow *window)
{
	GPtrArray *files = g_ptr_array_new();

	for (int i = 0; i < adw_tab_view_get_n_pages(window->tabs); i++) {
		GtkWidget *widget = tabs_content(adw_tab_view_get_nth_page(window->tabs, i));

		if (LADDER_IS_FILE_VIEW(widget) && !ladder_side_file_is_saved(
			    ladder_file_view_file(LADDER_FILE_VIEW(widget))))
			g_ptr_array_add(files, ladder_file_view_file(
				LADDER_FILE_VIEW(widget)));
	}
	return files;
}

void tabs_each_file(LadderWindow *window, void (*act)(gpointer file))
{
	for (int i = 0; i < adw_tab_view_get_n_pages(window->tabs); i++) {
		GtkWidget *widget = tabs_content(adw_tab_view_get_nth_page(window->tabs, i));

		if (LADDER_IS_FILE_VIEW(widget))
			act(ladder_file_view_file(LADDER_FILE_VIEW(widget)));
	}
}

/* ---- status ---- */

static void told(LadderWindow *window, const char *text)
{
	ladder_window_tell(window, text);
}

static void page_selected(LadderWindow *window)
{
	LadderGridView *sheet = tabs_sheet(window);
	GtkWidget *list = sheet ? below_made(window, "list") : NULL;

	tabs_show_place(window);
	window_show_state(window);
	ladder_window_tell(window, "");
	if (list)
		ladder_code_view_set_pou(list, ladder_grid_view_pou(sheet));
	tabs_enter_program(window);
}

/* ---- making pages ---- */

static AdwTabPage *insert_page(LadderWindow *window, int at, GtkWidget *child,
			       const char *name, const char *title)
{
	AdwTabPage *page = adw_tab_view_insert(window->tabs, child, at);

	set_name(page, name, title);
	place_follow(window, page);
	spoken_parts(child);
	spoken_parts(GTK_WIDGET(window->tab_bar));
	return page;
}

static AdwTabPage *add_page(LadderWindow *window, GtkWidget *child, const char *name,
			    const char *title)
{
	return insert_page(window, adw_tab_view_get_n_pages(window->tabs), child, name,
			   title);
}

/* What a sheet or a chart tells. */
static void listen(LadderWindow *window, gpointer view)
{
	g_signal_connect_object(view, "cursor-moved", G_CALLBACK(tabs_show_place), window,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(view, "cursor-moved", G_CALLBACK(names_follow), window,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(view, "zoom-changed", G_CALLBACK(tabs_show_place), window,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(view, "told", G_CALLBACK(told), window, G_CONNECT_SWAPPED);
}

static GtkWidget *new_sheet(LadderWindow *window, LadderDocument *document, int pou)
{
	GtkWidget *sheet = ladder_grid_view_new(document, pou);
	GtkWidget *scroller = gtk_scrolled_window_new();

	ladder_grid_view_set_sim(LADDER_GRID_VIEW(sheet), window->sim);
	listen(window, sheet);
	g_signal_connect_object(sheet, "cursor-moved", G_CALLBACK(window_follow_original),
				window, G_CONNECT_SWAPPED);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), sheet);
	slow_bar_make(GTK_SCROLLED_WINDOW(scroller));
	return scroller;
}

static GtkWidget *new_chart(LadderWindow *window, LadderDocument *document, int pou)
{
	GtkWidget *page = ladder_sfc_page_new(document, pou, window->sim);

	listen(window, ladder_sfc_page_chart(LADDER_SFC_PAGE(page)));
	return page;
}

GtkWidget *tabs_page_new(LadderWindow *window, LadderDocument *document, int pou)
{
	const struct project *project = ladder_document_project(document);
	GtkWidget *text;

	if (project->pou[pou].language == LANGUAGE_LD)
		return new_sheet(window, document, pou);
	if (project->pou[pou].sfc)
		return new_chart(window, document, pou);
	text = ladder_text_view_new(document, pou);
	ladder_text_view_set_sim(LADDER_TEXT_VIEW(text), window->sim);
	return text;
}

/* Behind those that come before it in the file, where it was before it was closed. */
static int place_of(LadderWindow *window, const struct project *project, int pou)
{
	int at = adw_tab_view_get_n_pages(window->tabs);

	while (at > 0) {
		const char *name = name_of(adw_tab_view_get_nth_page(window->tabs, at - 1));
		const int number = name[0] == ' ' ? -1 : pou_number(project, name);

		if (number >= 0 && number < pou)
			break;
		at--;
	}
	return at;
}

static AdwTabPage *open_pou(LadderWindow *window, int pou)
{
	const struct project *project = ladder_document_project(window->document);
	const char *name = project_text(project, project->pou[pou].name);

	return insert_page(window, place_of(window, project, pou),
			   tabs_page_new(window, window->document, pou), name, name);
}

/* What is opened is of the program that runs. */
static void select_page(LadderWindow *window, AdwTabPage *page)
{
	if (window_older_page(window))
		ladder_sim_show_now(window->sim);
	adw_tab_view_set_selected_page(window->tabs, page);
}

void tabs_show(LadderWindow *window, int pou)
{
	const struct project *project = ladder_document_project(window->document);
	AdwTabPage *page;

	if (!project || pou < 0 || pou >= project->pou_count)
		return;
	page = find_page(window, project_text(project, project->pou[pou].name));
	if (!page)
		page = open_pou(window, pou);
	select_page(window, page);
}

/* A table of thousands of symbols is not made before somebody looks at it. */
static GtkWidget *symbols_in(AdwBin *place, LadderWindow *window)
{
	GtkWidget *symbols = adw_bin_get_child(place);

	if (!symbols) {
		symbols = ladder_symbols_view_new();
		ladder_symbols_view_set_document(LADDER_SYMBOLS_VIEW(symbols),
						 window->document);
		adw_bin_set_child(place, symbols);
		spoken_parts(symbols);
	}
	return symbols;
}

static void symbols_seen(AdwBin *place, LadderWindow *window)
{
	symbols_in(place, window);
}

static GtkWidget *symbols_page(LadderWindow *window)
{
	GtkWidget *place = adw_bin_new();

	g_signal_connect(place, "map", G_CALLBACK(symbols_seen), window);
	return place;
}

/* Names of POUs have no blank before them. */
static AdwTabPage *open_widget(LadderWindow *window, const char *name)
{
	char *key = g_strdup_printf(" %s", name);
	AdwTabPage *page = find_page(window, key);

	if (!page && strcmp(name, "symbols") == 0)
		page = add_page(window, symbols_page(window), key, _("Symbols"));
	else if (!page && strcmp(name, "welcome") == 0)
		page = add_page(window, welcome_new(), key, _("Welcome"));
	else if (!page && strcmp(name, "text") == 0)
		page = add_page(window, ladder_text_view_new(window->document, -1), key,
				_("Text of the file"));
	g_free(key);
	return page;
}

static void show_file_state(AdwTabPage *page, LadderSideFile *file)
{
	char *name = ladder_side_file_name(file);
	char *title = g_strdup_printf("%s%s",
				      ladder_side_file_differs(file) ? "• " : "", name);

	adw_tab_page_set_title(page, title);
	g_free(title);
	g_free(name);
}

static AdwTabPage *find_file_page(LadderWindow *window, const char *path)
{
	for (int i = 0; i < adw_tab_view_get_n_pages(window->tabs); i++) {
		AdwTabPage *page = adw_tab_view_get_nth_page(window->tabs, i);
		GtkWidget *widget = tabs_content(page);

		if (LADDER_IS_FILE_VIEW(widget) &&
		    disk_same(path, ladder_side_file_path(
			    ladder_file_view_file(LADDER_FILE_VIEW(widget)))))
			return page;
	}
	return NULL;
}

LadderFileView *tabs_find_file(LadderWindow *window, const char *path)
{
	AdwTabPage *page = find_file_page(window, path);

	return page ? LADDER_FILE_VIEW(tabs_content(page)) : NULL;
}

/* Nothing is undone out of sight. */
static void show_undone(LadderSideFile *file, LadderWindow *window)
{
	tabs_show_file(window, ladder_side_file_path(file));
}

void tabs_put_file(LadderWindow *window, LadderSideFile *file)
{
	char *name = ladder_side_file_name(file);
	AdwTabPage *page = add_page(window, ladder_file_view_new(file,
		g_str_has_suffix(name, ".io") ? ladder_iomap_view_new : NULL), " file", name);

	g_signal_connect_object(file, "state-changed", G_CALLBACK(show_file_state), page,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(file, "undone", G_CALLBACK(show_undone), window, 0);
	show_file_state(page, file);
	draft_keep_file(file, window->document);
	select_page(window, page);
	g_free(name);
}

void tabs_show_file(LadderWindow *window, const char *path)
{
	AdwTabPage *page = find_file_page(window, path);
	GError *error = NULL;
	LadderSideFile *file;

	if (page) {
		select_page(window, page);
		return;
	}
	file = ladder_side_file_open(path, window->document, &error);
	if (file)
		tabs_put_file(window, file);
	else
		ladder_window_warn(window, error->message);
	g_clear_object(&file);
	g_clear_error(&error);
}

GtkWidget *tabs_show_widget(LadderWindow *window, const char *name)
{
	AdwTabPage *page = open_widget(window, name);

	if (!page)
		return NULL;
	select_page(window, page);
	return tabs_content(page);
}

/* A place in a rung, or a line of the POU's text. */
static void go_in_chart(LadderSfcPage *page, int rung, int row, int col)
{
	if (rung >= 0)
		ladder_sfc_page_show_rung(page, rung, row, col);
	else
		ladder_sfc_view_go_row(ladder_sfc_page_chart(page), row);
}

/* A declaration, with the keys there. */
static void go_in_symbols(LadderWindow *window, int table, int index)
{
	GtkWidget *place = tabs_show_widget(window, "symbols");
	LadderSymbolsView *symbols =
		LADDER_SYMBOLS_VIEW(symbols_in(ADW_BIN(place), window));

	if (ladder_symbols_view_show(symbols, table, index))
		ladder_symbols_view_enter(symbols);
}

void tabs_go(LadderWindow *window, int pou, int rung, int row, int col)
{
	LadderGridView *sheet;
	AdwTabPage *page;

	if (!ladder_document_project(window->document)) {
		GtkWidget *text = tabs_show_widget(window, "text");

		ladder_text_view_go(LADDER_TEXT_VIEW(text), rung + 1, col + 1);
		return;
	}
	if (pou < 0) {
		go_in_symbols(window, row, col);
		return;
	}
	tabs_show(window, pou);
	page = adw_tab_view_get_selected_page(window->tabs);
	sheet = tabs_sheet(window);
	if (page && LADDER_IS_SFC_PAGE(tabs_content(page)))
		go_in_chart(LADDER_SFC_PAGE(tabs_content(page)), rung, row, col);
	else if (sheet && ladder_grid_view_pou(sheet) == pou)
		ladder_grid_view_go(sheet, rung, row, col);
	else if (page && LADDER_IS_TEXT_VIEW(tabs_content(page)))
		ladder_text_view_go_here(LADDER_TEXT_VIEW(tabs_content(page)), row + 1, col + 1);
}

/* ---- when the project is another ---- */

static bool fits(GtkWidget *widget, const struct project *project, int pou)
{
	const bool ld = project->pou[pou].language == LANGUAGE_LD;

	if (project->pou[pou].sfc)
		return LADDER_IS_SFC_PAGE(widget);
	return ld ? LADDER_IS_GRID_VIEW(widget) : LADDER_IS_TEXT_VIEW(widget);
}

/* A page whose POU has another number, or is gone. @renamed: it may have another name. */
static bool update_page(AdwTabPage *page, const struct project *project, bool renamed)
{
	GtkWidget *widget = tabs_content(page);
	const char *name = name_of(page);
	int pou;

	if (strcmp(name, " welcome") == 0)
		return false; /* something was opened */
	if (LADDER_IS_FILE_VIEW(widget))
		return true; /* it is none of the project's */
	if (name[0] == ' ')
		return (strcmp(name, " text") == 0) == !project;
	pou = pou_number(project, name);
	if (pou < 0) {
		pou = LADDER_IS_GRID_VIEW(widget) ?
			ladder_grid_view_pou(LADDER_GRID_VIEW(widget)) :
			LADDER_IS_SFC_PAGE(widget) ? ladder_sfc_view_pou(
				ladder_sfc_page_chart(LADDER_SFC_PAGE(widget))) :
			ladder_text_view_pou(LADDER_TEXT_VIEW(widget));
		if (!renamed || pou >= project->pou_count || !fits(widget, project, pou))
			return false;
		set_name(page, project_text(project, project->pou[pou].name),
			 project_text(project, project->pou[pou].name));
	}
	if (!fits(widget, project, pou))
		return false;
	if (LADDER_IS_TEXT_VIEW(widget) &&
	    ladder_text_view_pou(LADDER_TEXT_VIEW(widget)) != pou)
		ladder_text_view_set_pou(LADDER_TEXT_VIEW(widget), pou);
	else if (LADDER_IS_GRID_VIEW(widget) &&
		 ladder_grid_view_pou(LADDER_GRID_VIEW(widget)) != pou)
		ladder_grid_view_set_pou(LADDER_GRID_VIEW(widget), pou);
	else if (LADDER_IS_SFC_PAGE(widget))
		ladder_sfc_page_set_pou(LADDER_SFC_PAGE(widget), pou);
	return true;
}

static bool has_pou_page(LadderWindow *window)
{
	for (int i = 0; i < adw_tab_view_get_n_pages(window->tabs); i++)
		if (name_of(adw_tab_view_get_nth_page(window->tabs, i))[0] != ' ')
			return true;
	return false;
}

/* Those that are none any more go. Who works beside them, in the tree, goes on there. */
static void update_pages(LadderWindow *window, const struct project *project)
{
	const bool renamed = project && project->pou_count == window->pou_count;
	GtkWidget *focus = gtk_window_get_focus(GTK_WINDOW(window));
	const bool beside = focus && !gtk_widget_is_ancestor(focus, GTK_WIDGET(window->tabs));

	window->pou_count = project ? project->pou_count : 0;
	for (int i = adw_tab_view_get_n_pages(window->tabs) - 1; i >= 0; i--) {
		AdwTabPage *page = adw_tab_view_get_nth_page(window->tabs, i);

		if (!update_page(page, project, renamed))
			adw_tab_view_close_page(window->tabs, page);
	}
	if (beside && adw_tab_view_get_n_pages(window->tabs))
		gtk_widget_grab_focus(focus);
}

void tabs_update(LadderWindow *window)
{
	const struct project *project = ladder_document_project(window->document);

	update_pages(window, project);
	if (!project) {
		tabs_show_widget(window, "text");
		return;
	}
	if (!has_pou_page(window)) {
		for (int i = 0; i < MIN(project->pou_count, OPEN_MOST); i++)
			if (!project->pou[i].included)
				open_pou(window, i);
		open_widget(window, "symbols");
		tabs_show(window, 0);
	}
	tabs_show_place(window);
}

/* The sheet of the empty project would go on as that of the first program, alone. */
void ladder_window_opened(LadderWindow *window)
{
	for (int i = adw_tab_view_get_n_pages(window->tabs) - 1; i >= 0; i--) {
		AdwTabPage *page = adw_tab_view_get_nth_page(window->tabs, i);

		if (!LADDER_IS_FILE_VIEW(tabs_content(page)))
			adw_tab_view_close_page(window->tabs, page);
	}
	g_clear_pointer(&window->origin, g_free);
	tabs_update(window);
}

void tabs_init(LadderWindow *window)
{
	/* Those keys go to the ends of a text or a rung. */
	adw_tab_view_remove_shortcuts(window->tabs, ADW_TAB_VIEW_SHORTCUT_CONTROL_HOME |
		ADW_TAB_VIEW_SHORTCUT_CONTROL_END |
		ADW_TAB_VIEW_SHORTCUT_CONTROL_SHIFT_HOME |
		ADW_TAB_VIEW_SHORTCUT_CONTROL_SHIFT_END |
		ADW_TAB_VIEW_SHORTCUT_CONTROL_PAGE_UP |
		ADW_TAB_VIEW_SHORTCUT_CONTROL_PAGE_DOWN);
	tab_home_make(window->tab_bar);
	g_signal_connect_object(window->document, "project-changed",
				G_CALLBACK(tabs_update), window, G_CONNECT_SWAPPED);
	g_signal_connect_object(window->tabs, "notify::selected-page",
				G_CALLBACK(page_selected), window, G_CONNECT_SWAPPED);
	tabs_init_closing(window);
	tabs_update(window);
}
