/* SPDX-License-Identifier: MIT
 *
 * online_move - see online_move.h.
 */
#include "editor-gtk/window/online_move.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/iomap_beside.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/window/ask.h"
#include "editor-gtk/window/below.h"
#include "editor-gtk/window/messages.h"
#include "editor-gtk/window/tabs.h"

#include <string.h>
#include <sys/prctl.h>

#define MAP_MOST   (4 << 20) /* bytes of a map, as in ladderd                  */
#define LOSSES_PX  160       /* height of the list of losses                   */

static void warn(struct online_move *move, const char *text)
{
	messages_banner(move->core->messages, LOG_COMMUNICATION, text, NULL, NULL);
}

static const char *board_name(struct online_move *move)
{
	return ladder_board_link_board(move->core->link);
}

static bool is_empty(struct online_move *move)
{
	const struct board_status *status = ladder_board_link_status(move->core->link);

	return status && !status_has_program(status);
}

/* ---- what the board stores ---- */

static void upload(struct online_move *move);
static void ask_password(struct online_move *move, const char *why);

static void unlocked(gpointer data, struct board_answer *answer)
{
	struct online_move *move = data;

	if (answer->end == DESK_REFUSED) {
		ask_password(move, answer->text);
	} else if (answer->end != DESK_GOOD) {
		warn(move, answer->text);
	} else {
		ladder_board_values_again(move->core->values);
		upload(move);
	}
}

static void password_answered(AdwMessageDialog *dialog, const char *answer,
			      struct online_move *move)
{
	GtkEditable *entry = GTK_EDITABLE(adw_message_dialog_get_extra_child(dialog));

	if (strcmp(answer, "answer") == 0)
		board_unlock(move->core->link, gtk_editable_get_text(entry), move->core->window,
			     unlocked, move);
	prctl(PR_SET_DUMPABLE, 1);
}

/* While it is typed, no core has it. */
static void ask_password(struct online_move *move, const char *why)
{
	char *heading = g_strdup_printf(_("Program password of “%s”"), board_name(move));
	AdwMessageDialog *dialog = ask_new(move->core->window, heading, why, "answer", _("OK"),
					   ADW_RESPONSE_SUGGESTED);

	prctl(PR_SET_DUMPABLE, 0);
	adw_message_dialog_set_extra_child(dialog, ask_secret(heading));
	core_connect(move->core, dialog, "response", G_CALLBACK(password_answered), move, 0);
	gtk_window_present(GTK_WINDOW(dialog));
	g_free(heading);
}

static void uploaded(gpointer data, struct board_copy *copy, const char *why, bool locked)
{
	struct online_move *move = data;

	if (locked)
		ask_password(move, why);
	else
		move->copied(move, copy, why);
}

static void upload(struct online_move *move)
{
	board_upload(move->core->link, move->core->window, uploaded, move);
}

/* ---- comparison ---- */

static void no_sources(struct online_move *move)
{
	warn(move, _("The board stores no sources, only its code. Download a program from this "
		     "editor: it stores them, too."));
}

static void compare_came(struct online_move *move, struct board_copy *copy, const char *why)
{
	struct compare_side side;

	if (!copy) {
		warn(move, why);
	} else if (!copy->text) {
		no_sources(move);
	} else {
		side = (struct compare_side){
			.name = g_strdup_printf(_("%s, on the board"), board_name(move)),
			.text = g_steal_pointer(&copy->text),
			.files = g_steal_pointer(&copy->files),
			.map = g_steal_pointer(&copy->map),
		};
		side.len = strlen(side.text);
		compare_with(move->compare, &side);
	}
	board_copy_free(copy);
}

void online_move_compare(struct online_move *move)
{
	move->copied = compare_came;
	upload(move);
}

/* ---- upload ---- */

/* "garage-door.io" of "garage-door.rung". Caller frees. */
static char *map_name(const char *program)
{
	const char *dot = strrchr(program, '.');

	return g_strdup_printf("%.*s.io", dot ? (int)(dot - program) : (int)strlen(program), program);
}

static void folder_chosen(GtkNativeDialog *chooser, int response, struct online_move *move)
{
	char *folder = ask_take_path(chooser, response), *map, *why, *path;

	if (folder && move->copy) {
		map = map_name(move->copy->name);
		why = board_copy_save(move->copy, folder, map);
		if (why) {
			warn(move, why);
		} else {
			path = g_build_filename(folder, move->copy->name, NULL);
			g_signal_emit_by_name(move->core->window, "open-on-board-wanted", path);
			g_free(path);
		}
		g_free(why);
		g_free(map);
	}
	g_clear_pointer(&move->copy, board_copy_free);
	g_free(folder);
}

/* A board without sources gives lists. */
static void make_lists(struct online_move *move, struct board_copy *copy)
{
	char *lost = board_copy_make_lists(copy), *text;

	if (copy->text && !lost) {
		warn(move, _("The board stores no sources. This is its program as instruction lists, "
			     "made from its code."));
	} else if (copy->text) {
		text = g_strdup_printf(_("The board stores no sources. This is its program as "
			"instruction lists, made from its code. Not expressed: %s"), g_strchomp(lost));
		warn(move, text);
		g_free(text);
	}
	g_free(lost);
}

static void upload_came(struct online_move *move, struct board_copy *copy, const char *why)
{
	GtkFileChooserNative *chooser;

	if (!copy) {
		warn(move, why);
		return;
	}
	if (!copy->text)
		make_lists(move, copy);
	if (!copy->text) {
		no_sources(move);
		board_copy_free(copy);
		return;
	}
	g_clear_pointer(&move->copy, board_copy_free);
	move->copy = copy;
	chooser = gtk_file_chooser_native_new(_("Folder for the program of the board"),
		move->core->window, GTK_FILE_CHOOSER_ACTION_SELECT_FOLDER, _("Upload"), _("Cancel"));
	gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(chooser), TRUE);
	core_connect(move->core, chooser, "response", G_CALLBACK(folder_chosen), move, 0);
	gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
}

void online_move_upload(struct online_move *move)
{
	move->copied = upload_came;
	upload(move);
}

/* ---- download: its dialog ---- */

static void close_dialog(struct online_move *move)
{
	AdwMessageDialog *dialog = move->dialog;

	move->dialog = NULL;
	move->progress = NULL;
	if (dialog)
		gtk_window_destroy(GTK_WINDOW(dialog));
}

static void forget_download(struct online_move *move)
{
	if (move->download) {
		g_signal_handlers_disconnect_by_data(move->download, move);
		ladder_board_download_cancel(move->download);
	}
	g_clear_object(&move->download);
	close_dialog(move);
}

static void answered(AdwMessageDialog *dialog, const char *answer, struct online_move *move)
{
	const bool restart = strcmp(answer, "restart") == 0;

	if (dialog != move->dialog)
		return;
	move->dialog = NULL; /* it closes itself */
	move->progress = NULL;
	if (restart || strcmp(answer, "download") == 0)
		ladder_board_download_commit(move->download, restart);
	else
		forget_download(move);
}

static AdwMessageDialog *dialog_new(struct online_move *move, const char *heading, const char *body)
{
	AdwMessageDialog *dialog = ADW_MESSAGE_DIALOG(adw_message_dialog_new(move->core->window,
									     heading, body));

	adw_message_dialog_add_response(dialog, "cancel", _("Cancel"));
	adw_message_dialog_set_close_response(dialog, "cancel");
	core_connect(move->core, dialog, "response", G_CALLBACK(answered), move, 0);
	return dialog;
}

static void show_progress(struct online_move *move)
{
	char *heading;

	if (!move->dialog) {
		heading = g_strdup_printf(_("Sending to “%s”"), board_name(move));
		move->dialog = dialog_new(move, heading, is_empty(move) ?
					  _("The board has no program.") :
					  _("The board goes on with its program."));
		move->progress = gtk_progress_bar_new();
		spoken_name(move->progress, heading);
		adw_message_dialog_set_extra_child(move->dialog, move->progress);
		gtk_window_present(GTK_WINDOW(move->dialog));
		g_free(heading);
	}
	gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(move->progress),
				      ladder_board_download_part(move->download));
}

/* What a person would lose, a line each. */
static GtkWidget *losses_new(struct online_move *move)
{
	GPtrArray *losses = ladder_board_download_losses(move->download);
	const guint more = ladder_board_download_more(move->download);
	GtkWidget *scrolled = gtk_scrolled_window_new();
	GString *text = g_string_new(NULL);
	GtkWidget *label;

	for (guint i = 0; i < losses->len; i++)
		g_string_append_printf(text, "%s%s", i ? "\n" : "", (char *)losses->pdata[i]);
	if (more)
		g_string_append_printf(g_string_append_c(text, '\n'), _("and %u more"), more);
	label = gtk_label_new(text->str);
	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_label_set_yalign(GTK_LABEL(label), 0);
	gtk_label_set_wrap(GTK_LABEL(label), TRUE);
	gtk_label_set_selectable(GTK_LABEL(label), TRUE);
	gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scrolled), GTK_POLICY_NEVER,
				       GTK_POLICY_AUTOMATIC);
	gtk_scrolled_window_set_max_content_height(GTK_SCROLLED_WINDOW(scrolled), LOSSES_PX);
	gtk_scrolled_window_set_propagate_natural_height(GTK_SCROLLED_WINDOW(scrolled), TRUE);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scrolled), label);
	g_string_free(text, TRUE);
	return scrolled;
}

static void ask(struct online_move *move)
{
	const bool restart = ladder_board_download_needs_restart(move->download);
	const guint losses = ladder_board_download_losses(move->download)->len +
			     ladder_board_download_more(move->download);
	char *heading = g_strdup_printf(_("Download to “%s”?"), board_name(move));
	const char *body = is_empty(move) ?
		_("The board has no program yet, so there are no values to keep.") : restart ?
		_("The I/O map differs from the one of the board, so ladderd begins again with "
		  "it: the outputs get their safe values for a moment, and values that are not "
		  "retained begin anew.") : losses ?
		_("The new program replaces the old one between two scans; no scan is missed. "
		  "These values do not go on:") :
		_("The new program replaces the old one between two scans; no scan is missed. "
		  "All values go on.");

	close_dialog(move);
	move->dialog = dialog_new(move, heading, body);
	adw_message_dialog_add_response(move->dialog, "restart", restart ? _("Download and restart") :
					_("With a restart"));
	if (!restart)
		adw_message_dialog_add_response(move->dialog, "download", _("Download"));
	adw_message_dialog_set_response_appearance(move->dialog, restart ? "restart" : "download",
		restart || losses ? ADW_RESPONSE_DESTRUCTIVE : ADW_RESPONSE_SUGGESTED);
	adw_message_dialog_set_default_response(move->dialog, restart ? "restart" : "download");
	if (losses)
		adw_message_dialog_set_extra_child(move->dialog, losses_new(move));
	gtk_window_present(GTK_WINDOW(move->dialog));
	g_free(heading);
}

static void download_ended(struct online_move *move, const char *why)
{
	char *text = NULL;

	if (!why)
		text = g_strdup_printf(_("Downloaded to “%s”"), board_name(move));
	if (text) {
		messages_toast(move->core->messages, text);
		messages_log(move->core->messages, LOG_OPERATOR, text);
	} else if (*why) {
		warn(move, why);
	}
	g_free(text);
	forget_download(move);
}

static void download_changed(struct online_move *move)
{
	LadderBoardDownload *download = g_object_ref(move->download);

	switch (ladder_board_download_state(download)) {
	case DOWNLOAD_SENDS: show_progress(move); break;
	case DOWNLOAD_ASKS: ask(move); break;
	case DOWNLOAD_COMMITS: break;
	case DOWNLOAD_DONE: download_ended(move, NULL); break;
	case DOWNLOAD_FAILED: download_ended(move, ladder_board_download_why(download)); break;
	}
	g_object_unref(download);
}

/* ---- download: its map ---- */

/* True, and tells so: the board has not answered to a download yet. */
static bool is_committing(struct online_move *move)
{
	if (!move->download ||
	    ladder_board_download_state(move->download) != DOWNLOAD_COMMITS)
		return false;
	messages_tell(move->core->messages, _("The board has not answered to the last download "
					      "yet. Wait for it, then download again"));
	return true;
}

static void send_with(struct online_move *move, const char *map)
{
	GError *error = NULL;
	struct board_program *program;

	if (is_committing(move))
		return;
	program = board_program_new(move->core->document, map, &error);
	forget_download(move);
	if (!program) {
		warn(move, error->message);
		g_error_free(error);
		return;
	}
	move->download = ladder_board_download_new(move->core->link, program);
	core_connect(move->core, move->download, "changed", G_CALLBACK(download_changed), move,
		     G_CONNECT_SWAPPED);
	board_program_unref(program);
}

static void map_came(struct online_move *move, struct board_copy *copy, const char *why)
{
	if (copy)
		send_with(move, copy->map);
	else
		warn(move, why);
	board_copy_free(copy);
}

static void map_answered(AdwMessageDialog *dialog, const char *answer, struct online_move *move)
{
	(void)dialog;
	if (strcmp(answer, "board") == 0) {
		move->copied = map_came;
		upload(move);
	} else if (strcmp(answer, "map") == 0) {
		core_do(move->core, "win.new_iomap");
	}
}

static void ask_map(struct online_move *move)
{
	AdwMessageDialog *dialog = ask_new(move->core->window, _("Which I/O map?"),
		_("The project has no I/O map, which says what pin each input and output uses. "
		  "The board can keep its own one."), "board", _("Keep the board's map"),
		ADW_RESPONSE_SUGGESTED);

	adw_message_dialog_add_response(dialog, "map", _("New I/O map…"));
	core_connect(move->core, dialog, "response", G_CALLBACK(map_answered), move, 0);
	gtk_window_present(GTK_WINDOW(dialog));
}

/* As it is in its page, saved or not. NULL: it cannot be read. Caller frees. */
static char *map_text(struct online_move *move, const char *path, GError **error)
{
	LadderFileView *view = tabs_find_file(move->core->tabs, path);
	gsize len;

	return view ? ladder_side_file_text(ladder_file_view_file(view)) :
	       disk_read(path, MAP_MOST, &len, error);
}

void online_move_download(struct online_move *move)
{
	const char *path = ladder_document_path(move->core->document);
	char *map = path ? iomap_beside(path) : NULL, *text;
	GError *error = NULL;

	ladder_document_check_now(move->core->document);
	if (is_committing(move)) {
		g_free(map);
		return;
	}
	if (!ladder_document_project(move->core->document) ||
	    ladder_document_diags(move->core->document)->errors) {
		below_show_error(move->core->below);
		messages_tell(move->core->messages, _("Cannot download a program with errors"));
	} else if (!map) {
		ask_map(move);
	} else {
		text = map_text(move, map, &error);
		if (text)
			send_with(move, text);
		else
			warn(move, error->message);
		g_clear_error(&error);
		g_free(text);
	}
	g_free(map);
}

/* ---- life ---- */

void online_move_init(struct online_move *move, struct core *core, struct compare *compare)
{
	*move = (struct online_move){ .core = core, .compare = compare };
}

void online_move_clear(struct online_move *move)
{
	if (move->download)
		g_signal_handlers_disconnect_by_data(move->download, move);
	g_clear_object(&move->download);
	g_clear_pointer(&move->copy, board_copy_free);
}
