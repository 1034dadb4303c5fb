/* SPDX-License-Identifier: MIT
 *
 * tabs - the open pages of a window; see tabs.h.
 */
#include "editor-gtk/window/tabs.h"

#include "editor-gtk/canvas/canvas.h"
#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/draft.h"
#include "editor-gtk/document/type_edit.h"
#include "editor-gtk/iomap/iomap_view.h"
#include "editor-gtk/kit/gtk48/shrink.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tab_home.h"
#include "editor-gtk/kit/gtk48/tab_seen.h"
#include "editor-gtk/kit/gtk48/tab_title.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/panels/address_view.h"
#include "editor-gtk/panels/compare_view.h"
#include "editor-gtk/panels/device_view.h"
#include "editor-gtk/panels/preview_view.h"
#include "editor-gtk/panels/symbols_view.h"
#include "editor-gtk/panels/tasks_view.h"
#include "editor-gtk/panels/types_view.h"
#include "editor-gtk/window/ask.h"
#include "editor-gtk/window/below.h"
#include "editor-gtk/window/messages.h"
#include "editor-gtk/window/welcome.h"

#include <string.h>

#define OPEN_MOST 8 /* POUs that are opened with a file, at most               */

/* ---- open tabs ---- */

static AdwTabPage *nth(struct tabs *tabs, int index)
{
	return adw_tab_view_get_nth_page(tabs->view, index);
}

static AdwTabPage *find_page(struct tabs *tabs, const char *name)
{
	for (int i = 0; i < adw_tab_view_get_n_pages(tabs->view); i++)
		if (g_strcmp0(page_name(nth(tabs, i)), name) == 0)
			return nth(tabs, i);
	return NULL;
}

/* The open files beside the project, with a page or kept for undo. Caller unrefs. */
static GPtrArray *files_of(struct tabs *tabs)
{
	GPtrArray *files = g_ptr_array_new();

	for (guint i = 0; i < tabs->parts->len; i++)
		g_ptr_array_add(files, tabs->parts->pdata[i]);
	for (int i = 0; i < adw_tab_view_get_n_pages(tabs->view); i++) {
		LadderSideFile *file = page_file(nth(tabs, i));

		if (file && !g_ptr_array_find(files, file, NULL))
			g_ptr_array_add(files, file);
	}
	return files;
}

void tabs_each_file(struct tabs *tabs, void (*act)(gpointer file))
{
	GPtrArray *files = files_of(tabs);

	for (guint i = 0; i < files->len; i++)
		act(files->pdata[i]);
	g_ptr_array_unref(files);
}

GPtrArray *tabs_unsaved(struct tabs *tabs)
{
	GPtrArray *files = files_of(tabs);

	for (guint i = files->len; i-- > 0;)
		if (ladder_side_file_is_saved(files->pdata[i]))
			g_ptr_array_remove_index(files, i);
	return files;
}

static AdwTabPage *find_file_page(struct tabs *tabs, const char *path)
{
	for (int i = 0; i < adw_tab_view_get_n_pages(tabs->view); i++) {
		LadderSideFile *file = page_file(nth(tabs, i));

		if (file && disk_same(path, ladder_side_file_path(file)))
			return nth(tabs, i);
	}
	return NULL;
}

LadderFileView *tabs_find_file(struct tabs *tabs, const char *path)
{
	AdwTabPage *page = find_file_page(tabs, path);

	return page ? LADDER_FILE_VIEW(page_content(page)) : NULL;
}

/* ---- saving files beside the project ---- */

bool tabs_save_file(struct tabs *tabs, LadderSideFile *file)
{
	GError *error = NULL;
	const bool good = ladder_side_file_save(file, &error);

	if (good)
		messages_tell(tabs->core->messages, _("Saved"));
	else
		messages_warn(tabs->core->messages, error->message);
	g_clear_error(&error);
	return good;
}

bool tabs_save_files(struct tabs *tabs)
{
	GPtrArray *files = tabs_unsaved(tabs);
	bool good = true;

	for (guint i = 0; good && i < files->len; i++)
		good = tabs_save_file(tabs, files->pdata[i]);
	g_ptr_array_unref(files);
	return good;
}

bool tabs_save_parts(struct tabs *tabs)
{
	GPtrArray *files = tabs_unsaved(tabs);
	bool good = true;

	for (guint i = 0; good && i < files->len; i++)
		if (ladder_side_file_is_part(files->pdata[i]))
			good = tabs_save_file(tabs, files->pdata[i]);
	g_ptr_array_unref(files);
	return good;
}

/* ---- opening ---- */

static AdwTabPage *insert_page(struct tabs *tabs, int at, GtkWidget *child,
			       const char *name, const char *title)
{
	AdwTabPage *page = adw_tab_view_insert(tabs->view, child, at);

	page_set_name(page, name, title);
	if (page == adw_tab_view_get_selected_page(tabs->view)) /* the first has a name now */
		g_signal_emit_by_name(tabs->core->window, "page-changed");
	page_follow(tabs->core, page);
	spoken_parts(child);
	shrink_buttons(child);
	spoken_parts(GTK_WIDGET(tabs->core->front->tab_bar));
	return page;
}

static AdwTabPage *add_page(struct tabs *tabs, GtkWidget *child, const char *name,
			    const char *title)
{
	return insert_page(tabs, adw_tab_view_get_n_pages(tabs->view), child, name,
			   title);
}

/* Pages have the order of the file. */
static int place_of(struct tabs *tabs, const struct project *project, int pou)
{
	int at = adw_tab_view_get_n_pages(tabs->view);

	while (at > 0) {
		const char *name = page_name(nth(tabs, at - 1));
		const int number = name[0] == ' ' ? -1 :
				   project_find_pou(project, name, strlen(name));

		if (number >= 0 && number < pou)
			break;
		at--;
	}
	return at;
}

static AdwTabPage *open_pou(struct tabs *tabs, int pou)
{
	const struct project *project = ladder_document_project(tabs->core->document);
	const char *name = project_text(project, project->pou[pou].name);

	return insert_page(tabs, place_of(tabs, project, pou),
			   page_new(tabs->core, tabs->core->document, pou), name, name);
}

/* Shows the current program first, because the tabs belong to it. */
static void select_page(struct tabs *tabs, AdwTabPage *page)
{
	if (front_is_older(tabs->core->front))
		ladder_sim_show_now(tabs->core->sim);
	adw_tab_view_set_selected_page(tabs->view, page);
}

void tabs_show(struct tabs *tabs, int pou)
{
	const struct project *project = ladder_document_project(tabs->core->document);
	AdwTabPage *page;

	if (!project || pou < 0 || pou >= project->pou_count)
		return;
	page = find_page(tabs, project_text(project, project->pou[pou].name));
	if (!page)
		page = open_pou(tabs, pou);
	select_page(tabs, page);
}

static void title_shown(AdwTabPage *page)
{
	char *title = ladder_shown_page_title(LADDER_SHOWN_PAGE(page_content(page)));

	adw_tab_page_set_title(page, title);
	g_free(title);
}

/* One page shows POUs in other languages; the blank makes its name different from that of any POU. */
void tabs_show_as(struct tabs *tabs, int pou, enum pou_language to)
{
	AdwTabPage *page = find_page(tabs, " as");

	if (!page)
		page = add_page(tabs, ladder_shown_page_new(tabs->core, page_new_live), " as", "");
	ladder_shown_page_set(LADDER_SHOWN_PAGE(page_content(page)), pou, to);
	title_shown(page);
	select_page(tabs, page);
	front_enter(tabs->core->front);
}

/* Made when it is shown first: there may be thousands of symbols. */
static GtkWidget *symbols_in(AdwBin *place, struct tabs *tabs)
{
	GtkWidget *symbols = adw_bin_get_child(place);

	if (!symbols) {
		symbols = ladder_symbols_view_new();
		ladder_symbols_view_set_document(LADDER_SYMBOLS_VIEW(symbols),
						 tabs->core->document);
		adw_bin_set_child(place, symbols);
		spoken_parts(symbols);
		shrink_buttons(symbols);
	}
	return symbols;
}

static GtkWidget *symbols_page(struct tabs *tabs)
{
	GtkWidget *place = adw_bin_new();

	core_connect(tabs->core, place, "map", G_CALLBACK(symbols_in), tabs, 0);
	return place;
}

static GtkWidget *tasks_page(struct tabs *tabs)
{
	GtkWidget *tasks = ladder_tasks_view_new(tabs->core->document);

	ladder_tasks_view_follow(LADDER_TASKS_VIEW(tasks), tabs->core->sim);
	return tasks;
}

/* The blank makes the name different from that of any POU. */
static AdwTabPage *open_widget(struct tabs *tabs, const char *name)
{
	char *key = g_strdup_printf(" %s", name);
	AdwTabPage *page = find_page(tabs, key);

	if (!page && strcmp(name, "symbols") == 0)
		page = add_page(tabs, symbols_page(tabs), key, _("Symbols"));
	else if (!page && strcmp(name, "tasks") == 0)
		page = add_page(tabs, tasks_page(tabs), key, _("Tasks"));
	else if (!page && strcmp(name, "types") == 0)
		page = add_page(tabs, ladder_types_view_new(tabs->core->document), key,
				_("Data types"));
	else if (!page && strcmp(name, "addresses") == 0)
		page = add_page(tabs, ladder_address_view_new(tabs->core->document), key,
				_("Address map"));
	else if (!page && strcmp(name, "device") == 0)
		page = add_page(tabs, ladder_device_view_new(tabs->core->link), key,
				_("Connected board"));
	else if (!page && strcmp(name, "welcome") == 0)
		page = add_page(tabs, welcome_new(), key, _("Welcome"));
	else if (!page && strcmp(name, "compare") == 0)
		page = add_page(tabs, ladder_compare_view_new(tabs->core->document), key,
				_("Compare"));
	else if (!page && strcmp(name, "preview") == 0)
		page = add_page(tabs, ladder_preview_view_new(tabs->core->document,
			tabs->core->paper), key, _("Print preview"));
	else if (!page && strcmp(name, "text") == 0)
		page = add_page(tabs, ladder_text_view_new(tabs->core->document, -1), key,
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

/* Shows a file in which a step was undone; closes the page of one that is not made any more. */
static void show_undone(LadderSideFile *file, struct tabs *tabs)
{
	AdwTabPage *page = find_file_page(tabs, ladder_side_file_path(file));

	if (!ladder_side_file_is_nothing(file))
		tabs_show_file(tabs, ladder_side_file_path(file));
	else if (page)
		adw_tab_view_close_page(tabs->view, page);
}

/* Once for a file, which may get another page later. */
static void follow_file(struct tabs *tabs, LadderSideFile *file)
{
	if (g_object_get_data(G_OBJECT(file), "followed"))
		return;
	g_object_set_data(G_OBJECT(file), "followed", tabs);
	if (ladder_side_file_is_part(file))
		g_ptr_array_add(tabs->parts, g_object_ref(file));
	core_connect(tabs->core, file, "undone", G_CALLBACK(show_undone), tabs, 0);
	draft_keep_file(file, tabs->core->document);
}

static AdwTabPage *add_file(struct tabs *tabs, LadderSideFile *file)
{
	char *name = ladder_side_file_name(file);
	AdwTabPage *page = add_page(tabs, ladder_file_view_new(file,
		g_str_has_suffix(name, ".io") ? ladder_iomap_view_new : NULL), " file", name);

	g_signal_connect_object(file, "state-changed", G_CALLBACK(show_file_state), page,
				G_CONNECT_SWAPPED);
	show_file_state(page, file);
	follow_file(tabs, file);
	g_free(name);
	return page;
}

void tabs_put_file(struct tabs *tabs, LadderSideFile *file)
{
	select_page(tabs, add_file(tabs, file));
}

/* An edit of the project opened the file. */
static void file_opened(LadderDocument *document, LadderSideFile *file, struct tabs *tabs)
{
	(void)document;
	if (!find_file_page(tabs, ladder_side_file_path(file)))
		add_file(tabs, file);
}

void tabs_show_file(struct tabs *tabs, const char *path)
{
	AdwTabPage *page = find_file_page(tabs, path);
	GError *error = NULL;
	LadderSideFile *file;

	if (page) {
		select_page(tabs, page);
		return;
	}
	file = side_file_find(tabs->core->document, path);
	file = file ? g_object_ref(file) :
	       ladder_side_file_open(path, tabs->core->document, &error);
	if (file)
		tabs_put_file(tabs, file);
	else
		messages_warn(tabs->core->messages, error->message);
	g_clear_error(&error);
	g_clear_object(&file);
}

GtkWidget *tabs_show_widget(struct tabs *tabs, const char *name)
{
	AdwTabPage *page = open_widget(tabs, name);

	if (!page)
		return NULL;
	select_page(tabs, page);
	return page_content(page);
}

void tabs_show_task(struct tabs *tabs, const char *task)
{
	GtkWidget *page;

	if (!ladder_document_project(tabs->core->document)) {
		messages_toast(tabs->core->messages, _("The file cannot be read as a program. Correct its errors first"));
		return;
	}
	page = tabs_show_widget(tabs, "tasks");
	if (task)
		ladder_tasks_view_show(LADDER_TASKS_VIEW(page), task);
	else
		front_enter(tabs->core->front);
}

void tabs_new_task(struct tabs *tabs)
{
	tabs_show_task(tabs, NULL);
	if (ladder_document_project(tabs->core->document))
		gtk_widget_activate_action(tabs_show_widget(tabs, "tasks"), "tasks.add", NULL);
}

GtkWidget *tabs_find_widget(struct tabs *tabs, const char *name)
{
	char *key = g_strdup_printf(" %s", name);
	GtkWidget *content = page_content(find_page(tabs, key));

	g_free(key);
	return content;
}

void tabs_show_type(struct tabs *tabs, const char *name)
{
	GtkWidget *page;

	if (!ladder_document_project(tabs->core->document)) {
		messages_toast(tabs->core->messages, _("The file cannot be read as a program. Correct its errors first"));
		return;
	}
	page = tabs_show_widget(tabs, "types");
	if (name)
		ladder_types_view_show(LADDER_TYPES_VIEW(page),
				       type_find(tabs->core->document, name));
	ladder_types_view_enter(LADDER_TYPES_VIEW(page));
}

void tabs_show_value(struct tabs *tabs, const char *type, const char *value)
{
	tabs_show_type(tabs, type);
	if (ladder_document_project(tabs->core->document))
		ladder_types_view_enter_value(LADDER_TYPES_VIEW(tabs_show_widget(tabs, "types")),
					      value);
}

static void go_in_chart(LadderSfcPage *page, int rung, int row, int col)
{
	if (rung >= 0)
		ladder_sfc_page_show_rung(page, rung, row, col);
	else
		ladder_sfc_view_go_row(ladder_sfc_page_chart(page), row);
}

/* A row counts lines of the text of the POU. */
static void go_in_networks(LadderFbdView *networks, int network, int row, int col)
{
	if (row >= 0 && network < 0)
		ladder_fbd_view_go_row(networks, row, col);
	else
		ladder_fbd_view_go(networks, network);
}

/* Without a rung: to a line of the program, in the statements of a box. */
static void go_in_ladder(LadderGridView *sheet, int rung, int row, int col)
{
	if (rung < 0 && row > 0)
		ladder_rung_page_go(ladder_rung_page_of(GTK_WIDGET(sheet)), row + 1, col + 1);
	else
		ladder_grid_view_go(sheet, rung, row, col);
}

static void go_in_symbols(struct tabs *tabs, int table, int index)
{
	const struct project *project = ladder_document_project(tabs->core->document);
	const int type = table - project->pou_count - 1;
	GtkWidget *place;
	LadderSymbolsView *symbols;

	if (type >= project->structure_count && type_is(project, type)) {
		tabs_show_type(tabs, type_name(project, type));
		return;
	}
	place = tabs_show_widget(tabs, "symbols");
	symbols =
		LADDER_SYMBOLS_VIEW(symbols_in(ADW_BIN(place), tabs));

	if (ladder_symbols_view_show(symbols, table, index))
		ladder_symbols_view_enter(symbols);
}

void tabs_go(struct tabs *tabs, int pou, int rung, int row, int col)
{
	GtkWidget *content;
	AdwTabPage *page;

	if (!ladder_document_project(tabs->core->document)) {
		GtkWidget *text = tabs_show_widget(tabs, "text");

		ladder_text_view_go(LADDER_TEXT_VIEW(text), rung + 1, col + 1);
		return;
	}
	if (pou < 0) {
		go_in_symbols(tabs, row, col);
		return;
	}
	tabs_show(tabs, pou);
	page = front_tab(tabs->core->front);
	content = page_content(page);
	if (LADDER_IS_FBD_VIEW(content))
		go_in_networks(LADDER_FBD_VIEW(content), rung, row, col);
	else if (LADDER_IS_SFC_PAGE(content))
		go_in_chart(LADDER_SFC_PAGE(content), rung, row, col);
	else if (LADDER_IS_GRID_VIEW(content) && page_pou(content) == pou &&
		 !front_is_older(tabs->core->front))
		go_in_ladder(LADDER_GRID_VIEW(content), rung, row, col);
	else if (LADDER_IS_TEXT_VIEW(content))
		ladder_text_view_go_here(LADDER_TEXT_VIEW(content), row + 1, col + 1);
}

void tabs_go_line(struct tabs *tabs, int pou, int line)
{
	AdwTabPage *page;

	tabs_go(tabs, pou, -1, line, 0);
	page = front_tab(tabs->core->front);
	if (page && LADDER_IS_SFC_PAGE(page_content(page)))
		ladder_sfc_page_show_line(LADDER_SFC_PAGE(page_content(page)), line);
}

/* ---- closing ---- */

struct closing {
	struct tabs *tabs;
	AdwTabPage *page;
};

static void close_answered(AdwMessageDialog *dialog, const char *answer,
			   struct closing *closing)
{
	LadderSideFile *file = page_file(closing->page);
	const bool save = strcmp(answer, "save") == 0;
	const bool close = strcmp(answer, "discard") == 0 ||
			   (save && tabs_save_file(closing->tabs, file));

	(void)dialog;
	if (close)
		draft_remove(file);
	adw_tab_view_close_page_finish(closing->tabs->view, closing->page, close);
}

static void closing_free(gpointer closing, GClosure *closure)
{
	(void)closure;
	g_object_unref(((struct closing *)closing)->page);
	g_free(closing);
}

/* Asks before a file with unsaved changes is closed. */
static gboolean close_page(struct tabs *tabs, AdwTabPage *page)
{
	LadderSideFile *file = page_file(page);
	struct closing *closing;
	char *name;

	/* a part of the project is saved, or not, with the project */
	if (!file || ladder_side_file_is_part(file) || ladder_side_file_is_saved(file))
		return GDK_EVENT_PROPAGATE;
	closing = g_new(struct closing, 1);
	*closing = (struct closing){ tabs, g_object_ref(page) };
	name = ladder_side_file_name(file);
	g_signal_connect_data(ask_save(tabs->core->window, name), "response",
			      G_CALLBACK(close_answered), closing, closing_free, 0);
	g_free(name);
	return GDK_EVENT_STOP;
}

void tabs_close(struct tabs *tabs)
{
	AdwTabPage *page;

	/* What is typed may close pages, which the end of this one would do in the middle. */
	front_take_typed(tabs->core->front);
	page = front_tab(tabs->core->front);
	if (page)
		adw_tab_view_close_page(tabs->view, page);
}

/* ---- undo and redo ---- */

/* The first place that a step changed. */
struct changed {
	int pou, rung; /* -1: neither rung nor list; in a list, rung is -1     */
	int end;       /* behind the last rung, before and afterwards          */
};

static void rungs_changed(LadderDocument *document, int pou, int at, int removed, int added,
			  struct changed *changed)
{
	(void)document;
	if (changed->pou < 0)
		*changed = (struct changed){ pou, at, at + MAX(removed, added) };
}

static void list_changed(LadderDocument *document, int pou, struct changed *changed)
{
	(void)document;
	if (changed->pou < 0)
		*changed = (struct changed){ pou, -1, -1 };
}

/* Is the cursor of the page in front there? */
static bool is_here(struct tabs *tabs, const struct changed *changed)
{
	LadderGridView *sheet = front_sheet(tabs->core->front);
	LadderTextView *list = front_list(tabs->core->front);

	if (sheet)
		return ladder_canvas_pou(LADDER_CANVAS(sheet)) == changed->pou &&
		       ladder_grid_view_first(sheet) + ladder_grid_view_cursor(sheet).rung ==
		       changed->rung;
	return list && ladder_text_view_pou(list) == changed->pou;
}

static void show(struct tabs *tabs, const struct changed *changed)
{
	const struct project *project = ladder_document_project(tabs->core->document);
	const int count = project && changed->pou >= 0 && changed->pou < project->pou_count ?
			  project->pou[changed->pou].rung_count : -1;

	if (count < 0 || is_here(tabs, changed))
		return;
	tabs_go(tabs, changed->pou, MIN(changed->rung, count - 1), -1, -1);
}

/* The cursor in the sheet in front. */
static struct step_cursor cursor_now(gpointer data)
{
	struct front *front = ((struct tabs *)data)->core->front;
	LadderGridView *sheet = front_sheet(front);
	LadderSfcView *chart = front_chart(front);
	LadderFbdView *networks = front_networks(front);

	if (sheet) {
		const struct grid_cursor at = ladder_grid_view_cursor(sheet);

		return (struct step_cursor){ ladder_canvas_pou(LADDER_CANVAS(sheet)),
			ladder_grid_view_first(sheet) + at.rung, at.row, at.col };
	}
	if (chart)
		return (struct step_cursor){ ladder_canvas_pou(LADDER_CANVAS(chart)), -1,
			ladder_sfc_view_row(chart), 0 };
	if (networks)
		return (struct step_cursor){ ladder_canvas_pou(LADDER_CANVAS(networks)), -1,
			ladder_fbd_view_row(networks), 0 };
	return (struct step_cursor){ .pou = -1 };
}

static bool has_rung(LadderGridView *sheet, struct step_cursor at)
{
	int count, first;

	if (!sheet || ladder_canvas_pou(LADDER_CANVAS(sheet)) != at.pou)
		return false;
	first = ladder_grid_view_range(sheet, &count);
	return at.rung >= first && (count < 0 || at.rung < first + count);
}

/* Moves the cursor to where the undone step began. False: what it changed is elsewhere. */
static bool go_back(struct tabs *tabs, struct step_cursor to, const struct changed *changed)
{
	const struct project *project = ladder_document_project(tabs->core->document);
	LadderGridView *sheet;

	if (!project || to.pou < 0 || to.pou >= project->pou_count ||
	    to.rung >= project->pou[to.pou].rung_count ||
	    (changed->pou >= 0 && (changed->pou != to.pou || (to.rung >= 0 &&
	     (to.rung < changed->rung - 1 || to.rung > changed->end)))))
		return false;
	if (!has_rung(front_sheet(tabs->core->front), to))
		tabs_go(tabs, to.pou, to.rung, to.rung < 0 ? to.row : -1, -1);
	sheet = front_sheet(tabs->core->front);
	if (has_rung(sheet, to))
		ladder_grid_view_move(sheet, (struct grid_cursor){
			to.rung - ladder_grid_view_first(sheet), to.row, to.col });
	return true;
}

/* An undone step of the project may have shown a file in which it changed something, too. */
static void stay(struct tabs *tabs, AdwTabPage *page)
{
	for (int i = 0; i < adw_tab_view_get_n_pages(tabs->view); i++)
		if (nth(tabs, i) == page)
			adw_tab_view_set_selected_page(tabs->view, page);
}

/* A sheet says its place anew when the cursor moves. */
static void say(struct tabs *tabs, const char *text)
{
	GtkWidget *focus = gtk_window_get_focus(tabs->core->window);

	if (focus && LADDER_IS_CANVAS(focus))
		spoken_say(focus, text);
	else if (focus)
		spoken_once(focus, text);
}

void tabs_step(struct tabs *tabs, bool redo)
{
	LadderDocument *document = tabs->core->document;
	struct changed changed = { -1, -1, -1 };
	struct step_cursor cursor;
	AdwTabPage *page;
	guint64 version;
	gulong rungs, list;
	char *name, *text;
	bool done;

	tabs_each_file(tabs, ladder_side_file_commit);
	name = g_strdup(redo ? ladder_document_redo_name(document) :
			ladder_document_undo_name(document));
	rungs = g_signal_connect(document, "rungs-changed", G_CALLBACK(rungs_changed),
				 &changed);
	list = g_signal_connect(document, "list-changed", G_CALLBACK(list_changed), &changed);
	cursor = ladder_document_undo_cursor(document);
	page = front_tab(tabs->core->front);
	version = ladder_document_version(document);
	done = redo ? ladder_document_redo(document) : ladder_document_undo(document);
	g_signal_handler_disconnect(document, rungs);
	g_signal_handler_disconnect(document, list);
	if (done) {
		if (version != ladder_document_version(document))
			stay(tabs, page);
		if (redo || !go_back(tabs, cursor, &changed))
			show(tabs, &changed);
		text = g_strdup_printf(redo ? _("Redone: %s") : _("Undone: %s"), name);
		messages_tell(tabs->core->messages, text);
		say(tabs, text);
		g_free(text);
	}
	g_free(name);
	front_enter_program(tabs->core->front);
}

/* ---- when the project is another ---- */

/* Gives the page the new index of its POU, and its new name (@renamed). False: the POU is
 * gone. */
static bool update_page(AdwTabPage *page, const struct project *project, bool renamed)
{
	GtkWidget *widget = page_content(page);
	const char *name = page_name(page);
	int pou;

	if (strcmp(name, " welcome") == 0)
		return false; /* a file was opened */
	if (LADDER_IS_FILE_VIEW(widget))
		return true; /* it does not depend on the project */
	if (strcmp(name, " compare") == 0 || strcmp(name, " preview") == 0)
		return true; /* they stay, and say that the project cannot be read */
	if (LADDER_IS_SHOWN_PAGE(widget)) {
		if (ladder_shown_page_follow(LADDER_SHOWN_PAGE(widget), renamed))
			title_shown(page);
		return !ladder_shown_page_is_over(LADDER_SHOWN_PAGE(widget));
	}
	if (name[0] == ' ')
		return (strcmp(name, " text") == 0) == !project;
	pou = project_find_pou(project, name, strlen(name));
	if (pou < 0) {
		pou = page_pou(widget);
		if (!renamed || pou >= project->pou_count || !page_fits(widget, project, pou))
			return false;
		name = project_text(project, project->pou[pou].name);
		page_set_name(page, name, name);
	}
	if (!page_fits(widget, project, pou))
		return false;
	page_set_pou(widget, pou);
	return true;
}

static bool has_pou_page(struct tabs *tabs)
{
	for (int i = 0; i < adw_tab_view_get_n_pages(tabs->view); i++)
		if (page_name(nth(tabs, i))[0] != ' ')
			return true;
	return false;
}

/* Closes the pages of deleted POUs. The focus stays where it is, for example in the tree. */
static void update_pages(struct tabs *tabs, const struct project *project)
{
	const bool renamed = project && project->pou_count == tabs->pou_count;
	GtkWidget *focus = gtk_window_get_focus(tabs->core->window);
	const bool beside = focus && !gtk_widget_is_ancestor(focus, GTK_WIDGET(tabs->view));

	tabs->pou_count = project ? project->pou_count : 0;
	for (int i = adw_tab_view_get_n_pages(tabs->view) - 1; i >= 0; i--) {
		AdwTabPage *page = nth(tabs, i);

		if (!update_page(page, project, renamed))
			adw_tab_view_close_page(tabs->view, page);
	}
	if (beside && adw_tab_view_get_n_pages(tabs->view))
		gtk_widget_grab_focus(focus);
}

static void update(struct tabs *tabs)
{
	const struct project *project = ladder_document_project(tabs->core->document);

	update_pages(tabs, project);
	if (!project) {
		tabs_show_widget(tabs, "text");
		return;
	}
	if (!has_pou_page(tabs)) {
		for (int i = 0; i < MIN(project->pou_count, OPEN_MOST); i++)
			if (!project->pou[i].included)
				open_pou(tabs, i);
		open_widget(tabs, "symbols");
		tabs_show(tabs, 0);
	}
	g_signal_emit_by_name(tabs->core->window, "place-changed");
}

/* Closes the pages of the empty project first; the sheet of the first program would be
 * kept. */
void tabs_open_anew(struct tabs *tabs)
{
	for (int i = adw_tab_view_get_n_pages(tabs->view) - 1; i >= 0; i--) {
		AdwTabPage *page = nth(tabs, i);

		if (!LADDER_IS_FILE_VIEW(page_content(page)))
			adw_tab_view_close_page(tabs->view, page);
	}
	update(tabs);
}

/* ---- life ---- */

static bool is_welcome(struct tabs *tabs)
{
	AdwTabPage *page = front_tab(tabs->core->front);

	return page && g_strcmp0(page_name(page), " welcome") == 0;
}

/* The welcome page has no problems, and nothing to watch. */
static void page_selected(struct tabs *tabs)
{
	below_leave(tabs->core->below, is_welcome(tabs));
	g_signal_emit_by_name(tabs->core->window, "place-changed");
	g_signal_emit_by_name(tabs->core->window, "page-changed");
	messages_tell(tabs->core->messages, "");
	front_enter_program(tabs->core->front);
}

static gboolean enter_now(gpointer data)
{
	struct core *core = data;

	if (core->document) {
		g_signal_emit_by_name(core->window, "page-changed");
		front_enter(core->front);
	}
	g_object_unref(core->window);
	return G_SOURCE_REMOVE;
}

/* After the click, which gives the focus to the tab; also a click on the tab in front. */
static void tab_pressed(struct tabs *tabs)
{
	g_object_ref(tabs->core->window);
	g_idle_add(enter_now, tabs->core);
}

/* ---- what the board runs without ---- */

static bool is_missing(struct tabs *tabs, const char *name)
{
	LadderDocument *document = tabs->core->document;
	const struct project *project = ladder_document_project(document);
	const int pou = project ? project_find_pou(project, name, strlen(name)) : -1;

	return pou >= 0 ? ladder_sim_is_missing(tabs->core->sim, document, pou, -1) :
	       g_strcmp0(name, " symbols") == 0 &&
	       ladder_sim_is_missing(tabs->core->sim, document, SIM_SYMBOLS, -1);
}

static void mark_missing(struct tabs *tabs)
{
	bool any = false;

	for (int i = 0; i < adw_tab_view_get_n_pages(tabs->view); i++) {
		const char *name = page_name(nth(tabs, i));
		const bool missing = name && is_missing(tabs, name);
		GIcon *icon;

		if (missing == (adw_tab_page_get_indicator_icon(nth(tabs, i)) != NULL))
			continue;
		icon = missing ? g_themed_icon_new("go-down-symbolic") : NULL;
		adw_tab_page_set_indicator_icon(nth(tabs, i), icon);
		adw_tab_page_set_indicator_tooltip(nth(tabs, i), missing ?
						   _("not downloaded") : "");
		g_clear_object(&icon);
		any = true;
	}
	if (any)
		spoken_parts(GTK_WIDGET(tabs->core->front->tab_bar));
}

void tabs_init(struct tabs *tabs, struct core *core)
{
	tabs->core = core;
	tabs->view = core->front->tabs;
	tabs->parts = g_ptr_array_new_with_free_func(g_object_unref);
	/* these keys move the text cursor or the cursor of a sheet */
	adw_tab_view_remove_shortcuts(tabs->view, ADW_TAB_VIEW_SHORTCUT_CONTROL_HOME |
		ADW_TAB_VIEW_SHORTCUT_CONTROL_END |
		ADW_TAB_VIEW_SHORTCUT_CONTROL_SHIFT_HOME |
		ADW_TAB_VIEW_SHORTCUT_CONTROL_SHIFT_END |
		ADW_TAB_VIEW_SHORTCUT_CONTROL_PAGE_UP |
		ADW_TAB_VIEW_SHORTCUT_CONTROL_PAGE_DOWN);
	tab_home_make(core->front->tab_bar);
	tab_seen_keep(core->front->tab_bar);
	tab_titles_mend(core->front->tab_bar);
	core_on_press(GTK_WIDGET(core->front->tab_bar), G_CALLBACK(tab_pressed), tabs);
	ladder_document_set_cursor(core->document, cursor_now, tabs);
	core_connect(core, core->document, "file-opened", G_CALLBACK(file_opened), tabs, 0);
	core_connect(core, core->document, "project-changed", G_CALLBACK(update), tabs,
		     G_CONNECT_SWAPPED);
	core_connect(core, core->sim, "program-changed", G_CALLBACK(mark_missing), tabs,
		     G_CONNECT_SWAPPED);
	core_connect(core, core->sim, "state-changed", G_CALLBACK(mark_missing), tabs,
		     G_CONNECT_SWAPPED);
	core_connect(core, core->document, "rungs-changed", G_CALLBACK(mark_missing), tabs,
		     G_CONNECT_SWAPPED);
	core_connect(core, tabs->view, "notify::n-pages", G_CALLBACK(mark_missing), tabs,
		     G_CONNECT_SWAPPED);
	core_connect(core, tabs->view, "notify::selected-page", G_CALLBACK(page_selected), tabs,
		     G_CONNECT_SWAPPED);
	core_connect(core, tabs->view, "close-page", G_CALLBACK(close_page), tabs,
		     G_CONNECT_SWAPPED);
	update(tabs);
}

void tabs_clear(struct tabs *tabs)
{
	g_clear_pointer(&tabs->parts, g_ptr_array_unref);
}
