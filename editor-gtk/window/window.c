/* SPDX-License-Identifier: MIT
 *
 * window - the window of one document: its parts, and which part does which command.
 *
 * Every row of verbs.def is an action "win.ID". Commands of a sheet go to the sheet in
 * front.
 */
#include "editor-gtk/window/window.h"

#include "editor-gtk/document/pou_convert.h"
#include "editor-gtk/document/type_edit.h"
#include "editor-gtk/kit/gtk48/paned.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/still.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/settings.h"
#include "editor-gtk/kit/verbs.h"
#include "editor-gtk/live/timing_view.h"
#include "editor-gtk/live/watch_view.h"
#include "editor-gtk/panels/address_view.h"
#include "editor-gtk/panels/alarm_view.h"
#include "editor-gtk/panels/code_view.h"
#include "editor-gtk/panels/log_view.h"
#include "editor-gtk/panels/palette.h"
#include "editor-gtk/panels/preview_view.h"
#include "editor-gtk/panels/problems.h"
#include "editor-gtk/panels/project_tree.h"
#include "editor-gtk/window/below.h"
#include "editor-gtk/window/blockers.h"
#include "editor-gtk/window/board_bar.h"
#include "editor-gtk/window/commands.h"
#include "editor-gtk/window/compare.h"
#include "editor-gtk/window/finder.h"
#include "editor-gtk/window/help.h"
#include "editor-gtk/window/messages.h"
#include "editor-gtk/window/names.h"
#include "editor-gtk/window/online_bar.h"
#include "editor-gtk/window/online_log.h"
#include "editor-gtk/window/pou_import_dialog.h"
#include "editor-gtk/window/pou_new.h"
#include "editor-gtk/window/preferences.h"
#include "editor-gtk/window/properties_dialog.h"
#include "editor-gtk/window/recent.h"
#include "editor-gtk/window/scenarios.h"
#include "editor-gtk/window/stand_bar.h"
#include "editor-gtk/window/status.h"
#include "editor-gtk/window/tabs.h"
#include "editor-gtk/window/type_new.h"

#include "engine/base/version.h"

#include <string.h>

/* New projects with a chart, with networks, or with statements. */
#define CHART "RUNGBOARD 1\n\nPROGRAM Main SFC\n  INITIAL_STEP Start:\n  END_STEP\nEND_PROGRAM\n"
#define NETWORKS "RUNGBOARD 1\n\nPROGRAM Main FBD\nNETWORK\nEND_PROGRAM\n"
#define STATEMENTS "RUNGBOARD 1\n\nPROGRAM Main ST\nEND_PROGRAM\n"
#define ABOVE_SIDE 80 /* px of heading and status bar                              */
#define DISK_SECONDS 2 /* between checks for changed files                     */

struct _LadderWindow {
	AdwApplicationWindow parent;
	struct core core;
	struct messages messages;
	struct below below;
	struct front front;
	struct tabs tabs;
	struct status status;
	struct finder finder;
	struct origin origin;
	struct export export;
	struct compare compare;
	struct help help;
	struct exchange exchange;
	struct files files;
	struct sim_bar sim_bar;
	struct stand_bar stand_bar;
	struct blockers blockers;
	struct scenarios scenarios;
	struct board_bar board_bar;
	struct online_bar online_bar;
	struct online_log online_log;
	guint disk_timer;         /* checks for changed files when it elapses    */
	GtkWidget *palette;
	AdwWindowTitle *title;
	GtkButton *undo_button, *redo_button;
	GtkMenuButton *menu_button;
	GtkPaned *side;
};

G_DEFINE_FINAL_TYPE(LadderWindow, ladder_window, ADW_TYPE_APPLICATION_WINDOW)

/* ---- what the application asks ---- */

LadderDocument *ladder_window_document(LadderWindow *window)
{
	return window->core.document;
}

bool ladder_window_is_untouched(LadderWindow *window)
{
	LadderDocument *document = window->core.document;

	return !ladder_document_path(document) && ladder_document_is_saved(document) &&
	       !ladder_document_undo_name(document) && (!ladder_sim_is_on(window->core.sim) || ladder_sim_board(window->core.sim));
}

void ladder_window_welcome(LadderWindow *window)
{
	tabs_show_widget(&window->tabs, "welcome");
}

void ladder_window_warn(LadderWindow *window, const char *text)
{
	messages_warn(&window->messages, text);
}

void ladder_window_offer_restored(LadderWindow *window)
{
	messages_banner(&window->messages, LOG_SYSTEM, _("The editor ended before this was saved. "
			"Your changes are restored."), _("Save"), "win.save");
}

void ladder_window_opened(LadderWindow *window)
{
	tabs_open_anew(&window->tabs);
	origin_set_path(&window->origin, NULL);
}

void ladder_window_tell_file(LadderWindow *window)
{
	files_tell(&window->files);
}

void ladder_window_set_origin(LadderWindow *window, const char *path)
{
	origin_set_path(&window->origin, path);
}

void ladder_window_set_classic(LadderWindow *window, LadderOrigin *origin)
{
	g_set_object(&window->origin.classic, origin);
	exchange_imported(&window->exchange);
}

void ladder_window_share_board(LadderWindow *window, LadderWindow *from)
{
	online_bar_share(&from->online_bar, &window->online_bar);
}

void ladder_window_compare(LadderWindow *window, const char *older, const char *newer)
{
	compare_files(&window->compare, older, newer);
}

bool ladder_window_has_file(LadderWindow *window, const char *path)
{
	return tabs_find_file(&window->tabs, path) != NULL;
}

void ladder_window_show_file(LadderWindow *window, const char *path)
{
	tabs_show_file(&window->tabs, path);
}

bool ladder_window_restore_file(LadderWindow *window, const struct draft *draft)
{
	return files_restore(&window->files, draft);
}

void ladder_window_keep_drafts(LadderWindow *window)
{
	files_keep_drafts(&window->files);
}

/* ---- editing ---- */

/* Renames the selected row of the tree or of a table if that has the focus, else the name at the cursor. */
static void do_rename(LadderWindow *window)
{
	GtkWidget *focus = gtk_window_get_focus(GTK_WINDOW(window));

	LadderGridView *sheet = front_sheet(&window->front);

	if (focus && (gtk_widget_activate_action(focus, "tree.rename", NULL) ||
		      gtk_widget_activate_action(focus, "tasks.rename", NULL) ||
		      gtk_widget_activate_action(focus, "types.rename-type", NULL)))
		return;
	if (!sheet || !ladder_grid_view_rename_box(sheet))
		names_rename(&window->core);
}

/* Lists the uses of the selected row if the tree or the page of data types has the focus, else of the
 * name at the cursor. */
static void do_show_uses(LadderWindow *window)
{
	GtkWidget *focus = gtk_window_get_focus(GTK_WINDOW(window));

	if (!focus || (!gtk_widget_activate_action(focus, "tree.uses", NULL) &&
		       !gtk_widget_activate_action(focus, "types.uses", NULL)))
		names_show_uses(&window->core);
}

/* ---- going ---- */

static void do_next_problem(LadderWindow *window)
{
	LadderProblems *problems = LADDER_PROBLEMS(below_panel(&window->below, "problems"));

	messages_tell(&window->messages, ladder_problems_next(problems, false) ?
			   ladder_problems_current(problems) : _("no problems"));
}

static void do_next_bookmark(LadderWindow *window)
{
	LadderGridView *sheet = front_sheet(&window->front);
	int pou = sheet ? ladder_canvas_pou(LADDER_CANVAS(sheet)) : 0;
	int rung = sheet ? ladder_grid_view_cursor(sheet).rung : -1;

	if (ladder_document_next_bookmark(window->core.document, &pou, &rung))
		tabs_go(&window->tabs, pou, rung, -1, -1);
	else
		messages_tell(&window->messages, _("no bookmarks"));
}

static void do_sheet_by(LadderWindow *window, bool next)
{
	if (front_older_by(&window->front, next ? 1 : -1))
		return;
	if (next ? !adw_tab_view_select_next_page(window->front.tabs) :
		   !adw_tab_view_select_previous_page(window->front.tabs))
		return;
	front_enter(&window->front);
}

/* ---- viewing ---- */

static void zoom(LadderWindow *window, double factor)
{
	LadderCanvas *canvas = front_seen_canvas(&window->front);
	GtkWidget *page = page_content(front_tab(&window->front));

	if (LADDER_IS_PREVIEW_VIEW(page))
		ladder_preview_view_zoom(LADDER_PREVIEW_VIEW(page), factor);
	else if (canvas)
		ladder_canvas_set_zoom(canvas, factor == 0 ? 1 :
				       ladder_canvas_zoom(canvas) * factor);
}

static void do_show_as(LadderWindow *window)
{
	LadderGridView *sheet = front_seen_sheet(&window->front);

	if (!sheet)
		return;
	ladder_grid_view_set_show(sheet, (ladder_grid_view_show(sheet) + 1) % 3);
	if (settings_get())
		g_settings_set_enum(settings_get(), "show",
				    (int)ladder_grid_view_show(sheet));
}

/* All sheets follow the setting; without settings the one in front does. */
static void do_fold_rungs(LadderWindow *window)
{
	LadderGridView *sheet = front_seen_sheet(&window->front);
	bool folds;

	if (!sheet)
		return;
	folds = !ladder_grid_view_folds(sheet);
	ladder_grid_view_set_folds(sheet, folds);
	if (settings_get())
		g_settings_set_boolean(settings_get(), "fold-rungs", folds);
	messages_tell(&window->messages, folds ? _("Rungs that are wider than the sheet are folded") :
		      _("Rungs have one line, however wide they are"));
}

/* A refusal is shown in place of the text that cannot be made. */
static void convert(LadderWindow *window, int pou, enum pou_language to)
{
	LadderDocument *document = window->core.document;
	struct diag_list *why = g_new0(struct diag_list, 1);
	const int was = pou;
	char *name = g_strdup(project_text(ladder_document_project(document),
					   ladder_document_project(document)->pou[pou].name)), *text;

	if (pou_convert(document, pou, to, why)) {
		pou = project_find_pou(ladder_document_project(document), name, strlen(name));
		tabs_show(&window->tabs, pou < 0 ? was : pou); /* the first ladder of a chart has its place */
		text = g_strdup_printf(_("“%s” is in %s now"), name, pou_language_word(to));
		messages_tell(&window->messages, text);
		g_free(text);
	} else {
		tabs_show_as(&window->tabs, pou, to);
	}
	g_free(name);
	g_free(why);
}

static void do_language_of(LadderWindow *window, enum verb verb, int pou)
{
	const struct project *project = ladder_document_project(window->core.document);
	enum pou_language to;
	bool converts;
	char *text;

	if (!shown_page_verb(verb, &to, &converts) || !project || pou < 0 || pou >= project->pou_count)
		return;
	if (project->pou[pou].language == to) {
		text = g_strdup_printf(_("“%s” is in %s already"), project_text(project, project->pou[pou].name),
				       pou_language_word(to));
		messages_tell(&window->messages, text);
		g_free(text);
	} else if (converts) {
		convert(window, pou, to);
	} else {
		tabs_show_as(&window->tabs, pou, to);
	}
}

static bool do_language(LadderWindow *window, enum verb verb)
{
	enum pou_language to;
	bool converts;

	if (!shown_page_verb(verb, &to, &converts))
		return false;
	do_language_of(window, verb, front_pou(&window->front));
	return true;
}

static void show_addresses(LadderWindow *window)
{
	if (!ladder_document_project(window->core.document)) {
		messages_toast(&window->messages, _("The file cannot be read as a program. Correct its errors first"));
		return;
	}
	ladder_address_view_enter(LADDER_ADDRESS_VIEW(tabs_show_widget(&window->tabs,
								       "addresses")));
}

static void toggle(GtkWidget *widget)
{
	gtk_widget_set_visible(widget, !gtk_widget_get_visible(widget));
}

/* Switches from desktop to light, to dark, and back. */
static void do_appearance(LadderWindow *window)
{
	static const AdwColorScheme schemes[] = {
		ADW_COLOR_SCHEME_DEFAULT, ADW_COLOR_SCHEME_FORCE_LIGHT,
		ADW_COLOR_SCHEME_FORCE_DARK,
	};
	static const char *const names[] = {
		N_("as the desktop"), N_("light"), N_("dark"),
	};
	AdwStyleManager *manager = adw_style_manager_get_default();
	const AdwColorScheme now = adw_style_manager_get_color_scheme(manager);
	int next = now == schemes[0] ? 1 : now == schemes[1] ? 2 : 0;

	adw_style_manager_set_color_scheme(manager, schemes[next]);
	if (settings_get())
		g_settings_set_enum(settings_get(), "appearance", next);
	messages_tell(&window->messages, _(names[next]));
}

static void do_fullscreen(LadderWindow *window)
{
	if (gtk_window_is_fullscreen(GTK_WINDOW(window)))
		gtk_window_unfullscreen(GTK_WINDOW(window));
	else
		gtk_window_fullscreen(GTK_WINDOW(window));
}

static void do_about(LadderWindow *window)
{
	adw_show_about_window(GTK_WINDOW(window), "application-name", "Rungboard",
		"application-icon", APP_ID, "version", LADDER_VERSION,
		"developer-name", _("The Rungboard developers"),
		"license-type", GTK_LICENSE_MIT_X11,
		"comments", _("Ladder logic for Linux ARM boards"), NULL);
}

/* ---- what the project is made of ---- */

/* The page with the table makes the dialog, so it is shown first. */
static void import_symbols(LadderWindow *window)
{
	GtkWidget *symbols;

	if (!ladder_document_project(window->core.document)) {
		messages_toast(&window->messages, _("The file cannot be read as a program. Correct its errors first"));
		return;
	}
	symbols = adw_bin_get_child(ADW_BIN(tabs_show_widget(&window->tabs, "symbols")));
	if (symbols)
		gtk_widget_activate_action(symbols, "symbols.import", NULL);
}

static bool do_project(LadderWindow *window, enum verb verb)
{
	struct core *core = &window->core;

	switch ((int)verb) {
	case VERB_new_program: pou_new_ask(core, POU_PROGRAM, LANGUAGE_LD); return true;
	case VERB_new_list: pou_new_ask(core, POU_PROGRAM, LANGUAGE_IL); return true;
	case VERB_new_chart: pou_new_ask(core, POU_PROGRAM, LANGUAGE_SFC); return true;
	case VERB_new_networks: pou_new_ask(core, POU_PROGRAM, LANGUAGE_FBD); return true;
	case VERB_new_statements: pou_new_ask(core, POU_PROGRAM, LANGUAGE_ST); return true;
	case VERB_new_block: pou_new_ask(core, POU_BLOCK, LANGUAGE_LD); return true;
	case VERB_new_function: pou_new_ask(core, POU_FUNCTION, LANGUAGE_LD); return true;
	case VERB_new_subroutine: pou_new_ask(core, POU_SUBROUTINE, LANGUAGE_LD); return true;
	case VERB_import:
		pou_import_ask(GTK_WIDGET(window), window->core.document);
		return true;
	case VERB_new_iomap: board_bar_new_map(&window->board_bar); return true;
	case VERB_symbols:
		tabs_show_widget(&window->tabs, "symbols");
		front_enter(&window->front);
		return true;
	case VERB_tasks: tabs_show_task(&window->tabs, NULL); return true;
	case VERB_new_task: tabs_new_task(&window->tabs); return true;
	case VERB_types: tabs_show_type(&window->tabs, NULL); return true;
	case VERB_new_type: type_new_ask(core, NULL); return true;
	case VERB_import_symbols: import_symbols(window); return true;
	case VERB_export_symbols: export_symbols(&window->export); return true;
	default: return false;
	}
}

/* ---- the table ---- */

/* Esc also closes the find bar, if the sheet had nothing to cancel. */
static void do_on_sheet(LadderWindow *window, LadderGridView *sheet, enum verb verb)
{
	const guint64 version = ladder_document_version(window->core.document);
	const bool begun = ladder_grid_view_has_begun(sheet);

	ladder_canvas_do(LADDER_CANVAS(sheet), verb);
	if (verb == VERB_cancel && !begun &&
	    ladder_document_version(window->core.document) == version)
		finder_close(&window->finder);
}

static void do_on_chart(LadderWindow *window, enum verb verb)
{
	LadderSfcView *chart = front_seen_chart(&window->front);

	if (chart)
		ladder_canvas_do(LADDER_CANVAS(chart), verb);
}

static void do_on_networks(LadderWindow *window, enum verb verb)
{
	LadderFbdView *networks = front_seen_networks(&window->front);

	if (networks)
		ladder_canvas_do(LADDER_CANVAS(networks), verb);
}

static bool do_in_file(LadderWindow *window, enum verb verb)
{
	switch ((int)verb) {
	case VERB_new_project: g_signal_emit_by_name(window, "new-wanted"); return true;
	case VERB_open: files_open(&window->files); return true;
	case VERB_save: files_save(&window->files); return true;
	case VERB_save_as: files_save_as(&window->files); return true;
	case VERB_compare: compare_ask(&window->compare); return true;
	case VERB_compare_files: compare_ask_files(&window->compare); return true;
	case VERB_next_difference: compare_step(&window->compare, false); return true;
	case VERB_previous_difference: compare_step(&window->compare, true); return true;
	case VERB_export_classic: exchange_export(&window->exchange); return true;
	case VERB_print: export_print(&window->export); return true;
	case VERB_print_preview: export_preview(&window->export); return true;
	case VERB_export_pdf: export_pdf(&window->export); return true;
	case VERB_properties: project_properties_show(&window->core); return true;
	case VERB_preferences: preferences_show(GTK_WINDOW(window)); return true;
	case VERB_close_tab: tabs_close(&window->tabs); return true;
	case VERB_close: gtk_window_close(GTK_WINDOW(window)); return true;
	default: return false;
	}
}

static void do_go(LadderWindow *window)
{
	LadderTextView *list = front_list(&window->front);

	if (list && ladder_text_view_is_st(list))
		names_go_definition(&window->core);
	else
		names_go_driver(&window->core);
}

static void do_text(LadderWindow *window, enum verb verb)
{
	LadderTextView *list = front_list(&window->front);

	if (!list)
		return;
	if (verb == VERB_format && !ladder_text_view_format(list))
		messages_tell(window->core.messages, _("The text cannot be read yet. Mend its errors first."));
	if (verb == VERB_mend && !ladder_text_view_mend(list))
		messages_tell(window->core.messages, _("No error in this line can be mended automatically."));
	if (verb == VERB_fold && !ladder_text_view_fold(list, true))
		messages_tell(window->core.messages, _("No block is around this line."));
	if (verb == VERB_unfold && !ladder_text_view_fold(list, false))
		messages_tell(window->core.messages, _("No folded block begins in this line."));
	if (verb == VERB_fold_all || verb == VERB_unfold_all)
		ladder_text_view_fold_all(list, verb == VERB_fold_all);
}

static bool do_find(LadderWindow *window, enum verb verb)
{
	switch ((int)verb) {
	case VERB_find: case VERB_replace: case VERB_find_next: case VERB_find_previous:
		finder_do(&window->finder, verb);
		return true;
	case VERB_find_element:
		gtk_widget_set_visible(GTK_WIDGET(window->side), TRUE);
		ladder_palette_find(window->palette);
		return true;
	case VERB_rename: do_rename(window); return true;
	case VERB_watch_add: names_watch(&window->core); return true;
	case VERB_show_uses: do_show_uses(window); return true;
	case VERB_go_coil: do_go(window); return true;
	case VERB_go_definition: names_go_definition(&window->core); return true;
	case VERB_format: case VERB_mend: case VERB_fold: case VERB_unfold: case VERB_fold_all:
	case VERB_unfold_all: do_text(window, verb); return true;
	case VERB_next_bookmark: do_next_bookmark(window); return true;
	case VERB_next_problem: do_next_problem(window); return true;
	case VERB_next_sheet: do_sheet_by(window, true); return true;
	case VERB_previous_sheet: do_sheet_by(window, false); return true;
	default: return false;
	}
}

static void do_view(LadderWindow *window, enum verb verb)
{
	switch ((int)verb) {
	case VERB_show_report: exchange_show(&window->exchange); break;
	case VERB_show_original: exchange_show_original(&window->exchange); break;
	case VERB_address_map: show_addresses(window); break;
	case VERB_online_device: tabs_show_widget(&window->tabs, "device"); break;
	case VERB_show_as: do_show_as(window); break;
	case VERB_fold_rungs: do_fold_rungs(window); break;
	case VERB_zoom_in: zoom(window, 1.25); break;
	case VERB_zoom_out: zoom(window, 0.8); break;
	case VERB_zoom_reset: zoom(window, 0); break;
	case VERB_side: toggle(GTK_WIDGET(window->side)); break;
	case VERB_below: below_toggle(&window->below); break;
	case VERB_appearance: do_appearance(window); break;
	case VERB_fullscreen: do_fullscreen(window); break;
	case VERB_palette: commands_show(GTK_WINDOW(window), window->core.with); break;
	case VERB_help: help_here(&window->help); break;
	case VERB_manual: help_show(&window->help, NULL); break;
	case VERB_tutorial: help_show(&window->help, "tutorial.md"); break;
	case VERB_shortcuts: keys_show(GTK_WINDOW(window)); break;
	case VERB_welcome: tabs_show_widget(&window->tabs, "welcome"); break;
	case VERB_about: do_about(window); break;
	default: break;
	}
}

static void do_in_window(LadderWindow *window, enum verb verb)
{
	LadderGridView *sheet = front_seen_sheet(&window->front);

	switch ((int)verb) {
	case VERB_undo: tabs_step(&window->tabs, false); break;
	case VERB_redo: tabs_step(&window->tabs, true); break;
	case VERB_run_board: board_bar_run(&window->board_bar); break;
	case VERB_stop_board: board_bar_stop(&window->board_bar); break;
	case VERB_sim_why: blockers_ask(&window->blockers); break;
	case VERB_go_rung:
		if (!sheet && front_seen_chart(&window->front))
			do_on_chart(window, verb); /* to a step */
		else
			front_ask_number(&window->front);
		break;
	case VERB_bookmark:
		if (sheet)
			do_on_sheet(window, sheet, verb);
		else
			do_on_networks(window, verb);
		break;
	default:
		if (!do_in_file(window, verb) && !do_project(window, verb) &&
		    !do_find(window, verb) && !online_bar_do(&window->online_bar, verb) &&
		    !sim_bar_do(&window->sim_bar, verb) &&
		    !stand_bar_do(&window->stand_bar, verb) &&
		    !scenarios_do(&window->scenarios, verb) && !do_language(window, verb))
			do_view(window, verb);
	}
}

static void do_verb(LadderWindow *window, enum verb verb)
{
	const enum verb_where where = verb_row(verb)->where;
	const bool taken = front_take_typed(&window->front);
	LadderGridView *sheet = front_seen_sheet(&window->front);

	if (!taken && (verb == VERB_close || verb == VERB_close_tab))
		return;
	if (where == VERB_WINDOW || where == VERB_TEXT)
		do_in_window(window, verb);
	else if (where == VERB_NETWORK || (where == VERB_BOTH && front_seen_networks(&window->front)))
		do_on_networks(window, verb);
	else if (sheet && where != VERB_CHART)
		do_on_sheet(window, sheet, verb);
	else if (!sheet)
		do_on_chart(window, verb);
}

static bool refuses(LadderWindow *window, enum verb verb)
{
	const char *why = verb == VERB_COUNT ? NULL : verb_why_not(verb, window->core.with);

	if (why)
		messages_tell(&window->messages, why);
	return why != NULL;
}

/* The key of a command of the window that cannot work now says why, and does nothing else in
 * the widget with the focus. Only undo and redo are left to an entry. */
static gboolean key_comes(GtkEventController *keys, guint key, guint code, GdkModifierType state,
			  LadderWindow *window)
{
	const bool letter = !(state & (GDK_CONTROL_MASK | GDK_ALT_MASK)) &&
			    (key < GDK_KEY_F1 || key > GDK_KEY_F12);
	const enum verb verb = letter ? VERB_COUNT :
		verb_of_key(gtk_event_controller_get_current_event(keys));

	(void)code;
	return verb != VERB_undo && verb != VERB_redo && refuses(window, verb);
}

/* The same of a sheet's commands, and of undo and redo, if nobody took the key. */
static gboolean key_left(GtkEventController *keys, guint key, guint code, GdkModifierType state,
			 LadderWindow *window)
{
	GdkEvent *event = gtk_event_controller_get_current_event(keys);
	GtkWidget *focus = gtk_window_get_focus(GTK_WINDOW(window));
	enum verb verb = verb_of_key(event);

	(void)key;
	(void)code;
	(void)state;
	if (verb == VERB_COUNT && LADDER_IS_CANVAS(focus))
		verb = verb_of_sheet_key(event, LADDER_IS_GRID_VIEW(focus) ? VERB_SHEET :
					 LADDER_IS_FBD_VIEW(focus) ? VERB_NETWORK : VERB_CHART);
	return refuses(window, verb);
}

static void hear_keys(LadderWindow *window, GtkPropagationPhase phase, GCallback heard)
{
	GtkEventController *keys = gtk_event_controller_key_new();

	gtk_event_controller_set_propagation_phase(keys, phase);
	g_signal_connect(keys, "key-pressed", heard, window);
	gtk_widget_add_controller(GTK_WIDGET(window), keys);
}

/* ---- actions ---- */

static void act(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)unused;
	do_verb(LADDER_WINDOW(widget), verb_find(name));
}

static void go_to(GtkWidget *widget, const char *name, GVariant *place)
{
	int pou, rung, row, col;

	(void)name;
	g_variant_get(place, "(iiii)", &pou, &rung, &row, &col);
	tabs_go(&LADDER_WINDOW(widget)->tabs, pou, rung, row, col);
}

/* The menu names the POU: another one may have its number by then. */
static void language_of(GtkWidget *widget, const char *name, GVariant *of)
{
	LadderWindow *window = LADDER_WINDOW(widget);
	const struct project *project = ladder_document_project(window->core.document);
	const char *pou;
	int verb;

	(void)name;
	g_variant_get(of, "(i&s)", &verb, &pou);
	if (project)
		do_language_of(window, (enum verb)verb, project_find_pou(project, pou, strlen(pou)));
}

static void act_on_pou(GtkWidget *widget, const char *name, GVariant *pou)
{
	struct core *core = &LADDER_WINDOW(widget)->core;

	if (strcmp(name, "win.rename-pou") == 0)
		names_rename_pou(core, g_variant_get_int32(pou));
	else if (strcmp(name, "win.duplicate-pou") == 0)
		pou_duplicate_ask(core, g_variant_get_int32(pou));
	else if (strcmp(name, "win.copy-pou") == 0 || strcmp(name, "win.move-pou") == 0)
		pou_export_ask(widget, core->document, g_variant_get_int32(pou),
			       strcmp(name, "win.move-pou") == 0);
	else if (strcmp(name, "win.about-pou") == 0)
		pou_properties_show(core, g_variant_get_int32(pou));
	else
		names_delete_pou(core, g_variant_get_int32(pou));
}

/* Actions "win.show-type" and the like, with the name of a type. */
static void act_on_type(GtkWidget *widget, const char *action, GVariant *parameter)
{
	struct core *core = &LADDER_WINDOW(widget)->core;
	const char *name = g_variant_get_string(parameter, NULL);
	const int type = type_find(core->document, name);

	if (type < 0)
		return;
	if (strcmp(action, "win.show-type") == 0)
		tabs_show_type(core->tabs, name);
	else if (strcmp(action, "win.rename-type") == 0)
		names_rename_type(core, type);
	else if (strcmp(action, "win.duplicate-type") == 0)
		type_new_ask(core, name);
	else
		names_delete_type(core, type);
}

static void act_on_text(GtkWidget *widget, const char *name, GVariant *parameter)
{
	LadderWindow *window = LADDER_WINDOW(widget);
	const char *text = g_variant_get_string(parameter, NULL);

	if (strcmp(name, "win.show-uses") == 0)
		names_show_uses_of(&window->core, text);
	else if (strcmp(name, "win.expect-value") == 0)
		scenarios_expect(&window->scenarios, text);
	else if (strcmp(name, "win.watch-value") == 0)
		names_watch_this(&window->core, text);
	else if (strcmp(name, "win.show-chart") == 0)
		ladder_watch_view_show(LADDER_WATCH_VIEW(below_show(&window->below, "watch")), text);
	else if (strcmp(name, "win.connect-board") == 0)
		online_bar_choose(&window->online_bar, text);
	else if (strcmp(name, "win.show-panel") == 0)
		below_show(&window->below, text);
	else if (strcmp(name, "win.show-task") == 0)
		tabs_show_task(&window->tabs, *text ? text : NULL);
	else if (strcmp(name, "win.rename-task") == 0)
		names_rename_task(&window->core, text);
	else if (strcmp(name, "win.delete-task") == 0)
		names_delete_task(&window->core, text);
	else if (strcmp(name, "win.open-text") == 0)
		tabs_show_file(&window->tabs, text);
	else if (strcmp(name, "win.tell") == 0)
		messages_tell(&window->messages, text);
	else if (strcmp(name, "win.warn") == 0)
		messages_warn(&window->messages, text);
	else
		g_signal_emit_by_name(window, "open-wanted", text,
				      strcmp(name, "win.open-sample") == 0);
}

/* From the welcome page to the empty sheet, or to an empty chart, network or text in its place. */
static void begin(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderWindow *window = LADDER_WINDOW(widget);
	AdwTabPage *page = front_tab(&window->front);
	const char *text = strcmp(action, "win.begin-chart") == 0 ? CHART :
			   strcmp(action, "win.begin-networks") == 0 ? NETWORKS :
			   strcmp(action, "win.begin-statements") == 0 ? STATEMENTS : NULL;

	(void)unused;
	if (text && ladder_window_is_untouched(window)) {
		ladder_document_open_text(window->core.document, NULL, text, strlen(text), true);
		ladder_window_opened(window);
		if (strcmp(text, STATEMENTS) == 0)
			tabs_go(&window->tabs, 0, -1, 1, 0);
		return;
	}
	tabs_show(&window->tabs, 0);
	adw_tab_view_close_page(window->front.tabs, page);
}

static void import_project(GtkWidget *widget, const char *action, GVariant *unused)
{
	(void)action;
	(void)unused;
	files_import(&LADDER_WINDOW(widget)->files);
}

static void place_word(GtkWidget *widget, const char *name, GVariant *word)
{
	LadderWindow *window = LADDER_WINDOW(widget);
	LadderGridView *sheet = front_sheet(&window->front);
	LadderFbdView *networks = front_networks(&window->front);

	(void)name;
	if (networks)
		ladder_fbd_view_put(networks, (enum word)g_variant_get_int32(word));
	else if (sheet)
		ladder_grid_view_put(sheet, (enum word)g_variant_get_int32(word));
	else
		messages_tell(&window->messages, _("Elements are placed in rungs. Open a "
						   "sheet first."));
}

static void place_part(GtkWidget *widget, const char *name, GVariant *tool)
{
	LadderSfcView *chart = front_chart(&LADDER_WINDOW(widget)->front);

	(void)name;
	if (chart)
		ladder_sfc_view_place(chart, (enum sfc_tool)g_variant_get_int32(tool));
}

/* Actions "win.save-over", "win.save-locked". */
static void save_over(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)unused;
	files_save_over(&LADDER_WINDOW(widget)->files, strcmp(name, "win.save-locked") == 0);
}

static void reload(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)name;
	(void)unused;
	files_reload(&LADDER_WINDOW(widget)->files);
}

static void show_error(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)name;
	(void)unused;
	below_show_error(&LADDER_WINDOW(widget)->below);
}

static void to_sheet(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)name;
	(void)unused;
	front_enter(&LADDER_WINDOW(widget)->front);
}

static void install_actions(GtkWidgetClass *class)
{
	static const char *const on_text[] = {
		"win.show-task", "win.rename-task", "win.delete-task", "win.show-uses", "win.expect-value", "win.watch-value", "win.show-panel",
		"win.show-chart", "win.connect-board",
		"win.open-text", "win.open-path", "win.open-sample", "win.tell", "win.warn",
	};
	static const char *const on_pou[] = {
		"win.rename-pou", "win.delete-pou", "win.duplicate-pou", "win.about-pou",
		"win.copy-pou", "win.move-pou",
	};
	static const char *const on_type[] = {
		"win.show-type", "win.rename-type", "win.duplicate-type", "win.delete-type",
	};

	for (int i = 0; i < VERB_COUNT; i++)
		gtk_widget_class_install_action(class, verb_row((enum verb)i)->action,
						NULL, act);
	for (gsize i = 0; i < G_N_ELEMENTS(on_text); i++)
		gtk_widget_class_install_action(class, on_text[i], "s", act_on_text);
	gtk_widget_class_install_action(class, "win.go-to", "(iiii)", go_to);
	gtk_widget_class_install_action(class, "win.language-of", "(is)", language_of);
	for (gsize i = 0; i < G_N_ELEMENTS(on_pou); i++)
		gtk_widget_class_install_action(class, on_pou[i], "i", act_on_pou);
	for (gsize i = 0; i < G_N_ELEMENTS(on_type); i++)
		gtk_widget_class_install_action(class, on_type[i], "s", act_on_type);
	gtk_widget_class_install_action(class, "win.begin", NULL, begin);
	gtk_widget_class_install_action(class, "win.begin-chart", NULL, begin);
	gtk_widget_class_install_action(class, "win.begin-statements", NULL, begin);
	gtk_widget_class_install_action(class, "win.begin-networks", NULL, begin);
	gtk_widget_class_install_action(class, "win.import-project", NULL, import_project);
	gtk_widget_class_install_action(class, "win.place", "i", place_word);
	gtk_widget_class_install_action(class, "win.place-part", "i", place_part);
	gtk_widget_class_install_action(class, "win.show-error", NULL, show_error);
	gtk_widget_class_install_action(class, "win.to-sheet", NULL, to_sheet);
	/* GTK binds F6 inside panes only, not above them. */
	gtk_widget_class_add_binding_action(class, GDK_KEY_F6, 0, "win.to-sheet", NULL);
	gtk_widget_class_install_action(class, "win.save-over", NULL, save_over);
	gtk_widget_class_install_action(class, "win.save-locked", NULL, save_over);
	gtk_widget_class_install_action(class, "win.reload", NULL, reload);
}

/* The menu owns it. */
static GMenu *section_new(GMenu *menu)
{
	GMenu *section = g_menu_new();

	g_menu_append_section(menu, NULL, G_MENU_MODEL(section));
	g_object_unref(section);
	return section;
}

/* The menu of a group, or a menu nested in it: @first and those behind it up to @last. Caller:
 * g_object_unref(). */
static GMenu *part_new(enum verb_group group, int first, int last)
{
	GMenu *part = g_menu_new(), *section = NULL;

	for (int i = first; i <= last; i++) {
		enum verb end = VERB_COUNT;
		const char *label = i > first ? verb_nested((enum verb)i, &end) : NULL;

		if (verb_row((enum verb)i)->group != group)
			continue;
		if (!section || verb_is_parted((enum verb)i))
			section = section_new(part);
		if (label) {
			GMenu *nested = part_new(group, i, (int)end);

			g_menu_append_submenu(section, _(label), G_MENU_MODEL(nested));
			g_object_unref(nested);
			i = (int)end;
			continue;
		}
		verb_append(section, (enum verb)i, NULL, NULL);
		if (i == VERB_open)
			recent_follow(section, g_menu_model_get_n_items(
					      G_MENU_MODEL(section)));
	}
	return part;
}

/* The main menu, from the rows of verbs.def. Caller: g_object_unref(). */
static GMenu *menu_new(void)
{
	GMenu *menu = g_menu_new();

	for (int group = 0; group < VERBS_GROUPS; group++) {
		GMenu *part = part_new((enum verb_group)group, 0, VERB_COUNT - 1);

		g_menu_append_submenu(menu, _(verb_group_label((enum verb_group)group)),
				      G_MENU_MODEL(part));
		g_object_unref(part);
	}
	return menu;
}

/* The next press on the button makes a menu with the keys of the other scheme. */
static void menu_forget(LadderWindow *window)
{
	gtk_menu_button_set_menu_model(window->menu_button, NULL);
}

/* ---- state ---- */

/* Tells what the page in front is. */
static void tell_front(LadderWindow *window)
{
	struct core *core = &window->core;
	struct front *front = &window->front;
	LadderCanvas *canvas = front_seen_canvas(front);
	const bool sheet = front_seen_sheet(front) != NULL;
	const bool networks = front_seen_networks(front) != NULL;
	const bool free = canvas && !ladder_document_is_fixed(ladder_canvas_document(canvas));

	core_with(core, WITH_PROJECT, ladder_document_project(core->document) != NULL);
	core_with(core, WITH_PAGE, front_tab(front) != NULL);
	core_with(core, WITH_POU, front_pou(front) >= 0);
	core_with(core, WITH_CANVAS, canvas != NULL);
	core_with(core, WITH_RUNGS, sheet);
	core_with(core, WITH_CHART, canvas && !sheet && !networks);
	core_with(core, WITH_NETWORK, networks);
	core_with(core, WITH_PARTS, sheet || networks);
	core_with(core, WITH_FREE, free);
	core_with(core, WITH_ENTRY, free || (canvas && !sheet && !networks));
	core_with(core, WITH_LIST, front_list(front) != NULL);
	core_with(core, WITH_ST, front_list(front) && ladder_text_view_is_st(front_list(front)));
	core_with(core, WITH_LINES, (canvas && !sheet && !networks) || front_has_numbers(front));
	core_with(core, WITH_ZOOM, canvas || LADDER_IS_PREVIEW_VIEW(page_content(front_tab(front))));
}

static void name_button(GtkButton *button, const char *verb, const char *step)
{
	char *text = step ? g_strdup_printf(_("%s: %s"), verb, step) : g_strdup(verb);

	tip_set(GTK_WIDGET(button), text);
	g_free(text);
}

/* "~/ladders/door.rung". Caller frees. */
static char *short_path(const char *path)
{
	const char *home = g_get_home_dir();
	const gsize len = strlen(home);

	return len > 1 && g_str_has_prefix(path, home) && path[len] == G_DIR_SEPARATOR ?
	       g_strdup_printf("~%s", path + len) : g_strdup(path);
}

static void show_state(LadderWindow *window)
{
	LadderDocument *document = window->core.document;
	const char *undo = ladder_document_undo_name(document);
	const char *redo = ladder_document_redo_name(document);
	const char *path = ladder_document_path(document);
	char *name = ladder_document_name(document);
	char *title = g_strdup_printf("%s%s",
		ladder_document_is_saved(document) ? "" : "• ", name);

	char *place = path ? short_path(path) : g_strdup(_("not saved yet"));

	adw_window_title_set_title(window->title, title);
	if (!ladder_sim_is_on(window->core.sim)) /* else it shows the time */
		adw_window_title_set_subtitle(window->title, place);
	gtk_window_set_title(GTK_WINDOW(window), title);
	core_with(&window->core, WITH_UNDO, undo != NULL);
	core_with(&window->core, WITH_REDO, redo != NULL);
	tell_front(window);
	name_button(window->undo_button, _("Undo"), undo);
	name_button(window->redo_button, _("Redo"), redo);
	g_free(place);
	g_free(title);
	g_free(name);
}

/* The tree shows which page is in front. */
static void select_in_tree(LadderWindow *window)
{
	const struct project *project = ladder_document_project(window->core.document);
	AdwTabPage *page = front_tab(&window->front);
	LadderSideFile *file = page_file(page);
	const char *name = page && page_name(page) ? page_name(page) : " "; /* not named yet */

	ladder_project_tree_select(window->core.tree,
		project ? project_find_pou(project, name, strlen(name)) : -1,
		file ? ladder_side_file_path(file) : NULL, name);
}

/* The tiles for what has the keys; beside a chart, its rungs may have them. */
static void show_palette(LadderWindow *window)
{
	ladder_palette_show(window->palette, front_sheet(&window->front) ? PALETTE_LADDER :
			    front_networks(&window->front) ? PALETTE_NETWORK :
			    front_chart(&window->front) ? PALETTE_CHART : PALETTE_NONE);
}

/* The instruction list is that of the sheet, and shows the rung with the cursor. */
static void follow(GtkWidget *list, LadderGridView *sheet)
{
	ladder_code_view_set_pou(list, ladder_canvas_pou(LADDER_CANVAS(sheet)));
	ladder_code_view_set_rung(list, ladder_grid_view_first(sheet) +
				  ladder_grid_view_cursor(sheet).rung);
}

static void place_changed(LadderWindow *window)
{
	LadderGridView *sheet = front_sheet(&window->front);
	GtkWidget *list = sheet ? below_made(&window->below, "list") : NULL;

	if (!window->core.document) /* the pages of a closing window go one by one */
		return;
	tell_front(window);
	show_palette(window);
	if (list)
		follow(list, sheet);
}

static void page_changed(LadderWindow *window)
{
	if (!window->core.document) /* the pages of a closing window go one by one */
		return;
	select_in_tree(window);
	place_changed(window);
}

/* ---- panels ---- */

/* The title of the tab has the number of problems. */
static void title_changed(LadderWindow *window, LadderProblems *problems)
{
	below_set_title(&window->below, "problems", ladder_problems_title(problems));
	/* Problems of an opened file open the panel. Problems of an edit do not: it would move the sheet. */
	if (ladder_problems_count(problems, false) &&
	    !ladder_document_undo_name(window->core.document))
		below_open(&window->below);
}

static GtkWidget *make_problems(gpointer data)
{
	LadderWindow *window = data;
	GtkWidget *problems = ladder_problems_new();

	g_signal_connect_object(problems, "title-changed", G_CALLBACK(title_changed), window,
				G_CONNECT_SWAPPED);
	ladder_problems_set_document(LADDER_PROBLEMS(problems), window->core.document);
	return problems;
}

static GtkWidget *make_watch(gpointer data)
{
	const struct core *core = data;

	return ladder_watch_view_new(core->document, core->sim);
}

static GtkWidget *make_timing(gpointer data)
{
	const struct core *core = data;

	return ladder_timing_view_new(core->sim);
}

static GtkWidget *make_list(gpointer data)
{
	struct core *core = data;
	GtkWidget *list = ladder_code_view_new(core->document, core->sim);
	LadderGridView *sheet = front_sheet(core->front);

	if (sheet)
		follow(list, sheet);
	return list;
}

static GtkWidget *make_alarms(gpointer data)
{
	const struct core *core = data;

	return ladder_alarm_view_new(core->sim, core->link);
}

static GtkWidget *make_log(gpointer data)
{
	const struct core *core = data;

	return ladder_log_view_new(core->document);
}

/* Panels are added in the order of their tabs. */
static void add_parts(LadderWindow *window)
{
	struct core *core = &window->core;

	window->sim_bar.title = window->title;
	window->sim_bar.side = GTK_WIDGET(window->side);
	window->online_bar.edit_mode = window->sim_bar.edit_mode;
	spoken_choice(window->sim_bar.edit_mode);
	spoken_choice(window->sim_bar.simulate_mode);
	spoken_choice(window->online_bar.mode);
	messages_init(&window->messages, core);
	below_init(&window->below, core);
	front_init(&window->front, core);
	status_init(&window->status, core);
	origin_init(&window->origin, core);
	export_init(&window->export, core, &window->origin);
	compare_init(&window->compare, core);
	help_init(&window->help, core);
	sim_bar_init(&window->sim_bar, core, &window->origin);
	stand_bar_init(&window->stand_bar, core, window->front.now);
	blockers_init(&window->blockers, core);
	finder_init(&window->finder, core);
	below_add(&window->below, "problems", N_("Problems"), make_problems, window);
	names_add_panel(core);
	below_add(&window->below, "watch", N_("Status chart"), make_watch, core);
	below_add(&window->below, "timing", N_("Timing chart"), make_timing, core);
	scenarios_init(&window->scenarios, core, &window->origin, &window->sim_bar);
	below_add(&window->below, "list", N_("Instruction list"), make_list, core);
	below_add(&window->below, "alarms", N_("Alarms"), make_alarms, core);
	below_add(&window->below, "log", N_("Log"), make_log, core);
	exchange_init(&window->exchange, core, &window->origin, &window->export);
	files_init(&window->files, core, &window->origin, &window->exchange);
	board_bar_init(&window->board_bar, core, &window->export, &window->files);
	online_bar_init(&window->online_bar, core, &window->compare);
	online_log_init(&window->online_log, core);
	/* these two need to see all events from the start */
	below_panel(&window->below, "problems");
	below_panel(&window->below, "log");
}

static void add_sides(LadderWindow *window)
{
	window->core.tree = ladder_project_tree_new(window->core.document);
	ladder_project_tree_set_sim(window->core.tree, window->core.sim);
	gtk_paned_set_start_child(window->side, ladder_still_new(window->core.tree));
	window->palette = ladder_palette_new(window->core.document);
	gtk_paned_set_end_child(window->side, ladder_still_new(window->palette));
}

/* ---- settings ---- */

static void load_settings(LadderWindow *window)
{
	const int height = settings_int("height", 900);

	gtk_window_set_default_size(GTK_WINDOW(window), settings_int("width", 1440), height);
	/* both grow with the window */
	gtk_paned_set_position(window->side, (height - ABOVE_SIDE) * 2 / 5);
	if (settings_flag("maximized", FALSE))
		gtk_window_maximize(GTK_WINDOW(window));
	gtk_widget_set_visible(GTK_WIDGET(window->side), settings_flag("side", TRUE));
	gtk_widget_set_visible(GTK_WIDGET(window->below.box), settings_flag("below", TRUE));
}

static void keep_settings(LadderWindow *window)
{
	GSettings *settings = settings_get();
	int width, height;

	if (!settings)
		return;
	gtk_window_get_default_size(GTK_WINDOW(window), &width, &height);
	g_settings_set_int(settings, "width", width);
	g_settings_set_int(settings, "height", height);
	g_settings_set_boolean(settings, "maximized",
			       gtk_window_is_maximized(GTK_WINDOW(window)));
	g_settings_set_boolean(settings, "side",
			       gtk_widget_get_visible(GTK_WIDGET(window->side)) ||
			       window->sim_bar.side_hidden);
	g_settings_set_boolean(settings, "below",
			       below_is_wanted(&window->below));
}

/* ---- life ---- */

static gboolean look_at_disk(gpointer data)
{
	LadderWindow *window = data;

	files_look(&window->files);
	board_bar_look(&window->board_bar);
	return G_SOURCE_CONTINUE;
}

static gboolean ladder_window_close_request(GtkWindow *gtk_window)
{
	LadderWindow *window = LADDER_WINDOW(gtk_window);

	if (!front_take_typed(&window->front))
		return TRUE;
	if (!ladder_sim_board(window->core.sim)) /* a board goes on without the editor */
		ladder_sim_stop(window->core.sim);
	if (!board_bar_may_close(&window->board_bar))
		return TRUE;
	if (!files_may_close(&window->files))
		return TRUE;
	keep_settings(window);
	return GTK_WINDOW_CLASS(ladder_window_parent_class)->close_request(gtk_window);
}

static void ladder_window_dispose(GObject *object)
{
	LadderWindow *window = LADDER_WINDOW(object);
	struct core *core = &window->core;

	g_clear_handle_id(&window->disk_timer, g_source_remove);
	if (core->link) /* requests end now, while all parts are there */
		ladder_board_link_disconnect(core->link);
	online_bar_clear(&window->online_bar);
	online_log_clear(&window->online_log);
	board_bar_clear(&window->board_bar);
	scenarios_clear(&window->scenarios);
	compare_clear(&window->compare);
	help_clear(&window->help);
	blockers_clear(&window->blockers);
	sim_bar_clear(&window->sim_bar);
	stand_bar_clear(&window->stand_bar);
	origin_clear(&window->origin);
	front_clear(&window->front);
	g_clear_object(&core->paper);
	g_clear_object(&core->values);
	g_clear_object(&core->sim);
	g_clear_object(&core->board);
	g_clear_object(&core->link);
	if (core->document) { /* drafts of files are removed with their tabs     */
		g_signal_handlers_disconnect_by_data(core->document, window);
		ladder_document_set_cursor(core->document, NULL, NULL);
		draft_stop(core->document);
	}
	g_clear_object(&core->document);
	tabs_clear(&window->tabs);
	messages_clear(&window->messages);
	G_OBJECT_CLASS(ladder_window_parent_class)->dispose(object);
}

static void make_signals(GType type)
{
	g_signal_new("open-wanted", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE,
		     2, G_TYPE_STRING, G_TYPE_BOOLEAN);
	g_signal_new("open-on-board-wanted", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
		     G_TYPE_NONE, 1, G_TYPE_STRING);
	g_signal_new("new-wanted", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE,
		     0);
	g_signal_new("cursor-moved", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
		     G_TYPE_NONE, 0);
	g_signal_new("place-changed", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
		     G_TYPE_NONE, 0);
	g_signal_new("facts-changed", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
		     G_TYPE_NONE, 1, G_TYPE_UINT);
	g_signal_new("page-changed", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
		     G_TYPE_NONE, 0);
}

static void ladder_window_class_init(LadderWindowClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	tip_init();
	G_OBJECT_CLASS(class)->dispose = ladder_window_dispose;
	GTK_WINDOW_CLASS(class)->close_request = ladder_window_close_request;
	make_signals(G_TYPE_FROM_CLASS(class));
	g_type_ensure(LADDER_TYPE_STILL);
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/window.ui");
#define CHILD(name, field) gtk_widget_class_bind_template_child_full(widget, name, FALSE, \
	G_STRUCT_OFFSET(LadderWindow, field))
	CHILD("title", title); CHILD("side", side);
	CHILD("undo_button", undo_button); CHILD("redo_button", redo_button);
	CHILD("menu_button", menu_button);
	CHILD("toasts", messages.toasts); CHILD("message_label", messages.message_label);
	CHILD("banner", messages.banner); CHILD("banner_label", messages.banner_label);
	CHILD("banner_button", messages.banner_button);
	CHILD("banner_close", messages.banner_close);
	CHILD("below", below.box); CHILD("below_paned", below.paned);
	CHILD("below_stack", below.stack); CHILD("below_switcher", below.switcher);
	CHILD("below_tabs", below.tabs); CHILD("below_more", below.more);
	CHILD("tab_bar", front.tab_bar); CHILD("front", front.now); CHILD("tabs", front.tabs);
	CHILD("nothing_label", front.nothing_label); CHILD("find_place", finder.place);
	CHILD("pill", status.pill); CHILD("place_label", status.place);
	CHILD("checked_label", status.checked); CHILD("zoom_label", status.zoom);
	CHILD("right", sim_bar.right); CHILD("edit_mode", sim_bar.edit_mode);
	CHILD("simulate_mode", sim_bar.simulate_mode);
	CHILD("online_mode", online_bar.mode); CHILD("online_place", online_bar.place); CHILD("sim_buttons", sim_bar.buttons);
	CHILD("run_button", sim_bar.run_button); CHILD("pace_button", sim_bar.pace_button);
	CHILD("forces_button", sim_bar.forces_button);
	CHILD("record_button", scenarios.record_button);
#undef CHILD
	install_actions(widget);
}

static void ladder_window_init(LadderWindow *window)
{
	gtk_widget_init_template(GTK_WIDGET(window));
	paned_mend(window->side);
	for (GtkWidget *at = GTK_WIDGET(window->below.paned); at; at = gtk_widget_get_parent(at))
		if (GTK_IS_PANED(at))
			paned_mend(GTK_PANED(at));
	popover_menu_of(window->menu_button, menu_new);
	if (settings_get())
		g_signal_connect_object(settings_get(), "changed::keys", G_CALLBACK(menu_forget),
					window, G_CONNECT_SWAPPED);
	window->core = (struct core){
		.window = GTK_WINDOW(window), .messages = &window->messages,
		.below = &window->below, .front = &window->front, .tabs = &window->tabs,
		.paper = gtk_page_setup_new(),
	};
}

LadderWindow *ladder_window_new(AdwApplication *application, LadderDocument *document)
{
	LadderWindow *window = g_object_new(LADDER_TYPE_WINDOW, "application", application,
					    NULL);

	window->core.document = g_object_ref(document);
	window->core.sim = ladder_sim_new(document);
	window->core.board = ladder_board_run_new();
	window->core.link = ladder_board_link_new();
	window->core.values = ladder_board_values_new(window->core.sim, window->core.link);
	g_signal_connect_object(document, "state-changed", G_CALLBACK(show_state), window,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(window->core.sim, "state-changed", G_CALLBACK(show_state),
				window, G_CONNECT_SWAPPED);
	g_signal_connect(window, "page-changed", G_CALLBACK(page_changed), NULL);
	g_signal_connect(window, "place-changed", G_CALLBACK(place_changed), NULL);
	g_signal_connect(window, "cursor-moved", G_CALLBACK(place_changed), NULL);
	window->core.with = ~0u;
	core_with(&window->core, ~0u, false);
	hear_keys(window, GTK_PHASE_CAPTURE, G_CALLBACK(key_comes));
	hear_keys(window, GTK_PHASE_BUBBLE, G_CALLBACK(key_left));
	load_settings(window);
	add_sides(window);
	add_parts(window);
	tabs_init(&window->tabs, &window->core);
	show_state(window);
	window->disk_timer = g_timeout_add_seconds(DISK_SECONDS, look_at_disk, window);
	spoken_parts(GTK_WIDGET(window));
	return window;
}
