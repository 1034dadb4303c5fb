/* SPDX-License-Identifier: MIT
 *
 * window - one document's window: sheets in tabs, panels round them.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/panels/palette.h"
#include "editor-gtk/panels/panels.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/settings.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/still.h"
#include "editor-gtk/kit/gtk48/tip.h"

#include <string.h>

G_DEFINE_FINAL_TYPE(LadderWindow, ladder_window, ADW_TYPE_APPLICATION_WINDOW)

#define NARROW 1100 /* px; below it the left side folds                        */

/* ---- messages ---- */

#define TOLD 1500000 /* us a message stays at least, if the cursor moves on    */
#define TOLD_BY_STEP 300000 /* us from what a step says to the end of its check */

void window_toast(LadderWindow *window, const char *text)
{
	adw_toast_overlay_add_toast(window->toasts, adw_toast_new(text));
}

/* Sheets speak until they have gone, which is after their window let go of its document. */
static bool goes(LadderWindow *window)
{
	return !window->document;
}

void ladder_window_tell(LadderWindow *window, const char *text)
{
	if (goes(window))
		return;
	window->told_at = text[0] ? g_get_monotonic_time() : 0;
	window->told_of = ladder_document_version(window->document);
	if (!text[0] && window->keys_text)
		text = window->keys_text;
	gtk_label_set_text(window->message_label, text);
	tip_set(GTK_WIDGET(window->message_label), text);
}

void window_show_keys(LadderWindow *window, char *text)
{
	g_free(window->keys_text);
	window->keys_text = text;
	if (goes(window)) /* the last one */
		g_clear_pointer(&window->keys_text, g_free);
	if (g_get_monotonic_time() - window->told_at > TOLD)
		ladder_window_tell(window, "");
}

/* What was said of a program that is another now is over, but for what a step said while it
 * was made. */
static void forget_told(LadderWindow *window)
{
	if (window->told_of == ladder_document_version(window->document))
		return;
	if (g_get_monotonic_time() - window->told_at > TOLD_BY_STEP)
		ladder_window_tell(window, "");
	window->told_of = ladder_document_version(window->document);
}

static void forget_bookmarks(LadderWindow *window)
{
	ladder_window_tell(window, "");
}

void window_log(LadderWindow *window, const char *kind, const char *text)
{
	ladder_log_view_put(below_panel(window, "log"), kind, text);
}

void window_banner_of(LadderWindow *window, const char *kind, const char *text,
		      const char *button, void (*act)(LadderWindow *window))
{
	window_log(window, kind, text);
	gtk_label_set_text(window->banner_label, text);
	gtk_widget_set_visible(GTK_WIDGET(window->banner_button), button != NULL);
	if (button)
		gtk_button_set_label(window->banner_button, button);
	window->banner_do = act;
	gtk_revealer_set_reveal_child(window->banner, TRUE);
}

void window_banner(LadderWindow *window, const char *text, const char *button,
		   void (*act)(LadderWindow *window))
{
	window_banner_of(window, _("system"), text, button, act);
}

LadderSim *ladder_window_sim(LadderWindow *window)
{
	return window->sim;
}

void ladder_window_welcome(LadderWindow *window)
{
	tabs_show_widget(window, "welcome");
}

void ladder_window_show_file(LadderWindow *window, const char *path)
{
	tabs_show_file(window, path);
}

void ladder_window_warn(LadderWindow *window, const char *text)
{
	window_banner(window, text, NULL, NULL);
}

void ladder_window_offer_restored(LadderWindow *window)
{
	window_banner(window, _("This was not saved when the editor ended. It is as you "
				"left it."), _("Save"), window_save);
}

void window_banner_close(LadderWindow *window)
{
	gtk_revealer_set_reveal_child(window->banner, FALSE);
}

static void banner_clicked(LadderWindow *window)
{
	window_banner_close(window);
	if (window->banner_do)
		window->banner_do(window);
}

/* ---- state ---- */

static void name_button(GtkButton *button, const char *verb, const char *step)
{
	char *text = step ? g_strdup_printf("%s: %s", verb, step) : g_strdup(verb);

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

void window_show_state(LadderWindow *window)
{
	LadderDocument *document = window->document;
	const char *undo = ladder_document_undo_name(document);
	const char *redo = ladder_document_redo_name(document);
	const char *path = ladder_document_path(document);
	char *name = ladder_document_name(document);
	char *title = g_strdup_printf("%s%s",
		ladder_document_is_saved(document) ? "" : "• ", name);

	adw_window_title_set_title(window->title, title);
	char *place = path ? short_path(path) : g_strdup(_("not saved yet"));

	adw_window_title_set_subtitle(window->title, place);
	g_free(place);
	gtk_window_set_title(GTK_WINDOW(window), title);
	gtk_widget_action_set_enabled(GTK_WIDGET(window), "win.undo", undo != NULL);
	gtk_widget_action_set_enabled(GTK_WIDGET(window), "win.redo", redo != NULL);
	name_button(window->undo_button, _("Undo"), undo);
	name_button(window->redo_button, _("Redo"), redo);
	g_free(title);
	g_free(name);
}

static void show_checked(LadderWindow *window)
{
	const struct diag_list *diags = ladder_document_diags(window->document);
	const int warnings = diags->count + diags->dropped - diags->errors;
	char *text;

	forget_told(window);
	if (diags->errors)
		text = g_strdup_printf(ngettext("%d error", "%d errors",
			(unsigned long)diags->errors), diags->errors);
	else if (warnings)
		text = g_strdup_printf(ngettext("%d warning", "%d warnings",
			(unsigned long)warnings), warnings);
	else
		text = g_strdup(_("no problems"));
	gtk_label_set_text(window->checked_label, text);
	g_free(text);
}

LadderDocument *ladder_window_document(LadderWindow *window)
{
	return window->document;
}

bool ladder_window_is_untouched(LadderWindow *window)
{
	return !ladder_document_path(window->document) &&
	       ladder_document_is_saved(window->document) &&
	       !ladder_document_undo_name(window->document) &&
	       !ladder_sim_is_on(window->sim);
}

/* ---- panels ---- */

static void add_panels(LadderWindow *window)
{
	window->tree = ladder_project_tree_new(window->document);
	gtk_paned_set_start_child(window->side, ladder_still_new(window->tree));
	window->palette = ladder_palette_new(window->document);
	gtk_paned_set_end_child(window->side, ladder_still_new(window->palette));
	gtk_paned_set_position(window->side, 230);
	window_scenario_init(window);
	below_init(window);
	gtk_paned_set_position(window->below_paned, 620);
	window_find_init(window);
	window_sim_init(window);
	window_board_init(window);
	window_drop_init(window);
}

/* ---- settings ---- */

static void load_settings(LadderWindow *window)
{
	gtk_window_set_default_size(GTK_WINDOW(window), settings_int("width", 1440),
				    settings_int("height", 900));
	if (settings_flag("maximized", FALSE))
		gtk_window_maximize(GTK_WINDOW(window));
	gtk_widget_set_visible(GTK_WIDGET(window->side), settings_flag("side", TRUE));
	gtk_widget_set_visible(GTK_WIDGET(window->below), settings_flag("below", TRUE));
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
			       gtk_widget_get_visible(GTK_WIDGET(window->side)));
	g_settings_set_boolean(settings, "below",
			       gtk_widget_get_visible(GTK_WIDGET(window->below)));
}

/* ---- life ---- */

static gboolean ladder_window_close_request(GtkWindow *gtk_window)
{
	LadderWindow *window = LADDER_WINDOW(gtk_window);

	if (!tabs_take_typed(window))
		return TRUE;
	ladder_sim_stop(window->sim);
	if (!window_board_may_close(window))
		return TRUE;
	if (!window->closing && !window_may_close(window))
		return TRUE;
	keep_settings(window);
	return GTK_WINDOW_CLASS(ladder_window_parent_class)->close_request(gtk_window);
}

static void ladder_window_dispose(GObject *object)
{
	LadderWindow *window = LADDER_WINDOW(object);

	if (window->disk_timer)
		g_source_remove(window->disk_timer);
	window->disk_timer = 0;
	g_clear_handle_id(&window->when_timer, g_source_remove);
	g_clear_object(&window->recorder);
	window_why_free(window);
	window_older_free(window);
	g_clear_object(&window->sim);
	g_clear_object(&window->board);
	g_clear_object(&window->classic);
	if (window->document) { /* files beside it go only with the tabs         */
		g_signal_handlers_disconnect_by_data(window->document, window);
		draft_stop(window->document);
	}
	g_clear_object(&window->document);
	g_clear_pointer(&window->keys_text, g_free);
	g_clear_pointer(&window->board_said, g_free);
	g_clear_pointer(&window->origin, g_free);
	g_clear_pointer(&window->plant, g_free);
	G_OBJECT_CLASS(ladder_window_parent_class)->dispose(object);
}

static void ladder_window_class_init(LadderWindowClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	tip_init();
	G_OBJECT_CLASS(class)->dispose = ladder_window_dispose;
	GTK_WINDOW_CLASS(class)->close_request = ladder_window_close_request;
	g_type_ensure(LADDER_TYPE_STILL);
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/window.ui");
#define CHILD(name) gtk_widget_class_bind_template_child(widget, LadderWindow, name)
	CHILD(toasts); CHILD(title); CHILD(undo_button); CHILD(redo_button);
	CHILD(menu_button); CHILD(side_paned); CHILD(side); CHILD(below_paned);
	CHILD(right_paned); CHILD(right); CHILD(edit_mode); CHILD(simulate_mode);
	CHILD(sim_buttons); CHILD(run_button); CHILD(forces_button); CHILD(pace_button);
	CHILD(record_button);
	CHILD(tab_bar); CHILD(front); CHILD(tabs); CHILD(nothing_label);
	CHILD(banner); CHILD(banner_label);
	CHILD(banner_button); CHILD(banner_close); CHILD(find_place); CHILD(below);
	CHILD(below_stack); CHILD(below_switcher);
	CHILD(below_tabs); CHILD(below_more); CHILD(pill); CHILD(place_label); CHILD(message_label);
	CHILD(checked_label); CHILD(zoom_label);
#undef CHILD
	window_install_actions(widget);
}

static void ladder_window_init(LadderWindow *window)
{
	gtk_widget_init_template(GTK_WIDGET(window));
	popover_menu_of(window->menu_button, window_menu);
	spoken_text(window->place_label);
	spoken_text(window->message_label);
	spoken_text(window->checked_label);
	spoken_text(window->zoom_label);
	g_signal_connect_swapped(window->banner_button, "clicked",
				 G_CALLBACK(banner_clicked), window);
	g_signal_connect_swapped(window->banner_close, "clicked",
				 G_CALLBACK(window_banner_close), window);
}

LadderWindow *ladder_window_new(AdwApplication *application, LadderDocument *document)
{
	LadderWindow *window = g_object_new(LADDER_TYPE_WINDOW, "application", application,
					    NULL);

	window->document = g_object_ref(document);
	window->sim = ladder_sim_new(document);
	window->board = ladder_board_run_new();
	g_signal_connect_object(document, "state-changed", G_CALLBACK(window_show_state),
				window, G_CONNECT_SWAPPED);
	g_signal_connect_object(document, "checked", G_CALLBACK(show_checked), window,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(document, "bookmarks-changed", G_CALLBACK(forget_bookmarks),
				window, G_CONNECT_SWAPPED);
	load_settings(window);
	add_panels(window);
	tabs_init(window);
	window_show_state(window);
	window_watch_disk(window);
	spoken_parts(GTK_WIDGET(window));
	return window;
}
