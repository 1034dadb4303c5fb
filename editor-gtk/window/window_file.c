/* SPDX-License-Identifier: MIT
 *
 * window_file - opening, saving and closing, and what is asked before.
 *
 * Unsaved work is never lost without being asked. What cannot be done is told in a banner,
 * and the work is kept.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/window/app.h"
#include "editor-gtk/document/panel.h"
#include "editor-gtk/document/classic.h"
#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/draft.h"
#include "editor-gtk/window/recent.h"

#include <string.h>

#define DISK_SECONDS 2 /* between looks at the file                            */

/* ---- choosing a file ---- */

GtkFileChooserNative *window_chooser(LadderWindow *window, const char *title,
					 GtkFileChooserAction action, const char *accept)
{
	GtkFileChooserNative *chooser = gtk_file_chooser_native_new(title,
		GTK_WINDOW(window), action, accept, _("Cancel"));
	GtkFileFilter *rungs = gtk_file_filter_new(), *all = gtk_file_filter_new();

	gtk_file_filter_set_name(rungs, _("Rung files"));
	gtk_file_filter_add_pattern(rungs, "*.rung");
	gtk_file_filter_set_name(all, _("All files"));
	gtk_file_filter_add_pattern(all, "*");
	gtk_file_chooser_add_filter(GTK_FILE_CHOOSER(chooser), rungs);
	gtk_file_chooser_add_filter(GTK_FILE_CHOOSER(chooser), all);
	gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(chooser), TRUE);
	panel_choose_beside(chooser, window->document);
	g_object_unref(rungs);
	g_object_unref(all);
	return chooser;
}

char *window_chosen_path(GtkNativeDialog *dialog)
{
	GFile *file = gtk_file_chooser_get_file(GTK_FILE_CHOOSER(dialog));
	char *path = file ? g_file_get_path(file) : NULL;

	g_clear_object(&file);
	return path;
}

/* ---- opening ---- */

static void open_response(GtkNativeDialog *dialog, int response, LadderWindow *window)
{
	char *path = response == GTK_RESPONSE_ACCEPT ? window_chosen_path(dialog) : NULL;

	if (path)
		app_open_path(window, path);
	g_free(path);
	g_object_unref(dialog);
}

/* All that opens, before one or the other. */
static void add_all(GtkFileChooser *chooser)
{
	GtkFileFilter *filter = gtk_file_filter_new();

	gtk_file_filter_set_name(filter, _("Programs, scenarios, I/O maps"));
	gtk_file_filter_add_pattern(filter, "*.rung");
	gtk_file_filter_add_pattern(filter, "*.scn");
	gtk_file_filter_add_pattern(filter, "*.io");
	gtk_file_filter_add_pattern(filter, "*.clprj");
	gtk_file_filter_add_pattern(filter, "*.clprjz");
	gtk_file_filter_add_pattern(filter, "*.clp");
	gtk_file_chooser_add_filter(chooser, filter);
	gtk_file_chooser_set_filter(chooser, filter);
	g_object_unref(filter);
}

void window_open(LadderWindow *window)
{
	GtkFileChooserNative *chooser = window_chooser(window, _("Open"),
		GTK_FILE_CHOOSER_ACTION_OPEN, _("Open"));

	add_all(GTK_FILE_CHOOSER(chooser));
	window_classic_filter(GTK_FILE_CHOOSER(chooser), false);

	g_signal_connect(chooser, "response", G_CALLBACK(open_response), window);
	gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
}

/* ---- saving ---- */

static bool save_to(LadderWindow *window, const char *path)
{
	const char *sample = window_sample(window);
	GError *error = NULL;

	if (ladder_document_save(window->document, path, &error)) {
		window->over_locked = window->over_locked && !path;
		draft_remove(window->document);
		recent_add(ladder_document_path(window->document));
		ladder_window_tell(window, _("Saved"));
		window_banner_close(window);
		window->disk_told = DISK_AS_READ;
		window_classic_saved(window);
		if (sample)
			window_sample_saved(window, sample);
		return true;
	}
	window_banner(window, error->message, _("Save as…"), window_save_as);
	g_clear_error(&error);
	return false;
}

/* The file is read-only, and nobody said yet that it is written over all the same. */
static bool is_locked(LadderWindow *window)
{
	const char *path = ladder_document_path(window->document);

	return path && !window->over_locked && disk_is_locked(path);
}

static void save_locked(LadderWindow *window)
{
	window->over_locked = true;
	save_to(window, NULL);
}

static void ask_locked(LadderWindow *window)
{
	window_banner(window, _("The file is read-only. Saving would write over it; saved as "
				"another file it stays as it is."), _("Save all the same"),
		      save_locked);
}

static void save_over(LadderWindow *window)
{
	if (is_locked(window))
		ask_locked(window);
	else
		save_to(window, NULL);
}

/* For ClassicLadder it is written and not saved: the window stays. */
static void save_chosen(LadderWindow *window, const char *path)
{
	if (classic_save_is(path)) {
		window->closing = false;
		window_export_to(window, path);
	} else if (save_to(window, path) && window->closing) {
		gtk_window_close(GTK_WINDOW(window));
	} else {
		window->closing = false;
	}
}

/* Endings of programs, and the one it has: any other is that of a scenario, a map, a table
 * beside it, and what is read as that would be a program. Caller frees. */
static char *program_endings(LadderWindow *window, bool classic)
{
	const char *path = ladder_document_path(window->document);
	char *name = g_path_get_basename(path ? path : ""), *lower = g_utf8_strdown(name, -1);
	const char *own = strrchr(lower, '.');
	char *endings = g_strconcat(classic ? ".clprj|.clprjz|.clp|.rung" :
				    ".rung|.clprj|.clprjz|.clp", own ? "|" : NULL, own, NULL);

	g_free(lower);
	g_free(name);
	return endings;
}

static void save_response(GtkNativeDialog *dialog, int response, LadderWindow *window)
{
	GtkFileFilter *filter = gtk_file_chooser_get_filter(GTK_FILE_CHOOSER(dialog));
	const char *kind = filter ? gtk_file_filter_get_name(filter) : NULL;
	char *path = response == GTK_RESPONSE_ACCEPT ? window_chosen_path(dialog) : NULL;
	char *endings = program_endings(window, kind && g_str_has_prefix(kind, "Classic"));

	if (path)
		window_save_named(window, path, endings, save_chosen);
	else
		window->closing = false;
	g_free(endings);
	g_free(path);
	g_object_unref(dialog);
}

void window_save_as(LadderWindow *window)
{
	GtkFileChooserNative *chooser = window_chooser(window, _("Save as"),
		GTK_FILE_CHOOSER_ACTION_SAVE, _("Save"));
	const char *path = ladder_document_path(window->document);
	char *name = path ? g_path_get_basename(path) :
		window->classic || window_sample(window) ?
		window_name_with(window, ".rung") : g_strdup(_("program.rung"));

	window_classic_filter(GTK_FILE_CHOOSER(chooser), false);
	gtk_file_chooser_set_current_name(GTK_FILE_CHOOSER(chooser), name);
	g_free(name);
	g_signal_connect(chooser, "response", G_CALLBACK(save_response), window);
	gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
}

bool window_save_file(LadderWindow *window, LadderSideFile *file)
{
	GError *error = NULL;
	const bool good = ladder_side_file_save(file, &error);

	if (good)
		ladder_window_tell(window, _("Saved"));
	else
		ladder_window_warn(window, error->message);
	g_clear_error(&error);
	return good;
}

static void tell_bytes(LadderWindow *window, const char *button, void (*act)(LadderWindow *))
{
	char *text = g_strdup_printf(_("From line %d on the file holds bytes that are no text "
		"(UTF-8); they are shown as �. Saving would write over them."),
		ladder_document_repaired(window->document));

	window_banner(window, text, button, act);
	g_free(text);
}

void ladder_window_tell_file(LadderWindow *window)
{
	window->over_locked = false;
	if (ladder_document_repaired(window->document) > 0)
		tell_bytes(window, _("Save as…"), window_save_as);
	else if (is_locked(window))
		window_banner(window, _("The file is read-only: saving asks before it writes "
					"over it."), _("Save as…"), window_save_as);
}

/* Not over what somebody else wrote there meanwhile, nor over what cannot be shown or is
 * locked. */
bool window_save_here(LadderWindow *window)
{
	if (ladder_document_disk(window->document) == DISK_OTHER)
		window_banner(window, _("Somebody else changed the file since it was opened. "
					"Saving would write over that."),
			      _("Save all the same"), save_over);
	else if (ladder_document_repaired(window->document) > 0)
		tell_bytes(window, _("Save all the same"), save_over);
	else if (is_locked(window))
		ask_locked(window);
	else
		return save_to(window, NULL);
	return false;
}

void window_save(LadderWindow *window)
{
	/* The file in front: a scenario, an I/O map. */
	if (tabs_file(window))
		window_save_file(window, ladder_file_view_file(tabs_file(window)));
	else if (!ladder_document_path(window->document))
		window_save_as(window);
	else
		window_save_here(window);
}

/* ---- closing ---- */

static gboolean close_idle(gpointer window)
{
	gtk_window_close(GTK_WINDOW(window));
	g_object_unref(window);
	return G_SOURCE_REMOVE;
}

/* Nobody wants them, or all is saved. */
static void drop_drafts(LadderWindow *window)
{
	draft_remove(window->document);
	tabs_each_file(window, draft_remove);
}

/* Of two drafts of one file the second is a step that can be undone. */
bool ladder_window_restore_file(LadderWindow *window, const struct draft *draft)
{
	LadderFileView *there = tabs_find_file(window, draft->path);
	LadderSideFile *file = there ? g_object_ref(ladder_file_view_file(there)) :
		ladder_side_file_restore(draft->path, draft->sum, draft->text,
					 window->document);
	bool kept;

	if (there)
		ladder_side_file_put(file, draft->text, draft->sum);
	else
		tabs_put_file(window, file);
	draft_write(file);
	kept = draft_is_kept(file);
	g_object_unref(file);
	return kept;
}

bool ladder_window_has_file(LadderWindow *window, const char *path)
{
	return tabs_find_file(window, path) != NULL;
}

void ladder_window_keep_drafts(LadderWindow *window)
{
	tabs_take_typed(window);
	tabs_each_file(window, ladder_side_file_commit);
	ladder_document_disk(window->document); /* it may be gone since           */
	draft_write(window->document);
	tabs_each_file(window, draft_write);
}

/* Not while its dialog, which goes with it, still tells what was answered. */
static void close_now(LadderWindow *window)
{
	drop_drafts(window);
	window->closing = true;
	g_idle_add(close_idle, g_object_ref(window));
}

static bool save_files(LadderWindow *window)
{
	GPtrArray *files = tabs_unsaved(window);
	bool good = true;

	for (guint i = 0; good && i < files->len; i++)
		good = window_save_file(window, files->pdata[i]);
	g_ptr_array_unref(files);
	return good;
}

static void save_and_close(LadderWindow *window)
{
	if (!save_files(window))
		return;
	window->closing = true;
	if (ladder_document_is_saved(window->document))
		close_now(window);
	else if (!ladder_document_path(window->document))
		window_save_as(window);
	else if (window_save_here(window))
		close_now(window);
	else
		window->closing = false;
}

static void close_response(AdwMessageDialog *dialog, const char *response,
			   LadderWindow *window)
{
	(void)dialog;
	if (g_strcmp0(response, "discard") == 0)
		close_now(window);
	else if (g_strcmp0(response, "save") == 0)
		save_and_close(window);
}

GtkWidget *window_ask_save(LadderWindow *window, const char *name)
{
	GtkWidget *dialog = adw_message_dialog_new(GTK_WINDOW(window),
						   _("Save the changes?"), NULL);
	AdwMessageDialog *message = ADW_MESSAGE_DIALOG(dialog);

	adw_message_dialog_format_body(message,
		_("“%s” has changes that are not saved."), name);
	adw_message_dialog_add_responses(message, "cancel", _("Cancel"),
		"discard", _("Discard"), "save", _("Save"), NULL);
	adw_message_dialog_set_response_appearance(message, "discard",
						   ADW_RESPONSE_DESTRUCTIVE);
	adw_message_dialog_set_response_appearance(message, "save",
						   ADW_RESPONSE_SUGGESTED);
	adw_message_dialog_set_default_response(message, "save");
	adw_message_dialog_set_close_response(message, "cancel");
	gtk_window_present(GTK_WINDOW(dialog));
	return dialog;
}

/* "Pump, pump.scn". */
static char *unsaved_names(LadderWindow *window, const GPtrArray *files)
{
	GString *names = g_string_new(NULL);

	if (!ladder_document_is_saved(window->document)) {
		char *name = ladder_document_name(window->document);

		g_string_append(names, name);
		g_free(name);
	}
	for (guint i = 0; i < files->len; i++) {
		char *name = ladder_side_file_name(files->pdata[i]);

		g_string_append_printf(names, "%s%s", names->len ? ", " : "", name);
		g_free(name);
	}
	return g_string_free(names, FALSE);
}

bool window_may_close(LadderWindow *window)
{
	GPtrArray *files = tabs_unsaved(window);
	bool good;
	char *names;

	ladder_document_disk(window->document); /* it may be gone since           */
	good = ladder_document_is_saved(window->document) && files->len == 0;

	if (good) {
		drop_drafts(window);
	} else {
		names = unsaved_names(window, files);
		g_signal_connect(window_ask_save(window, names), "response",
				 G_CALLBACK(close_response), window);
		g_free(names);
	}
	g_ptr_array_unref(files);
	return good;
}

/* ---- somebody else ---- */

static void reload(LadderWindow *window)
{
	GError *error = NULL;
	char *path = g_strdup(ladder_document_path(window->document));

	if (ladder_document_open(window->document, path, &error)) {
		window->disk_told = DISK_AS_READ;
		ladder_window_tell_file(window);
	} else {
		window_banner(window, error->message, NULL, NULL);
	}
	g_clear_error(&error);
	g_free(path);
}

static void tell_disk(LadderWindow *window, enum disk_state state)
{
	if (state == DISK_GONE)
		window_banner(window, _("The file is gone. What you see here is all there "
					"is of it."), _("Save"), save_over);
	else if (state == DISK_OTHER)
		window_banner(window, ladder_document_is_saved(window->document) ?
			_("The file was changed by somebody else.") :
			_("The file was changed by somebody else. Reading it again "
			  "would lose what you did since."), _("Read it again"), reload);
	else if (window->disk_told == DISK_GONE)
		window_banner_close(window); /* it is there again                */
}

/* Told once: who closes the banner knows. */
static gboolean look(gpointer data)
{
	LadderWindow *window = data;
	const enum disk_state state = ladder_document_disk(window->document);

	tabs_each_file(window, ladder_side_file_look);
	window_board_look(window);
	if (state == window->disk_told || (state != DISK_AS_READ &&
	    gtk_revealer_get_reveal_child(window->banner) && window->disk_told == DISK_AS_READ))
		return G_SOURCE_CONTINUE;
	tell_disk(window, state);
	window->disk_told = state;
	return G_SOURCE_CONTINUE;
}

void window_watch_disk(LadderWindow *window)
{
	window->disk_timer = g_timeout_add_seconds(DISK_SECONDS, look, window);
}
