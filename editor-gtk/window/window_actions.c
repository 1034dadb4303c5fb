/* SPDX-License-Identifier: MIT
 *
 * window_actions - what each verb of the window does.
 *
 * Every row of verbs.def is an action "win.ID". Verbs of a sheet go to the sheet in front.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/window/app.h"
#include "editor-gtk/window/commands.h"
#include "editor-gtk/panels/palette.h"
#include "editor-gtk/document/pou_edit.h"
#include "editor-gtk/window/pou_import_dialog.h"
#include "editor-gtk/window/preferences.h"
#include "editor-gtk/panels/problems.h"
#include "editor-gtk/window/recent.h"
#include "editor-gtk/kit/settings.h"

#include "engine/base/version.h"

/* ---- editing ---- */

/* Of the tree, if one is there; else of the name at the cursor. */
static void do_rename(LadderWindow *window)
{
	GtkWidget *focus = gtk_window_get_focus(GTK_WINDOW(window));

	if (!focus || !gtk_widget_activate_action(focus, "tree.rename", NULL))
		names_rename(window);
}

/* ---- going ---- */

static void do_next_problem(LadderWindow *window)
{
	LadderProblems *problems = LADDER_PROBLEMS(below_panel(window, "problems"));

	ladder_window_tell(window, ladder_problems_next(problems, false) ?
			   ladder_problems_current(problems) : _("no problems"));
}

static void do_next_bookmark(LadderWindow *window)
{
	LadderGridView *sheet = tabs_sheet(window);
	int pou = sheet ? ladder_grid_view_pou(sheet) : 0;
	int rung = sheet ? ladder_grid_view_cursor(sheet).rung : -1;

	if (ladder_document_next_bookmark(window->document, &pou, &rung))
		tabs_go(window, pou, rung, -1, -1);
	else
		ladder_window_tell(window, _("no bookmarks"));
}

static void do_sheet_by(LadderWindow *window, bool next)
{
	if (window_older_by(window, next ? 1 : -1))
		return;
	if (next ? !adw_tab_view_select_next_page(window->tabs) :
		   !adw_tab_view_select_previous_page(window->tabs))
		return;
	tabs_enter(window);
}

/* ---- viewing ---- */

static void zoom(LadderWindow *window, double factor)
{
	LadderGridView *sheet = tabs_seen_sheet(window);

	LadderSfcView *chart = tabs_seen_chart(window);

	if (sheet)
		ladder_grid_view_set_zoom(sheet, factor == 0 ? 1 :
					  ladder_grid_view_zoom(sheet) * factor);
	else if (chart)
		ladder_sfc_view_set_zoom(chart, factor == 0 ? 1 :
					 ladder_sfc_view_zoom(chart) * factor);
}

static void do_show_as(LadderWindow *window)
{
	LadderGridView *sheet = tabs_seen_sheet(window);

	if (!sheet)
		return;
	ladder_grid_view_set_show(sheet, (ladder_grid_view_show(sheet) + 1) % 3);
	if (settings_get())
		g_settings_set_enum(settings_get(), "show",
				    (int)ladder_grid_view_show(sheet));
}

static void toggle(GtkWidget *widget)
{
	gtk_widget_set_visible(widget, !gtk_widget_get_visible(widget));
}

/* Light, dark, as the desktop has it. */
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
	ladder_window_tell(window, _(names[next]));
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

static void add_pou(LadderWindow *window, const char *what)
{
	const char *why = pou_add(GTK_WIDGET(window), window->document, what);

	if (why)
		ladder_window_tell(window, why);
}

/* On their page, which is made when it is seen. */
static void import_symbols(LadderWindow *window)
{
	GtkWidget *place, *symbols;

	if (!ladder_document_project(window->document)) {
		window_toast(window, _("The file cannot be read as a program"));
		return;
	}
	place = tabs_show_widget(window, "symbols");
	symbols = place ? adw_bin_get_child(ADW_BIN(place)) : NULL;
	if (symbols)
		gtk_widget_activate_action(symbols, "symbols.import", NULL);
}

static bool do_project(LadderWindow *window, enum verb verb)
{
	switch ((int)verb) {
	case VERB_new_program: add_pou(window, "PROGRAM LD"); return true;
	case VERB_new_list: add_pou(window, "PROGRAM IL"); return true;
	case VERB_new_chart: add_pou(window, "PROGRAM SFC"); return true;
	case VERB_new_block: add_pou(window, "FUNCTION_BLOCK LD"); return true;
	case VERB_new_function: add_pou(window, "FUNCTION LD"); return true;
	case VERB_new_subroutine: add_pou(window, "SUBROUTINE LD"); return true;
	case VERB_import:
		pou_import_ask(GTK_WIDGET(window), window->document);
		return true;
	case VERB_new_iomap: window_new_iomap(window); return true;
	case VERB_symbols:
		tabs_show_widget(window, "symbols");
		tabs_enter(window);
		return true;
	case VERB_import_symbols: import_symbols(window); return true;
	case VERB_export_symbols: window_export_symbols(window); return true;
	default: return false;
	}
}

/* ---- the table ---- */

/* Esc closes the bar that finds when the sheet has nothing to give back. */
static void do_on_sheet(LadderWindow *window, LadderGridView *sheet, enum verb verb)
{
	const guint64 version = ladder_document_version(window->document);
	const bool begun = ladder_grid_view_has_begun(sheet);

	ladder_grid_view_do(sheet, verb);
	if (verb == VERB_cancel && !begun && ladder_document_version(window->document) == version)
		window_find_close(window);
}

void ladder_window_do(LadderWindow *window, enum verb verb)
{
	LadderGridView *sheet = tabs_seen_sheet(window);

	const enum verb_where where = verb_row(verb)->where;

	if (!tabs_take_typed(window) && (verb == VERB_close || verb == VERB_close_tab))
		return;
	if (where != VERB_WINDOW) {
		if (sheet && where != VERB_CHART)
			do_on_sheet(window, sheet, verb);
		else if (!sheet && tabs_seen_chart(window) && where != VERB_SHEET)
			ladder_sfc_view_do(tabs_seen_chart(window), verb);
		else if (verb == VERB_copy_picture)
			ladder_window_tell(window, _("Rungs are copied as pictures: open a "
						     "sheet first."));
		return;
	}
	if (do_project(window, verb) || window_sim(window, verb) || window_scenario(window, verb))
		return;
	switch ((int)verb) {
	case VERB_new_project: app_new_window(window); break;
	case VERB_open: window_open(window); break;
	case VERB_save: window_save(window); break;
	case VERB_run_board: window_run_board(window); break;
	case VERB_stop_board: window_stop_board(window); break;
	case VERB_save_as: window_save_as(window); break;
	case VERB_export_classic: window_export_classic(window); break;
	case VERB_print: window_print(window); break;
	case VERB_export_pdf: window_export_pdf(window); break;
	case VERB_preferences: preferences_show(window); break;
	case VERB_close_tab: tabs_close(window); break;
	case VERB_close: gtk_window_close(GTK_WINDOW(window)); break;
	case VERB_undo: window_step(window, false); break;
	case VERB_redo: window_step(window, true); break;
	case VERB_find: case VERB_replace: case VERB_find_next:
	case VERB_find_previous:
		window_find(window, verb);
		break;
	case VERB_find_element:
		gtk_widget_set_visible(GTK_WIDGET(window->side), TRUE);
		ladder_palette_find(window->palette);
		break;
	case VERB_watch_add: names_watch(window); break;
	case VERB_show_uses: names_show_uses(window); break;
	case VERB_rename: do_rename(window); break;
	case VERB_go_coil: names_go_driver(window); break;
	case VERB_go_rung:
		if (!sheet && tabs_seen_chart(window))
			ladder_sfc_view_do(tabs_seen_chart(window), verb); /* a step */
		else
			window_ask_number(window);
		break;
	case VERB_bookmark:
		if (sheet)
			do_on_sheet(window, sheet, verb);
		else
			ladder_window_tell(window, _("Only rungs have bookmarks: open a sheet "
						     "first."));
		break;
	case VERB_next_bookmark: do_next_bookmark(window); break;
	case VERB_next_problem: do_next_problem(window); break;
	case VERB_next_sheet: do_sheet_by(window, true); break;
	case VERB_previous_sheet: do_sheet_by(window, false); break;
	case VERB_show_report: window_show_report(window); break;
	case VERB_show_original: window_show_original(window); break;
	case VERB_show_as: do_show_as(window); break;
	case VERB_zoom_in: zoom(window, 1.25); break;
	case VERB_zoom_out: zoom(window, 0.8); break;
	case VERB_zoom_reset: zoom(window, 0); break;
	case VERB_side: toggle(GTK_WIDGET(window->side)); break;
	case VERB_below: toggle(GTK_WIDGET(window->below)); break;
	case VERB_appearance: do_appearance(window); break;
	case VERB_fullscreen: do_fullscreen(window); break;
	case VERB_palette: commands_show(window); break;
	case VERB_shortcuts: keys_show(window); break;
	case VERB_welcome: tabs_show_widget(window, "welcome"); break;
	case VERB_about: do_about(window); break;
	default: break;
	}
}

/* ---- actions ---- */

static void act(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)unused;
	ladder_window_do(LADDER_WINDOW(widget), verb_find(name));
}

static void go_to(GtkWidget *widget, const char *name, GVariant *place)
{
	int pou, rung, row, col;

	(void)name;
	g_variant_get(place, "(iiii)", &pou, &rung, &row, &col);
	tabs_go(LADDER_WINDOW(widget), pou, rung, row, col);
}

static void rename_pou(GtkWidget *widget, const char *name, GVariant *pou)
{
	(void)name;
	names_rename_pou(LADDER_WINDOW(widget), g_variant_get_int32(pou));
}

static void show_uses(GtkWidget *widget, const char *action, GVariant *name)
{
	(void)action;
	names_show_uses_of(LADDER_WINDOW(widget), g_variant_get_string(name, NULL));
}

static void expect_value(GtkWidget *widget, const char *action, GVariant *name)
{
	(void)action;
	window_expect(LADDER_WINDOW(widget), g_variant_get_string(name, NULL));
}

static void watch_value(GtkWidget *widget, const char *action, GVariant *name)
{
	(void)action;
	names_watch_this(LADDER_WINDOW(widget), g_variant_get_string(name, NULL));
}

static void show_panel(GtkWidget *widget, const char *action, GVariant *name)
{
	(void)action;
	below_show(LADDER_WINDOW(widget), g_variant_get_string(name, NULL));
}

static void open_path(GtkWidget *widget, const char *action, GVariant *path)
{
	(void)action;
	app_open_path(LADDER_WINDOW(widget), g_variant_get_string(path, NULL));
}

static void open_text(GtkWidget *widget, const char *action, GVariant *path)
{
	(void)action;
	tabs_show_file(LADDER_WINDOW(widget), g_variant_get_string(path, NULL));
}

static void open_sample(GtkWidget *widget, const char *action, GVariant *path)
{
	(void)action;
	app_open_sample(LADDER_WINDOW(widget), g_variant_get_string(path, NULL));
}

/* From the welcome page to the empty sheet. */
static void begin(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderWindow *window = LADDER_WINDOW(widget);
	AdwTabPage *page = adw_tab_view_get_selected_page(window->tabs);

	(void)action;
	(void)unused;
	tabs_show(window, 0);
	adw_tab_view_close_page(window->tabs, page);
}

static void place_word(GtkWidget *widget, const char *name, GVariant *word)
{
	LadderWindow *window = LADDER_WINDOW(widget);
	LadderGridView *sheet = tabs_sheet(window);

	(void)name;
	if (sheet)
		ladder_grid_view_put(sheet, (enum word)g_variant_get_int32(word));
	else
		ladder_window_tell(window, _("Elements go into rungs: open a sheet first."));
}

static void tell(GtkWidget *widget, const char *name, GVariant *text)
{
	(void)name;
	ladder_window_tell(LADDER_WINDOW(widget), g_variant_get_string(text, NULL));
}

static void to_sheet(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)name;
	(void)unused;
	tabs_enter(LADDER_WINDOW(widget));
}

void window_install_actions(GtkWidgetClass *class)
{
	for (int i = 0; i < VERB_COUNT; i++)
		gtk_widget_class_install_action(class, verb_row((enum verb)i)->action,
						NULL, act);
	gtk_widget_class_install_action(class, "win.go-to", "(iiii)", go_to);
	gtk_widget_class_install_action(class, "win.rename-pou", "i", rename_pou);
	gtk_widget_class_install_action(class, "win.show-uses", "s", show_uses);
	gtk_widget_class_install_action(class, "win.expect-value", "s", expect_value);
	gtk_widget_class_install_action(class, "win.watch-value", "s", watch_value);
	gtk_widget_class_install_action(class, "win.open-path", "s", open_path);
	gtk_widget_class_install_action(class, "win.open-text", "s", open_text);
	gtk_widget_class_install_action(class, "win.open-sample", "s", open_sample);
	gtk_widget_class_install_action(class, "win.begin", NULL, begin);
	gtk_widget_class_install_action(class, "win.place", "i", place_word);
	gtk_widget_class_install_action(class, "win.to-sheet", NULL, to_sheet);
	/* Between the panes GTK goes by it; what is above them is in none. */
	gtk_widget_class_add_binding_action(class, GDK_KEY_F6, 0, "win.to-sheet", NULL);
	gtk_widget_class_install_action(class, "win.tell", "s", tell);
	gtk_widget_class_install_action(class, "win.show-panel", "s", show_panel);
}

GMenu *window_menu(void)
{
	GMenu *menu = g_menu_new();

	for (int group = 0; group < VERBS_GROUPS; group++) {
		GMenu *part = g_menu_new();
		int recent = -1;

		for (int i = 0; i < VERB_COUNT; i++) {
			if ((int)verb_row((enum verb)i)->group != group)
				continue;
			g_menu_append(part, _(verb_row((enum verb)i)->label),
				      verb_row((enum verb)i)->action);
			if (i == VERB_open)
				recent = g_menu_model_get_n_items(G_MENU_MODEL(part));
		}
		if (recent >= 0)
			recent_follow(part, recent);
		g_menu_append_submenu(menu, _(verb_group_label((enum verb_group)group)),
				      G_MENU_MODEL(part));
		g_object_unref(part);
	}
	return menu;
}
