/* SPDX-License-Identifier: MIT
 *
 * files - opening, saving and closing; see files.h.
 */
#include "editor-gtk/window/files.h"

#include "editor-gtk/document/classic.h"
#include "editor-gtk/document/plain_file.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/window/ask.h"
#include "editor-gtk/window/messages.h"
#include "editor-gtk/window/recent.h"
#include "editor-gtk/window/tabs.h"

#include <string.h>

/* ---- opening ---- */

static void want_open(struct files *files, const char *path)
{
	g_signal_emit_by_name(files->core->window, "open-wanted", path, false);
}

static void open_response(GtkNativeDialog *dialog, int response, struct files *files)
{
	char *path = ask_take_path(dialog, response);

	if (path)
		want_open(files, path);
	g_free(path);
}

/* Adds a filter with all kinds, and selects it. */
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
	gtk_file_filter_add_pattern(filter, "*.ld");
	gtk_file_filter_add_pattern(filter, "*.xml");
	gtk_file_filter_add_pattern(filter, "project.json");
	for (int i = 0; plain_file_patterns[i]; i++)
		gtk_file_filter_add_pattern(filter, plain_file_patterns[i]);
	gtk_file_chooser_add_filter(chooser, filter);
	gtk_file_chooser_set_filter(chooser, filter);
	g_object_unref(filter);
}

static void ask_open(struct files *files, const char *title, bool import)
{
	struct core *core = files->core;
	GtkFileChooserNative *chooser = ask_rung_file(core->window, core->document, title,
		GTK_FILE_CHOOSER_ACTION_OPEN, _("Open"));

	if (!import)
		add_all(GTK_FILE_CHOOSER(chooser));
	exchange_add_filter(GTK_FILE_CHOOSER(chooser), false, import);
	exchange_add_others(GTK_FILE_CHOOSER(chooser));
	core_connect(core, chooser, "response", G_CALLBACK(open_response), files, 0);
	gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
}

void files_open(struct files *files)
{
	ask_open(files, _("Open"), false);
}

void files_import(struct files *files)
{
	ask_open(files, _("Import"), true);
}

/* ---- files that are dropped ---- */

static bool can_open(const char *path)
{
	const char *dot = strrchr(path, '.');

	return (dot && g_ascii_strcasecmp(dot, ".rung") == 0) || side_file_is(path) ||
	       plain_file_is(path) || classic_is_project(path);
}

static void tell_refused(struct files *files, const GPtrArray *refused)
{
	GString *names = g_string_new(NULL);
	char *text;

	for (guint i = 0; i < refused->len; i++)
		g_string_append_printf(names, "%s%s", i ? ", " : "",
				       (const char *)refused->pdata[i]);
	text = g_strdup_printf(_("Cannot open %s. You can drop rung files, scenarios, I/O "
				 "maps and ClassicLadder projects here."), names->str);
	messages_warn(files->core->messages, text);
	gtk_window_present(files->core->window); /* above windows that were just opened */
	g_free(text);
	g_string_free(names, TRUE);
}

static gboolean dropped(GtkDropTarget *target, const GValue *value, double x, double y,
			struct files *files)
{
	GPtrArray *refused = g_ptr_array_new_with_free_func(g_free);

	(void)target;
	(void)x;
	(void)y;
	for (const GSList *at = g_value_get_boxed(value); at; at = at->next) {
		char *path = g_file_get_path(at->data);

		if (path && can_open(path))
			want_open(files, path);
		else
			g_ptr_array_add(refused, g_file_get_basename(at->data));
		g_free(path);
	}
	if (refused->len)
		tell_refused(files, refused);
	g_ptr_array_unref(refused);
	return TRUE;
}

/* In the capture phase, because a text view would insert the file name. */
static void accept_drops(struct files *files)
{
	GtkDropTarget *drop = gtk_drop_target_new(GDK_TYPE_FILE_LIST, GDK_ACTION_COPY);

	gtk_event_controller_set_propagation_phase(GTK_EVENT_CONTROLLER(drop),
						   GTK_PHASE_CAPTURE);
	g_signal_connect(drop, "drop", G_CALLBACK(dropped), files);
	gtk_widget_add_controller(
		adw_application_window_get_content(ADW_APPLICATION_WINDOW(files->core->window)),
		GTK_EVENT_CONTROLLER(drop));
}

/* ---- saving ---- */

static void warn(struct files *files, const char *text, const char *button,
		 const char *action)
{
	messages_banner(files->core->messages, LOG_SYSTEM, text, button, action);
}

static bool save_to(struct files *files, const char *path)
{
	LadderDocument *document = files->core->document;
	const char *sample = origin_sample(files->origin);
	GError *error = NULL;

	if (!tabs_save_parts(files->core->tabs))
		return false;
	origin_will_save(files->origin, sample, path);
	if (!ladder_document_save(document, path, &error)) {
		warn(files, error->message, _("Save as…"), "win.save_as");
		g_clear_error(&error);
		return false;
	}
	files->over_locked = files->over_locked && !path;
	draft_remove(document);
	recent_add(ladder_document_path(document));
	messages_tell(files->core->messages, _("Saved"));
	messages_close_banner(files->core->messages);
	files->disk_told = DISK_AS_READ;
	origin_saved(files->origin, sample);
	return true;
}

static bool is_locked(struct files *files)
{
	const char *path = ladder_document_path(files->core->document);

	return path && !files->over_locked && disk_is_locked(path);
}

static void ask_locked(struct files *files)
{
	warn(files, _("The file is read-only. Save as another file, or overwrite this one."),
	     _("Save anyway"), "win.save-locked");
}

void files_save_over(struct files *files, bool locked)
{
	files->over_locked = files->over_locked || locked;
	if (is_locked(files))
		ask_locked(files);
	else
		save_to(files, NULL);
}

static gboolean close_idle(gpointer window)
{
	gtk_window_close(GTK_WINDOW(window));
	g_object_unref(window);
	return G_SOURCE_REMOVE;
}

/* In an idle call, because the dialog that was answered belongs to the window. */
static void close_now(struct files *files)
{
	draft_remove(files->core->document);
	tabs_each_file(files->core->tabs, draft_remove);
	files->closing = true;
	g_idle_add(close_idle, g_object_ref(files->core->window));
}

/* After an export to ClassicLadder the window stays open: the program is not saved. */
static void save_chosen(gpointer part, const char *path)
{
	struct files *files = part;

	if (classic_save_is(path))
		exchange_export_to(files->exchange, path);
	else if (save_to(files, path) && files->close_when_saved)
		close_now(files);
}

/* Endings of programs, and the one that the file has. With the ending of a scenario or an
 * I/O map the program could not be opened again. Caller frees. */
static char *program_endings(struct files *files, bool classic)
{
	const char *path = ladder_document_path(files->core->document);
	char *name = g_path_get_basename(path ? path : ""), *lower = g_utf8_strdown(name, -1);
	const char *own = strrchr(lower, '.');
	char *endings = g_strconcat(classic ? ".clprj|.clprjz|.clp|.rung" :
				    ".rung|.clprj|.clprjz|.clp", own ? "|" : NULL, own, NULL);

	g_free(lower);
	g_free(name);
	return endings;
}

static void save_response(GtkNativeDialog *dialog, int response, struct files *files)
{
	GtkFileFilter *filter = gtk_file_chooser_get_filter(GTK_FILE_CHOOSER(dialog));
	const char *kind = filter ? gtk_file_filter_get_name(filter) : NULL;
	char *endings = program_endings(files, kind && g_str_has_prefix(kind, "Classic"));
	char *path = ask_take_path(dialog, response);

	if (path)
		export_named(files->core, path, endings, save_chosen, files);
	g_free(endings);
	g_free(path);
}

/* "pump.rung" of "parts/pump.st". */
static char *rung_name(const char *path)
{
	char *base = g_path_get_basename(path), *dot = strrchr(base, '.');
	char *name = g_strdup_printf("%.*s.rung", (int)(dot ? dot - base : (long)strlen(base)), base);

	g_free(base);
	return name;
}

static void ask_path(struct files *files, bool close_when_saved)
{
	struct core *core = files->core;
	GtkFileChooserNative *chooser = ask_rung_file(core->window, core->document,
		_("Save as"), GTK_FILE_CHOOSER_ACTION_SAVE, _("Save"));
	const char *path = ladder_document_path(core->document);
	char *name = path && ladder_document_needs_rung_file(core->document) ?
		rung_name(path) : path ? g_path_get_basename(path) :
		files->origin->classic || origin_sample(files->origin) ?
		origin_name(files->origin, ".rung") : g_strdup(_("program.rung"));

	files->close_when_saved = close_when_saved;
	exchange_add_filter(GTK_FILE_CHOOSER(chooser), false, false);
	gtk_file_chooser_set_current_name(GTK_FILE_CHOOSER(chooser), name);
	g_free(name);
	core_connect(core, chooser, "response", G_CALLBACK(save_response), files, 0);
	gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
}

void files_save_as(struct files *files)
{
	ask_path(files, false);
}

static void tell_bytes(struct files *files, const char *button, const char *action)
{
	char *text = g_strdup_printf(_("From line %d on, the file contains bytes that are "
				       "not UTF-8 text; they are shown as �. Saving would "
				       "overwrite them."),
		ladder_document_repaired(files->core->document));

	warn(files, text, button, action);
	g_free(text);
}

void files_tell(struct files *files)
{
	files->over_locked = false;
	if (ladder_document_repaired(files->core->document) > 0)
		tell_bytes(files, _("Save as…"), "win.save_as");
	else if (is_locked(files))
		warn(files, _("The file is read-only. Saving asks before it overwrites the "
			      "file."),
		     _("Save as…"), "win.save_as");
}

/* Saves to the path of the document. False: not saved, or a banner asks first. */
static bool save_here(struct files *files)
{
	if (ladder_document_disk(files->core->document) == DISK_OTHER)
		warn(files, _("Another program changed the file after it was opened. Saving "
			      "would overwrite those changes."), _("Save anyway"),
		     "win.save-over");
	else if (ladder_document_repaired(files->core->document) > 0)
		tell_bytes(files, _("Save anyway"), "win.save-over");
	else if (is_locked(files))
		ask_locked(files);
	else if (ladder_document_needs_rung_file(files->core->document))
		warn(files, _("Only a rung file can hold ladders, charts, a title and bookmarks. "
			      "Save the program as a rung file."), _("Save as…"), "win.save_as");
	else
		return save_to(files, NULL);
	return false;
}

void files_save(struct files *files)
{
	LadderSideFile *file = front_file(files->core->front);

	if (file && !ladder_side_file_is_part(file))
		tabs_save_file(files->core->tabs, file);
	else if (!ladder_document_path(files->core->document))
		files_save_as(files);
	else if (save_here(files))
		tabs_save_files(files->core->tabs); /* a rename has changed them, too */
}

bool files_is_all_saved(struct files *files)
{
	GPtrArray *beside = tabs_unsaved(files->core->tabs);
	const bool saved = ladder_document_is_saved(files->core->document) && beside->len == 0;

	g_ptr_array_unref(beside);
	return saved;
}

bool files_save_all(struct files *files)
{
	return tabs_save_files(files->core->tabs) &&
	       (ladder_document_is_saved(files->core->document) || save_here(files));
}

/* ---- closing ---- */

static void save_and_close(struct files *files)
{
	if (!tabs_save_files(files->core->tabs))
		return;
	if (!ladder_document_is_saved(files->core->document) &&
	    !ladder_document_path(files->core->document))
		ask_path(files, true);
	else if (files_save_all(files))
		close_now(files);
}

static void close_answered(AdwMessageDialog *dialog, const char *answer, struct files *files)
{
	(void)dialog;
	if (g_strcmp0(answer, "discard") == 0)
		close_now(files);
	else if (g_strcmp0(answer, "save") == 0)
		save_and_close(files);
}

/* "Pump, pump.scn". Caller frees. */
static char *unsaved_names(struct files *files)
{
	GPtrArray *beside = tabs_unsaved(files->core->tabs);
	GString *names = g_string_new(NULL);

	if (!ladder_document_is_saved(files->core->document)) {
		char *name = ladder_document_name(files->core->document);

		g_string_append(names, name);
		g_free(name);
	}
	for (guint i = 0; i < beside->len; i++) {
		char *name = ladder_side_file_name(beside->pdata[i]);

		g_string_append_printf(names, "%s%s", names->len ? ", " : "", name);
		g_free(name);
	}
	g_ptr_array_unref(beside);
	return g_string_free(names, FALSE);
}

bool files_may_close(struct files *files)
{
	char *names;

	if (files->closing)
		return true;
	ladder_document_disk(files->core->document); /* detects a deleted file */
	if (files_is_all_saved(files)) {
		draft_remove(files->core->document);
		tabs_each_file(files->core->tabs, draft_remove);
		return true;
	}
	names = unsaved_names(files);
	core_connect(files->core, ask_save(files->core->window, names), "response",
		     G_CALLBACK(close_answered), files, 0);
	g_free(names);
	return false;
}

/* ---- drafts ---- */

void files_keep_drafts(struct files *files)
{
	front_take_typed(files->core->front);
	tabs_each_file(files->core->tabs, ladder_side_file_commit);
	ladder_document_disk(files->core->document); /* detects a deleted file */
	draft_write(files->core->document);
	tabs_each_file(files->core->tabs, draft_write);
}

/* If the file is open and unsaved, the draft becomes a step that can be undone. */
bool files_restore(struct files *files, const struct draft *draft)
{
	struct tabs *tabs = files->core->tabs;
	LadderFileView *there = tabs_find_file(tabs, draft->path);
	LadderSideFile *file = there ? g_object_ref(ladder_file_view_file(there)) :
		ladder_side_file_restore(draft->path, draft->sum, draft->text,
					 files->core->document);
	bool kept;

	if (there)
		ladder_side_file_put(file, draft->text, draft->sum);
	else
		tabs_put_file(tabs, file);
	draft_write(file);
	kept = draft_is_kept(file);
	g_object_unref(file);
	return kept;
}

/* ---- what others do to the file ---- */

void files_reload(struct files *files)
{
	GError *error = NULL;
	char *path = g_strdup(ladder_document_path(files->core->document));

	if (ladder_document_open(files->core->document, path, &error)) {
		files->disk_told = DISK_AS_READ;
		files_tell(files);
	} else {
		messages_warn(files->core->messages, error->message);
	}
	g_clear_error(&error);
	g_free(path);
}

static void tell_disk(struct files *files, enum disk_state state)
{
	if (state == DISK_GONE)
		warn(files, _("The file was deleted or moved. Save it to keep what you see "
			      "here."),
		     _("Save"), "win.save-over");
	else if (state == DISK_OTHER)
		warn(files, ladder_document_is_saved(files->core->document) ?
			_("Another program changed the file.") :
			_("Another program changed the file. Reloading it would discard your "
			  "changes."), _("Reload"), "win.reload");
	else if (files->disk_told == DISK_GONE)
		messages_close_banner(files->core->messages); /* the file exists again */
}

/* Each change is reported once: a closed banner stays closed. */
void files_look(struct files *files)
{
	const enum disk_state state = ladder_document_disk(files->core->document);

	tabs_each_file(files->core->tabs, ladder_side_file_look);
	if (state == files->disk_told || (state != DISK_AS_READ &&
	    messages_has_banner(files->core->messages) && files->disk_told == DISK_AS_READ))
		return;
	tell_disk(files, state);
	files->disk_told = state;
}

void files_init(struct files *files, struct core *core, struct origin *origin,
		struct exchange *exchange)
{
	files->core = core;
	files->origin = origin;
	files->exchange = exchange;
	accept_drops(files);
}
